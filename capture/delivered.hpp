// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The planes of a case that another program delivered, which need not be all.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "capture/capture.hpp"

namespace capture {

// How much is known of the hits of a sample.
enum class HitDetail : uint8_t {
    none,
    coverage,  // whether there was any
    total,     // how many
    faces      // how many by front and by back faces
};

// A plane that was not delivered is empty; the others have one entry a sample, as in a Capture.
struct Delivered {
    HitDetail detail = HitDetail::none;
    std::vector<uint32_t> front, back;        // coverage (0 or 1) and total stand in front alone
    std::vector<uint32_t> draws, primitives;  // kClearId where nothing was drawn; both or neither
    // The clear values are kClearValue in x and Target::depth_clear. Depth holds its own where
    // nothing was hit; the others are not looked at there. Without hits and writers a sample was
    // hit if any of these does not hold it.
    std::vector<glm::vec4> frag_coord;
    std::vector<float> depth;
    std::array<std::vector<glm::vec4>, cases::kMaxAttributes> attributes;
    std::vector<ColorCodes> color;  // stored codes, Target::color
    std::vector<uint32_t> stencil;  // stored values

    bool is_empty() const;
};

}  // namespace capture
