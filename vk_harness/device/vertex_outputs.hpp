// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// gl_ViewportIndex and gl_Layer, as vertex shaders of a device may write them.
#pragma once

#include "vk_harness/device/capabilities.hpp"

namespace vk_harness {

// The largest number that vertex shaders of the device can choose from; 1 without the features
// multiViewport and shaderOutputViewportIndex.
uint32_t query_max_viewports(VkPhysicalDevice physical);

// Fills max_layers and layer_output.
void query_layers(Capabilities& c);

// Asks for the features behind gl_ViewportIndex and gl_Layer that the device has; chained to
// `features`, which must not hold the Vulkan 1.2 ones yet.
void enable_vertex_outputs(const Capabilities& c, VkPhysicalDeviceFeatures2& features,
                           VkPhysicalDeviceVulkan12Features& features12);

}  // namespace vk_harness
