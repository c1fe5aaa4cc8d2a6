// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the fragments of a multisampled target, and those of several pixels, are: masks,
// invocations, and where their inputs are evaluated.
#pragma once

#include <array>
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
    uint32_t rate = 0;      // gl_ShadingRateEXT
    Place sample_position;  // gl_SamplePosition
    Place frag_coord;       // FragCoord.xy
    Place centre, sample, centroid;
};

// Sample s of the pixel (i,j) whose samples `covered` the triangle covers.
Invocation invoke(const cases::Draw& draw, const Device& device,
                  std::span<const SampleOffset> samples, int64_t i, int64_t j, uint32_t s,
                  uint32_t covered);

// The pixels that one invocation serves, from (x,y) on, and which of their samples a triangle
// covers, row by row.
struct CoarseFragment {
    int64_t x = 0, y = 0;
    uint32_t log_width = 0, log_height = 0;
    std::array<uint32_t, 16> covered{};
    uint32_t width() const { return 1U << log_width; }
    uint32_t height() const { return 1U << log_height; }
    uint32_t& covered_at(int64_t i, int64_t j) {
        return covered.at(static_cast<size_t>(((j - y) << log_width) + (i - x)));
    }
};

// The one that holds pixel (i,j), of which nothing is covered yet; (left,top) is where a faulty
// device begins its grid.
CoarseFragment coarse_fragment(const cases::Draw& draw, const Device& device, int64_t i, int64_t j,
                               int64_t left, int64_t top);

// Makes of the view of pixel (i,j) that of the whole fragment.
void coarsen(const cases::Draw& draw, const Device& device, std::span<const SampleOffset> samples,
             const CoarseFragment& fragment, int64_t i, int64_t j, Invocation& out);

}  // namespace software
