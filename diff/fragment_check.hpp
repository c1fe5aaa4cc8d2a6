// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the pixels of one fragment have to agree on (VK_KHR_fragment_shading_rate).
#pragma once

#include <functional>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "diff/verdict.hpp"
#include "ref/expectation/expectation.hpp"

namespace diff {

// Whether any draw of a case with instruments has fragments of several pixels that are judged
// together at the expectation's profile.
bool has_fragment_rules(const cases::Case& c, const ref::Expectation& expectation);

// Tells `add` of each block of pixels in which one triangle has written several samples last, with
// different bits of FragCoord or of an attribute: one finding a block and quantity, at the first
// sample that differs from the block's first. Clipped triangles are left out, of whose pieces a
// device may make several fragments. Source: Vulkan specification, "Fragment Shading Rates" ("the
// shading rate of a given fragment shader invocation"); docs/rules.md, fragment-size.shared.
void check_fragments(const cases::Case& c, const ref::Expectation& expectation,
                     const capture::CaptureView& capture, const std::function<void(Finding)>& add);

}  // namespace diff
