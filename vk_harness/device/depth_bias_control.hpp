// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// VK_EXT_depth_bias_control: the unit of a constant depth bias, chosen by the application. Debian
// 12's Vulkan headers are older than the extension (revision 1, extension 284), so what is used of
// it is declared here.
#pragma once

#include <optional>
#include <string>

#include "cases/model/case.hpp"
#include "vk_harness/device/api.hpp"

namespace vk_harness {

inline constexpr const char* kDepthBiasControlExtension = "VK_EXT_depth_bias_control";

struct DepthBiasSupport {
    bool control = false;      // depthBiasControl
    bool force_unorm = false;  // leastRepresentableValueForceUnormRepresentation
    bool floating = false;     // floatRepresentation
    bool exact = false;        // depthBiasExact
};

// VkPhysicalDeviceDepthBiasControlFeaturesEXT.
struct DepthBiasControlFeatures {
    VkStructureType type = static_cast<VkStructureType>(1000283000);
    void* pNext = nullptr;
    VkBool32 control = VK_FALSE, force_unorm = VK_FALSE, floating = VK_FALSE, exact = VK_FALSE;
};

// As PFN_vkCmdSetDepthBias2EXT; the argument is a VkDepthBiasInfoEXT.
using SetDepthBias2 = void(VKAPI_PTR*)(VkCommandBuffer, const void*);

// Why the device cannot take a bias: one sentence that names the feature; nothing if it can.
std::optional<std::string> missing_depth_bias_support(const DepthBiasSupport& support,
                                                      const cases::DepthBias& bias);

// Records a bias whose unit is chosen (DepthBias::is_controlled()).
void record_controlled_bias(SetDepthBias2 set_depth_bias, VkCommandBuffer commands,
                            const cases::DepthBias& bias);

}  // namespace vk_harness
