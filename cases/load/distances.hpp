// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Clip and cull distances of a draw.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "cases/load/attributes.hpp"
#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"
#include "cases/toml/toml_reader.hpp"

namespace cases {

// Magnitudes of distances other than zero: far from underflow and overflow of what a device
// computes with them.
inline constexpr float kMinDistance = 0x1p-60F;
inline constexpr float kMaxDistance = 0x1p60F;

// The distances of every vertex, in the order of `source.vertices`, whose clip-space positions are
// `positions`. `draw` is the table of the draw. Mistakes go to the context.
ClipDistances read_distances(LeafContext& context, const TomlValue& draw,
                             const AttributeSource& source,
                             const std::vector<glm::vec4>& positions);

}  // namespace cases
