// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include "vulkan_layer/layer.hpp"

#ifndef VK_EXT_shader_object
// Newer than Debian 12's headers; the handles are 64 bits each.
using PFN_vkCmdBindShadersEXT = void(VKAPI_PTR*)(VkCommandBuffer, uint32_t,
                                                 const VkShaderStageFlagBits*, const uint64_t*);
#endif

namespace breaking {

// Every device command that the layer takes on the way to the driver.
// clang-format off
#define BREAKING_COMMANDS(X) \
    X(CreateShaderModule) \
    X(CreateBuffer) \
    X(AllocateMemory) \
    X(CreateImage) \
    X(MapMemory) \
    X(CreateImageView) \
    X(CreatePipelineCache) \
    X(BindBufferMemory) \
    X(BindImageMemory) \
    X(FreeMemory) \
    X(CmdFillBuffer) \
    X(CreateGraphicsPipelines) \
    X(QueueSubmit) \
    X(WaitForFences) \
    X(CmdSetViewport) \
    X(CmdSetScissor) \
    X(CmdSetCullMode) \
    X(CmdSetFrontFace) \
    X(CmdSetPrimitiveTopology) \
    X(CmdSetPrimitiveRestartEnable) \
    X(CmdSetRasterizerDiscardEnable) \
    X(CmdSetDepthCompareOp) \
    X(CmdSetDepthWriteEnable) \
    X(CmdSetDepthBoundsTestEnable) \
    X(CmdSetDepthBounds) \
    X(CmdSetDepthBiasEnable) \
    X(CmdSetDepthBias) \
    X(CmdSetBlendConstants) \
    X(CmdSetColorBlendEnableEXT) \
    X(CmdSetColorWriteMaskEXT) \
    X(CmdSetSampleMaskEXT) \
    X(CmdSetDepthClampEnableEXT) \
    X(CmdSetProvokingVertexModeEXT) \
    X(CmdSetAlphaToCoverageEnableEXT) \
    X(CmdSetStencilOp) \
    X(CmdSetStencilCompareMask) \
    X(CmdSetStencilWriteMask) \
    X(CmdSetStencilReference) \
    X(CmdBindPipeline) \
    X(CmdBindShadersEXT) \
    X(CmdBindDescriptorSets) \
    X(CmdPushConstants) \
    X(CmdBindVertexBuffers) \
    X(CmdBindIndexBuffer) \
    X(CmdDraw) \
    X(CmdDrawIndexed) \
    X(CmdBindVertexBuffers2) \
    X(CmdDrawIndirect) \
    X(CmdDrawIndexedIndirect) \
    X(CmdDrawIndirectCount) \
    X(CmdDrawIndexedIndirectCount) \
    X(CmdDrawMultiEXT) \
    X(CmdDrawMultiIndexedEXT) \
    X(CmdDrawMeshTasksEXT) \
    X(UpdateDescriptorSets) \
    X(CmdBeginRendering) \
    X(CmdEndRendering) \
    X(CmdBeginRenderPass) \
    X(CmdBeginTransformFeedbackEXT) \
    X(CmdEndTransformFeedbackEXT) \
    X(CmdNextSubpass) \
    X(CmdPipelineBarrier2) \
    X(CmdClearColorImage) \
    X(CmdCopyImageToBuffer) \
    X(CmdCopyBufferToImage) \
    X(CmdBlitImage) \
    X(CmdDispatch) \
    X(BeginCommandBuffer) \
    X(CmdExecuteCommands) \
    X(CmdClearAttachments) \
    X(CreateQueryPool) \
    X(CmdBeginQuery) \
    X(CmdResetQueryPool) \
    X(GetQueryPoolResults)
// clang-format on

// The next layer's, or the driver's, commands of one device.
struct Driver : vulkan_layer::Device {
#define BREAKING_MEMBER(name) PFN_vk##name name = nullptr;
    BREAKING_COMMANDS(BREAKING_MEMBER)
#undef BREAKING_MEMBER
};

template <typename Handle>
const Driver& driver_of_handle(Handle handle) {
    return static_cast<const Driver&>(vulkan_layer::device_of(vulkan_layer::dispatch_key(handle)));
}

}  // namespace breaking
