// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/depth_bias_control.hpp"

#include <utility>

namespace vk_harness {

namespace {

constexpr const char* kExtension = "VK_EXT_depth_bias_control";

// VkDepthBiasRepresentationInfoEXT.
struct RepresentationInfo {
    VkStructureType type = static_cast<VkStructureType>(1000283002);
    const void* pNext = nullptr;
    int32_t representation = 0;  // VkDepthBiasRepresentationEXT, in the order of the model's
    VkBool32 exact = VK_FALSE;
};

// VkDepthBiasInfoEXT.
struct BiasInfo {
    VkStructureType type = static_cast<VkStructureType>(1000283001);
    const void* pNext = nullptr;
    float constant = 0, clamp = 0, slope = 0;
};

}  // namespace

DepthBiasSupport query_depth_bias_support(VkPhysicalDevice physical,
                                          bool (*has_extension)(VkPhysicalDevice, const char*)) {
    if (!has_extension(physical, kExtension)) {
        return {};
    }
    DepthBiasControlFeatures control;
    VkPhysicalDeviceFeatures2 features = Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    features.pNext = &control;
    vkGetPhysicalDeviceFeatures2(physical, &features);
    return {control.control == VK_TRUE, control.force_unorm == VK_TRUE, control.floating == VK_TRUE,
            control.exact == VK_TRUE};
}

void enable_depth_bias_control(const DepthBiasSupport& support, VkPhysicalDeviceFeatures2& features,
                               std::vector<const char*>& extensions,
                               DepthBiasControlFeatures& chain) {
    if (!support.control) {
        return;
    }
    chain.control = VK_TRUE;
    chain.force_unorm = support.force_unorm ? VK_TRUE : VK_FALSE;
    chain.floating = support.floating ? VK_TRUE : VK_FALSE;
    chain.exact = support.exact ? VK_TRUE : VK_FALSE;
    vk_harness::chain(features, chain);
    extensions.push_back(kExtension);
}

std::optional<std::string> missing_depth_bias_support(const DepthBiasSupport& support,
                                                      const cases::DepthBias& bias) {
    using Representation = cases::DepthBiasRepresentation;
    if (!bias.is_controlled()) {
        return std::nullopt;
    }
    for (const auto& [lacks, feature] :
         {std::pair(!support.control, "depthBiasControl"),
          {bias.representation == Representation::force_unorm && !support.force_unorm,
           "leastRepresentableValueForceUnormRepresentation"},
          {bias.representation == Representation::floating && !support.floating,
           "floatRepresentation"},
          {bias.is_exact && !support.exact, "depthBiasExact"}}) {
        if (lacks) {
            return std::string("the device lacks the feature ") + feature + " of " + kExtension;
        }
    }
    return std::nullopt;
}

void record_controlled_bias(SetDepthBias2 set_depth_bias, VkCommandBuffer commands,
                            const cases::DepthBias& bias) {
    RepresentationInfo representation;
    representation.representation = static_cast<int32_t>(bias.representation);
    representation.exact = bias.is_exact ? VK_TRUE : VK_FALSE;
    BiasInfo info;
    info.pNext = &representation;
    info.constant = bias.constant;
    info.clamp = bias.clamp;
    info.slope = bias.slope;
    set_depth_bias(commands, &info);
}

}  // namespace vk_harness
