// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers compared by their bits: -0 is not 0, and a NaN is itself.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/gtc/packing.hpp>
#include <optional>

namespace cases {

inline bool same_bits(float a, float b) {
    return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
}

// The bits of the same number as binary16, if it is one: finite, 0 or not denormal there (a device
// may read denormals as 0).
inline std::optional<uint16_t> half_bits(float number) {
    constexpr float kSmallest = 0x1p-14F;
    if (!std::isfinite(number) || (std::abs(number) < kSmallest && std::abs(number) > 0)) {
        return std::nullopt;
    }
    const uint16_t bits = glm::packHalf1x16(number);
    return same_bits(glm::unpackHalf1x16(bits), number) ? std::optional(bits) : std::nullopt;
}

}  // namespace cases
