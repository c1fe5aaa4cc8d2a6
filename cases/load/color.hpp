// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The keys that speak of colour: [target] color, [[draw]] color, a format.
#pragma once

#include <optional>

#include "cases/model/case.hpp"
#include "cases/model/words.hpp"
#include "cases/toml/field_reader.hpp"

namespace cases {

// The equations of a word of kBlendWords, by its index from 1; the constants are 0.
Blend blend_of_word(size_t index);

// Four numbers, and for integer formats whole ones that the format holds.
std::optional<glm::vec4> read_color(LeafContext& context, const TomlValue& value,
                                    const std::string& what, ColorFormat format);

// The table [target.color].
std::optional<ColorTarget> read_color_target(LeafContext& context, const TomlValue& value);

// The key `color` of a draw to a target that has one, whose attributes have been read: a table, or
// a list of them where the target has several colours.
void read_color_outputs(LeafContext& context, const TomlValue& value, const Target& target,
                        Draw& draw);

}  // namespace cases
