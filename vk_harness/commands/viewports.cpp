// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/viewports.hpp"

#include <algorithm>
#include <vector>

#include "vk_harness/target/shader_interface.hpp"

namespace vk_harness {

namespace {

VkViewport to_vulkan(const cases::Viewport& v) {
    return {v.x, v.y, v.width, v.height, v.min_depth, v.max_depth};
}

}  // namespace

void bind_viewports(const Device& device, VkCommandBuffer commands, const cases::Case& c,
                    const cases::Draw& own, const VkRect2D& own_scissor) {
    const uint32_t count = viewport_count(c);
    std::vector<VkViewport> viewports(count, {0, 0, 1, 1, 0, 1});
    std::vector<VkRect2D> scissors(count, {{0, 0}, {1, 1}});
    for (const cases::Draw& draw : c.draws) {
        viewports[draw.viewport_index] = to_vulkan(draw.viewport);
        scissors[draw.viewport_index] = {{draw.scissor.x, draw.scissor.y},
                                         {draw.scissor.width, draw.scissor.height}};
    }
    viewports[own.viewport_index] = to_vulkan(own.viewport);
    scissors[own.viewport_index] = own_scissor;
    device.vk().vkCmdSetViewport(commands, 0, count, viewports.data());
    device.vk().vkCmdSetScissor(commands, 0, count, scissors.data());
}

}  // namespace vk_harness
