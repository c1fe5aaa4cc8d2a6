// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What every room has to know of a device.
#pragma once

#include <algorithm>
#include <cstdint>

namespace cases {

// The id under which a run tells of the device's limits (rule device.limits); no file has it.
inline constexpr char kLimitsCase[] = "device/limits";

// Vulkan requires 4 of every device ("Required Limits", subPixelPrecisionBits), so one that claims
// fewer is held to these; positions of the reference are S47.16.
inline constexpr uint32_t kLeastSubpixelBits = 4, kMostSubpixelBits = 16;
constexpr uint32_t judged_subpixel_bits(uint32_t claimed) {
    return std::clamp(claimed, kLeastSubpixelBits, kMostSubpixelBits);
}

}  // namespace cases
