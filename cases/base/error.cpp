// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/base/error.hpp"

namespace cases {

std::string to_string(const Error& error) {
    std::string text;
    if (!error.where.file.empty()) {
        text = error.where.file + ":";
        if (error.where.line != 0) {
            text +=
                std::to_string(error.where.line) + ":" + std::to_string(error.where.column) + ":";
        }
        text += " ";
    }
    return text + "error: " + error.message;
}

}  // namespace cases
