// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The layer's versions of the commands that begin and execute command buffers, and that clear
// within a rendering.
#include <vector>

#include "altering.hpp"
#include "recording.hpp"

namespace breaking {

namespace {

VKAPI_ATTR VkResult VKAPI_CALL begin_command_buffer(VkCommandBuffer commands,
                                                    const VkCommandBufferBeginInfo* info) {
    // Only a secondary one continues a rendering.
    const bool is_secondary = (info->flags & VK_COMMAND_BUFFER_USAGE_RENDER_PASS_CONTINUE_BIT) != 0;
    Recording& recording = recording_of(commands);
    recording.begin(is_secondary);
    recording.may_repeat = !is_secondary && info->flags == 0;
    return driver_of_handle(commands).BeginCommandBuffer(commands, info);
}

VKAPI_ATTR void VKAPI_CALL execute_commands(VkCommandBuffer commands, uint32_t count,
                                            const VkCommandBuffer* given) {
    std::vector<VkCommandBuffer> own(given, given + count);
    alter(hooks().secondaries, own);
    std::erase_if(own, [](VkCommandBuffer c) {
        return ++recording_of(c).executions > 1 && alter(hooks().drop_again);
    });
    if (!own.empty()) {
        driver_of_handle(commands).CmdExecuteCommands(commands, static_cast<uint32_t>(own.size()),
                                                      own.data());
    }
}

VKAPI_ATTR void VKAPI_CALL clear_attachments(VkCommandBuffer commands, uint32_t count,
                                             const VkClearAttachment* attachments,
                                             uint32_t rect_count, const VkClearRect* rects) {
    Clears own;
    own.attachments.assign(attachments, attachments + count);
    own.rects.assign(rects, rects + rect_count);
    alter(hooks().clear_attachments, own);
    driver_of_handle(commands).CmdClearAttachments(
        commands, static_cast<uint32_t>(own.attachments.size()), own.attachments.data(),
        static_cast<uint32_t>(own.rects.size()), own.rects.data());
}

VKAPI_ATTR void VKAPI_CALL begin_render_pass(VkCommandBuffer commands,
                                             const VkRenderPassBeginInfo* info,
                                             VkSubpassContents contents) {
    std::vector<VkClearValue> clears(info->pClearValues,
                                     info->pClearValues + info->clearValueCount);
    alter(hooks().pass_clears, clears);
    VkRenderPassBeginInfo own = *info;
    own.pClearValues = clears.data();
    recording_of(commands).begin_rendering(false);
    recording_of(commands).subpass = 0;
    driver_of_handle(commands).CmdBeginRenderPass(commands, &own, contents);
}

VKAPI_ATTR void VKAPI_CALL next_subpass(VkCommandBuffer commands, VkSubpassContents contents) {
    ++recording_of(commands).subpass;
    driver_of_handle(commands).CmdNextSubpass(commands, contents);
}

VKAPI_ATTR void VKAPI_CALL begin_feedback(VkCommandBuffer commands, uint32_t first, uint32_t count,
                                          const VkBuffer* counters, const VkDeviceSize* offsets) {
    recording_of(commands).lacks_feedback = alter(hooks().drop_feedback);
    if (!recording_of(commands).lacks_feedback) {
        driver_of_handle(commands).CmdBeginTransformFeedbackEXT(commands, first, count, counters,
                                                                offsets);
    }
}

VKAPI_ATTR void VKAPI_CALL end_feedback(VkCommandBuffer commands, uint32_t first, uint32_t count,
                                        const VkBuffer* counters, const VkDeviceSize* offsets) {
    if (!recording_of(commands).lacks_feedback) {
        driver_of_handle(commands).CmdEndTransformFeedbackEXT(commands, first, count, counters,
                                                              offsets);
    }
}

const OwnCommand kRecordingCommands[] = {
    BREAKING_OWN(CmdBeginTransformFeedbackEXT, begin_feedback),
    BREAKING_OWN(CmdEndTransformFeedbackEXT, end_feedback),
    BREAKING_OWN(CmdBeginRenderPass, begin_render_pass),
    BREAKING_OWN(CmdNextSubpass, next_subpass),
    BREAKING_OWN(BeginCommandBuffer, begin_command_buffer),
    BREAKING_OWN(CmdExecuteCommands, execute_commands),
    BREAKING_OWN(CmdClearAttachments, clear_attachments),
};

}  // namespace

std::span<const OwnCommand> recording_commands() {
    return kRecordingCommands;
}

}  // namespace breaking
