// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The parts of a case file: load_*.cpp and attributes.cpp read them. A mistake goes to the context,
// and what is returned then means nothing.
#pragma once

#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cases/load/attributes.hpp"
#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"
#include "cases/toml/toml_reader.hpp"

namespace cases {

// Mistakes end up in the context; the target then has no width.
Target load_target(LeafContext& context, const TomlValue& table);

// Reads the table `depth` of a draw.
DepthState read_depth_state(LeafContext& context, const TomlValue& value);

// Reads the table `frag_depth` of a draw. What it must be beside the rest of the draw is checked
// once that is known.
FragDepth read_frag_depth(LeafContext& context, const TomlValue& value);
void check_frag_depth(LeafContext& context, const TomlValue& value, const Draw& draw);

// Reads `fragment_size` of a draw; and what it must be beside the rest of the draw, once that is
// known.
void read_fragment_size(LeafContext& context, const TomlValue& table, Draw& draw);
void check_fragment_size(LeafContext& context, const TomlValue& table, const Draw& draw,
                         const Target& target);

// Reads the table `stencil` of a draw: keys of both faces, and those of one in `front` and `back`.
StencilState read_stencil_state(LeafContext& context, const TomlValue& value, const Target& target);

// One [[draw]] table. `index` of the draw, from 0, stands in notes. Mistakes go to the context; the
// result is then meaningless.
Draw load_draw(LeafContext& context, const TomlValue& table, const Target& target, size_t index,
               std::vector<std::string>& notes);

// Magnitudes of distances other than zero: far from underflow and overflow of what a device
// computes with them.
inline constexpr float kMinDistance = 0x1p-60F;
inline constexpr float kMaxDistance = 0x1p60F;

// The distances of every vertex, in the order of `source.vertices`, whose clip-space positions are
// `positions`. `draw` is the table of the draw. Mistakes go to the context.
ClipDistances read_distances(LeafContext& context, const TomlValue& draw,
                             const AttributeSource& source,
                             const std::vector<glm::vec4>& positions);

// The table [blit] of a case whose target has been read: a colour target alone.
std::optional<Blit> load_blit(LeafContext& context, const TomlValue& table, const Target& target);

// Reads the relations of a case whose target and draws have been read.
std::vector<Relation> load_relations(LeafContext& context, const TomlValue& value, const Case& c);

}  // namespace cases
