// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What reaches and leaves the shaders of a case: inputs, viewports, layers, ids.
#pragma once

#include <cstdint>

#include "cases/model/case.hpp"

namespace vk_harness {

// The attributes that reach the vertex shader: all, or, without instruments, those that are colours
// or that the fragment shader discards by.
uint32_t input_count(const cases::Case& c);
// Input number `input` of a draw; nullptr if the draw has none there.
const cases::Attribute* input_attribute(const cases::Case& c, const cases::Draw& draw,
                                        uint32_t input);

// The input that a draw's colour at a location comes from, or -1.
int32_t input_of_color(const cases::Case& c, const cases::Draw& draw, uint32_t location);
// The input whose sign a draw's shader discards by, if it does.
uint32_t input_of_discard(const cases::Case& c, const cases::Draw& draw);

// Ids are written as binary32 (shaders/capture.frag): integers below 2^24 are exact.
inline constexpr uint32_t kMaxId = 1U << 24;

// How many viewports a case binds: one more than the largest index of its draws.
uint32_t viewport_count(const cases::Case& c);

// Whether a shader before rasterization writes gl_Layer: some draw goes to another than the first
// layer, which is the one that is drawn to without it.
bool names_layers(const cases::Case& c);

}  // namespace vk_harness
