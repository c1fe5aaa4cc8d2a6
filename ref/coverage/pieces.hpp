// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a device may show of a clipped triangle that it draws in pieces. "One algorithm that achieves
// the required behavior is to triangulate a polygon (without adding any vertices) and then treat
// each triangle individually" (Vulkan specification, "Basic Polygon Rasterization"). NVIDIA 580 does.
//
// Conservative draws enlarge or fill each piece by itself: along an edge between two pieces an
// overestimated pixel is covered once by each that reaches it, since "the tie-breaking rule ...
// does not apply" ("Conservative Rasterization"), and an underestimated one by none. Which edges lie
// between pieces is the device's choice: any from a vertex of the polygon to one that is not its
// neighbour. How far a piece reaches beyond its edges is free where the size is, and where the
// corners are (pixel_area.hpp).
//
// All other draws cover each sample of a convex polygon once, however it is divided. But a polygon
// so thin that its rounded corners may run either way round may fold: of its pieces, one may then
// face the front and another, over it, the back. (A fold at a corner of any other polygon is thinner
// than a unit of the grid, and its back face is not expected.)
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ref/coverage/setup.hpp"

namespace ref {

// How many triangles a polygon may be drawn as, but for one.
inline uint32_t further_pieces(const Outline& o) {
    return o.count > 3 ? o.count - 3 : 0;
}

// The same of an overestimated triangle of which nothing is known.
inline uint32_t further_if_undefined(const PixelArea& area) {
    return area.is_over() ? kMaxClippedVertices - 3 : 0;
}

// Whether pieces of an outline in mode boxes may lie over each other.
bool may_fold(const Outline& o);

// Where the two ends lie of each edge that may lie between pieces.
using InnerEdge = std::array<Box, 2>;
std::vector<InnerEdge> inner_edges(const Outline& o);

// Whether pieces of an overestimated triangle may meet wherever it may cover a pixel.
inline bool meets_everywhere(const PixelArea& area) {
    return area.is_over() && (area.is_unbounded || area.is_mitred);
}

// How near an inner edge comes to the centre of a pixel that it decides of, along x and y; S47.16.
inline int64_t reach_of_inner_edges(const PixelArea& area) {
    return kHalfPixel + (area.is_over() ? area.most : area.least);
}

}  // namespace ref
