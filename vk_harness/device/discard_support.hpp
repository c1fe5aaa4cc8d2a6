// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The instructions besides OpKill by which a fragment shader may discard.
#pragma once

#include <vector>

#include "vk_harness/device/api.hpp"

namespace vk_harness {

struct DiscardSupport {
    bool demote = false;                  // shaderDemoteToHelperInvocation
    bool terminate = false;               // shaderTerminateInvocation
    std::vector<const char*> extensions;  // to enable, because the device's version lacks them
};

DiscardSupport query_discard_support(VkPhysicalDevice physical, uint32_t api_version,
                                     bool (*has_extension)(VkPhysicalDevice, const char*));

// Features to enable, as a chain that must outlive vkCreateDevice and must not be moved.
struct DiscardFeatures {
    VkPhysicalDeviceShaderDemoteToHelperInvocationFeatures demote =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_DEMOTE_TO_HELPER_INVOCATION_FEATURES};
    VkPhysicalDeviceShaderTerminateInvocationFeatures terminate =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_TERMINATE_INVOCATION_FEATURES};
};
// Puts them before `features`' chain, and the extensions into the list.
void enable_discard_features(const DiscardSupport& support, VkPhysicalDeviceFeatures2& features,
                             std::vector<const char*>& extensions, DiscardFeatures& enabled);

}  // namespace vk_harness
