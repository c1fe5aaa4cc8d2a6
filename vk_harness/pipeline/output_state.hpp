// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What becomes of a fragment's outputs: a part of the pipeline, but behind the door state-output,
// where all of it is dynamic (VK_EXT_extended_dynamic_state2 and 3).
#pragma once

#include <vector>

#include "vk_harness/device/device.hpp"
#include "vk_harness/pipeline/pipeline_key.hpp"

namespace vk_harness {

struct OutputState {
    // One an attachment.
    std::vector<VkBool32> blends;
    std::vector<VkColorBlendEquationEXT> equations;
    std::vector<VkColorComponentFlags> write_masks;
    VkBool32 has_logic = VK_FALSE;
    VkLogicOp logic = VK_LOGIC_OP_COPY;
    VkBool32 alpha_to_coverage = VK_FALSE;
    VkBool32 alpha_to_one = VK_FALSE;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    VkSampleMask sample_mask = 0;
};

// That of a pipeline in which it is not dynamic.
OutputState output_state(const PipelineKey& key);
// The same pipeline with dynamic outputs: draws that differ in nothing else share it.
PipelineKey without_outputs(PipelineKey key);

void set_outputs(const Device& device, VkCommandBuffer commands, const OutputState& state);

}  // namespace vk_harness
