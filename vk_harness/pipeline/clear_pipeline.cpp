// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/clear_pipeline.hpp"

#include <algorithm>

#include "cases/model/sample.hpp"
#include "shaders/shaders.hpp"
#include "vk_harness/pipeline/pipeline_key.hpp"
#include "vk_harness/pipeline/pipeline_state.hpp"

namespace vk_harness {

namespace {

constexpr VkStencilOpState kReplace = {VK_STENCIL_OP_REPLACE,
                                       VK_STENCIL_OP_REPLACE,
                                       VK_STENCIL_OP_REPLACE,
                                       VK_COMPARE_OP_ALWAYS,
                                       cases::kStencilBits,
                                       cases::kStencilBits,
                                       0};

}  // namespace

std::vector<ClearKey> clear_keys(const cases::Target& target,
                                 const std::vector<Attachment>& attachments) {
    ClearKey key;
    key.samples = target.samples;
    key.sample_locations = target.sample_locations;
    for (const Attachment& a : attachments) {
        if (a.is_resolved()) {
            continue;
        }
        if (a.role == Role::depth) {
            key.depth_format = a.format;
            key.has_depth = true;
        } else if (a.role == Role::stencil) {
            key.stencil_format = a.format;
            key.has_stencil = true;
        } else {
            key.colors.push_back(a.format);
        }
    }
    std::vector<ClearKey> keys;
    for (uint32_t k = 0; k < key.colors.size(); ++k) {
        keys.push_back(key);
        keys.back().location = k;
        keys.back().output = output_of(key.colors[k]);
    }
    if (key.has_depth || key.has_stencil) {
        keys.push_back(key);
    }
    return keys;
}

VkClearValue other_clear(const Attachment& attachment) {
    VkClearValue out{};
    if (attachment.is_depth_stencil()) {
        out.depthStencil = {attachment.clear.depthStencil.depth > 0.5F ? 0.0F : 1.0F,
                            attachment.clear.depthStencil.stencil ^ cases::kStencilBits};
        return out;
    }
    const auto& own = attachment.clear.color.uint32;
    const bool has_zero = std::find(std::begin(own), std::end(own), 0U) != std::end(own);
    if (has_zero && output_of(attachment.format) != shaders::Output::number) {
        std::fill(std::begin(out.color.uint32), std::end(out.color.uint32), 1U);
    } else if (has_zero) {
        std::fill(std::begin(out.color.float32), std::end(out.color.float32), 0.8125F);
    }
    return out;
}

Handle<VkPipeline> make_clear(PipelineBase& base, const ClearKey& key) {
    const bool is_depth = !key.location;
    const VkShaderModule vertex = base.shader_module(shaders::clear_vertex());
    const VkShaderModule fragment = base.shader_module(
        is_depth ? shaders::clear_depth() : shaders::clear_color(*key.location, key.output));
    const std::array<VkPipelineShaderStageCreateInfo, 2> stages = {
        stage_info(VK_SHADER_STAGE_VERTEX_BIT, vertex),
        stage_info(VK_SHADER_STAGE_FRAGMENT_BIT, fragment)};
    PipelineKey target;
    target.samples = key.samples;
    target.sample_locations = key.sample_locations;
    const MultisampleState multisample(target);
    VkPipelineDepthStencilStateCreateInfo depth =
        Typed{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthCompareOp = VK_COMPARE_OP_ALWAYS;
    depth.depthTestEnable = depth.depthWriteEnable = is_depth && key.has_depth ? VK_TRUE : VK_FALSE;
    depth.stencilTestEnable = is_depth && key.has_stencil ? VK_TRUE : VK_FALSE;
    depth.front = depth.back = kReplace;
    std::vector<VkPipelineColorBlendAttachmentState> blends(key.colors.size());
    if (key.location) {
        blends.at(*key.location).colorWriteMask =
            VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
            VK_COLOR_COMPONENT_A_BIT;
    }
    VkPipelineColorBlendStateCreateInfo blend =
        Typed{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = static_cast<uint32_t>(blends.size());
    blend.pAttachments = blends.data();
    FullTargetState full;
    if (is_depth && key.has_stencil) {
        full.dynamic.push_back(VK_DYNAMIC_STATE_STENCIL_REFERENCE);
    }
    const VkPipelineRenderingCreateInfo rendering =
        rendering_info(key.colors, key.depth_format, key.stencil_format);
    VkGraphicsPipelineCreateInfo info = Typed{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.pNext = &rendering;
    info.stageCount = static_cast<uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pMultisampleState = &multisample.info;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.layout = base.layouts().draw.get();
    full.apply(info);
    return base.create(info);
}

}  // namespace vk_harness
