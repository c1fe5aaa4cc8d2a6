// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/pipeline_base.hpp"

#include <array>
#include <initializer_list>

#include "shaders/shaders.hpp"

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

PipelineLayouts::PipelineLayouts(const Device& device) {
    const auto draw_layout = [&](std::initializer_list<VkDescriptorSetLayout> sets) {
        return make_layout(device, draw_stages(device), sizeof(shaders::DrawConstants), sets);
    };
    const std::array<VkDescriptorSetLayoutBinding, 1> texture = {
        {{0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr}}};
    texture_set = make_set_layout(device, texture);
    draw = draw_layout({texture_set.get()});
    const VkShaderStageFlags readers =
        VkShaderStageFlags{VK_SHADER_STAGE_VERTEX_BIT} |
        (device.capabilities().doors.mesh ? VkShaderStageFlags{VK_SHADER_STAGE_MESH_BIT_EXT} : 0U);
    const std::array<VkDescriptorSetLayoutBinding, 1> inputs = {
        {{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, readers, nullptr}}};
    pulled_set = make_set_layout(device, inputs);
    pulled = draw_layout({texture_set.get(), pulled_set.get()});
    constexpr std::array kSources = {
        VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC,
        VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};
    for (size_t k = 0; k < kSources.size(); ++k) {
        const std::array<VkDescriptorSetLayoutBinding, 1> source = {
            {{0, kSources.at(k), 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr}}};
        all_colored.at(k).set = make_set_layout(device, source);
        all_colored.at(k).layout = draw_layout({all_colored.at(k).set.get()});
    }
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
                input_set, input);
    read_layout(VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, VK_SHADER_STAGE_COMPUTE_BIT, kCopyConstants,
                copy_set, copy);
}

Handle<VkPipelineCache> make_cache(const Device& device, std::span<const char> initial) {
    VkPipelineCacheCreateInfo info = Typed{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    info.initialDataSize = initial.size();
    info.pInitialData = initial.data();
    return make(device, Stage::pipeline, "vkCreatePipelineCache", device.vk().vkCreatePipelineCache,
                device.vk().vkDestroyPipelineCache, info);
}

PipelineBase::PipelineBase(const Device& device)
    : device_(&device), cache_(make_cache(device)), layouts_(device) {}

VkShaderModule PipelineBase::shader_module(std::span<const uint32_t> code, ShaderChanges changes) {
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

Handle<VkPipeline> PipelineBase::create(const VkGraphicsPipelineCreateInfo& info,
                                        VkPipelineCache cache) const {
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(Stage::pipeline,
          device_->vk().vkCreateGraphicsPipelines(device_->get(),
                                                  cache != VK_NULL_HANDLE ? cache : cache_.get(), 1,
                                                  &info, nullptr, &pipeline),
          "vkCreateGraphicsPipelines");
    return Handle<VkPipeline>(device_->get(), pipeline, device_->vk().vkDestroyPipeline);
}

}  // namespace vk_harness
