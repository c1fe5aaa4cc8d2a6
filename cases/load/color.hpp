// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Formats of the colour target, and the keys that speak of colour: [target] color, [[draw]] color.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"

namespace cases {

// As it is written in case files: "rgba8-unorm".
std::string_view name_of(ColorFormat format);

enum class ComponentKind : uint8_t { unorm, srgb, half, binary32, uint };
// How component k (0: red ... 3: alpha) of a format is stored. bits == 0: the format lacks it.
struct ComponentFormat {
    ComponentKind kind = ComponentKind::unorm;
    uint32_t bits = 0;
};
ComponentFormat component_of(ColorFormat format, uint32_t k);
// Whole numbers; never blended.
bool is_integer(ColorFormat format);

// The word of a format.
std::optional<ColorFormat> read_format(LeafContext& context, const TomlValue& value);

// The table [target.color].
std::optional<ColorTarget> read_color_target(LeafContext& context, const TomlValue& value);

// The table `color` of a draw. `attributes`: those of the draw.
ColorOutput read_color_output(LeafContext& context, const TomlValue& value,
                              const ColorTarget& target, const std::vector<Attribute>& attributes);

}  // namespace cases
