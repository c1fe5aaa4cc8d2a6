// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/snapping.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace software {

float to_half_precision(float v) {
    const uint32_t bits = std::bit_cast<uint32_t>(v);
    return std::bit_cast<float>((bits + 0x1000U) & 0xffffe000U);
}

int64_t to_fixed(float v, const Device& device) {
    int bits = device.subpixel_bits;
    Rounding rounding = device.rounding;
    if (device.fault == "floor-snapping"_fault) {
        rounding = Rounding::floor;
    } else if (device.fault == "ceil-snapping"_fault) {
        rounding = Rounding::ceil;
    }
    int coarse = 0;
    if (device.fault == "coarse-snapping"_fault) {
        coarse = bits - 4;
        bits = 4;
    }
    // Far outside only without clipping; the limit keeps edge functions inside 64 bits.
    const double scaled = std::ldexp(std::clamp(static_cast<double>(v), -0x1p18, 0x1p18), bits);
    double whole = 0;
    switch (rounding) {
        case Rounding::nearest_even:
            whole = std::nearbyint(scaled);
            break;
        case Rounding::half_up:
            whole = std::floor(scaled + 0.5);
            break;
        case Rounding::floor:
            whole = std::floor(scaled);
            break;
        case Rounding::ceil:
            whole = std::ceil(scaled);
            break;
        case Rounding::truncate:
            whole = std::trunc(scaled);
            break;
    }
    return static_cast<int64_t>(whole) * (int64_t{1} << coarse);
}

}  // namespace software
