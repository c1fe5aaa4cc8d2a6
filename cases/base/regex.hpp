// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Regular expressions in the syntax of RE2, searched in time and memory that are linear in the
// text: an expression of a file or a command line can neither hang nor overflow the stack.
#pragma once

#include <optional>
#include <string_view>
#include <utility>

#include "cases/base/error.hpp"

namespace cases {

// Error: "'(' is not a regular expression (missing ): ()".
Expected<void> check_regex(std::string_view regex);

// Where the leftmost match begins and ends, in bytes; nothing if there is none. An expression that
// check_regex refuses has none.
std::optional<std::pair<size_t, size_t>> find_regex(std::string_view regex, std::string_view text);

}  // namespace cases
