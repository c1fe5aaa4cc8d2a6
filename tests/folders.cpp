// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "folders.hpp"

namespace test_support {

std::string source_dir() {
    return EDGECASE_SOURCE_DIR;
}

std::string binary_dir() {
    return EDGECASE_BINARY_DIR;
}

}  // namespace test_support
