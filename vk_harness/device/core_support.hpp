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
    std::vector<const char*> extensions;  // without features, in place of a version of Vulkan
    bool depth_resolve = false;           // VK_KHR_depth_stencil_resolve
    // Features (features.hpp).
    bool independent_blend = false;
    bool synchronization2 = false;  // else barriers are those of 1.0
    bool maintenance4 = false;
    bool dynamic_rendering = false;  // else cases are rendered by render pass objects
    // extendedDynamicState and extendedDynamicState2; else pipelines hold what these would set.
    bool dynamic_state = false;
};

// All but the features.
CoreSupport query_core_support(VkPhysicalDevice physical, uint32_t api_version);

// Commands that are core in 1.3 under the names that they have in an extension of the device.
void use_extension_names(VolkDeviceTable& table);

}  // namespace vk_harness
