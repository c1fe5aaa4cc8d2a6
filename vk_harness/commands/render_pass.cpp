// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/render_pass.hpp"

#include <array>
#include <vector>

#include "vk_harness/commands/draw_commands.hpp"
#include "vk_harness/target/target_way.hpp"

namespace vk_harness {

Handle<VkFramebuffer> make_framebuffer(const Device& device, const CasePlan& plan,
                                       VkRenderPass pass) {
    std::vector<VkImageView> views;
    for (size_t k = 0; k < plan.images.size(); ++k) {
        if (!plan.attachments[k].is_beside_depth) {
            views.push_back(plan.images[k]->view());
        }
    }
    VkFramebufferCreateInfo info = Typed{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    info.renderPass = pass;
    info.attachmentCount = static_cast<uint32_t>(views.size());
    info.pAttachments = views.data();
    const VkOffset2D origin = image_way(*plan.test).origin();
    info.width = plan.test->target.width + static_cast<uint32_t>(origin.x);
    info.height = plan.test->target.height + static_cast<uint32_t>(origin.y);
    info.layers = plan.test->target.layers;
    return make(device, Stage::pipeline, "vkCreateFramebuffer", device.vk().vkCreateFramebuffer,
                device.vk().vkDestroyFramebuffer, info);
}

namespace {

// Has a triangle over the whole target read each of them.
void read_inputs(const Device& device, const PipelineCache& pipelines, VkCommandBuffer commands,
                 const CasePlan& plan) {
    const VolkDeviceTable& vk = device.vk();
    const cases::Target& target = plan.test->target;
    const VkViewport viewport = {
        0, 0, static_cast<float>(target.width), static_cast<float>(target.height), 0, 1};
    const VkRect2D scissor = {{0, 0}, {target.width, target.height}};
    const std::array<uint32_t, kInputConstants> constants = {target.width, target.samples};
    for (const InputRead& input : plan.inputs) {
        if (input.set == VK_NULL_HANDLE) {
            continue;
        }
        vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, input.pipeline);
        vk.vkCmdSetViewport(commands, 0, 1, &viewport);
        vk.vkCmdSetScissor(commands, 0, 1, &scissor);
        vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                                   pipelines.layouts().input.get(), 0, 1, &input.set, 0, nullptr);
        vk.vkCmdPushConstants(commands, pipelines.layouts().input.get(),
                              VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof constants, constants.data());
        vk.vkCmdDraw(commands, 3, 1, 0, 0);
    }
}

}  // namespace

void render_by_pass(const Device& device, const PipelineCache& pipelines, VkCommandBuffer commands,
                    const CasePlan& plan, VkBuffer vertices) {
    const cases::Case& test = *plan.test;
    std::vector<VkClearValue> clears;
    for (const Attachment& a : plan.attachments) {
        if (!a.is_beside_depth) {
            clears.push_back(a.clear);
        }
    }
    VkRenderPassBeginInfo begin = Typed{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
    begin.renderPass = plan.pass;
    begin.framebuffer = plan.framebuffer->get();
    begin.renderArea = moved(test, {{0, 0}, {test.target.width, test.target.height}});
    begin.clearValueCount = static_cast<uint32_t>(clears.size());
    begin.pClearValues = clears.data();
    const VolkDeviceTable& vk = device.vk();
    vk.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    uint32_t subpass = 0;
    for (uint32_t k = 0; k < plan.draws.size(); ++k) {
        for (; subpass < subpass_of(test, k); ++subpass) {
            vk.vkCmdNextSubpass(commands, VK_SUBPASS_CONTENTS_INLINE);
        }
        record_draw(device, pipelines, commands, plan, k, vertices);
    }
    if (!plan.inputs.empty()) {
        vk.vkCmdNextSubpass(commands, VK_SUBPASS_CONTENTS_INLINE);
        read_inputs(device, pipelines, commands, plan);
    }
    vk.vkCmdEndRenderPass(commands);
}

}  // namespace vk_harness
