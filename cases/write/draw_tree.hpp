// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cases/model/case.hpp"
#include "cases/toml/toml_reader.hpp"

namespace cases {

// The table [[draw]] of a case with the tables inside it.
TomlValue draw_tree(const Draw& draw, const Target& target);

bool same_color(const glm::vec4& a, const glm::vec4& b);  // bit for bit

// The four numbers of a colour.
TomlValue color_value(const glm::vec4& color);

}  // namespace cases
