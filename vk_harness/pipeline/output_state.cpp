// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/output_state.hpp"

#include "vk_harness/pipeline/pipeline_state.hpp"

namespace vk_harness {

OutputState output_state(const PipelineKey& key) {
    const ColorState color(key);
    const MultisampleState multisample(key);
    OutputState out;
    for (const VkPipelineColorBlendAttachmentState& blend : color.blends) {
        out.blends.push_back(blend.blendEnable);
        out.equations.push_back({blend.srcColorBlendFactor, blend.dstColorBlendFactor,
                                 blend.colorBlendOp, blend.srcAlphaBlendFactor,
                                 blend.dstAlphaBlendFactor, blend.alphaBlendOp});
        out.write_masks.push_back(blend.colorWriteMask);
    }
    out.has_logic = color.info.logicOpEnable;
    out.logic = color.info.logicOpEnable == VK_TRUE ? color.info.logicOp : VK_LOGIC_OP_COPY;
    out.alpha_to_coverage = multisample.info.alphaToCoverageEnable;
    out.alpha_to_one = multisample.info.alphaToOneEnable;
    out.samples = multisample.info.rasterizationSamples;
    out.sample_mask = multisample.sample_mask;
    return out;
}

PipelineKey without_outputs(PipelineKey key) {
    for (ColorKey& color : key.colors) {
        ColorKey bare;
        bare.format = color.format;
        bare.output = color.output;
        bare.attribute = color.attribute;
        color = bare;
    }
    key.logic.reset();
    key.alpha_to_one = false;
    key.alpha_to_coverage = false;
    key.sample_mask = 0xffffffffU;
    key.masked = 0;
    key.outputs_are_dynamic = true;
    return key;
}

void set_outputs(const Device& device, VkCommandBuffer commands, const OutputState& state) {
    const VolkDeviceTable& vk = device.vk();
    const auto count = static_cast<uint32_t>(state.blends.size());
    if (count > 0) {
        vk.vkCmdSetColorBlendEnableEXT(commands, 0, count, state.blends.data());
        vk.vkCmdSetColorBlendEquationEXT(commands, 0, count, state.equations.data());
        vk.vkCmdSetColorWriteMaskEXT(commands, 0, count, state.write_masks.data());
    }
    vk.vkCmdSetLogicOpEnableEXT(commands, state.has_logic);
    vk.vkCmdSetLogicOpEXT(commands, state.logic);
    vk.vkCmdSetAlphaToCoverageEnableEXT(commands, state.alpha_to_coverage);
    vk.vkCmdSetAlphaToOneEnableEXT(commands, state.alpha_to_one);
    vk.vkCmdSetSampleMaskEXT(commands, state.samples, &state.sample_mask);
}

}  // namespace vk_harness
