// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers compared by their bits: -0 is not 0, and a NaN is itself.
#pragma once

#include <bit>
#include <cstdint>

namespace cases {

inline bool same_bits(float a, float b) {
    return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
}

}  // namespace cases
