// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/viewports.hpp"

#include <algorithm>
#include <vector>

namespace vk_harness {

namespace {

VkViewport to_vulkan(const cases::Viewport& v) {
    return {v.x, v.y, v.width, v.height, v.min_depth, v.max_depth};
}

}  // namespace

uint32_t viewport_count(const cases::Case& c) {
    uint32_t count = 1;
    for (const cases::Draw& draw : c.draws) {
        count = std::max(count, draw.viewport_index + 1);
    }
    return count;
}

uint32_t query_max_viewports(VkPhysicalDevice physical) {
    VkPhysicalDeviceVulkan12Features features12{};
    features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &features12;
    vkGetPhysicalDeviceFeatures2(physical, &features);
    if (features.features.multiViewport != VK_TRUE ||
        features12.shaderOutputViewportIndex != VK_TRUE) {
        return 1;
    }
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical, &properties);
    return properties.limits.maxViewports;
}

bool names_layers(const cases::Case& c) {
    return std::any_of(c.draws.begin(), c.draws.end(),
                       [](const cases::Draw& draw) { return draw.layer > 0; });
}

void query_layers(Capabilities& c) {
    VkPhysicalDeviceVulkan12Features features12{};
    features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &features12;
    vkGetPhysicalDeviceFeatures2(c.physical, &features);
    c.layer_output = features12.shaderOutputLayer == VK_TRUE;
    c.max_layers = std::min(c.limits.maxFramebufferLayers, c.limits.maxImageArrayLayers);
}

void enable_vertex_outputs(const Capabilities& c, VkPhysicalDeviceFeatures2& features,
                           VkPhysicalDeviceVulkan12Features& features12) {
    const VkBool32 has_viewports = c.max_viewports > 1 ? VK_TRUE : VK_FALSE;
    features.features.multiViewport = has_viewports;
    features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    features12.shaderOutputViewportIndex = has_viewports;
    features12.shaderOutputLayer = c.layer_output ? VK_TRUE : VK_FALSE;
    features12.pNext = features.pNext;
    features.pNext = &features12;
}

void bind_viewports(const Device& device, VkCommandBuffer commands, const cases::Case& c,
                    const cases::Draw& own, const VkRect2D& own_scissor) {
    const uint32_t count = viewport_count(c);
    std::vector<VkViewport> viewports(count, {0, 0, 1, 1, 0, 1});
    std::vector<VkRect2D> scissors(count, {{0, 0}, {1, 1}});
    for (const cases::Draw& draw : c.draws) {
        viewports[draw.viewport_index] = to_vulkan(draw.viewport);
        scissors[draw.viewport_index] = {{draw.scissor.x, draw.scissor.y},
                                         {draw.scissor.width, draw.scissor.height}};
    }
    viewports[own.viewport_index] = to_vulkan(own.viewport);
    scissors[own.viewport_index] = own_scissor;
    device.vk().vkCmdSetViewport(commands, 0, count, viewports.data());
    device.vk().vkCmdSetScissor(commands, 0, count, scissors.data());
}

}  // namespace vk_harness
