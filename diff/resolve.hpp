// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Planes that follow from others of the same capture: the stencil from the hit counter, unless
// draws test it (stencil.hpp), resolved pixels from the samples. They are judged by what the device
// itself has written elsewhere.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "diff/verdict.hpp"

namespace diff {

// What the hit counter says the stencil is: (front - back) mod 256.
uint32_t stencil_of(const glm::vec4& hits);

// The finding of a stencil that counts hits, if their faces are known (rule stencil.count).
std::optional<Finding> judge_count(const capture::CaptureView& capture, size_t index,
                                   const ref::path::SeenHits& seen);

// Judges what was resolved (resolve.select, resolve.average at `profile`) and hands each finding to
// `add`. Returns why there is nothing to judge, or "": planes that were not copied.
std::string judge_dependent_planes(const capture::CaptureView& capture, cases::Profile profile,
                                   const std::function<void(Finding)>& add);

// Whether a pixel is resolved from its samples as the two rules say.
bool is_resolved_rightly(const capture::CaptureView& capture, size_t pixel, cases::Profile profile);

// Fills these planes of a capture from its others, as a device that is right does; averages are
// rounded to nearest. A stencil that is there already is left as it is.
void add_dependent_planes(capture::Capture& capture);

}  // namespace diff
