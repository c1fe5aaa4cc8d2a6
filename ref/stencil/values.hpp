// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The stencils that a sample may hold, as a set and in words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "ref/stencil/operation.hpp"

namespace ref::stencil {

// The least of at least one value.
uint32_t least_of(const Values& values);

// The values in ascending order with `between` between them, "3 or 4"; of more than `most` the
// first ones and how many there are besides, "0 or 1 and 14 others".
std::string to_text(const Values& values, std::string_view between, size_t most);

}  // namespace ref::stencil
