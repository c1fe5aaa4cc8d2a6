// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/discard_support.hpp"

namespace vk_harness {

DiscardSupport query_discard_support(VkPhysicalDevice physical, uint32_t api_version,
                                     bool (*has_extension)(VkPhysicalDevice, const char*)) {
    DiscardSupport out;
    DiscardFeatures asked;
    VkPhysicalDeviceFeatures2 features = Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    const auto ask = [&](const char* extension, auto& structure) {
        if (api_version < VK_API_VERSION_1_3 && !has_extension(physical, extension)) {
            return;
        }
        chain(features, structure);
        if (api_version < VK_API_VERSION_1_3) {
            out.extensions.push_back(extension);
        }
    };
    ask(VK_EXT_SHADER_DEMOTE_TO_HELPER_INVOCATION_EXTENSION_NAME, asked.demote);
    ask(VK_KHR_SHADER_TERMINATE_INVOCATION_EXTENSION_NAME, asked.terminate);
    vkGetPhysicalDeviceFeatures2(physical, &features);
    out.demote = asked.demote.shaderDemoteToHelperInvocation == VK_TRUE;
    out.terminate = asked.terminate.shaderTerminateInvocation == VK_TRUE;
    return out;
}

void enable_discard_features(const DiscardSupport& support, VkPhysicalDeviceFeatures2& features,
                             std::vector<const char*>& extensions, DiscardFeatures& enabled) {
    extensions.insert(extensions.end(), support.extensions.begin(), support.extensions.end());
    if (support.demote) {
        enabled.demote.shaderDemoteToHelperInvocation = VK_TRUE;
        chain(features, enabled.demote);
    }
    if (support.terminate) {
        enabled.terminate.shaderTerminateInvocation = VK_TRUE;
        chain(features, enabled.terminate);
    }
}

}  // namespace vk_harness
