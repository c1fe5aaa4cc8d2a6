// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline_state.hpp"

namespace vk_harness {

void vertex_input_state(const PipelineKey& key, VertexInputState& state) {
    // Binding and location 0: positions; 1..: attributes. Each is an array of its own.
    for (uint32_t binding = 0; binding <= key.attribute_count; ++binding) {
        state.bindings.push_back({binding, 16, VK_VERTEX_INPUT_RATE_VERTEX});
        state.inputs.push_back({binding, binding, VK_FORMAT_R32G32B32A32_SFLOAT, 0});
    }
    state.info.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    state.info.vertexBindingDescriptionCount = static_cast<uint32_t>(state.bindings.size());
    state.info.pVertexBindingDescriptions = state.bindings.data();
    state.info.vertexAttributeDescriptionCount = static_cast<uint32_t>(state.inputs.size());
    state.info.pVertexAttributeDescriptions = state.inputs.data();
}

void rasterization_state(const PipelineKey&, RasterizationState& state) {
    state.info.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    state.info.polygonMode = VK_POLYGON_MODE_FILL;
    state.info.lineWidth = 1.0F;
}

void multisample_state(const PipelineKey& key, MultisampleState& state) {
    state.info.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    state.info.rasterizationSamples = static_cast<VkSampleCountFlagBits>(key.samples);
}

VkPipelineDepthStencilStateCreateInfo depth_state(const PipelineKey& key) {
    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = VK_TRUE;  // without the test there is no depth write
    depth.depthWriteEnable = key.masks_depth ? VK_FALSE : VK_TRUE;
    depth.depthCompareOp = VK_COMPARE_OP_ALWAYS;
    return depth;
}

void color_state(const PipelineKey& key, ColorState& state) {
    const uint32_t count = kFixedAttachments + key.attribute_count;
    VkPipelineColorBlendAttachmentState plain{};
    plain.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                           VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    state.blends.assign(count, plain);
    state.formats.assign(count, kColorFormat);
    VkPipelineColorBlendAttachmentState& hits = state.blends.front();
    hits.blendEnable = VK_TRUE;
    hits.srcColorBlendFactor = VK_BLEND_FACTOR_ONE;
    hits.dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
    hits.colorBlendOp = VK_BLEND_OP_ADD;
    hits.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    hits.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    hits.alphaBlendOp = VK_BLEND_OP_ADD;
    for (uint32_t k = 0; k < kFixedAttachments + key.attribute_count; ++k) {
        if ((key.masked >> k & 1U) != 0) {
            state.blends[k].colorWriteMask = 0;
        }
    }
    state.info.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    state.info.attachmentCount = count;
    state.info.pAttachments = state.blends.data();
}

}  // namespace vk_harness
