// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace report {

// Text for a terminal of `width` columns: lines are broken at spaces, what follows is indented two
// columns deeper than the line's beginning. Escape sequences take no room. Words longer than a line
// and lines with a command to copy ("rerun: ", "explain: ", pictures) stay whole.
std::string wrapped(std::string_view text, uint32_t width);

}  // namespace report
