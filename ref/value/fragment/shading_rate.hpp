// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How often the fragment shader of a draw runs.
#pragma once

#include <cstdint>

#include "cases/model/case.hpp"

namespace ref::value {

// How often the fragment shader runs for a fragment (Vulkan specification, "Sample Shading").
enum class ShadingRate : uint8_t {
    fragment,   // sample shading is off
    may_split,  // an input is decorated with Sample, which "may" turn it on
    some,       // it is on, with fewer invocations than samples required
    sample,     // one invocation a sample is required
};
ShadingRate shading_rate(const cases::Draw& draw, uint32_t samples);

// The fewest invocations that a fragment must have.
uint32_t least_invocations(const cases::Draw& draw, uint32_t samples);

// Whether an input is decorated with Centroid.
bool has_centroid(const cases::Draw& draw);

}  // namespace ref::value
