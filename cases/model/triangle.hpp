// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cases/model/case.hpp"

namespace cases {

// One assembled triangle. Vertex numbers are indices into Draw::positions (after the index buffer).
// Vertex order and provoking vertex as in the Vulkan specification, "Primitive Topologies": list
// {3i,3i+1,3i+2}; strip {i, i+(1+i%2), i+(2-i%2)}; fan {i+1, i+2, 0}. The provoking vertex is 3i, i
// and i+1 with the first-vertex convention; 3i+2, i+2 and i+2 with the last-vertex convention,
// which changes nothing else.
struct Triangle {
    uint32_t draw = 0;
    uint32_t primitive = 0;  // gl_PrimitiveID: counts per instance of a draw, culled ones
                             // included, not reset by restart
    std::array<uint32_t, 3> vertex{};
    uint32_t provoking = 0;  // one of vertex[0..2]; vertex[0] with the first-vertex convention
};

// A clear has one triangle for each rectangle and layer, layers of a rectangle side by side.
inline const Rect& rect_of(const Clear& clear, const Triangle& t) {
    return clear.rects[t.primitive / clear.layers];
}
inline uint32_t layer_of(const Draw& draw, const Triangle& t) {
    return draw.layer + (draw.clear ? t.primitive % draw.clear->layers : 0);
}

// All triangles of a case in drawing order: draw by draw, instance by instance [Vulkan
// specification, "Primitive Order"]. Incomplete ones at the end (or before a restart) are
// dropped.
std::vector<Triangle> assemble(const Case& c);
// Those of draw number `draw` alone.
std::vector<Triangle> assemble(const Case& c, uint32_t draw);

}  // namespace cases
