// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The matrix of Draw::matrix: (x, y, z, w) is of what is stored (4 y', x' / 2, w' / 8, 2 z').
//
// It loses nothing. OpMatrixTimesVector has the precision of the sum of M_ij v_j ("Precision of
// Core SPIR-V Instructions"), and products and sums are correctly rounded: one product of each row
// is with a power of two, exact while it is no denormal number and no infinity, and the others are
// 0. That leaves only the sign of zeros, which no comparison sees.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec4.hpp>
#include <span>

namespace cases {

// By columns, as GLSL has them: [4 * j + i] is what component j adds to component i.
inline constexpr std::array<float, 16> kMatrix = {0, 0.5F, 0, 0, 4, 0, 0,      0,
                                                  0, 0,    0, 2, 0, 0, 0.125F, 0};

// What the matrix makes the position of; the position takes_matrix().
inline glm::vec4 before_matrix(const glm::vec4& p) {
    return {p.y / 0.5F, p.x / 4, p.w / 2, p.z / 0.125F};
}

// Whether nothing is lost of any of the positions.
inline bool takes_matrix(std::span<const glm::vec4> positions) {
    constexpr float kLeast = 0x1p-100F, kMost = 0x1p100F;
    return std::ranges::all_of(positions, [](const glm::vec4& p) {
        return std::ranges::all_of(std::array{p.x, p.y, p.z, p.w}, [](float v) {
            const float size = std::fabs(v);
            return !(size > 0) ? !std::isnan(v) : size >= kLeast && size <= kMost;
        });
    });
}

}  // namespace cases
