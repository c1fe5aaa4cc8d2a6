// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

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

}  // namespace vk_harness
