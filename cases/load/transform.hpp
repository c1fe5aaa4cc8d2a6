// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// mirror, rotate, offset, winding, first and order: the same draw in another place, orientation or
// order.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cases/generate/vertices.hpp"
#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"

namespace cases {

// Moves the vertices as the draw's keys mirror, rotate and offset say. Pixels turn about the centre
// of the target, ndc about the origin; clip space has no such keys.
void move_vertices(LeafContext& context, const TomlValue& draw, Space space, const Target& target,
                   std::vector<ExactVertex>& vertices);

// The order of the vertices that winding, first and order ask for: element i is the number of the
// vertex that comes i-th. Vertices after the last whole triangle stay. Only lists without indices.
std::optional<std::vector<uint32_t>> vertex_order(LeafContext& context, const TomlValue& draw,
                                                  Topology topology, bool indexed,
                                                  size_t vertex_count);

}  // namespace cases
