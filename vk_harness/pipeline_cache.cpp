// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline_cache.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "shaders/shaders.hpp"

namespace vk_harness {

namespace {

shaders::Mode to_mode(cases::Interpolation interpolation) {
    switch (interpolation) {
        case cases::Interpolation::smooth:
            return shaders::Mode::smooth;
        case cases::Interpolation::noperspective:
            return shaders::Mode::noperspective;
        case cases::Interpolation::flat:
            break;
    }
    return shaders::Mode::flat;
}

VkPipelineShaderStageCreateInfo stage_info(VkShaderStageFlagBits stage, VkShaderModule module) {
    VkPipelineShaderStageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = stage;
    info.module = module;
    info.pName = "main";
    return info;
}

Result<Handle<VkPipelineLayout>> make_layout(const Device& device, VkShaderStageFlags stage,
                                             uint32_t words, VkDescriptorSetLayout set) {
    const VkPushConstantRange range{stage, 0, words * 4};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = set != VK_NULL_HANDLE ? 1 : 0;
    info.pSetLayouts = &set;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &range;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    const VkResult result =
        device.vk().vkCreatePipelineLayout(device.get(), &info, nullptr, &layout);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::pipeline, result, "vkCreatePipelineLayout"));
    }
    return Handle<VkPipelineLayout>(device.get(), layout, device.vk().vkDestroyPipelineLayout);
}

}  // namespace

Result<PipelineCache> PipelineCache::create(const Device& device) {
    PipelineCache cache(device);
    const VolkDeviceTable& vk = device.vk();

    VkPipelineCacheCreateInfo cache_info{};
    cache_info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
    VkPipelineCache handle = VK_NULL_HANDLE;
    VkResult result = vk.vkCreatePipelineCache(device.get(), &cache_info, nullptr, &handle);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::pipeline, result, "vkCreatePipelineCache"));
    }
    cache.cache_ = Handle<VkPipelineCache>(device.get(), handle, vk.vkDestroyPipelineCache);

    auto layout = make_layout(device, VK_SHADER_STAGE_FRAGMENT_BIT, kDrawConstants, VK_NULL_HANDLE);
    if (!layout) {
        return fail(layout.error());
    }
    cache.layout_ = std::move(*layout);

    std::array<VkDescriptorSetLayoutBinding, 2> bindings{};
    bindings[0] = {0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
    bindings[1] = {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
    VkDescriptorSetLayoutCreateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set_info.bindingCount = static_cast<uint32_t>(bindings.size());
    set_info.pBindings = bindings.data();
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    result = vk.vkCreateDescriptorSetLayout(device.get(), &set_info, nullptr, &set_layout);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::pipeline, result, "vkCreateDescriptorSetLayout"));
    }
    cache.copy_set_layout_ =
        Handle<VkDescriptorSetLayout>(device.get(), set_layout, vk.vkDestroyDescriptorSetLayout);
    auto copy_layout = make_layout(device, VK_SHADER_STAGE_COMPUTE_BIT, kCopyConstants, set_layout);
    if (!copy_layout) {
        return fail(copy_layout.error());
    }
    cache.copy_layout_ = std::move(*copy_layout);
    return cache;
}

Result<VkShaderModule> PipelineCache::shader_module(std::span<const uint32_t> code) {
    const auto found = modules_.find(code.data());
    if (found != modules_.end()) {
        return found->second.get();
    }
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = code.size_bytes();
    info.pCode = code.data();
    VkShaderModule handle = VK_NULL_HANDLE;
    const VkResult result =
        device_->vk().vkCreateShaderModule(device_->get(), &info, nullptr, &handle);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::shader, result, "vkCreateShaderModule"));
    }
    modules_.emplace(code.data(), Handle<VkShaderModule>(device_->get(), handle,
                                                         device_->vk().vkDestroyShaderModule));
    return handle;
}

Result<VkPipeline> PipelineCache::get(const PipelineKey& key) {
    const auto found = pipelines_.find(key);
    if (found != pipelines_.end()) {
        return found->second.get();
    }
    auto pipeline = make_graphics(key);
    if (!pipeline) {
        return fail(pipeline.error());
    }
    return pipelines_.emplace(key, std::move(*pipeline)).first->second.get();
}

Result<VkPipeline> PipelineCache::get_copy(bool depth) {
    const auto found = copies_.find(depth);
    if (found != copies_.end()) {
        return found->second.get();
    }
    auto code = shader_module(shaders::copy_samples(depth));
    if (!code) {
        return fail(code.error());
    }
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage = stage_info(VK_SHADER_STAGE_COMPUTE_BIT, *code);
    info.layout = copy_layout_.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult result = device_->vk().vkCreateComputePipelines(device_->get(), cache_.get(), 1,
                                                                   &info, nullptr, &pipeline);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::pipeline, result, "vkCreateComputePipelines"));
    }
    Handle<VkPipeline> owned(device_->get(), pipeline, device_->vk().vkDestroyPipeline);
    return copies_.emplace(depth, std::move(owned)).first->second.get();
}

Result<Handle<VkPipeline>> PipelineCache::make_graphics(const PipelineKey& key) {
    std::array<shaders::Mode, shaders::kMaxAttributes> modes{};
    std::transform(key.modes.begin(), key.modes.end(), modes.begin(), to_mode);
    auto vertex = shader_module(shaders::capture_vertex(key.attribute_count));
    if (!vertex) {
        return fail(vertex.error());
    }
    auto fragment = shader_module(shaders::capture_fragment(
        key.attribute_count, modes, device_->capabilities().info.has_primitive_id));
    if (!fragment) {
        return fail(fragment.error());
    }
    const std::array<VkPipelineShaderStageCreateInfo, 2> stages = {
        stage_info(VK_SHADER_STAGE_VERTEX_BIT, *vertex),
        stage_info(VK_SHADER_STAGE_FRAGMENT_BIT, *fragment)};

    // Binding and location 0: positions; 1..: attributes. Each is an array of its own.
    std::vector<VkVertexInputBindingDescription> bindings;
    std::vector<VkVertexInputAttributeDescription> inputs;
    for (uint32_t binding = 0; binding <= key.attribute_count; ++binding) {
        bindings.push_back({binding, 16, VK_VERTEX_INPUT_RATE_VERTEX});
        inputs.push_back({binding, binding, VK_FORMAT_R32G32B32A32_SFLOAT, 0});
    }
    VkPipelineVertexInputStateCreateInfo vertex_input{};
    vertex_input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    vertex_input.vertexBindingDescriptionCount = static_cast<uint32_t>(bindings.size());
    vertex_input.pVertexBindingDescriptions = bindings.data();
    vertex_input.vertexAttributeDescriptionCount = static_cast<uint32_t>(inputs.size());
    vertex_input.pVertexAttributeDescriptions = inputs.data();

    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;  // the class; dynamic

    VkPipelineViewportStateCreateInfo viewport{};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;

    VkPipelineRasterizationStateCreateInfo rasterization{};
    rasterization.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    rasterization.polygonMode = VK_POLYGON_MODE_FILL;
    rasterization.lineWidth = 1.0F;

    VkPipelineMultisampleStateCreateInfo multisample{};
    multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    multisample.rasterizationSamples = static_cast<VkSampleCountFlagBits>(key.samples);

    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = VK_TRUE;  // without the test there is no depth write
    depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = VK_COMPARE_OP_ALWAYS;

    const uint32_t color_count = kFixedAttachments + key.attribute_count;
    VkPipelineColorBlendAttachmentState plain{};
    plain.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                           VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    std::vector<VkPipelineColorBlendAttachmentState> blends(color_count, plain);
    VkPipelineColorBlendAttachmentState& hits = blends.front();
    hits.blendEnable = VK_TRUE;
    hits.srcColorBlendFactor = VK_BLEND_FACTOR_ONE;
    hits.dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
    hits.colorBlendOp = VK_BLEND_OP_ADD;
    hits.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    hits.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    hits.alphaBlendOp = VK_BLEND_OP_ADD;
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = color_count;
    blend.pAttachments = blends.data();

    const std::array<VkDynamicState, 6> dynamic_states = {
        VK_DYNAMIC_STATE_VIEWPORT,           VK_DYNAMIC_STATE_SCISSOR,
        VK_DYNAMIC_STATE_CULL_MODE,          VK_DYNAMIC_STATE_FRONT_FACE,
        VK_DYNAMIC_STATE_PRIMITIVE_TOPOLOGY, VK_DYNAMIC_STATE_PRIMITIVE_RESTART_ENABLE};
    VkPipelineDynamicStateCreateInfo dynamic{};
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = static_cast<uint32_t>(dynamic_states.size());
    dynamic.pDynamicStates = dynamic_states.data();

    const std::vector<VkFormat> formats(color_count, kColorFormat);
    VkPipelineRenderingCreateInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    rendering.colorAttachmentCount = color_count;
    rendering.pColorAttachmentFormats = formats.data();
    rendering.depthAttachmentFormat = kDepthFormat;

    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.pNext = &rendering;
    info.stageCount = static_cast<uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &vertex_input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &rasterization;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = layout_.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult result = device_->vk().vkCreateGraphicsPipelines(device_->get(), cache_.get(), 1,
                                                                    &info, nullptr, &pipeline);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::pipeline, result, "vkCreateGraphicsPipelines"));
    }
    return Handle<VkPipeline>(device_->get(), pipeline, device_->vk().vkDestroyPipeline);
}

}  // namespace vk_harness
