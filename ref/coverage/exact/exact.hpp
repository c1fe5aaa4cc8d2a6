// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The oracle: coverage from the definitions in plain loops over numbers of unlimited size (GMP),
// with no shortcut but bounding boxes. Positions are integers in units of 2^-16 pixel.
#pragma once

#include <span>

#include "ref/coverage/coverage.hpp"
#include "ref/coverage/setup.hpp"

namespace ref::exact {

// Classifies one sample.
Coverage classify(const TriangleSetup& setup, const FixedPoint& p);

// Does the same and, if `is_told`, names the reasons; `setup` must then have been set up to be
// told.
Decision decide(const TriangleSetup& setup, const FixedPoint& p, bool is_told);

// What one outline says of a sample, without its cuts and whatever the window.
Coverage coverage_of(const TriangleSetup& setup, const Outline& outline, const FixedPoint& p);

// The same of a pixel of a conservative draw, at its centre (pixel.cpp).
Coverage pixel_coverage(const TriangleSetup& setup, const PixelArea& area, const Outline& outline,
                        const FixedPoint& centre);

// Whether an edge between pieces of the outline may come near enough to the pixel to decide of it.
bool meets_inner_edge(const PixelArea& area, const Outline& outline, const FixedPoint& centre);

// How many more pieces of the outline than one may cover the pixel of an overestimated draw, whose
// centre this is.
uint32_t further_pieces_at(const TriangleSetup& setup, const Outline& outline,
                           const FixedPoint& centre);

// True if p lies in the closed convex hull of the boxes: no line through p has all corners strictly
// on one side.
bool is_in_hull(std::span<const Box> boxes, const FixedPoint& p);

// Computes what fast::winding computes, by its definition: the sum of the signs of the triangles
// (first vertex, edge) that cover p under the top-left rule.
int winding(std::span<const FixedPoint> polygon, const FixedPoint& p);

// True if the triangle, whose vertices may stand in either order, covers p under the top-left rule.
bool covers(const FixedPoint& a, const FixedPoint& b, const FixedPoint& c, const FixedPoint& p);

// True if the outline covers p but for its cuts, whatever positions the device uses.
bool is_inside_whole(const TriangleSetup& setup, const Outline& outline, const FixedPoint& p);

}  // namespace ref::exact
