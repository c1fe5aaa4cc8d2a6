// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/graphics_pipeline.hpp"

#include <limits>

#include "shaders/shaders.hpp"
#include "vk_harness/pipeline/pipeline_state.hpp"
#include "vk_harness/pipeline/pipeline_ways.hpp"

namespace vk_harness {

namespace {

// The shader stages, with all that they point to: not to be moved.
struct Stages {
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    Specialization of_fragment, of_between;

    Stages(PipelineBase& base, const PipelineKey& key) {
        // What discards for good has no fragment shader
        // (VUID-VkGraphicsPipelineCreateInfo-pStages-06894).
        if (needs_fragments(key) && (!key.fixed || key.fixed->discard != VK_TRUE)) {
            const bool has_id = base.device().capabilities().info.has_primitive_id;
            specialize(key, of_fragment);
            stages.push_back(
                stage_info(VK_SHADER_STAGE_FRAGMENT_BIT,
                           base.shader_module(fragment_code(key), fragment_changes(key, has_id))));
            stages.back().pSpecializationInfo = &of_fragment.info;
        }
        stages.push_back(
            key.stages == StageWay::mesh
                ? stage_info(VK_SHADER_STAGE_MESH_BIT_EXT,
                             base.shader_module(shaders::capture_mesh(geometry_variant(key))))
                : stage_info(VK_SHADER_STAGE_VERTEX_BIT,
                             base.shader_module(vertex_code(key), vertex_changes(key))));
        for (const auto& [stage, code] : stages_between(key)) {
            stages.push_back(stage_info(stage, base.shader_module(code)));
            if (stage != VK_SHADER_STAGE_TESSELLATION_CONTROL_BIT) {
                specialize_between(key, of_between);
                stages.back().pSpecializationInfo = &of_between.info;
            }
        }
    }
};

// The fixed state, with all that it points to: not to be moved.
struct FixedState {
    VertexInputState inputs;
    VkPipelineInputAssemblyStateCreateInfo assembly;
    VkPipelineTessellationStateCreateInfo tessellation =
        Typed{VK_STRUCTURE_TYPE_PIPELINE_TESSELLATION_STATE_CREATE_INFO};
    ViewportState viewport;
    RasterizationState rasterization;
    MultisampleState multisample;
    VkPipelineDepthStencilStateCreateInfo depth;
    ColorState color;
    std::vector<VkDynamicState> dynamic;
    VkPipelineDynamicStateCreateInfo dynamic_info =
        Typed{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    VkPipelineFragmentShadingRateStateCreateInfoKHR fragments;
    VkPipelineRenderingCreateInfo rendering;

    explicit FixedState(const PipelineKey& key)
        : inputs(key),
          assembly(assembly_state(key)),
          viewport(key),
          rasterization(key),
          multisample(key),
          depth(depth_state(key)),
          color(key),
          dynamic(dynamic_states(key)),
          fragments(fragment_size_state(key)),
          rendering(rendering_info(color.formats,
                                   !key.has_depth    ? VK_FORMAT_UNDEFINED
                                   : key.has_stencil ? key.layout.stencil_format
                                                     : depth_format(key.depth_format),
                                   key.layout.stencil_format)) {
        tessellation.patchControlPoints = 3;
        dynamic_info.dynamicStateCount = static_cast<uint32_t>(dynamic.size());
        dynamic_info.pDynamicStates = dynamic.data();
        rendering.viewMask = key.view_mask;
    }

    void apply(const PipelineKey& key, VkGraphicsPipelineCreateInfo& info) {
        const bool is_mesh = key.stages == StageWay::mesh;
        info.pVertexInputState = is_mesh ? nullptr : &inputs.info;
        info.pInputAssemblyState = is_mesh ? nullptr : &assembly;
        info.pTessellationState = key.stages == StageWay::tessellation ? &tessellation : nullptr;
        info.pViewportState = &viewport.info;
        info.pRasterizationState = &rasterization.info;
        info.pMultisampleState = &multisample.info;
        info.pDepthStencilState = &depth;
        info.pColorBlendState = &color.info;
        info.pDynamicState = &dynamic_info;
        // "The default is {1,1}" of a pipeline that does not say it.
        if (key.fragment_size[0] * key.fragment_size[1] > 1) {
            chain(info, fragments);
        }
        if (!key.pass) {
            rendering.pNext = info.pNext;
            info.pNext = &rendering;
        }
    }
};

}  // namespace

PipelineKey base_key(const PipelineKey& key) {
    PipelineKey other = key;
    other.made = PipelineWay::base;
    other.masked = std::numeric_limits<uint32_t>::max();
    for (ColorKey& color : other.colors) {
        color.write_mask = 0;
    }
    return other;
}

Handle<VkPipeline> make_graphics(PipelineBase& base, const PipelineKey& key, VkRenderPass pass,
                                 VkPipeline derived_from,
                                 std::vector<Handle<VkPipeline>>& libraries) {
    const Stages stages(base, key);
    FixedState state(key);
    VkGraphicsPipelineCreateInfo info = Typed{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.stageCount = static_cast<uint32_t>(stages.stages.size());
    info.pStages = stages.stages.data();
    state.apply(key, info);
    info.renderPass = pass;
    info.subpass = key.subpass;
    // Nothing is bound to the second set where no shader has it.
    const PipelineLayouts& layouts = base.layouts();
    info.layout = key.color_from > cases::ColorFrom::constant
                      ? layouts.colored(key.color_from).layout.get()
                  : key.way.pulled || key.unused_interface ? layouts.pulled.get()
                                                           : layouts.draw.get();
    switch (key.made) {
        case PipelineWay::usual:
            break;
        case PipelineWay::unoptimized:
            info.flags = VK_PIPELINE_CREATE_DISABLE_OPTIMIZATION_BIT;
            break;
        case PipelineWay::base:
            info.flags = VK_PIPELINE_CREATE_ALLOW_DERIVATIVES_BIT;
            break;
        case PipelineWay::library:
            return make_from_library(base, info, libraries);
        case PipelineWay::derived:
            info.flags = VK_PIPELINE_CREATE_DERIVATIVE_BIT;
            info.basePipelineHandle = derived_from;
            info.basePipelineIndex = -1;
            break;
        case PipelineWay::cached:
            return make_cached(base, info);
    }
    return base.create(info);
}

}  // namespace vk_harness
