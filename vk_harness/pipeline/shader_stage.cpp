// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/shader_stage.hpp"

#include <algorithm>
#include <bit>

namespace vk_harness {

namespace {

shaders::Choice choice_of(const AttributeKey& attribute) {
    switch (attribute.source) {
        case cases::Source::vertex:
            break;
        case cases::Source::barycentric:
            return attribute.interpolation == cases::Interpolation::noperspective
                       ? shaders::Choice::barycentric_linear
                       : shaders::Choice::barycentric;
        case cases::Source::sample_mask_in:
            return shaders::Choice::sample_mask_in;
        case cases::Source::sample_id:
            return shaders::Choice::sample_id;
        case cases::Source::sample_position:
            return shaders::Choice::sample_position;
        case cases::Source::shading_rate:
            return shaders::Choice::shading_rate;
    }
    return static_cast<shaders::Choice>(attribute.probe);
}
static_assert(static_cast<uint32_t>(cases::Probe::lod) ==
              static_cast<uint32_t>(shaders::Choice::last_probe));

shaders::Ending ending_of(const PipelineKey& key) {
    switch (key.discard_by) {
        case cases::DiscardBy::kill:
            break;
        case cases::DiscardBy::demote:
            return shaders::Ending::demote;
        case cases::DiscardBy::terminate:
            return shaders::Ending::terminate;
    }
    return shaders::Ending::kill;
}

}  // namespace

void Specialization::add(uint32_t id, uint32_t word) {
    entries.push_back({id, static_cast<uint32_t>(words.size() * sizeof word), sizeof word});
    words.push_back(word);
}

void Specialization::tie() {
    info.mapEntryCount = static_cast<uint32_t>(entries.size());
    info.pMapEntries = entries.data();
    info.dataSize = words.size() * sizeof(uint32_t);
    info.pData = words.data();
}

VkPipelineShaderStageCreateInfo stage_info(VkShaderStageFlagBits stage, VkShaderModule module) {
    VkPipelineShaderStageCreateInfo info =
        Typed{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage = stage;
    info.module = module;
    info.pName = "main";
    return info;
}

std::vector<shaders::InputChange> input_changes(const PipelineKey& key, bool has_primitive_id) {
    std::vector<shaders::InputChange> changes;
    if (has_primitive_id && key.instruments) {
        shaders::InputChange change;
        change.number = shaders::kPrimitiveLocation;
        change.becomes_primitive_id = true;
        changes.push_back(change);
    }
    const bool is_bare = key.color_from != cases::ColorFrom::push_constant;
    const uint32_t inputs = !is_bare ? key.attribute_count : is_texture(key.color_from) ? 1 : 0;
    for (uint32_t k = 0; k < inputs; ++k) {
        const AttributeKey& attribute = key.attributes[k];
        shaders::InputChange change;
        change.number = 1 + k;
        change.flat = attribute.interpolation == cases::Interpolation::flat;
        change.no_perspective = attribute.interpolation == cases::Interpolation::noperspective;
        change.centroid = attribute.auxiliary == cases::Auxiliary::centroid;
        change.sample = attribute.auxiliary == cases::Auxiliary::sample;
        if (attribute.source == cases::Source::barycentric) {
            // The built-in is chosen by the interpolation; it is perspective or not by itself.
            change.by = shaders::InputBy::built_in;
            change.number = change.no_perspective ? shaders::kBuiltInBaryCoordNoPersp
                                                  : shaders::kBuiltInBaryCoord;
            change.no_perspective = false;
        } else if (attribute.source != cases::Source::vertex) {
            continue;
        }
        const bool is_change =
            change.flat || change.no_perspective || change.centroid || change.sample;
        // Several attributes may be the same built-in.
        if (is_change && std::ranges::find(changes, change) == changes.end()) {
            changes.push_back(change);
        }
    }
    return changes;
}

ShaderChanges vertex_changes(const PipelineKey& key) {
    ShaderChanges out;
    if (key.unused_interface) {
        out.unused_outputs = {shaders::kPrimitiveLocation + 1};  // behind those that are read
    }
    return out;
}

ShaderChanges fragment_changes(const PipelineKey& key, bool has_primitive_id) {
    ShaderChanges out = {input_changes(key, has_primitive_id),
                         execution_modes(key),
                         ending_of(key),
                         output_change(key),
                         {},
                         {}};
    if (key.unused_color) {
        out.unused_outputs = {*key.unused_color};
    }
    return out;
}

std::vector<uint32_t> changed_code(std::span<const uint32_t> code, const ShaderChanges& changes) {
    auto changed = shaders::change_inputs(code, changes.inputs);
    if (changed && !changes.modes.empty()) {
        changed = shaders::with_modes(*changed, changes.modes);
    }
    if (changed && changes.ending != shaders::Ending::kill) {
        changed = shaders::with_ending(*changed, changes.ending);
    }
    if (changed) {
        changed = shaders::with_outputs(*changed, changes.outputs);
    }
    for (const uint32_t location : changes.unused_outputs) {
        if (changed) {
            changed = shaders::with_unused_output(*changed, location);
        }
    }
    if (changed && changes.input_index) {
        changed = shaders::with_input_index(*changed, *changes.input_index);
    }
    if (!changed) {
        fail(Stage::shader, changed.error());
    }
    return std::move(*changed);
}

void specialize(const PipelineKey& key, Specialization& out) {
    if (key.color_from != cases::ColorFrom::push_constant) {
        for (uint32_t k = 0; k < key.constant_bits.size(); ++k) {
            out.add(k, key.constant_bits[k]);
        }
        out.tie();
        return;
    }
    for (uint32_t k = 0; k < key.attribute_count; ++k) {
        out.add(k, static_cast<uint32_t>(choice_of(key.attributes[k])));
    }
    for (uint32_t k = 0; k < key.colors.size(); ++k) {
        out.add(
            k == 0 ? shaders::kColorAttributeConstant : shaders::kOtherAttributeConstant + k - 1,
            std::bit_cast<uint32_t>(key.colors[k].attribute));
    }
    if (key.layout.halves) {
        out.add(shaders::kBackHitConstant, std::bit_cast<uint32_t>(kBinary16Hits.back_hit));
    }
    out.tie();
}

void specialize_between(const PipelineKey& key, Specialization& out) {
    const bool is_last = key.provoking == cases::ProvokingVertex::last;
    if (key.stages == StageWay::geometry_strip) {
        out.add(shaders::kStripConstant, is_last ? 2 : 1);
    }
    if (key.stages != StageWay::tessellation) {
        out.tie();
        return;
    }
    uint32_t flat = 0;
    for (uint32_t k = 0; k < key.attribute_count; ++k) {
        flat |= (key.attributes[k].interpolation == cases::Interpolation::flat ? 1U : 0U) << k;
    }
    out.add(shaders::kProvokingConstant, is_last ? 2 : 0);
    out.add(shaders::kFlatConstant, flat);
    out.tie();
}

std::vector<std::pair<VkShaderStageFlagBits, std::span<const uint32_t>>> stages_between(
    const PipelineKey& key) {
    switch (key.stages) {
        case StageWay::vertex:
            break;
        case StageWay::mesh:  // in the place of the vertex shader
            break;
        case StageWay::geometry:
        case StageWay::geometry_strip:
            return {
                {VK_SHADER_STAGE_GEOMETRY_BIT, shaders::capture_geometry(geometry_variant(key))}};
        case StageWay::tessellation:
            return {{VK_SHADER_STAGE_TESSELLATION_CONTROL_BIT,
                     shaders::capture_control(key.attribute_count)},
                    {VK_SHADER_STAGE_TESSELLATION_EVALUATION_BIT,
                     shaders::capture_evaluation(key.attribute_count)}};
    }
    return {};
}

}  // namespace vk_harness
