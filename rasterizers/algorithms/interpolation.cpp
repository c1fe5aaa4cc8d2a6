// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/algorithms/interpolation.hpp"

#include <algorithm>
#include <cmath>

#include "rasterizers/algorithms/edge.hpp"

namespace rasterizers {

namespace {

float ratio(int64_t a, int64_t b) {
    return static_cast<float>(a) / static_cast<float>(b);
}

}  // namespace

Areas areas_at(const Corners& t, const SubpixelPoint& p) {
    Areas out;
    out.whole = edge_function(t[0], t[1], t[2]);
    for (size_t k = 0; k < 3; ++k) {
        out.part[k] = edge_function(t[(k + 1) % 3], t[(k + 2) % 3], p);
    }
    if (out.whole < 0) {
        out.whole = -out.whole;
        for (int64_t& a : out.part) {
            a = -a;
        }
    }
    return out;
}

float three_multiplies(const Areas& areas, const Values& z) {
    const float l0 = ratio(areas.part[0], areas.whole);
    const float l1 = ratio(areas.part[1], areas.whole);
    const float l2 = ratio(areas.part[2], areas.whole);
    return l0 * z[0] + l1 * z[1] + l2 * z[2];
}

float two_multiplies(const Areas& areas, const Values& z) {
    const float l1 = ratio(areas.part[1], areas.whole);
    const float l2 = ratio(areas.part[2], areas.whole);
    return z[0] + l1 * (z[1] - z[0]) + l2 * (z[2] - z[0]);
}

float nested_lines(const Areas& areas, const Values& z) {
    const int64_t opposite = areas.part[0] + areas.part[1];  // whole - part[2]
    if (opposite == 0) {
        return areas.part[0] == 0 ? z[2] : three_multiplies(areas, z);
    }
    const float s = ratio(opposite, areas.whole);
    const float one_minus_s = ratio(areas.part[2], areas.whole);
    const float t = ratio(areas.part[1], opposite);
    const float one_minus_t = ratio(areas.part[0], opposite);
    return one_minus_s * z[2] + s * (one_minus_t * z[0] + t * z[1]);
}

std::array<float, 3> w_products(const std::array<float, 3>& w) {
    int exponent = -200;
    for (const float v : w) {
        exponent = std::max(exponent, std::ilogb(v));
    }
    std::array<float, 3> scaled{};
    for (size_t k = 0; k < 3; ++k) {
        scaled[k] = std::ldexp(w[k], -exponent);  // exact
    }
    return {scaled[1] * scaled[2], scaled[2] * scaled[0], scaled[0] * scaled[1]};
}

float brown(const Areas& areas, const std::array<float, 3>& q, const Values& values) {
    std::array<float, 3> a{};
    for (size_t k = 0; k < 3; ++k) {
        // Relative to the whole: the same in equation 5, and small enough for its products.
        a[k] = q[k] * std::ldexp(static_cast<float>(areas.part[k]), -40);
    }
    const float sum = a[0] + a[1] + a[2];
    return a[0] / sum * values[0] + a[1] / sum * values[1] + a[2] / sum * values[2];
}

}  // namespace rasterizers
