// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/object_state.hpp"

#include <bit>

#include "vk_harness/device/sample_locations.hpp"
#include "vk_harness/pipeline/output_state.hpp"
#include "vk_harness/pipeline/pipeline_state.hpp"

namespace vk_harness {

namespace {

void set_inputs(const Device& device, VkCommandBuffer commands, const PipelineKey& key) {
    VertexInputState own;
    vertex_input_state(key, own);
    std::vector<VkVertexInputBindingDescription2EXT> bindings;
    for (const VkVertexInputBindingDescription& b : own.bindings) {
        bindings.push_back({VK_STRUCTURE_TYPE_VERTEX_INPUT_BINDING_DESCRIPTION_2_EXT, nullptr,
                            b.binding, b.stride, b.inputRate, 1});
    }
    std::vector<VkVertexInputAttributeDescription2EXT> inputs;
    for (const VkVertexInputAttributeDescription& i : own.inputs) {
        inputs.push_back({VK_STRUCTURE_TYPE_VERTEX_INPUT_ATTRIBUTE_DESCRIPTION_2_EXT, nullptr,
                          i.location, i.binding, i.format, i.offset});
    }
    device.vk().vkCmdSetVertexInputEXT(commands, static_cast<uint32_t>(bindings.size()),
                                       bindings.data(), static_cast<uint32_t>(inputs.size()),
                                       inputs.data());
}

void set_samples(const Device& device, VkCommandBuffer commands, const PipelineKey& key) {
    const VolkDeviceTable& vk = device.vk();
    vk.vkCmdSetRasterizationSamplesEXT(commands, static_cast<VkSampleCountFlagBits>(key.samples));
    if (device.capabilities().location_counts == 0) {
        return;
    }
    const std::vector<VkSampleLocationEXT> places = sample_places(key.sample_locations);
    vk.vkCmdSetSampleLocationsEnableEXT(commands, places.empty() ? VK_FALSE : VK_TRUE);
    if (!places.empty()) {
        const VkSampleLocationsInfoEXT info = sample_locations_info(places);
        vk.vkCmdSetSampleLocationsEXT(commands, &info);
    }
}

void set_rasterization(const Device& device, VkCommandBuffer commands, const PipelineKey& key) {
    const VolkDeviceTable& vk = device.vk();
    const Capabilities& c = device.capabilities();
    RasterizationState own;
    rasterization_state(key, own);
    vk.vkCmdSetPolygonModeEXT(commands, own.info.polygonMode);
    if (c.depth_clamp) {
        vk.vkCmdSetDepthClampEnableEXT(commands, own.info.depthClampEnable);
    }
    if (c.depth_clip_enable) {
        // Without a word on it a pipeline clips where it does not clamp.
        const bool clips = key.depth_clip.value_or(!key.depth_clamp);
        vk.vkCmdSetDepthClipEnableEXT(commands, clips ? VK_TRUE : VK_FALSE);
    }
    if (c.clip.depth_clip_control) {
        vk.vkCmdSetDepthClipNegativeOneToOneEXT(commands,
                                                key.negative_one_to_one ? VK_TRUE : VK_FALSE);
    }
    if (c.clip.last_provoking_vertex) {
        vk.vkCmdSetProvokingVertexModeEXT(commands,
                                          key.provoking == cases::ProvokingVertex::last
                                              ? VK_PROVOKING_VERTEX_MODE_LAST_VERTEX_EXT
                                              : VK_PROVOKING_VERTEX_MODE_FIRST_VERTEX_EXT);
    }
    if (c.has_conservative) {
        vk.vkCmdSetConservativeRasterizationModeEXT(commands,
                                                    own.conservative.conservativeRasterizationMode);
        vk.vkCmdSetExtraPrimitiveOverestimationSizeEXT(
            commands, own.conservative.extraPrimitiveOverestimationSize);
    }
    if (c.fragment_sizes.is_supported) {
        const auto size = fragment_size_state(key);
        vk.vkCmdSetFragmentShadingRateKHR(commands, &size.fragmentSize, size.combinerOps);
    }
}

}  // namespace

Handle<ShaderObject> PipelineCache::make_object(VkShaderStageFlagBits stage,
                                                std::span<const uint32_t> code,
                                                const VkSpecializationInfo* specialization) {
    const VkDescriptorSetLayout set = texture_set_layout_.get();
    const VkPushConstantRange range{draw_stages(*device_), 0, sizeof(shaders::DrawConstants)};
    ShaderObjectInfo info;
    info.stage = stage;
    info.next_stages =
        stage == VK_SHADER_STAGE_VERTEX_BIT ? VkShaderStageFlags{VK_SHADER_STAGE_FRAGMENT_BIT} : 0;
    info.code_size = code.size_bytes();
    info.code = code.data();
    info.set_count = 1;
    info.sets = &set;
    info.range_count = 1;
    info.ranges = &range;
    info.specialization = specialization;
    ShaderObject made = VK_NULL_HANDLE;
    check(Stage::shader, device_->shader_objects().create(device_->get(), 1, &info, nullptr, &made),
          "vkCreateShadersEXT");
    return Handle<ShaderObject>(device_->get(), made, device_->shader_objects().destroy);
}

ShaderPair PipelineCache::get_objects(const PipelineKey& key) {
    auto found = objects_.find(key);
    if (found == objects_.end()) {
        auto code =
            changed_code(shaders::capture_fragment(fragment_variant(key)),
                         fragment_changes(key, device_->capabilities().info.has_primitive_id));
        Specialization specialization;
        specialize(key, specialization);
        auto vertex = make_object(VK_SHADER_STAGE_VERTEX_BIT,
                                  shaders::capture_vertex(vertex_variant(key)), nullptr);
        auto fragment = make_object(VK_SHADER_STAGE_FRAGMENT_BIT, code, &specialization.info);
        std::array<Handle<ShaderObject>, 2> made = {std::move(vertex), std::move(fragment)};
        found = objects_.emplace(key, std::move(made)).first;
    }
    return ShaderPair{found->second[0].get(), found->second[1].get()};
}

void bind_objects(const Device& device, VkCommandBuffer commands, const ShaderPair& shaders) {
    std::vector<VkShaderStageFlagBits> stages = {VK_SHADER_STAGE_VERTEX_BIT,
                                                 VK_SHADER_STAGE_FRAGMENT_BIT};
    std::vector<ShaderObject> objects(shaders.begin(), shaders.end());
    const DoorSupport& doors = device.capabilities().doors;
    if (doors.tessellation) {
        stages.push_back(VK_SHADER_STAGE_TESSELLATION_CONTROL_BIT);
        stages.push_back(VK_SHADER_STAGE_TESSELLATION_EVALUATION_BIT);
    }
    if (doors.geometry) {
        stages.push_back(VK_SHADER_STAGE_GEOMETRY_BIT);
    }
    if (doors.mesh) {
        stages.push_back(VK_SHADER_STAGE_MESH_BIT_EXT);
    }
    objects.resize(stages.size(), VK_NULL_HANDLE);
    device.shader_objects().bind(commands, static_cast<uint32_t>(stages.size()), stages.data(),
                                 objects.data());
}

void set_object_state(const Device& device, VkCommandBuffer commands, const PipelineKey& key) {
    const VolkDeviceTable& vk = device.vk();
    set_inputs(device, commands, key);
    set_samples(device, commands, key);
    set_rasterization(device, commands, key);
    const VkPipelineDepthStencilStateCreateInfo depth = depth_state(key);
    vk.vkCmdSetDepthTestEnable(commands, depth.depthTestEnable);
    vk.vkCmdSetStencilTestEnable(commands, depth.stencilTestEnable);
    if (device.capabilities().depth_bounds && !key.tests_bounds) {
        vk.vkCmdSetDepthBoundsTestEnable(commands, VK_FALSE);
    }
    set_outputs(device, commands, output_state(key));
}

void set_counted_viewports(const Device& device, VkCommandBuffer commands, const DrawState& state) {
    const std::vector<VkViewport> viewports = state.vulkan_viewports();
    const std::vector<VkRect2D> scissors = state.vulkan_scissors();
    const auto count = static_cast<uint32_t>(viewports.size());
    device.vk().vkCmdSetViewportWithCount(commands, count, viewports.data());
    device.vk().vkCmdSetScissorWithCount(commands, count, scissors.data());
}

}  // namespace vk_harness
