// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Arithmetic of closed intervals of rationals, exact.
#pragma once

#include <algorithm>
#include <array>

#include "ref/color/component.hpp"

namespace ref::color {

// 1 minus each of its numbers.
inline Interval complement(const Interval& v) {
    return {1 - v.high, 1 - v.low};
}

inline Interval product(const Interval& a, const Interval& b) {
    const std::array<mpq_class, 4> ends = {a.low * b.low, a.low * b.high, a.high * b.low,
                                           a.high * b.high};
    return {*std::min_element(ends.begin(), ends.end()),
            *std::max_element(ends.begin(), ends.end())};
}

inline Interval smaller(const Interval& a, const Interval& b) {
    return {std::min(a.low, b.low), std::min(a.high, b.high)};
}

inline Interval larger(const Interval& a, const Interval& b) {
    return {std::max(a.low, b.low), std::max(a.high, b.high)};
}

inline Interval negated(const Interval& v) {
    return {-v.high, -v.low};
}

inline Interval hull(const Interval& a, const Interval& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

}  // namespace ref::color
