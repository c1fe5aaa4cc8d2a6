// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/shader_object.hpp"

#include <vector>

#include "shaders/shaders.hpp"

namespace vk_harness {

namespace {

Handle<ShaderObject> make_object(const PipelineBase& base, const PipelineKey& key,
                                 VkShaderStageFlagBits stage, std::span<const uint32_t> code,
                                 const VkSpecializationInfo* specialization) {
    const Device& device = base.device();
    const VkDescriptorSetLayout set = key.color_from > cases::ColorFrom::constant
                                          ? base.layouts().colored(key.color_from).set.get()
                                          : base.layouts().texture_set.get();
    const VkPushConstantRange range{draw_stages(device), 0, sizeof(shaders::DrawConstants)};
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
    check(Stage::shader, device.shader_objects().create(device.get(), 1, &info, nullptr, &made),
          "vkCreateShadersEXT");
    return Handle<ShaderObject>(device.get(), made, device.shader_objects().destroy);
}

}  // namespace

std::array<Handle<ShaderObject>, 2> make_objects(const PipelineBase& base, const PipelineKey& key) {
    auto vertex = make_object(base, key, VK_SHADER_STAGE_VERTEX_BIT, vertex_code(key), nullptr);
    if (!needs_fragments(key)) {
        return {std::move(vertex), {}};
    }
    const bool has_id = base.device().capabilities().info.has_primitive_id;
    const std::vector<uint32_t> code =
        changed_code(fragment_code(key), fragment_changes(key, has_id));
    Specialization specialization;
    specialize(key, specialization);
    auto fragment =
        make_object(base, key, VK_SHADER_STAGE_FRAGMENT_BIT, code, &specialization.info);
    return {std::move(vertex), std::move(fragment)};
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

}  // namespace vk_harness
