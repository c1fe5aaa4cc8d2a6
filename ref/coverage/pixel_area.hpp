// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How far the triangles of a conservative draw reach (Vulkan specification, "Conservative
// Rasterization"). Its pixels are covered by area: all samples of a pixel, whose closed square a
// triangle touches (overestimation) or fills (underestimation).
//
// "In X and Y equally" the generating primitive is enlarged: its Minkowski sum with a square. So a
// pixel is touched where its centre lies in the sum of the triangle and a larger square, which is
// what both implementations of the coverage decide, each in its own way.
//
// What is free:
//   vulkan    how far a device enlarges triangles: results "only approximate" the sizes it names;
//   practice  the corners: each edge is moved, and where two of them meet is not said;
//   direct3d  nothing of that: the square is swept along the edges (Direct3D, "Conservative
//             Rasterization", uncertainty region).
// At every profile it is open whether a triangle covers a pixel that has only its border in common
// with it: the text counts the pixel's "edges and corners", and says nothing of the triangle's.
#pragma once

#include <cstdint>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "ref/number/fixed_point.hpp"
#include "ref/position/limits.hpp"

namespace ref {

inline constexpr int64_t kHalfPixel = kFixedOne / 2;

// Lengths in S47.16.
struct PixelArea {
    cases::Conservative mode = cases::Conservative::none;
    // Overestimation: by how much a device enlarges a triangle at least, and at most.
    // Underestimation: by how much a pixel that must be covered is enlarged.
    int64_t least = 0, most = 0;
    bool is_unbounded = false;       // there is no most
    bool is_mitred = false;          // edges are moved, and meet where they do
    bool keeps_degenerates = false;  // overestimation draws what has no area

    bool is_on() const { return mode != cases::Conservative::none; }
    bool is_over() const { return mode == cases::Conservative::overestimate; }
};
PixelArea pixel_area_of(const cases::Draw& draw, const Limits& limits, cases::Profile profile);

// The centre of the pixel that p lies in.
inline FixedPoint pixel_centre(const FixedPoint& p) {
    return {(p.x & -kFixedOne) + kHalfPixel, (p.y & -kFixedOne) + kHalfPixel};
}

}  // namespace ref
