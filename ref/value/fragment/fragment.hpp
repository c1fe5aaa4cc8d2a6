// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What one fragment carries, and from what a device may have set it up.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>

#include "cases/model/case.hpp"

namespace ref {

// What the device drew at one sample.
struct FragmentValues {
    glm::vec4 frag_coord{};
    float depth = 0;
    std::array<glm::vec4, cases::kMaxAttributes> attributes{};
};

// From what the device may have set up its planes.
enum class BasisKind : uint8_t { unsnapped, snapped, clipped_piece };

inline constexpr int32_t kDepthAttribute = -2;

}  // namespace ref
