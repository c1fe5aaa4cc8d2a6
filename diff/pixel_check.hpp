// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the samples of one pixel have to agree on: how many invocations a fragment had, and which
// samples each of them stands for.
#pragma once

#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "diff/verdict.hpp"
#include "ref/expectation/expectation.hpp"

namespace diff {

// The triangle that has written a sample last, by what the capture says of the writer; null if it
// does not tell one from another.
const cases::Triangle* written_triangle(const ref::Expectation& expectation,
                                        const capture::CaptureView& capture, size_t index);

// Whether any draw has something to agree on.
bool has_pixel_rules(const cases::Case& c);

// Finds what is wrong with a pixel though no sample shows it alone; a finding names the sample that
// shows it first. Source: Vulkan specification, "Sample Shading" (at least ceil(minSampleShading x
// samples) invocations a fragment; FragCoord.xy is a sample of its invocation) and "Built-In
// Variables" (SampleMask: each covered sample is set in exactly one invocation).
std::vector<Finding> check_pixel(const cases::Case& c, const ref::Expectation& expectation,
                                 const capture::CaptureView& capture, cases::SampleId pixel);

}  // namespace diff
