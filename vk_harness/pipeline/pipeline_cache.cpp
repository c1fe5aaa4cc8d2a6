// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/pipeline_cache.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "shaders/shaders.hpp"
#include "vk_harness/pipeline/pipeline_state.hpp"
#include "vk_harness/pipeline/shader_stage.hpp"

namespace vk_harness {

namespace {

Handle<VkPipelineLayout> make_layout(const Device& device, VkShaderStageFlags stage, uint32_t bytes,
                                     std::span<const VkDescriptorSetLayout> sets) {
    const VkPushConstantRange range{stage, 0, bytes};
    VkPipelineLayoutCreateInfo info = Typed{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = static_cast<uint32_t>(sets.size());
    info.pSetLayouts = sets.data();
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &range;
    return make(device, Stage::pipeline, "vkCreatePipelineLayout",
                device.vk().vkCreatePipelineLayout, device.vk().vkDestroyPipelineLayout, info);
}

Handle<VkDescriptorSetLayout> make_set_layout(
    const Device& device, std::span<const VkDescriptorSetLayoutBinding> bindings) {
    VkDescriptorSetLayoutCreateInfo info =
        Typed{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = static_cast<uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    return make(device, Stage::pipeline, "vkCreateDescriptorSetLayout",
                device.vk().vkCreateDescriptorSetLayout, device.vk().vkDestroyDescriptorSetLayout,
                info);
}

}  // namespace

VkShaderStageFlags draw_stages(const Device& device) {
    const VkShaderStageFlags always = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    const DoorSupport& doors = device.capabilities().doors;
    return always | (doors.geometry ? VkShaderStageFlags{VK_SHADER_STAGE_GEOMETRY_BIT} : 0U) |
           (doors.mesh ? VkShaderStageFlags{VK_SHADER_STAGE_MESH_BIT_EXT} : 0U);
}

PipelineCache PipelineCache::create(const Device& device) {
    PipelineCache cache(device);
    const VolkDeviceTable& vk = device.vk();

    VkPipelineCacheCreateInfo cache_info = Typed{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    cache.cache_ = make(device, Stage::pipeline, "vkCreatePipelineCache", vk.vkCreatePipelineCache,
                        vk.vkDestroyPipelineCache, cache_info);
    const auto draw_layout = [&](std::initializer_list<VkDescriptorSetLayout> sets) {
        return make_layout(device, draw_stages(device), sizeof(shaders::DrawConstants), sets);
    };
    const std::array<VkDescriptorSetLayoutBinding, 1> texture = {
        {{0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr}}};
    cache.texture_set_layout_ = make_set_layout(device, texture);
    cache.layout_ = draw_layout({cache.texture_set_layout_.get()});
    const VkShaderStageFlags readers =
        VkShaderStageFlags{VK_SHADER_STAGE_VERTEX_BIT} |
        (device.capabilities().doors.mesh ? VkShaderStageFlags{VK_SHADER_STAGE_MESH_BIT_EXT} : 0U);
    const std::array<VkDescriptorSetLayoutBinding, 1> inputs = {
        {{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, readers, nullptr}}};
    cache.pulled_set_layout_ = make_set_layout(device, inputs);
    cache.pulled_layout_ =
        draw_layout({cache.texture_set_layout_.get(), cache.pulled_set_layout_.get()});
    const auto read_layout = [&](VkDescriptorType from, VkShaderStageFlags stage,
                                 uint32_t constants, auto& set_layout, auto& layout) {
        const std::array<VkDescriptorSetLayoutBinding, 2> reads = {
            {{0, from, 1, stage, nullptr},
             {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, stage, nullptr}}};
        set_layout = make_set_layout(device, reads);
        const VkDescriptorSetLayout set = set_layout.get();
        layout = make_layout(device, stage, constants * sizeof(uint32_t), {&set, 1});
    };
    read_layout(VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, VK_SHADER_STAGE_FRAGMENT_BIT, kInputConstants,
                cache.input_set_layout_, cache.input_layout_);
    read_layout(VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, VK_SHADER_STAGE_COMPUTE_BIT, kCopyConstants,
                cache.copy_set_layout_, cache.copy_layout_);
    return cache;
}

VkShaderModule PipelineCache::shader_module(std::span<const uint32_t> code, ShaderChanges changes) {
    std::tuple key(code.data(), std::move(changes));
    const auto found = modules_.find(key);
    if (found != modules_.end()) {
        return found->second.get();
    }
    auto changed = changed_code(code, std::get<1>(key));
    VkShaderModuleCreateInfo info = Typed{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = changed.size() * sizeof(uint32_t);
    info.pCode = changed.data();
    auto made = make(*device_, Stage::shader, "vkCreateShaderModule",
                     device_->vk().vkCreateShaderModule, device_->vk().vkDestroyShaderModule, info);
    return modules_.emplace(std::move(key), std::move(made)).first->second.get();
}

void PipelineCache::trim(size_t most) {
    if (pipelines_.size() + objects_.size() > most) {
        pipelines_.clear();
        libraries_.clear();
        objects_.clear();
    }
}

VkPipeline PipelineCache::get(const PipelineKey& key) {
    return get_or_make(pipelines_, key, [&] { return make_graphics(key); });
}

VkRenderPass PipelineCache::get_pass(const PassKey& key) {
    return get_or_make(passes_, key, [&] { return make_render_pass(*device_, key); });
}

VkPipeline PipelineCache::get_copy(const Attachment& attachment) {
    return get_copy(shaders::copy_samples(attachment.is_depth(), attachment.sample_bytes / 4));
}

VkPipeline PipelineCache::get_code_copy() {
    return get_copy(shaders::copy_codes_of_depth());
}

VkPipeline PipelineCache::get_copy(std::span<const uint32_t> source) {
    const auto found = copies_.find(source.data());
    if (found != copies_.end()) {
        return found->second.get();
    }
    auto code = shader_module(source);
    VkComputePipelineCreateInfo info = Typed{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = stage_info(VK_SHADER_STAGE_COMPUTE_BIT, code);
    info.layout = copy_layout_.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(Stage::pipeline,
          device_->vk().vkCreateComputePipelines(device_->get(), cache_.get(), 1, &info, nullptr,
                                                 &pipeline),
          "vkCreateComputePipelines");
    Handle<VkPipeline> owned(device_->get(), pipeline, device_->vk().vkDestroyPipeline);
    return copies_.emplace(source.data(), std::move(owned)).first->second.get();
}

Handle<VkPipeline> PipelineCache::make_graphics(const PipelineKey& key) {
    const bool is_mesh = key.stages == StageWay::mesh;
    auto vertex =
        is_mesh ? shader_module(shaders::capture_mesh(geometry_variant(key)))
                : shader_module(shaders::capture_vertex(vertex_variant(key)), vertex_changes(key));
    auto fragment =
        shader_module(shaders::capture_fragment(fragment_variant(key)),
                      fragment_changes(key, device_->capabilities().info.has_primitive_id));
    std::vector<VkPipelineShaderStageCreateInfo> stages = {
        stage_info(VK_SHADER_STAGE_FRAGMENT_BIT, fragment),
        stage_info(is_mesh ? VK_SHADER_STAGE_MESH_BIT_EXT : VK_SHADER_STAGE_VERTEX_BIT, vertex)};
    Specialization specialization;
    specialize(key, specialization);
    stages[0].pSpecializationInfo = &specialization.info;
    Specialization patch;
    specialize_patch(key, patch);
    for (const auto& [stage, code] : stages_between(key)) {
        auto module = shader_module(code);
        stages.push_back(stage_info(stage, module));
        if (stage == VK_SHADER_STAGE_TESSELLATION_EVALUATION_BIT) {
            stages.back().pSpecializationInfo = &patch.info;
        }
    }
    if (key.fixed && key.fixed->discard == VK_TRUE) {
        // What discards for good has no fragment shader
        // (VUID-VkGraphicsPipelineCreateInfo-pStages-06894).
        stages.erase(stages.begin());
    }
    VertexInputState vertex_input;
    vertex_input_state(key, vertex_input);

    const VkPipelineInputAssemblyStateCreateInfo assembly = assembly_state(key);
    ViewportState viewport;
    viewport_state(key, viewport);

    RasterizationState rasterization;
    rasterization_state(key, rasterization);
    MultisampleState multisample;
    multisample_state(key, multisample);
    const VkPipelineDepthStencilStateCreateInfo depth = depth_state(key);
    ColorState color;
    color_state(key, color);

    const std::vector<VkDynamicState> states = dynamic_states(key);
    VkPipelineDynamicStateCreateInfo dynamic =
        Typed{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = static_cast<uint32_t>(states.size());
    dynamic.pDynamicStates = states.data();

    VkPipelineRenderingCreateInfo rendering =
        Typed{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = static_cast<uint32_t>(color.formats.size());
    rendering.pColorAttachmentFormats = color.formats.data();
    rendering.depthAttachmentFormat = !key.has_depth    ? VK_FORMAT_UNDEFINED
                                      : key.has_stencil ? key.layout.stencil_format
                                                        : depth_format(key.depth_format);
    rendering.stencilAttachmentFormat = key.layout.stencil_format;
    rendering.viewMask = key.view_mask;

    VkPipelineTessellationStateCreateInfo tessellation =
        Typed{VK_STRUCTURE_TYPE_PIPELINE_TESSELLATION_STATE_CREATE_INFO};
    tessellation.patchControlPoints = 3;

    // "The default is {1,1}" of a pipeline that does not say it.
    VkPipelineFragmentShadingRateStateCreateInfoKHR fragments = fragment_size_state(key);
    const void* further = key.fragment_size[0] * key.fragment_size[1] > 1 ? &fragments : nullptr;
    rendering.pNext = further;

    VkGraphicsPipelineCreateInfo info = Typed{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    if (key.pass) {
        auto pass = get_pass(*key.pass);
        info.renderPass = pass;
        info.subpass = key.subpass;
        info.pNext = further;
    } else {
        info.pNext = &rendering;
    }
    info.stageCount = static_cast<uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = is_mesh ? nullptr : &vertex_input.info;
    info.pInputAssemblyState = is_mesh ? nullptr : &assembly;
    info.pTessellationState = key.stages == StageWay::tessellation ? &tessellation : nullptr;
    info.pViewportState = &viewport.info;
    info.pRasterizationState = &rasterization.info;
    info.pMultisampleState = &multisample.info;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &color.info;
    info.pDynamicState = &dynamic;
    // Nothing is bound to the second set where no shader has it.
    info.layout = key.way.pulled || key.unused_interface ? pulled_layout_.get() : layout_.get();
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
            return make_from_library(info);
        case PipelineWay::derived:
            return make_derived(key, info);
        case PipelineWay::cached:
            return make_cached(info);
    }
    return create(info, cache_.get());
}

Handle<VkPipeline> PipelineCache::create(const VkGraphicsPipelineCreateInfo& info,
                                         VkPipelineCache cache) {
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(Stage::pipeline,
          device_->vk().vkCreateGraphicsPipelines(device_->get(), cache, 1, &info, nullptr,
                                                  &pipeline),
          "vkCreateGraphicsPipelines");
    return Handle<VkPipeline>(device_->get(), pipeline, device_->vk().vkDestroyPipeline);
}

}  // namespace vk_harness
