// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The positions of a draw as a case file writes them.
#pragma once

#include <vector>

#include "cases/model/draw.hpp"
#include "cases/toml/toml_reader.hpp"

namespace cases {

struct VertexTree {
    bool is_pixels = false;           // otherwise the space is "clip"
    std::vector<TomlValue> vertices;  // [x, y] and so on, one a vertex
};
// In pixels if every vertex has a position there that the loader converts to the very bits of the
// draw, and that lies within 2^24 pixels of the corner: farther ones say less than clip space does.
VertexTree vertex_tree(const Draw& draw);

}  // namespace cases
