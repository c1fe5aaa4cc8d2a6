// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which texel a coordinate chooses where nothing is filtered.
//
// The formula (Vulkan, "(s,t,r,q,a) to (u,v,w,a) Transformation" and "(u,v,w,a) to (i,j,k,l,n)
// Transformation And Array Layer Selection"): u = s * width, i = floor(u), then clamped to the
// edge. Sizes here are powers of two, so that a product in binary32 loses nothing. The text has no
// precision of u, but devices take it in fixed point, with at least subTexelPrecisionBits of
// fraction where they filter: 4 ("Limits, Required"), of Direct3D 8
// (D3D12_SUBTEXEL_FRACTIONAL_BIT_COUNT), and so of common devices (practice). A number that is
// rounded to such a grid, whichever way, stays within less than a step of it. So texel i is allowed
// if some s in the interval of the input has i - step <= s * width < i + 1 + step.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "cases/model/profile.hpp"

namespace ref::value {

// Texels that a coordinate may be off.
constexpr double texel_step(cases::Profile profile) {
    return profile == cases::Profile::vulkan ? 0x1p-4 : 0x1p-8;
}

// The first and the last texel of so many, a power of two, that a coordinate in [low, high], both
// finite, may choose.
inline std::pair<uint32_t, uint32_t> texels_of(double low, double high, uint32_t size,
                                               cases::Profile profile) {
    const double most = size - 1.0;
    const auto texel = [&](double u) {
        return static_cast<uint32_t>(std::clamp(std::floor(u), 0.0, most));
    };
    // Its upper end is in: a device may round up to it, and then it is the next texel's.
    return {texel(low * size - texel_step(profile)), texel(high * size + texel_step(profile))};
}

}  // namespace ref::value
