// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Coverage in 64/128-bit fixed point. The samples that must or may be covered are intersections of
// half planes a x + b y + c >= 0 with integer coefficients; a row of samples is cut by each in one
// exact integer division, and the value at the row's start is carried from row to row by addition
// (Pineda 1988, with the step in x solved instead of walked).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cases/model/case.hpp"
#include "ref/coverage/coverage.hpp"
#include "ref/coverage/setup.hpp"
#include "ref/number/edge_function.hpp"

namespace ref::fast {

// Samples s of the pixels [x0, x1) in row y, all with the same answer.
struct Span {
    uint32_t y = 0, sample = 0;
    uint32_t x0 = 0, x1 = 0;
    uint32_t triangle = 0;
    Coverage coverage = Coverage::either;
};

// Appends all samples of the target that the triangle must or may cover.
void scan(const TriangleSetup& setup, uint32_t triangle, const cases::Target& target,
          std::vector<Span>& out);

// Coverage of one sample.
Coverage classify(const TriangleSetup& setup, const FixedPoint& p);

// True if p lies in the closed convex hull of the boxes.
bool is_in_hull(std::span<const Box> boxes, const FixedPoint& p);

// True if the outline covers p but for its cuts, whatever positions the device uses.
bool is_inside_whole(const TriangleSetup& setup, const Outline& outline, const FixedPoint& p);

// How often the closed polygon runs around p, clockwise on screen positive; a p on its border
// counts as the top-left rule has it.
int winding(std::span<const FixedPoint> polygon, const FixedPoint& p);

}  // namespace ref::fast
