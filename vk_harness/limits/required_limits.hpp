// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What Vulkan requires of the limits of every device ("Limit Requirements"), as far as they bound
// what cases may draw: targets, viewports, vertices, varyings, samples, interpolation, filters.
#pragma once

#define VK_ENABLE_BETA_EXTENSIONS  // as wherever volk is included
#include <volk.h>

#include <vector>

#include "vk_harness/public/harness.hpp"

namespace vk_harness {

// The limits that are not as the specification requires them of a device of that version (packed,
// VkPhysicalDeviceProperties::apiVersion) with those features, in the order of its table. NaN meets
// no requirement. `is_subset`: of VK_KHR_portability_subset.
std::vector<WrongLimit> wrong_limits(const VkPhysicalDeviceLimits& limits,
                                     const VkPhysicalDeviceFeatures& features, uint32_t api_version,
                                     bool is_subset);

}  // namespace vk_harness
