// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Text of unknown origin, made safe to show.
#pragma once

#include <string>
#include <string_view>

#include "cases/base/fields.hpp"

namespace cases {

// Text that a driver or file may have filled with anything, made safe for a terminal or XML:
// valid UTF-8, no control characters but newline and tab (shown as \xNN).
std::string printable(std::string_view bytes);
// The same as text or an attribute value in double quotes of HTML and XML: printable() leaves only
// what XML 1.0 allows (section 2.2); ">" is escaped too, so that "]]>" never appears.
std::string markup(std::string_view bytes);

// All texts of a structure (fields.hpp).
void make_printable(auto& structure) {
    change_texts(structure, [](std::string& text) { text = printable(text); });
}

}  // namespace cases
