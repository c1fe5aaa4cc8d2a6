// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cases/fault/fault.hpp"
#include "cases/model/case.hpp"
#include "rasterizers/software/choice/device.hpp"
#include "rasterizers/software/target/query_unit.hpp"

namespace software {

// Three vertex numbers in the order that the topology gives them, and where flat values come from.
struct Primitive {
    std::array<uint32_t, 3> vertex{};
    uint32_t provoking = 0;            // vertex number
    uint32_t id = 0;                   // gl_PrimitiveID
    std::array<uint32_t, 3> values{};  // whose values that vary the three vertices have
    uint32_t number = 0;               // in its draw
};

// The triangles of a draw, as an input assembler walks the index stream: a window of the last
// vertices and a parity bit for strips, hub and last rim vertex for fans.
std::vector<Primitive> assemble_primitives(const cases::Draw& draw, Fault fault);

// Counts the pipeline statistics of what comes before rasterization for draw `number`, whose
// primitives these are: vertices and primitives that are assembled, vertices that are shaded.
void count_assembled(const cases::Draw& draw, uint32_t number,
                     std::span<const Primitive> primitives, const Device& device,
                     QueryUnit& queries);

}  // namespace software
