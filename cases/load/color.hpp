// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The keys that speak of colour: [target] color, [[draw]] color, a format.
#pragma once

#include <optional>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"

namespace cases {

// The word of a format.
std::optional<ColorFormat> read_format(LeafContext& context, const TomlValue& value);

// The table [target.color].
std::optional<ColorTarget> read_color_target(LeafContext& context, const TomlValue& value);

// The table `color` of a draw. `attributes`: those of the draw.
ColorOutput read_color_output(LeafContext& context, const TomlValue& value,
                              const ColorTarget& target, const std::vector<Attribute>& attributes);

}  // namespace cases
