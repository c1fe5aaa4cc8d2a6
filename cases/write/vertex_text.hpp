// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The positions of a draw as a case file writes them.
#pragma once

#include <string>
#include <vector>

#include "cases/model/draw.hpp"

namespace cases {

struct VertexText {
    bool is_pixels = false;             // otherwise the space is "clip"
    std::vector<std::string> vertices;  // "[x,y]" and so on, one a vertex
};
// In pixels if every vertex has a position there that the loader converts to the very bits of the
// draw, and that lies within 2^24 pixels of the corner: farther ones say less than clip space does.
VertexText vertex_text(const Draw& draw);

}  // namespace cases
