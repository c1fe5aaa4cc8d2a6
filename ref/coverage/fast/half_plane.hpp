// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Convex sets of sample positions as intersections of integer half planes.
#pragma once

#include <span>
#include <vector>

#include "ref/coverage/setup.hpp"
#include "ref/number/edge_function.hpp"

namespace ref::fast {

// The half plane E_ab(p) >= 0 or, if it is strict, E_ab(p) > 0, which over integers is E - 1 >= 0.
inline HalfPlane right_of(const FixedPoint& a, const FixedPoint& b, bool is_strict) {
    return {Int128{a.y} - b.y, Int128{b.x} - a.x,
            static_cast<Int128>(a.x) * b.y - static_cast<Int128>(a.y) * b.x - (is_strict ? 1 : 0)};
}

// Says as sets what a triangle set-up says. What must be covered is the intersection of all `must`
// half planes (nothing without has_must); what may be is the union of `may`, each inside its
// bounds.
struct ConvexSet {
    std::vector<HalfPlane> planes;
    Box bounds;
};
struct CoverageSets {
    bool has_must = true;
    std::vector<HalfPlane> must;
    std::vector<ConvexSet> may;
    // Of a conservative draw (ref/coverage/pieces.hpp): where the k + 2nd piece of an overestimated
    // triangle may cover a pixel, too; where an underestimated one need not.
    std::vector<std::vector<ConvexSet>> further;
    std::vector<ConvexSet> open;
};

// Corners of the closed convex hull of points, clockwise on screen (Andrew's monotone chain); fewer
// than three if the points lie on a line.
std::vector<FixedPoint> convex_hull(std::vector<FixedPoint> points);

// The closed convex hull of the boxes.
ConvexSet hull_set(std::span<const Box> boxes);

// Sign of the area of the polygon through the low corners of the boxes. If some sample must be
// covered, every choice of positions has this sign.
int corner_sign(std::span<const Box> boxes);

// Adds the half planes of an edge of an outline in mode boxes whose area has this sign.
void add_edge(const Box& from, const Box& to, EdgeTest test, int sign,
              std::vector<HalfPlane>& planes);

// Makes the sets of one outline as if nothing cut it.
CoverageSets coverage_set(const Outline& outline, int64_t grid_step);

CoverageSets coverage_sets(const TriangleSetup& setup);

}  // namespace ref::fast
