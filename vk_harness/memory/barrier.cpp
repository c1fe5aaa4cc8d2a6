// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/memory/barrier.hpp"

#include <vector>

namespace vk_harness {

namespace {

// A mask of 1.0 that covers one of synchronization2: what is new there stands for a part of what
// was before.
VkPipelineStageFlags old_stages(VkPipelineStageFlags2 stages) {
    constexpr VkPipelineStageFlags2 kTransfers =
        VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_RESOLVE_BIT |
        VK_PIPELINE_STAGE_2_BLIT_BIT | VK_PIPELINE_STAGE_2_CLEAR_BIT;
    constexpr VkPipelineStageFlags2 kInputs =
        VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT;
    auto out = static_cast<VkPipelineStageFlags>(stages);  // the others have the same bits
    out |= VkPipelineStageFlags{(stages & kTransfers) != 0 ? VK_PIPELINE_STAGE_TRANSFER_BIT
                                                           : VK_PIPELINE_STAGE_NONE};
    out |= VkPipelineStageFlags{(stages & kInputs) != 0 ? VK_PIPELINE_STAGE_VERTEX_INPUT_BIT
                                                        : VK_PIPELINE_STAGE_NONE};
    return out != 0 ? out : VkPipelineStageFlags{VK_PIPELINE_STAGE_ALL_COMMANDS_BIT};
}

VkAccessFlags old_access(VkAccessFlags2 access) {
    constexpr VkAccessFlags2 kReads =
        VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
    auto out = static_cast<VkAccessFlags>(access);
    out |= VkAccessFlags{(access & kReads) != 0 ? VK_ACCESS_SHADER_READ_BIT : VK_ACCESS_NONE};
    out |= VkAccessFlags{(access & VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT) != 0
                             ? VK_ACCESS_SHADER_WRITE_BIT
                             : VK_ACCESS_NONE};
    return out;
}

// As vkCmdPipelineBarrier2 on a device without it: one call, the stages of all barriers together.
void record_old_barriers(const Device& device, VkCommandBuffer commands,
                         const VkDependencyInfo& info) {
    VkPipelineStageFlags2 from = 0;
    VkPipelineStageFlags2 to = 0;
    std::vector<VkMemoryBarrier> memory;
    for (uint32_t k = 0; k < info.memoryBarrierCount; ++k) {
        const VkMemoryBarrier2& b = info.pMemoryBarriers[k];
        from |= b.srcStageMask;
        to |= b.dstStageMask;
        memory.push_back({VK_STRUCTURE_TYPE_MEMORY_BARRIER, b.pNext, old_access(b.srcAccessMask),
                          old_access(b.dstAccessMask)});
    }
    std::vector<VkImageMemoryBarrier> images;
    for (uint32_t k = 0; k < info.imageMemoryBarrierCount; ++k) {
        const VkImageMemoryBarrier2& b = info.pImageMemoryBarriers[k];
        from |= b.srcStageMask;
        to |= b.dstStageMask;
        images.push_back({VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER, b.pNext,
                          old_access(b.srcAccessMask), old_access(b.dstAccessMask), b.oldLayout,
                          b.newLayout, b.srcQueueFamilyIndex, b.dstQueueFamilyIndex, b.image,
                          b.subresourceRange});
    }
    device.vk().vkCmdPipelineBarrier(commands, old_stages(from), old_stages(to), 0,
                                     static_cast<uint32_t>(memory.size()), memory.data(), 0,
                                     nullptr, static_cast<uint32_t>(images.size()), images.data());
}

void record_barriers(const Device& device, VkCommandBuffer commands, const VkDependencyInfo& info) {
    if (device.capabilities().core.synchronization2) {
        device.vk().vkCmdPipelineBarrier2(commands, &info);
    } else {
        record_old_barriers(device, commands, info);
    }
}

}  // namespace

void memory_barrier(const Device& device, VkCommandBuffer commands, const MemoryUse& from,
                    const MemoryUse& to) {
    VkMemoryBarrier2 barrier = Typed{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    barrier.srcStageMask = from.stage;
    barrier.srcAccessMask = from.access;
    barrier.dstStageMask = to.stage;
    barrier.dstAccessMask = to.access;
    VkDependencyInfo info = Typed{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    record_barriers(device, commands, info);
}

VkImageMemoryBarrier2 image_barrier(VkImage image, const VkImageSubresourceRange& range,
                                    const ImageUse& from, const ImageUse& to) {
    VkImageMemoryBarrier2 b = Typed{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    b.srcStageMask = from.stage;
    b.srcAccessMask = from.access;
    b.dstStageMask = to.stage;
    b.dstAccessMask = to.access;
    b.oldLayout = from.layout;
    b.newLayout = to.layout;
    b.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    b.image = image;
    b.subresourceRange = range;
    return b;
}

void record_barriers(const Device& device, VkCommandBuffer commands,
                     std::span<const VkImageMemoryBarrier2> barriers) {
    VkDependencyInfo info = Typed{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.imageMemoryBarrierCount = static_cast<uint32_t>(barriers.size());
    info.pImageMemoryBarriers = barriers.data();
    record_barriers(device, commands, info);
}

}  // namespace vk_harness
