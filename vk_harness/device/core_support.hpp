// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the harness uses of Vulkan beyond 1.1 where a device has it: in core, or by the extension
// that it was before.
#pragma once

#include <string>
#include <vector>

#include "vk_harness/device/api.hpp"

namespace vk_harness {

struct CoreSupport {
    std::vector<std::string> missing;     // one sentence each; empty: all is there
    std::vector<const char*> extensions;  // to enable, because the device's version lacks them
    bool synchronization2 = false;        // else barriers are those of 1.0
    bool maintenance4 = false;
    bool depth_resolve = false;      // VK_KHR_depth_stencil_resolve
    bool dynamic_rendering = false;  // else cases are rendered by render pass objects
    // extendedDynamicState and extendedDynamicState2; else pipelines hold what these would set.
    bool dynamic_state = false;
    bool dynamic_state_features = false;  // they are of extensions, and enabled by structures
};

CoreSupport query_core_support(VkPhysicalDevice physical, uint32_t api_version,
                               bool (*has_extension)(VkPhysicalDevice, const char*));

// Features to enable, as a chain that must outlive vkCreateDevice and must not be moved.
struct CoreFeatures {
    VkPhysicalDeviceDynamicRenderingFeatures dynamic_rendering =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES};
    VkPhysicalDeviceSynchronization2Features synchronization2 =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES};
    VkPhysicalDeviceMaintenance4Features maintenance4 =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES};
    VkPhysicalDeviceExtendedDynamicStateFeaturesEXT dynamic_state =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTENDED_DYNAMIC_STATE_FEATURES_EXT};
    VkPhysicalDeviceExtendedDynamicState2FeaturesEXT dynamic_state2 =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTENDED_DYNAMIC_STATE_2_FEATURES_EXT};
};
// Puts them before `features`' chain, and the extensions into the list.
void enable_core_features(const CoreSupport& support, VkPhysicalDeviceFeatures2& features,
                          std::vector<const char*>& extensions, CoreFeatures& enabled);

// Commands that are core in 1.3 under the names that they have in an extension of the device.
void use_extension_names(VolkDeviceTable& table);

}  // namespace vk_harness
