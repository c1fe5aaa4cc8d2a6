// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The stencils that a sample may hold, as a set and in words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "ref/stencil/outcome.hpp"

namespace ref::stencil {

// All that a sample may hold: what goes with these hits, front and back; with hits that no course
// of events has, and with none given, any that it may hold. Without a course it is what it was
// cleared to; `is_free`: nothing is claimed of it.
Values values_of(std::span<const Outcome> outcomes, bool is_free, uint32_t clear,
                 const std::optional<std::pair<uint32_t, uint32_t>>& hits);

// The least of at least one value.
uint32_t least_of(const Values& values);

// The values in ascending order with `between` between them, "3 or 4"; of more than `most` the
// first ones and how many there are besides, "0 or 1 and 14 others".
std::string to_text(const Values& values, std::string_view between, size_t most);

}  // namespace ref::stencil
