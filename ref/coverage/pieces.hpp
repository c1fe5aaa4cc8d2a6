// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a conservative draw may show of a triangle that is clipped. "One algorithm that achieves the
// required behavior is to triangulate a polygon (without adding any vertices) and then treat each
// triangle individually" (Vulkan specification, "Basic Polygon Rasterization"). Each piece is then
// enlarged, or filled, by itself: along an edge between two pieces an overestimated pixel is
// covered once by each that reaches it, since "the tie-breaking rule ... does not apply" and
// "coverage is set for all fragments generated from shared edges of polygons" ("Conservative
// Rasterization"), and an underestimated one by none. NVIDIA 580 draws so.
//
// Which edges lie between pieces is the device's choice: any from a vertex of the polygon to one
// that is not its neighbour. How far a piece reaches beyond its edges is free where the size is,
// and where the corners are (pixel_area.hpp).
//
// No other draw may hit a sample by two pieces: there the rule of ties gives it to one
// (docs/findings/clipped-twice.md).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ref/coverage/setup.hpp"

namespace ref {

// How many triangles a polygon may be drawn as, but for one. Where a corner of the triangle lies on
// the plane that cuts it, a device may find a cut beside it, in the same place, and with it a piece
// without area, which counts if overestimated draws keep those.
inline uint32_t further_pieces(const Outline& o, const PixelArea& area) {
    const bool keeps_flat = area.is_over() && area.keeps_degenerates;
    return (o.count > 3 ? o.count - 3 : 0) + (keeps_flat ? o.cut_corners : 0U);
}

// The same of an overestimated triangle of which nothing is known.
inline uint32_t further_if_undefined(const PixelArea& area) {
    return area.is_over() ? kMaxClippedVertices - 3 : 0;
}

// Where the two ends lie of each edge that may lie between pieces, those without area included.
using InnerEdge = std::array<Box, 2>;
std::vector<InnerEdge> inner_edges(const Outline& o, const PixelArea& area);

// Whether pieces of an overestimated triangle may meet wherever it may cover a pixel.
inline bool meets_everywhere(const PixelArea& area) {
    return area.is_over() && (area.is_unbounded || area.is_mitred);
}

// How near an inner edge comes to the centre of a pixel that it decides of, along x and y; S47.16.
inline int64_t reach_of_inner_edges(const PixelArea& area) {
    return kHalfPixel + (area.is_over() ? area.most : area.least);
}

}  // namespace ref
