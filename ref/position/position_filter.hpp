// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The position boxes of common vertices without rationals: the box is computed in binary64 together
// with a bound on what binary64 may have lost, and is given only where that cannot change a floor
// or a ceil. Whatever is closer than that is left to the rationals, so the result never rests on a
// rounded number.
#pragma once

#include <optional>

#include "cases/model/profile.hpp"
#include "ref/number/fixed_point.hpp"
#include "ref/position/limits.hpp"

namespace ref {

// One coordinate of position_box: clip coordinate c, clip w > 0, and the viewport's origin and
// extent on that axis. Nothing if binary64 cannot tell.
std::optional<FixedRange> filtered_range(float c, float w, float origin, float extent,
                                         const Limits& limits, cases::Profile profile);

// One coordinate of snap_nearest, likewise.
std::optional<int64_t> filtered_nearest(float c, float w, float origin, float extent,
                                        const Limits& limits);

}  // namespace ref
