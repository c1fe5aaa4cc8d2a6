// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/depth_bias_control.hpp"

#include <utility>

namespace vk_harness {

namespace {

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
            return std::string("the device lacks the feature ") + feature + " of " +
                   kDepthBiasControlExtension;
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
