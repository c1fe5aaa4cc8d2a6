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

}  // namespace vk_harness
