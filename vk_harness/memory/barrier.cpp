// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/memory/barrier.hpp"

namespace vk_harness {

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
    device.vk().vkCmdPipelineBarrier2(commands, &info);
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
    device.vk().vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace vk_harness
