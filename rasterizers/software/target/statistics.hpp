// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The pipeline statistics of what comes before rasterization: vertices and primitives that are
// assembled, vertices that are shaded.
#pragma once

#include <cstdint>
#include <span>

#include "cases/model/case.hpp"
#include "rasterizers/software/assembly.hpp"
#include "rasterizers/software/choice/device.hpp"
#include "rasterizers/software/target/query_unit.hpp"

namespace software {

// Counts them for draw `number`, whose primitives these are.
void count_assembled(const cases::Draw& draw, uint32_t number,
                     std::span<const Primitive> primitives, const Device& device,
                     QueryUnit& queries);

}  // namespace software
