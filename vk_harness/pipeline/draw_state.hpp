// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The state of a draw that is dynamic as a rule, and a part of the pipeline behind some doors
// (cases/model/door.hpp).
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "cases/model/case.hpp"
#include "vk_harness/device/device.hpp"

namespace vk_harness {

// Floats are kept as their bits, so that pipelines are told apart by them.
struct DrawState {
    using Viewport = std::array<uint32_t, 6>;     // as VkViewport
    using Scissor = std::array<uint32_t, 4>;      // as VkRect2D
    using StencilFace = std::array<uint32_t, 7>;  // as VkStencilOpState
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    VkFrontFace front_face = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    bool is_assembled = true;  // there are a topology and restarts: no mesh shader
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkBool32 restart = VK_FALSE, discard = VK_FALSE;
    VkCompareOp compare = VK_COMPARE_OP_ALWAYS;
    VkBool32 depth_write = VK_TRUE;
    VkBool32 has_bias = VK_FALSE;
    std::array<uint32_t, 3> bias{};  // constant, clamp, slope
    bool tests_bounds = false;       // some draw of the case has depth bounds
    VkBool32 has_bounds = VK_FALSE;
    std::array<uint32_t, 2> bounds{};  // min, max
    std::array<uint32_t, 4> blend_constants{};
    bool has_stencil = false;
    std::array<StencilFace, 2> stencil{};  // front, back
    std::vector<Viewport> viewports;
    std::vector<Scissor> scissors;
    std::vector<VkViewport> vulkan_viewports() const;
    std::vector<VkRect2D> vulkan_scissors() const;
    friend auto operator<=>(const DrawState&, const DrawState&) = default;
};

VkRect2D to_vulkan(const cases::Rect& rect);
// As far to the right and down as the door draws the case (target_way.hpp).
VkRect2D moved(const cases::Case& c, VkRect2D rect);

// The viewport and scissor of each draw stand at its index, those of `own` at theirs; what no draw
// has is a viewport of one pixel. Each draw picks its own by gl_ViewportIndex.
DrawState draw_state(const cases::Case& c, const cases::Draw& own);

// The same without what Vulkan 1.0 sets between draws: viewports, scissors, numbers of biases,
// bounds and blending, masks and references of stencils. All are 0.
DrawState without_numbers(DrawState state);

// The same with another scissor for `own`.
void replace_scissor(DrawState& state, const cases::Draw& own, const VkRect2D& scissor);

// State of which no value is the same but for a restart that is on; a draw with it leaves nothing,
// since rasterization is off or the scissors are empty.
enum class Leaves : uint8_t { rasterization_off, scissors_empty };
DrawState other_state(const DrawState& state, Leaves leaves);

// Sets all but the viewports and scissors; on a device without extendedDynamicState the numbers
// alone. A bias whose unit is chosen is taken from `bias`.
void set_state(const Device& device, VkCommandBuffer commands, const DrawState& state,
               const cases::DepthBias& bias);
void set_viewports(const Device& device, VkCommandBuffer commands, const DrawState& state);

}  // namespace vk_harness
