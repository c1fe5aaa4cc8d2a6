// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// 128-bit fixed-point geometry. Positions are S47.16 with magnitude below 2^50 (position_box keeps
// them within 2^32 pixels plus an error of at most 2^32), so differences stay below 2^51, products
// below 2^102 and a cross product below 2^103: always inside Int128.
#pragma once

#include <gmpxx.h>

#include <span>

#include "ref/number/fixed_point.hpp"

namespace ref {

__extension__ typedef __int128 Int128;
inline constexpr int kPositionBits = 50;
static_assert(2 * (kPositionBits + 1) + 1 < 127, "a cross product of differences fits Int128");

inline mpz_class to_mpz(Int128 v) {
    mpz_class out(static_cast<long>(v >> 64));  // rounds down, so that the rest is positive
    out <<= 64;
    return out + mpz_class(static_cast<unsigned long>(v));
}

// Computes (b-a) x (p-a), which is positive if p lies to the right of a->b on screen (y down).
inline Int128 edge_function(const FixedPoint& a, const FixedPoint& b, const FixedPoint& p) {
    return static_cast<Int128>(b.x - a.x) * (p.y - a.y) -
           static_cast<Int128>(b.y - a.y) * (p.x - a.x);
}

inline int sign_of(Int128 v) {
    return v > 0 ? 1 : (v < 0 ? -1 : 0);
}

// Gives the sign of a polygon's area; positive if it runs clockwise on screen.
inline int area_sign(std::span<const FixedPoint> polygon) {
    Int128 area = 0;
    for (size_t i = 1; i + 1 < polygon.size(); ++i) {
        area += edge_function(polygon[0], polygon[i], polygon[i + 1]);
    }
    return sign_of(area);
}

// A point is inside where a x + b y + c >= 0. With positions below 2^50: |a|, |b| < 2^51, |c| <
// 2^102.
struct HalfPlane {
    Int128 a = 0, b = 0, c = 0;
    Int128 at(const FixedPoint& p) const { return a * p.x + b * p.y + c; }
    friend bool operator==(const HalfPlane&, const HalfPlane&) = default;
};

// True if the edge a->b of a triangle with positive area owns the samples on it (top-left rule).
inline bool is_top_left(const FixedPoint& a, const FixedPoint& b) {
    return b.y < a.y || (b.y == a.y && b.x > a.x);
}

}  // namespace ref
