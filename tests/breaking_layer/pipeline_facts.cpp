// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline_facts.hpp"

#include <map>
#include <mutex>

namespace breaking {

namespace {

std::mutex shaders_mutex;
std::map<VkShaderModule, ShaderFacts> facts_of_shaders;

}  // namespace

void note_shader(VkShaderModule shader, const ShaderFacts& facts) {
    const std::lock_guard lock(shaders_mutex);
    facts_of_shaders[shader] = facts;
}

PipelineFacts facts_of(const VkGraphicsPipelineCreateInfo& info) {
    PipelineFacts out;
    for (uint32_t k = 0; k < info.stageCount; ++k) {
        const VkPipelineShaderStageCreateInfo& stage = info.pStages[k];
        out.stages |= static_cast<VkShaderStageFlags>(stage.stage);
        const std::lock_guard lock(shaders_mutex);
        if (stage.stage == VK_SHADER_STAGE_VERTEX_BIT) {
            out.has_matrix = facts_of_shaders[stage.module].multiplies;
        } else if (stage.stage == VK_SHADER_STAGE_FRAGMENT_BIT) {
            out.fragment = facts_of_shaders[stage.module];
            out.constants =
                stage.pSpecializationInfo != nullptr ? stage.pSpecializationInfo->mapEntryCount : 0;
        }
    }
    out.has_divisors =
        info.pVertexInputState != nullptr && info.pVertexInputState->pNext != nullptr;
    for (const auto* s = static_cast<const VkBaseInStructure*>(info.pNext); s != nullptr;
         s = s->pNext) {
        if (s->sType == VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO) {
            const auto& rendering = *reinterpret_cast<const VkPipelineRenderingCreateInfo*>(s);
            out.colors.assign(rendering.pColorAttachmentFormats,
                              rendering.pColorAttachmentFormats + rendering.colorAttachmentCount);
            out.depth = rendering.depthAttachmentFormat;
            out.stencil = rendering.stencilAttachmentFormat;
        }
    }
    if (info.pColorBlendState != nullptr) {
        out.blends.assign(
            info.pColorBlendState->pAttachments,
            info.pColorBlendState->pAttachments + info.pColorBlendState->attachmentCount);
        out.has_plain_output = info.pColorBlendState->logicOpEnable == VK_FALSE;
    }
    if (info.pMultisampleState != nullptr) {
        out.samples = info.pMultisampleState->rasterizationSamples;
        out.has_plain_output = out.has_plain_output &&
                               info.pMultisampleState->alphaToCoverageEnable == VK_FALSE &&
                               info.pMultisampleState->alphaToOneEnable == VK_FALSE;
    }
    return out;
}

}  // namespace breaking
