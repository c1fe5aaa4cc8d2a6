// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/vertex_outputs.hpp"

#include <algorithm>

namespace vk_harness {

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

}  // namespace vk_harness
