// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A case that has more attachments than the device, or more hits than its attachments tell apart,
// is drawn in parts: renderings of the same draws, each to some of the attachments, which together
// make the case's capture. Each part has the case's depth and stencil, so every test of a fragment
// ends as it would in one rendering, and the inputs by which fragments are discarded or the shader
// runs once a sample, so every part has the same fragments.
#pragma once

#include <optional>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "vk_harness/device/device.hpp"
#include "vk_harness/device/rejection.hpp"

namespace vk_harness {

// What of a case is taken from one rendering.
struct Part {
    cases::Case test;  // what is drawn
    // The case's attributes that `test` has, ascending: a draw that has fewer lacks the last ones.
    std::vector<uint32_t> attributes;
    std::vector<uint32_t> taken;  // of them, those of which this part tells
    // Hits, writers, FragCoord, depth, stencil, resolved depth and queries: of one part, the first.
    bool has_fragments = false;
    bool has_color = false;  // and what it is resolved into: of one part at most
};

// The parts of a case; empty if it is drawn in one rendering, or if no parts of it can be drawn.
std::vector<Part> parts_of(const Capabilities& capabilities, const cases::Case& c);

// Why the device cannot draw a case, in one rendering or in parts; nothing if it can.
std::optional<Rejection> check_parts(const Capabilities& capabilities, const cases::Case& c);

// Copies what a part has drawn of the case to the planes of the case.
void take_part(const Part& part, const capture::CaptureView& drawn, const capture::PlaneSpans& to);

}  // namespace vk_harness
