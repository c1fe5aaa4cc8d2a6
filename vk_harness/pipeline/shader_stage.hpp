// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the fragment shader of a pipeline gets beside its code: changed decorations and
// specialization constants.
#pragma once

#include <vector>

#include "shaders/spirv_variant.hpp"
#include "vk_harness/device/api.hpp"
#include "vk_harness/pipeline/pipeline_key.hpp"

namespace vk_harness {

// Interpolation and auxiliary qualifiers of the inputs; the primitive's number if the device has
// it.
std::vector<shaders::InputChange> input_changes(const PipelineKey& key, bool has_primitive_id);

// Values of the specialization constants of capture.frag. Must not be moved once it is filled.
struct Specialization {
    std::vector<uint32_t> words;
    std::vector<VkSpecializationMapEntry> entries;
    VkSpecializationInfo info{};
};
void specialize(const PipelineKey& key, Specialization& out);

}  // namespace vk_harness
