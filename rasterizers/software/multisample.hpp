// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the fragments of a multisampled target are: masks, invocations, and where their inputs are
// evaluated.
#pragma once

#include <cstdint>
#include <span>

#include "rasterizers/software/choice/device.hpp"
#include "rasterizers/software/tiles.hpp"

namespace software {

// A place in the framebuffer, pixels.
struct Place {
    float x = 0, y = 0;
};

// One invocation's view of a fragment, for the sample that it writes.
struct Invocation {
    bool is_written = false;  // after the sample mask and what the shader writes to its own
    uint32_t mask_in = 0;     // gl_SampleMaskIn
    uint32_t sample_id = 0;
    Place sample_position;  // gl_SamplePosition
    Place frag_coord;       // FragCoord.xy
    Place centre, sample, centroid;
};

// Sample s of the pixel (i,j) whose samples `covered` the triangle covers.
Invocation invoke(const cases::Draw& draw, const Device& device,
                  std::span<const SampleOffset> samples, int64_t i, int64_t j, uint32_t s,
                  uint32_t covered);

}  // namespace software
