// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Ways to interpolate in binary32 from exact areas. A bound on the error stands beside each; u =
// 2^-24 is the unit roundoff and g(k) = k u / (1 - k u) bounds k roundings in a row (Higham,
// "Accuracy and Stability of Numerical Algorithms", lemma 3.1). None of the bounds depends on the
// shape of the triangle: the areas are exact integers, converted once. docs/algorithms.md has what
// happens when they are not.
#pragma once

#include <array>
#include <cstdint>

#include "rasterizers/algorithms/raster.hpp"

namespace rasterizers {

// Signed doubled areas of P with the edges opposite the vertices; they add up to `whole`, which is
// positive. S15.16 square pixels, |.| < 2^61.
struct Areas {
    std::array<int64_t, 3> part{};
    int64_t whole = 0;
};
// Areas at p of a triangle with area, vertices in either order.
Areas areas_at(const Corners& triangle, const SubpixelPoint& p);

using Values = std::array<float, 3>;  // at the vertices

// l_0 z_0 + l_1 z_1 + l_2 z_2 (Scratchapixel; Brown, equation 3). l_i = fl(fl(A_i) / fl(A)) has
// three roundings, the product one, the sums two:
//   |error| <= g(6) sum |l_i z_i|.
// A constant z comes back within 6u |z| only.
float three_multiplies(const Areas& areas, const Values& z);

// z_0 + l_1 (z_1 - z_0) + l_2 (z_2 - z_0) (Giesen; "the expression that GPUs normally use"). l_i
// three roundings, the difference and the product one each, the two sums:
//   |error| <= g(7) (|l_1 (z_1 - z_0)| + |l_2 (z_2 - z_0)|) + g(2) |z_0|.
// A constant comes back unchanged; the value of vertex 1 or 2 does not come back at that vertex if
// z_0 is larger by far.
float two_multiplies(const Areas& areas, const Values& z);

// V = (1-s) C + s ((1-t) A + t B) with C vertex 2, s = 1 - gamma, t = beta / s: the point U on the
// edge AB first, then from C to U (lecture notes, "Sketch"). s and t come from exact areas, s =
// (A_0 + A_1) / A and t = A_1 / (A_0 + A_1), three roundings each, and 1 - s, 1 - t are computed as
// exact areas, too. On the longest way a weight has six roundings, with two products and two sums:
//   |error| <= g(10) sum |l_i z_i|.
// If A_0 + A_1 = 0, P is C or lies on the parallel to AB through it, where t is not defined: at C
// the value is z_2, elsewhere the first form is used.
float nested_lines(const Areas& areas, const Values& z);

// Products of w of two vertices each, scaled so that the largest is near 1; the common factor drops
// out of equations 4 and 5. One rounding each; |w| from 2^-126 up.
std::array<float, 3> w_products(const std::array<float, 3>& w);

// u = sum b'_i u_i with b'_i = q_i A_i / sum q_j A_j, q_0 = w_1 w_2 and so on (Brown, equations 5
// and 6). With A_i >= 0 every sum is of one sign: a product q_i fl(A_i) has three roundings, the
// denominator two more, the quotient one and the last product and sums three, 3 + 5 + 4 = 12:
//   |error| <= g(12) sum |b'_i u_i|     inside the triangle.
float brown(const Areas& areas, const std::array<float, 3>& q, const Values& values);

}  // namespace rasterizers
