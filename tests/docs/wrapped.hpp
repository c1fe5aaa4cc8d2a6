// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How the generated pages break their lines.
#pragma once

#include <string>
#include <string_view>

// The words of `text` in lines of at most 120 columns, with a line break at the end. `indent`
// stands before each line but the first; a word that is longer than a line gets one of its own.
inline std::string wrapped(std::string_view text, std::string_view indent = "") {
    constexpr size_t kColumns = 120;
    std::string out;
    size_t column = 0;
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        text.remove_prefix(word.size() == text.size() ? word.size() : word.size() + 1);
        if (column > 0 && column + 1 + word.size() > kColumns) {
            out += "\n" + std::string(indent) + std::string(word);
            column = indent.size() + word.size();
        } else {
            out += (column > 0 ? " " : "") + std::string(word);
            column += (column > 0 ? 1 : 0) + word.size();
        }
    }
    return out + "\n";
}
