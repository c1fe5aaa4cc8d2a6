// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <optional>
#include <vector>

namespace breaking {

// What a fragment shader reads, and whether a shader multiplies by a matrix.
struct ShaderFacts {
    bool multiplies = false;
    bool reads_pushed = false;  // push constants
    bool reads_uniforms = false, reads_storage = false, reads_textures = false;
    bool has_flat = false, has_smooth = false;  // inputs of floats
};

// What a pipeline is made of, for faults of pipelines that have only that.
struct PipelineFacts {
    VkShaderStageFlags stages = 0;
    std::optional<ShaderFacts> fragment;  // nothing without such a shader
    bool has_matrix = false;              // in the vertex shader
    bool has_divisors = false;            // others than 1
    uint32_t constants = 0;               // that specialize it
    std::vector<VkFormat> colors;         // of a dynamic rendering, as are the next two
    VkFormat depth = VK_FORMAT_UNDEFINED, stencil = VK_FORMAT_UNDEFINED;
    std::vector<VkPipelineColorBlendAttachmentState> blends;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    // Neither a logic operation nor alpha to coverage or to one.
    bool has_plain_output = true;
};

void note_shader(VkShaderModule shader, const ShaderFacts& facts);
PipelineFacts facts_of(const VkGraphicsPipelineCreateInfo& info);

}  // namespace breaking
