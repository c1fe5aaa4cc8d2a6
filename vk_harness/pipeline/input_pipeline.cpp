// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/input_pipeline.hpp"

#include "shaders/shaders.hpp"
#include "vk_harness/pipeline/pipeline_cache.hpp"
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

VkPipeline PipelineCache::get_input(const InputKey& key) {
    return get_or_make(inputs_, key, [&] { return make_input(key); });
}

Handle<VkPipeline> PipelineCache::make_input(const InputKey& key) {
    ShaderChanges changes;
    changes.input_index = key.index;
    auto vertex = shader_module(shaders::clear_vertex());
    auto fragment = shader_module(
        shaders::read_input(key.kind == cases::ComponentKind::uint, key.pass.samples > 1), changes);
    Specialization constants;
    specialize_input(key, constants);
    std::array<VkPipelineShaderStageCreateInfo, 2> stages = {
        stage_info(VK_SHADER_STAGE_VERTEX_BIT, vertex),
        stage_info(VK_SHADER_STAGE_FRAGMENT_BIT, fragment)};
    stages[1].pSpecializationInfo = &constants.info;
    // Nothing is drawn to: one sample covers a pixel, of which the shader reads all.
    PipelineKey target;
    MultisampleState multisample;
    multisample_state(target, multisample);
    auto pass = get_pass(key.pass);
    VkGraphicsPipelineCreateInfo info = Typed{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.stageCount = static_cast<uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pMultisampleState = &multisample.info;
    info.layout = input_layout_.get();
    info.renderPass = pass;
    info.subpass = 1;
    FullTargetState full;
    full.apply(info);
    return create(info, cache_.get());
}

}  // namespace vk_harness
