// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Here stands what position.cpp, clip.cpp and ref/coverage/setup.cpp share.
#pragma once

#include <gmpxx.h>

#include <cmath>
#include <optional>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "ref/number/ball.hpp"
#include "ref/position/limits.hpp"
#include "ref/position/position.hpp"

namespace ref {

// True if a viewport's origin or extent is a whole number of pixels.
inline bool is_integer(float f) {
    return !(std::floor(f) < f);
}

// Bound on the rounding errors from x_d to x_f = t + o with unit roundoff u; position.cpp derives
// it.
template <class T>
T rounding_bound(const T& t, const T& o, const T& x_f, const T& u) {
    using value::magnitude;
    return u * T(T(4) * magnitude(t) + magnitude(o) + T(2) * magnitude(x_f) + T(1)) *
           T(T(1) + T(8) * u);
}

// The box of a position whose ideal is (x,y) pixels and whose computed value is off by at most
// `error` before it is snapped (position_box, ref/position/position.hpp). There is none beyond
// 2^32 pixels.
std::optional<Box> box_around(const mpq_class& x, const mpq_class& y, const TransformError& error,
                              const cases::Viewport& viewport, const Limits& limits,
                              cases::Profile profile);

// All positions where an edge may cross the border, if (x,y) is where the ideal edge does. A device
// with a guard band cuts the edge farther out and snaps it there. Its edge is off the ideal one by
// at most the snapping error of either end: less than one subpixel unit, 0.6 at profile direct3d;
// so the crossing need not be near a grid point. Contains box_around of the same point.
std::optional<Box> box_around_crossing(const mpq_class& x, const mpq_class& y,
                                       const TransformError& error, const cases::Viewport& viewport,
                                       const Limits& limits, cases::Profile profile);

// position_box by rationals alone, for a projectable vertex in the guaranteed range; position_box
// takes it where binary64 cannot tell.
std::optional<Box> exact_position_box(const glm::vec4& clip, const cases::Viewport& viewport,
                                      const Limits& limits, cases::Profile profile);

// snap_nearest, of a projectable vertex, by rationals alone.
std::optional<FixedPoint> exact_snap_nearest(const glm::vec4& clip, const cases::Viewport& viewport,
                                             const Limits& limits);

}  // namespace ref
