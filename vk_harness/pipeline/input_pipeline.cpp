// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/input_pipeline.hpp"

#include "shaders/shaders.hpp"
#include "vk_harness/pipeline/pipeline_state.hpp"

namespace vk_harness {

InputKey input_key(const PassKey& pass, const cases::Target& target, const Attachment& attachment,
                   uint32_t index) {
    InputKey key;
    key.pass = pass;
    key.index = index;
    key.words = attachment.sample_bytes / 4;
    if (attachment.role == Role::color) {
        const cases::ColorFormatRow& row = cases::row_of(target.color->format);
        key.kind = row.kind;
        key.bits = row.bits;
        key.first_bit = row.first_bit;
        return key;
    }
    // Depth is read as binary32 whatever it is stored as, a stencil as a whole number.
    if (attachment.role == Role::stencil) {
        key.kind = cases::ComponentKind::uint;
    }
    for (uint32_t k = 0; k < key.words; ++k) {
        key.bits.at(k) = 32;
        key.first_bit.at(k) = static_cast<uint8_t>(32 * k);
    }
    return key;
}

Handle<VkPipeline> make_input(PipelineBase& base, const InputKey& key, VkRenderPass pass) {
    ShaderChanges changes;
    changes.input_index = key.index;
    const VkShaderModule vertex = base.shader_module(shaders::clear_vertex());
    const VkShaderModule fragment = base.shader_module(
        shaders::read_input(key.kind == cases::ComponentKind::uint, key.pass.samples > 1), changes);
    Specialization constants;
    constants.add(shaders::kInputWords, key.words);
    constants.add(shaders::kInputKind, static_cast<uint32_t>(key.kind));
    for (uint32_t k = 0; k < key.bits.size(); ++k) {
        constants.add(shaders::kInputBits + k, key.bits.at(k));
        constants.add(shaders::kInputFirstBits + k, key.first_bit.at(k));
    }
    constants.tie();
    std::array<VkPipelineShaderStageCreateInfo, 2> stages = {
        stage_info(VK_SHADER_STAGE_VERTEX_BIT, vertex),
        stage_info(VK_SHADER_STAGE_FRAGMENT_BIT, fragment)};
    stages[1].pSpecializationInfo = &constants.info;
    // Nothing is drawn to: one sample covers a pixel, of which the shader reads all.
    const MultisampleState multisample{PipelineKey()};
    VkGraphicsPipelineCreateInfo info = Typed{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.stageCount = static_cast<uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pMultisampleState = &multisample.info;
    info.layout = base.layouts().input.get();
    info.renderPass = pass;
    info.subpass = 1;
    FullTargetState full;
    full.apply(info);
    return base.create(info);
}

}  // namespace vk_harness
