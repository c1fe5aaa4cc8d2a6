// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is asked of a case before it may reach a driver: a case that the device cannot draw is
// unsupported, never drawn wrongly, and no index may read beyond the vertices.
#pragma once

#include <optional>
#include <string>

#include "vk_harness/device/device.hpp"

namespace vk_harness {

struct Rejection {
    Rendered::Status status = Rendered::Status::unsupported;
    std::string reason;
};

// Why this case must not be drawn on that device; nothing if it may be.
std::optional<Rejection> check_case(const Capabilities& capabilities, const cases::Case& c);

// The largest number of attributes among the draws: how many attribute attachments the case has.
uint32_t attribute_count(const cases::Case& c);

// The attributes that reach the vertex shader: all, or, without instruments, the one that is the
// colour, if any.
uint32_t input_count(const cases::Case& c);
// Input number `input` of a draw; nullptr if the draw has none there.
const cases::Attribute* input_attribute(const cases::Case& c, const cases::Draw& draw,
                                        uint32_t input);

// Ids are written as binary32 (shaders/capture.frag): integers below 2^24 are exact.
inline constexpr uint32_t kMaxId = 1U << 24;

}  // namespace vk_harness
