// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "vk_harness/device/device.hpp"

namespace vk_harness {

// In which stages memory is used, and how.
struct MemoryUse {
    VkPipelineStageFlags2 stage;
    VkAccessFlags2 access;
};

// Records that all memory is used as `to` only after its uses as `from`. Source: Vulkan
// specification, "Memory Barriers".
void memory_barrier(const Device& device, VkCommandBuffer commands, const MemoryUse& from,
                    const MemoryUse& to);

// The same of an image, and in which layout.
struct ImageUse {
    VkPipelineStageFlags2 stage;
    VkAccessFlags2 access;
    VkImageLayout layout;
};
VkImageMemoryBarrier2 image_barrier(VkImage image, const VkImageSubresourceRange& range,
                                    const ImageUse& from, const ImageUse& to);
void record_barriers(const Device& device, VkCommandBuffer commands,
                     std::span<const VkImageMemoryBarrier2> barriers);

}  // namespace vk_harness
