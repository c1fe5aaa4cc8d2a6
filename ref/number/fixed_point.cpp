// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/number/fixed_point.hpp"

namespace ref {

FixedPoint sample_position(uint32_t i, uint32_t j, uint32_t s, const cases::Target& target) {
    const std::array<uint8_t, 2> location = cases::sample_locations(target)[s];
    // 1/16 pixel -> S47.16: 1 -> 2^12
    constexpr int64_t kSixteenth = kFixedOne / 16;
    return {int64_t{i} * kFixedOne + location[0] * kSixteenth,
            int64_t{j} * kFixedOne + location[1] * kSixteenth};
}

}  // namespace ref
