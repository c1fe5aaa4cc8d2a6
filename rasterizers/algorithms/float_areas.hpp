// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Areas in binary32, as textbook programs have them (Scratchapixel, "Putting Things Together"):
// what they lose, in coverage and in values, depends on the shape of the triangle.
//
// Coordinates are pixels with 8 fractional bits below 2^15, so they and their differences (at most
// 2^24 units) are exact. Two products and their difference are rounded:
//     |E^ - E| <= g(2) M,   M = |(b-a)_x (p-a)_y| + |(b-a)_y (p-a)_x|,   |E| <= M,
// g(k) = k u / (1 - k u). Both products are exact, and so is E, while the differences have at most
// 12 bits: up to 16 pixels. Otherwise the sign may be wrong wherever |E| <= g(2) M.
#pragma once

#include "rasterizers/algorithms/interpolation.hpp"
#include "rasterizers/algorithms/raster.hpp"

namespace rasterizers {

inline constexpr int64_t kMaxFloatCoordinate = int64_t{1} << (15 + kSubpixelBits);
static_assert(kMaxFloatCoordinate <= int64_t{1} << 23, "differences fit 24 bits");

struct FloatAreas {
    std::array<float, 3> part{};  // square pixels
    float whole = 0;              // positive for a clockwise triangle
};
// The triangle is clockwise, and all coordinates are at most kMaxFloatCoordinate.
FloatAreas float_areas_at(const Corners& clockwise, const SubpixelPoint& p);

// l_i = fl(part / whole), then as the functions of the same names. With d_i >= |l^_i - l_i|,
//     d_i = (g(2) M_i + |l_i| g(2) M) / (A - g(2) M) (1 + u) + u |l_i|,
// the errors are at most
//     three:  sum d_i |z_i| + g(3) sum (|l_i| + d_i) |z_i|
//     two:    sum_{1,2} (d_i + g(4) (|l_i| + d_i)) |z_i - z_0| + g(2) |z_0|.
float three_multiplies(const FloatAreas& areas, const Values& z);
float two_multiplies(const FloatAreas& areas, const Values& z);

// Coverage of a clockwise triangle from the signs of the computed areas, ties by the top-left rule.
bool covers_in_float(const Corners& clockwise, const SubpixelPoint& p);

}  // namespace rasterizers
