// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "shaders/shaders.hpp"

#include <cstddef>
#include <iterator>

namespace shaders {

namespace {

#include "modules.inc"

// 1 + 3 + 9 + 27 + 81 combinations of modes.
constexpr size_t kCombinations = 121;
static_assert(std::size(kVertex) == kMaxAttributes + 1);
static_assert(std::size(kFragment) == 2 * kCombinations);

}  // namespace

std::span<const uint32_t> capture_vertex(uint32_t attribute_count) {
    return kVertex[attribute_count];
}

std::span<const uint32_t> capture_fragment(uint32_t attribute_count,
                                           const std::array<Mode, kMaxAttributes>& modes,
                                           bool primitive_id) {
    size_t first = 0;  // (3^count - 1) / 2 combinations have fewer attributes
    size_t code = 0;   // sum of mode_k 3^k
    size_t power = 1;  // 3^k
    for (uint32_t k = 0; k < attribute_count; ++k) {
        first += power;
        code += static_cast<size_t>(modes[k]) * power;
        power *= 3;
    }
    return kFragment[(primitive_id ? kCombinations : 0) + first + code];
}

std::span<const uint32_t> copy_samples(bool depth) {
    return depth ? std::span<const uint32_t>(copy_depth) : std::span<const uint32_t>(copy_color);
}

}  // namespace shaders
