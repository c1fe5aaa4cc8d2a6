// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Several viewports: all of a case are bound at once, and each draw picks its own by
// gl_ViewportIndex. Several layers: each draw picks its own by gl_Layer.
#pragma once

#include <span>

#include "cases/model/case.hpp"
#include "vk_harness/device/device.hpp"

namespace vk_harness {

// How many viewports a case binds: one more than the largest index of its draws.
uint32_t viewport_count(const cases::Case& c);

// The largest number that vertex shaders of the device can choose from; 1 without the features
// multiViewport and shaderOutputViewportIndex.
uint32_t query_max_viewports(VkPhysicalDevice physical);

// Whether the vertex shaders of a case write gl_Layer: some draw goes to another than the first
// layer, which is the one that is drawn to without it.
bool names_layers(const cases::Case& c);

// Fills max_layers and layer_output.
void query_layers(Capabilities& c);

// Asks for the features behind gl_ViewportIndex and gl_Layer that the device has; chained to
// `features`, which must not hold the Vulkan 1.2 ones yet.
void enable_vertex_outputs(const Capabilities& c, VkPhysicalDeviceFeatures2& features,
                           VkPhysicalDeviceVulkan12Features& features12);

// Binds the viewport and scissor of each draw at its index, those of `own` at the last; what no
// draw has is a viewport of one pixel. `own_scissor` is bound instead of the scissor of `own`.
void bind_viewports(const Device& device, VkCommandBuffer commands, const cases::Case& c,
                    const cases::Draw& own, const VkRect2D& own_scissor);

}  // namespace vk_harness
