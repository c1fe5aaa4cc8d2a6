// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the shaders of a pipeline get beside their code: changed decorations and specialization
// constants; which stages there are.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "shaders/spirv_variant.hpp"
#include "vk_harness/device/api.hpp"
#include "vk_harness/pipeline/pipeline_key.hpp"

namespace vk_harness {

// A stage of a pipeline, without specialization.
VkPipelineShaderStageCreateInfo stage_info(VkShaderStageFlagBits stage, VkShaderModule module);

// Interpolation and auxiliary qualifiers of the inputs; the primitive's number if the device has
// it.
std::vector<shaders::InputChange> input_changes(const PipelineKey& key, bool has_primitive_id);

// What is changed of a compiled shader: its inputs and outputs, execution modes that are added, and
// by which instruction it discards.
struct ShaderChanges {
    std::vector<shaders::InputChange> inputs;
    std::vector<uint32_t> modes;
    shaders::Ending ending = shaders::Ending::kill;
    shaders::OutputChange outputs;
    std::vector<uint32_t> unused_outputs;  // locations of outputs that are added
    std::optional<uint32_t> input_index;   // of the one subpass input
    friend auto operator<=>(const ShaderChanges&, const ShaderChanges&) = default;
};
// Of the vertex shader.
ShaderChanges vertex_changes(const PipelineKey& key);
// Of the fragment shader.
ShaderChanges fragment_changes(const PipelineKey& key, bool has_primitive_id);
std::vector<uint32_t> changed_code(std::span<const uint32_t> code, const ShaderChanges& changes);

// Values of specialization constants. Must not be moved once it is filled.
struct Specialization {
    std::vector<uint32_t> words;
    std::vector<VkSpecializationMapEntry> entries;
    VkSpecializationInfo info{};

    void add(uint32_t id, uint32_t word);
    void tie();  // once all constants have been added
};
// Those of capture.frag.
void specialize(const PipelineKey& key, Specialization& out);
// Those of capture.geom and capture.tese.
void specialize_between(const PipelineKey& key, Specialization& out);

// The stages between the vertex shader and rasterization, with their code.
std::vector<std::pair<VkShaderStageFlagBits, std::span<const uint32_t>>> stages_between(
    const PipelineKey& key);

}  // namespace vk_harness
