// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A set of stencils in words.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "ref/stencil/outcome.hpp"

namespace ref::stencil {

// The values in ascending order with `between` between them, "3 or 4"; of more than `most` the
// first ones and how many there are besides, "0 or 1 and 14 others".
std::string to_text(const Values& values, std::string_view between, size_t most);

}  // namespace ref::stencil
