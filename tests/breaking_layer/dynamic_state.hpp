// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <vector>

namespace breaking {

struct StencilOpSet {
    VkStencilOp fail, pass, depth_fail;
    VkCompareOp compare;
};

// What an application has set of dynamic state.
struct DynamicState {
    std::vector<VkViewport> viewports;
    std::vector<VkRect2D> scissors;
    VkCullModeFlags cull_mode = VK_CULL_MODE_NONE;
    VkFrontFace front_face = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkBool32 discards = VK_FALSE;
    VkCompareOp depth_compare = VK_COMPARE_OP_ALWAYS;
    VkBool32 depth_write = VK_FALSE, has_bias = VK_FALSE;
    std::array<StencilOpSet, 2> stencil{};  // of front and back faces
    std::array<uint32_t, 2> stencil_reference{};
};

// Sets what differs.
void change_state(VkCommandBuffer commands, const DynamicState& from, const DynamicState& to);

}  // namespace breaking
