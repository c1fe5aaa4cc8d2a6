// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The pipeline statistics of what comes before rasterization: vertices and primitives that are
// assembled, vertices that are shaded.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "cases/model/case.hpp"
#include "rasterizers/software/choice/device.hpp"
#include "rasterizers/software/target/query_unit.hpp"

namespace software {

// The vertices of a triangle.
using Corners = std::array<uint32_t, 3>;

// Counts them for draw `number`, whose primitives these are.
void count_assembled(const cases::Draw& draw, uint32_t number, std::span<const Corners> primitives,
                     const Device& device, QueryUnit& queries);

}  // namespace software
