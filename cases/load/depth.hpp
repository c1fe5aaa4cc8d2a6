// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Depth, stencil and written depth of a draw. A mistake goes to the context, and what is returned
// then means nothing.
#pragma once

#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"
#include "cases/toml/toml_reader.hpp"

namespace cases {

// Reads the table `depth` of a draw.
DepthState read_depth_state(LeafContext& context, const TomlValue& value);

// Reads the table `frag_depth` of a draw. What it must be beside the rest of the draw is checked
// once that is known.
FragDepth read_frag_depth(LeafContext& context, const TomlValue& value);
void check_frag_depth(LeafContext& context, const TomlValue& value, const Draw& draw);

// Reads the table `stencil` of a draw: keys of both faces, and those of one in `front` and `back`.
StencilState read_stencil_state(LeafContext& context, const TomlValue& value, const Target& target);

}  // namespace cases
