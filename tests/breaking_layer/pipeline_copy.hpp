// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <optional>
#include <vector>

#include "pipeline_facts.hpp"

namespace breaking {

inline bool has_dynamic_state(const VkGraphicsPipelineCreateInfo& info) {
    return info.pDynamicState != nullptr && info.pDynamicState->dynamicStateCount > 0;
}

// A VkGraphicsPipelineCreateInfo with everything that faults write, in memory of its own. Chained
// structures that are not named here go on to the driver as they are.
class PipelineCopy {
  public:
    explicit PipelineCopy(const VkGraphicsPipelineCreateInfo& from);

    VkPipelineVertexInputStateCreateInfo vertex_input{};
    std::vector<VkVertexInputAttributeDescription> inputs;
    std::vector<VkVertexInputBindingDescription> bindings;
    std::vector<VkVertexInputBindingDivisorDescriptionEXT> divisors;
    std::optional<VkPipelineVertexInputDivisorStateCreateInfoEXT> divided;
    VkPipelineRasterizationStateCreateInfo rasterization{};
    std::optional<VkPipelineRasterizationDepthClipStateCreateInfoEXT> depth_clip;
    std::optional<VkPipelineRasterizationProvokingVertexStateCreateInfoEXT> provoking;
    std::optional<VkPipelineViewportDepthClipControlCreateInfoEXT> clip_control;
    VkPipelineMultisampleStateCreateInfo multisample{};
    VkSampleMask mask = ~VkSampleMask{0};  // up to 32 samples
    std::optional<VkPipelineSampleLocationsStateCreateInfoEXT> locations;
    std::vector<VkSampleLocationEXT> places;
    VkPipelineDepthStencilStateCreateInfo depth{};
    VkPipelineColorBlendStateCreateInfo blend{};
    std::vector<VkPipelineColorBlendAttachmentState> blends;

    PipelineFacts facts;              // as it was asked for
    std::vector<uint32_t> constants;  // words that specialize the fragment shader

    bool is_unoptimized() const {
        return (info_.flags & VK_PIPELINE_CREATE_DISABLE_OPTIMIZATION_BIT) != 0;
    }
    bool is_library() const { return (info_.flags & VK_PIPELINE_CREATE_LIBRARY_BIT_KHR) != 0; }
    bool is_derived() const { return (info_.flags & VK_PIPELINE_CREATE_DERIVATIVE_BIT) != 0; }
    bool has_cached_data = false;  // it is made with a cache that was made of data
    bool has_inputs() const { return info_.pVertexInputState == nullptr || !inputs.empty(); }
    bool lacks_stencil = false;  // it is made for a dynamic rendering without stencil
    // Nothing of its state is dynamic.
    bool is_static() const { return !has_dynamic_state(info_); }

    // Ties the parts together; valid until the copy is changed or moved.
    const VkGraphicsPipelineCreateInfo& info();

  private:
    VkGraphicsPipelineCreateInfo info_;
    std::vector<VkPipelineShaderStageCreateInfo> stages_;
    VkSpecializationInfo specialized_{};
    VkPipelineViewportStateCreateInfo viewport_{};
};

}  // namespace breaking
