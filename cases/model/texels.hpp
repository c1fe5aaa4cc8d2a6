// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What textures hold whose texels matter (ColorFrom::texels and mask).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec4.hpp>

namespace cases {

// Texels a side of the texture whose texels tell where they lie, in rgba8-unorm: texel (i, j) has
// the codes texel_code(i), texel_code(j), 255 and 255. Neighbours are three codes apart, further
// than a code is off that is rounded either way.
inline constexpr uint32_t kTexels = 64;
constexpr uint32_t texel_code(uint32_t at) {
    return 32 + 3 * at;
}

// What is read there at (s, t), by the formula i = floor(s * size), clamped to the edge.
inline glm::vec4 texel_at(const glm::vec4& coordinates) {
    const auto number = [](float s) {
        const auto size = static_cast<float>(kTexels);
        const float i = std::clamp(std::floor(s * size), 0.0F, size - 1);  // NaN stays NaN
        return std::isnan(i) ? i : static_cast<float>(texel_code(static_cast<uint32_t>(i))) / 255;
    };
    return {number(coordinates.x), number(coordinates.y), 1, 1};
}

// Columns of the mask, which is read at the attribute plus 1/2: the left half is transparent.
inline constexpr uint32_t kMaskColumns = 4;

}  // namespace cases
