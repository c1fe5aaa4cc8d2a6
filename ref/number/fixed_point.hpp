// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Framebuffer coordinates in fixed point: S47.16, unit 2^-16 pixel. Any snap grid of 4 to 16
// subpixel bits and every standard sample location (multiples of 1/16 pixel) is exact in it.
#pragma once

#include <gmpxx.h>

#include <cstdint>

#include "cases/model/sample.hpp"

namespace ref {

inline constexpr int kFixedBits = 16;
inline constexpr int64_t kFixedOne = int64_t{1} << kFixedBits;  // one pixel

struct FixedPoint {
    int64_t x = 0, y = 0;  // S47.16 pixels
    friend bool operator==(const FixedPoint&, const FixedPoint&) = default;
};

// Is a closed range of coordinates.
struct FixedRange {
    int64_t low = 0, high = -1;
    bool contains(int64_t v) const { return low <= v && v <= high; }
};

// Convert a coordinate to pixels. Those here are below 2^53: binary64 holds them exactly, too.
inline double pixels(int64_t fixed) {
    return static_cast<double>(fixed) / static_cast<double>(kFixedOne);
}
inline mpq_class exact_pixels(int64_t fixed) {
    return mpq_class(pixels(fixed));
}

// Where sample s of pixel (i,j) lies. "These locations are exact positions" (Vulkan specification,
// "Multisampling"): they are never snapped.
FixedPoint sample_position(uint32_t i, uint32_t j, uint32_t s, const cases::Target& target);

}  // namespace ref
