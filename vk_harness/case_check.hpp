// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is asked of a case before it may reach a driver: a case that the device cannot draw is
// unsupported, never drawn wrongly, and no index may read beyond the vertices.
#pragma once

#include <optional>

#include "vk_harness/device/device.hpp"
#include "vk_harness/device/rejection.hpp"
#include "vk_harness/target/target_layout.hpp"

namespace vk_harness {

// Why this case must not be drawn in one rendering on that device; nothing if it may be.
// `reads_hits`: false of a part (parts.hpp) of which nobody looks at the hits and their writers.
std::optional<Rejection> check_case(const Capabilities& capabilities, const cases::Case& c,
                                    bool reads_hits = true);

// Why the attachments of this layout cannot tell the case's hits and their writers apart.
std::optional<Rejection> check_counting(const Capabilities& capabilities, const cases::Case& c,
                                        const TargetLayout& layout);

}  // namespace vk_harness
