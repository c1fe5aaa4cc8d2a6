// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/pipeline_state.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "capture/capture.hpp"
#include "vk_harness/device/sample_locations.hpp"

namespace vk_harness {

VertexInputState::VertexInputState(const PipelineKey& key) {
    // Binding and location 0: positions; 1..: attributes; distances. Each is an array of its own,
    // but if all lie together.
    const Bindings read = key.way.pulled
                              ? Bindings{}
                              : bindings_of(key.attribute_count, key.clip_count, key.cull_count,
                                            key.way.instances == shaders::Instances::placed);
    uint32_t offset = 0;
    for (const uint32_t binding : read) {
        const uint32_t size = size_of(key.way, binding);
        const auto format = static_cast<VkFormat>(row_of(key.way.formats.at(binding)).vulkan);
        if (key.way.interleaved) {
            inputs.push_back({binding, 0, format, offset});
            offset += size;
            continue;
        }
        const bool is_of_instance = key.way.is_of_instance(binding);
        const VkVertexInputRate rate =
            is_of_instance ? VK_VERTEX_INPUT_RATE_INSTANCE : VK_VERTEX_INPUT_RATE_VERTEX;
        if (is_of_instance && key.way.divisors.at(binding) != 1) {
            divisors.push_back({binding, key.way.divisors.at(binding)});
        }
        const uint32_t stride =
            key.way.dynamic_stride ? kIgnoredStride : stride_of(key.way, binding);
        bindings.push_back({binding, stride, rate});
        inputs.push_back({binding, binding, format, 0});
    }
    if (key.way.interleaved) {
        bindings.push_back({0, offset, VK_VERTEX_INPUT_RATE_VERTEX});
    }
    if (key.unused_interface) {  // part of what is bound for positions
        inputs.push_back({kUnusedInput, 0, VK_FORMAT_R32_SFLOAT, 0});
    }
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    if (!divisors.empty()) {
        divided.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_DIVISOR_STATE_CREATE_INFO_EXT;
        divided.vertexBindingDivisorCount = static_cast<uint32_t>(divisors.size());
        divided.pVertexBindingDivisors = divisors.data();
        info.pNext = &divided;
    }
    info.vertexBindingDescriptionCount = static_cast<uint32_t>(bindings.size());
    info.pVertexBindingDescriptions = bindings.data();
    info.vertexAttributeDescriptionCount = static_cast<uint32_t>(inputs.size());
    info.pVertexAttributeDescriptions = inputs.data();
}

RasterizationState::RasterizationState(const PipelineKey& key) {
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    info.polygonMode = VK_POLYGON_MODE_FILL;
    info.lineWidth = 1.0F;
    info.depthClampEnable = key.depth_clamp ? VK_TRUE : VK_FALSE;
    if (key.fixed) {
        const auto [constant, clamp, slope] = std::bit_cast<std::array<float, 3>>(key.fixed->bias);
        info.cullMode = key.fixed->cull;
        info.frontFace = key.fixed->front_face;
        info.rasterizerDiscardEnable = key.fixed->discard;
        info.depthBiasEnable = key.fixed->has_bias;
        info.depthBiasConstantFactor = constant;
        info.depthBiasClamp = clamp;
        info.depthBiasSlopeFactor = slope;
    }
    if (key.depth_clip) {
        depth_clip.sType =
            VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_DEPTH_CLIP_STATE_CREATE_INFO_EXT;
        depth_clip.depthClipEnable = *key.depth_clip ? VK_TRUE : VK_FALSE;
        depth_clip.pNext = info.pNext;
        info.pNext = &depth_clip;
    }
    if (key.conservative != cases::Conservative::none) {
        conservative.sType =
            VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_CONSERVATIVE_STATE_CREATE_INFO_EXT;
        conservative.conservativeRasterizationMode =
            key.conservative == cases::Conservative::overestimate
                ? VK_CONSERVATIVE_RASTERIZATION_MODE_OVERESTIMATE_EXT
                : VK_CONSERVATIVE_RASTERIZATION_MODE_UNDERESTIMATE_EXT;
        conservative.extraPrimitiveOverestimationSize = std::bit_cast<float>(key.extra_bits);
        conservative.pNext = info.pNext;
        info.pNext = &conservative;
    }
    if (key.provoking == cases::ProvokingVertex::last) {
        provoking.sType =
            VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_PROVOKING_VERTEX_STATE_CREATE_INFO_EXT;
        provoking.provokingVertexMode = VK_PROVOKING_VERTEX_MODE_LAST_VERTEX_EXT;
        provoking.pNext = info.pNext;
        info.pNext = &provoking;
    }
}

VkPipelineFragmentShadingRateStateCreateInfoKHR fragment_size_state(const PipelineKey& key) {
    VkPipelineFragmentShadingRateStateCreateInfoKHR state =
        Typed{VK_STRUCTURE_TYPE_PIPELINE_FRAGMENT_SHADING_RATE_STATE_CREATE_INFO_KHR};
    state.fragmentSize = {key.fragment_size[0], key.fragment_size[1]};
    state.combinerOps[0] = state.combinerOps[1] = VK_FRAGMENT_SHADING_RATE_COMBINER_OP_KEEP_KHR;
    return state;
}

VkPipelineInputAssemblyStateCreateInfo assembly_state(const PipelineKey& key) {
    VkPipelineInputAssemblyStateCreateInfo assembly =
        Typed{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    // Where it is dynamic, the pipeline names its class.
    assembly.topology = key.fixed ? key.fixed->topology
                        : key.stages == StageWay::tessellation
                            ? VK_PRIMITIVE_TOPOLOGY_PATCH_LIST
                            : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    assembly.primitiveRestartEnable = key.fixed ? key.fixed->restart : VK_FALSE;
    return assembly;
}

ViewportState::ViewportState(const PipelineKey& key) {
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    info.viewportCount = key.viewports;
    info.scissorCount = key.viewports;
    if (key.fixed) {
        viewports = key.fixed->vulkan_viewports();
        scissors = key.fixed->vulkan_scissors();
        info.pViewports = viewports.data();
        info.pScissors = scissors.data();
    }
    if (key.negative_one_to_one) {
        depth_clip_control.sType =
            VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_DEPTH_CLIP_CONTROL_CREATE_INFO_EXT;
        depth_clip_control.negativeOneToOne = VK_TRUE;
        info.pNext = &depth_clip_control;
    }
}

MultisampleState::MultisampleState(const PipelineKey& key) {
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    info.rasterizationSamples = static_cast<VkSampleCountFlagBits>(key.samples);
    sample_mask = key.sample_mask;
    info.pSampleMask = &sample_mask;
    info.sampleShadingEnable = key.min_shading_bits ? VK_TRUE : VK_FALSE;
    info.minSampleShading = std::bit_cast<float>(key.min_shading_bits.value_or(0U));
    info.alphaToCoverageEnable = key.alpha_to_coverage ? VK_TRUE : VK_FALSE;
    info.alphaToOneEnable = key.alpha_to_one ? VK_TRUE : VK_FALSE;
    places = sample_places(key.sample_locations);
    locations.sType = VK_STRUCTURE_TYPE_PIPELINE_SAMPLE_LOCATIONS_STATE_CREATE_INFO_EXT;
    locations.sampleLocationsEnable = VK_TRUE;
    locations.sampleLocationsInfo = sample_locations_info(places);
    if (!places.empty()) {
        info.pNext = &locations;
    }
    if (key.outputs_are_dynamic) {
        sample_mask = 0;
    }
}

VkPipelineDepthStencilStateCreateInfo depth_state(const PipelineKey& key) {
    VkPipelineDepthStencilStateCreateInfo depth =
        Typed{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.stencilTestEnable = key.has_stencil ? VK_TRUE : VK_FALSE;
    if (key.has_stencil && key.fixed) {
        depth.front = std::bit_cast<VkStencilOpState>(key.fixed->stencil[0]);
        depth.back = std::bit_cast<VkStencilOpState>(key.fixed->stencil[1]);
    }
    if (key.unused_tests && !key.has_stencil) {
        // It would fail, and write.
        depth.stencilTestEnable = VK_TRUE;
        depth.front = {VK_STENCIL_OP_INVERT, VK_STENCIL_OP_INVERT, VK_STENCIL_OP_INVERT,
                       VK_COMPARE_OP_NEVER,  cases::kStencilBits,  cases::kStencilBits,
                       cases::kStencilBits};
        depth.back = depth.front;
    }
    if (key.unused_bounds) {
        depth.depthBoundsTestEnable = VK_TRUE;
        depth.minDepthBounds = depth.maxDepthBounds = 0.5F;
    }
    if (!key.has_depth) {
        // Beside a stencil there may be depth in the image.
        depth.depthTestEnable = key.unused_tests && !key.has_stencil ? VK_TRUE : VK_FALSE;
        return depth;
    }
    depth.depthTestEnable = VK_TRUE;  // without the test there is no depth write
    if (key.fixed) {
        depth.depthCompareOp = key.fixed->compare;
        depth.depthWriteEnable = key.fixed->depth_write;
    }
    if (key.fixed && key.tests_bounds) {
        const auto [min, max] = std::bit_cast<std::array<float, 2>>(key.fixed->bounds);
        depth.depthBoundsTestEnable = key.fixed->has_bounds;
        depth.minDepthBounds = min;
        depth.maxDepthBounds = max;
    }
    return depth;
}

namespace {

VkPipelineColorBlendAttachmentState blend_state(const ColorKey& key) {
    VkPipelineColorBlendAttachmentState out{};
    out.blendEnable = key.blends ? VK_TRUE : VK_FALSE;
    out.srcColorBlendFactor = static_cast<VkBlendFactor>(key.equation[0]);
    out.dstColorBlendFactor = static_cast<VkBlendFactor>(key.equation[1]);
    out.colorBlendOp = static_cast<VkBlendOp>(key.equation[2]);
    out.srcAlphaBlendFactor = static_cast<VkBlendFactor>(key.equation[3]);
    out.dstAlphaBlendFactor = static_cast<VkBlendFactor>(key.equation[4]);
    out.alphaBlendOp = static_cast<VkBlendOp>(key.equation[5]);
    out.colorWriteMask = key.write_mask;  // bits as VkColorComponentFlagBits
    return out;
}

using capture::kFragCoordPlane;
using capture::kHitsPlane;
using capture::kWritersPlane;

constexpr uint8_t kNothing = 0, kRgb = 0x7, kAlpha = 0x8, kAll = 0xf;

// Attachments of instruments in the order of attachments_of.
void instrument_states(const PipelineKey& key, ColorState& state) {
    const auto add = [&state](VkFormat format, const ColorKey& blend) {
        state.formats.push_back(format);
        state.blends.push_back(blend_state(blend));
    };
    const auto is_masked = [&key](uint32_t plane) { return (key.masked >> plane & 1U) != 0; };
    const auto replaced = [&is_masked](uint32_t plane) {
        ColorKey out;
        out.write_mask = is_masked(plane) ? kNothing : kAll;
        return out;
    };
    ColorKey hits;  // are added
    hits.blends = true;
    const auto destination = key.layout.split ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ZERO;
    hits.equation = {VK_BLEND_FACTOR_ONE, static_cast<uint8_t>(destination),
                     VK_BLEND_OP_ADD,     VK_BLEND_FACTOR_ONE,
                     VK_BLEND_FACTOR_ONE, VK_BLEND_OP_ADD};
    if (key.layout.split) {
        hits.write_mask = is_masked(kHitsPlane) ? kNothing : kAll;
        add(kTwoNumbers, replaced(kWritersPlane));
        add(key.layout.hit_format(), hits);
        add(kTwoNumbers, replaced(kFragCoordPlane));
        add(kTwoNumbers, replaced(kFragCoordPlane));
    } else {
        hits.write_mask = static_cast<uint8_t>((is_masked(kHitsPlane) ? kNothing : kAlpha) |
                                               (is_masked(kWritersPlane) ? kNothing : kRgb));
        add(key.layout.hit_format(), hits);
        add(kColorFormat, replaced(kFragCoordPlane));
    }
    for (uint32_t k = 0; k < key.attribute_count; ++k) {
        for (uint32_t half = 0; half < key.layout.attribute_attachments(); ++half) {
            add(key.layout.attribute_format(k), replaced(capture::kAttributePlane + k));
        }
    }
}

}  // namespace

ColorState::ColorState(const PipelineKey& key) {
    if (key.instruments) {
        instrument_states(key, *this);
    }
    for (const ColorKey& color : key.colors) {
        blends.push_back(blend_state(color));
        formats.push_back(color.format);
    }
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    if (key.outputs_are_dynamic) {
        blends.assign(blends.size(), {});  // nothing is written
    }
    info.attachmentCount = static_cast<uint32_t>(blends.size());
    info.pAttachments = blends.data();
    if (key.logic) {
        info.logicOpEnable = VK_TRUE;
        info.logicOp = static_cast<VkLogicOp>(*key.logic);
    }
    if (key.fixed) {
        const auto constants = std::bit_cast<std::array<float, 4>>(key.fixed->blend_constants);
        std::ranges::copy(constants, info.blendConstants);
    }
}

std::vector<VkDynamicState> dynamic_states(const PipelineKey& key) {
    std::vector<VkDynamicState> out;
    const auto add = [&](std::initializer_list<VkDynamicState> states) {
        out.insert(out.end(), states);
    };
    const bool sets_modes = !key.fixed;
    const bool sets_numbers = sets_modes || key.sets_numbers;
    if (sets_modes && key.stages != StageWay::mesh) {
        add({VK_DYNAMIC_STATE_PRIMITIVE_TOPOLOGY, VK_DYNAMIC_STATE_PRIMITIVE_RESTART_ENABLE});
    }
    if (sets_modes) {
        add({VK_DYNAMIC_STATE_DEPTH_COMPARE_OP, VK_DYNAMIC_STATE_DEPTH_WRITE_ENABLE,
             VK_DYNAMIC_STATE_DEPTH_BIAS_ENABLE, VK_DYNAMIC_STATE_CULL_MODE,
             VK_DYNAMIC_STATE_FRONT_FACE, VK_DYNAMIC_STATE_RASTERIZER_DISCARD_ENABLE});
    }
    if (sets_numbers) {
        add({VK_DYNAMIC_STATE_BLEND_CONSTANTS, VK_DYNAMIC_STATE_DEPTH_BIAS,
             VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR});
    }
    if (sets_modes && key.has_stencil) {
        add({VK_DYNAMIC_STATE_STENCIL_OP});
    }
    if (sets_numbers && key.has_stencil) {
        add({VK_DYNAMIC_STATE_STENCIL_COMPARE_MASK, VK_DYNAMIC_STATE_STENCIL_WRITE_MASK,
             VK_DYNAMIC_STATE_STENCIL_REFERENCE});
    }
    if (sets_modes && key.tests_bounds) {
        add({VK_DYNAMIC_STATE_DEPTH_BOUNDS_TEST_ENABLE});
    }
    if (sets_numbers && key.tests_bounds) {
        add({VK_DYNAMIC_STATE_DEPTH_BOUNDS});
    }
    if (key.outputs_are_dynamic) {
        out.insert(
            out.end(),
            {VK_DYNAMIC_STATE_COLOR_BLEND_ENABLE_EXT, VK_DYNAMIC_STATE_COLOR_BLEND_EQUATION_EXT,
             VK_DYNAMIC_STATE_COLOR_WRITE_MASK_EXT, VK_DYNAMIC_STATE_LOGIC_OP_ENABLE_EXT,
             VK_DYNAMIC_STATE_LOGIC_OP_EXT, VK_DYNAMIC_STATE_ALPHA_TO_ONE_ENABLE_EXT,
             VK_DYNAMIC_STATE_ALPHA_TO_COVERAGE_ENABLE_EXT, VK_DYNAMIC_STATE_SAMPLE_MASK_EXT});
    }
    if (key.rasterization_is_dynamic) {
        add({VK_DYNAMIC_STATE_RASTERIZATION_SAMPLES_EXT, VK_DYNAMIC_STATE_SAMPLE_MASK_EXT,
             VK_DYNAMIC_STATE_POLYGON_MODE_EXT, VK_DYNAMIC_STATE_DEPTH_CLAMP_ENABLE_EXT,
             VK_DYNAMIC_STATE_DEPTH_CLIP_ENABLE_EXT, VK_DYNAMIC_STATE_PROVOKING_VERTEX_MODE_EXT});
    }
    if (key.way.dynamic_stride) {
        out.push_back(VK_DYNAMIC_STATE_VERTEX_INPUT_BINDING_STRIDE);
    }
    return out;
}

VkPipelineRenderingCreateInfo rendering_info(const std::vector<VkFormat>& colors, VkFormat depth,
                                             VkFormat stencil) {
    VkPipelineRenderingCreateInfo info = Typed{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    info.colorAttachmentCount = static_cast<uint32_t>(colors.size());
    info.pColorAttachmentFormats = colors.data();
    info.depthAttachmentFormat = depth;
    info.stencilAttachmentFormat = stencil;
    return info;
}

FullTargetState::FullTargetState() {
    inputs_ = Typed{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    assembly_ = Typed{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly_.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    viewport_ = Typed{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport_.viewportCount = viewport_.scissorCount = 1;
    rasterization_ = Typed{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    rasterization_.lineWidth = 1;
    dynamic_ = Typed{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
}

void FullTargetState::apply(VkGraphicsPipelineCreateInfo& info) {
    dynamic_.dynamicStateCount = static_cast<uint32_t>(dynamic.size());
    dynamic_.pDynamicStates = dynamic.data();
    info.pVertexInputState = &inputs_;
    info.pInputAssemblyState = &assembly_;
    info.pViewportState = &viewport_;
    info.pRasterizationState = &rasterization_;
    info.pDynamicState = &dynamic_;
}

}  // namespace vk_harness
