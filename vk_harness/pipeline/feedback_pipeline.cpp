// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/feedback_pipeline.hpp"

#include "vk_harness/pipeline/pipeline_state.hpp"

namespace vk_harness {

Handle<VkPipeline> make_feedback(PipelineBase& base, uint32_t attribute_count) {
    const VkShaderModule vertex = base.shader_module(shaders::feedback_vertex(attribute_count));
    const VkPipelineShaderStageCreateInfo stage = stage_info(VK_SHADER_STAGE_VERTEX_BIT, vertex);
    PipelineKey key;
    key.attribute_count = attribute_count;
    key.way.interleaved = true;
    const VertexInputState inputs(key);
    VkPipelineInputAssemblyStateCreateInfo assembly =
        Typed{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineRasterizationStateCreateInfo rasterization =
        Typed{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    rasterization.rasterizerDiscardEnable = VK_TRUE;
    rasterization.lineWidth = 1;
    const VkPipelineRenderingCreateInfo rendering =
        Typed{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    VkGraphicsPipelineCreateInfo info = Typed{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.pNext = &rendering;
    info.stageCount = 1;
    info.pStages = &stage;
    info.pVertexInputState = &inputs.info;
    info.pInputAssemblyState = &assembly;
    info.pRasterizationState = &rasterization;
    info.layout = base.layouts().draw.get();
    return base.create(info);
}

}  // namespace vk_harness
