// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Depth in a case file: the target's format and clear value, and the depth state of a draw.
#pragma once

#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"

namespace cases {

// Reads `depth` and `depth_clear` of [target]; mistakes go to the context.
void read_depth_target(LeafContext& context, const TomlValue& table, Target& target);

// Reads the table `depth` of a draw.
DepthState read_depth_state(LeafContext& context, const TomlValue& value);

}  // namespace cases
