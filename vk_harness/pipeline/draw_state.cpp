// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/draw_state.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "cases/model/derive.hpp"
#include "cases/model/sample.hpp"
#include "vk_harness/pipeline/vertex_way.hpp"
#include "vk_harness/target/shader_interface.hpp"
#include "vk_harness/target/target_way.hpp"

namespace vk_harness {

namespace {

VkPrimitiveTopology vulkan_of(cases::Topology topology) {
    constexpr std::array kTopologies = {VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
                                        VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
                                        VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN};
    static_assert(kTopologies.size() == static_cast<size_t>(cases::Topology::triangle_fan) + 1);
    return kTopologies.at(static_cast<size_t>(topology));
}

VkCullModeFlags vulkan_of(cases::CullMode mode) {
    constexpr std::array<VkCullModeFlags, 4> kModes = {VK_CULL_MODE_NONE, VK_CULL_MODE_FRONT_BIT,
                                                       VK_CULL_MODE_BACK_BIT,
                                                       VK_CULL_MODE_FRONT_AND_BACK};
    static_assert(kModes.size() == static_cast<size_t>(cases::CullMode::front_and_back) + 1);
    return kModes.at(static_cast<size_t>(mode));
}

VkFrontFace vulkan_of(cases::FrontFace face) {
    return face == cases::FrontFace::clockwise ? VK_FRONT_FACE_CLOCKWISE
                                               : VK_FRONT_FACE_COUNTER_CLOCKWISE;
}

VkBool32 vulkan_of(bool value) {
    return value ? VK_TRUE : VK_FALSE;
}

DrawState::Viewport bits_of(const cases::Viewport& v) {
    return std::bit_cast<DrawState::Viewport>(
        VkViewport{v.x, v.y, v.width, v.height, v.min_depth, v.max_depth});
}

DrawState::Scissor bits_of(const VkRect2D& rect) {
    return std::bit_cast<DrawState::Scissor>(rect);
}

DrawState::StencilFace bits_of(const cases::StencilFace& face) {
    VkStencilOpState out{};
    out.failOp = static_cast<VkStencilOp>(face.fail);
    out.passOp = static_cast<VkStencilOp>(face.pass);
    out.depthFailOp = static_cast<VkStencilOp>(face.depth_fail);
    out.compareOp = static_cast<VkCompareOp>(face.compare);
    out.compareMask = face.compare_mask;
    out.writeMask = face.write_mask;
    out.reference = face.reference;
    return std::bit_cast<DrawState::StencilFace>(out);
}

DrawState::StencilFace other_face(const DrawState::StencilFace& face) {
    constexpr uint32_t kOps = 8;  // of either enumeration
    constexpr uint32_t kOther = 3;
    DrawState::StencilFace out = face;
    for (size_t k = 0; k < 4; ++k) {
        out.at(k) = (face.at(k) + kOther) % kOps;
    }
    for (size_t k = 4; k < out.size(); ++k) {
        out.at(k) = face.at(k) ^ cases::kStencilBits;
    }
    return out;
}

template <size_t count>
std::array<float, count> floats(const std::array<uint32_t, count>& bits) {
    return std::bit_cast<std::array<float, count>>(bits);
}

}  // namespace

VkRect2D to_vulkan(const cases::Rect& rect) {
    return {{rect.x, rect.y}, {rect.width, rect.height}};
}

VkRect2D moved(const cases::Case& c, VkRect2D rect) {
    const VkOffset2D by = image_way(c).origin();
    // The end may be the largest that there is.
    constexpr int64_t kLargest = std::numeric_limits<int32_t>::max();
    const auto move = [](int32_t& begin, uint32_t& size, int32_t distance) {
        begin += distance;
        size = static_cast<uint32_t>(std::min<int64_t>(size, kLargest - begin));
    };
    move(rect.offset.x, rect.extent.width, by.x);
    move(rect.offset.y, rect.extent.height, by.y);
    return rect;
}

std::vector<VkViewport> DrawState::vulkan_viewports() const {
    std::vector<VkViewport> out;
    for (const Viewport& viewport : viewports) {
        out.push_back(std::bit_cast<VkViewport>(viewport));
    }
    return out;
}

std::vector<VkRect2D> DrawState::vulkan_scissors() const {
    std::vector<VkRect2D> out;
    for (const Scissor& scissor : scissors) {
        out.push_back(std::bit_cast<VkRect2D>(scissor));
    }
    return out;
}

namespace {

// The dynamic part of what pipeline_key() switches on for nothing.
void switch_on_unused(const cases::Case& c, const cases::Draw& own, DrawState& out) {
    // "Depth Bias": a sum of products with 0. Where depths are clipped, they and so the slope are
    // bounded, and no product is one of infinity; without a depth attachment nothing says what the
    // unit is.
    if (!own.depth.bias && c.target.has_depth && own.depth.clip.value_or(!own.depth.clamp)) {
        out.has_bias = VK_TRUE;
    }
    // "Drawing": it applies to indexed draws, and to the largest index of 32 bits, which names no
    // vertex here. Lists need a feature.
    if (own.topology != cases::Topology::triangle_list) {
        out.restart = VK_TRUE;
    }
    // "Depth Test": skipped without a depth attachment.
    if (!c.target.has_depth && !c.target.has_stencil) {
        out.compare = VK_COMPARE_OP_NEVER;
    }
}

}  // namespace

DrawState draw_state(const cases::Case& c, const cases::Draw& own) {
    DrawState out;
    out.cull = vulkan_of(own.cull);
    out.front_face = vulkan_of(own.front_face);
    out.topology = c.variation.door == cases::Door::tessellation ? VK_PRIMITIVE_TOPOLOGY_PATCH_LIST
                                                                 : vulkan_of(own.topology);
    out.is_assembled = c.variation.door != cases::Door::mesh_shader;
    out.restart = vulkan_of(own.primitive_restart || adds_restarts(c.variation.door, own));
    out.discard = vulkan_of(own.rasterizer_discard);
    out.compare = static_cast<VkCompareOp>(own.depth.compare);
    out.depth_write = vulkan_of(own.depth.write && !c.variation.masks_depth);
    out.has_bias = vulkan_of(own.depth.bias.has_value());
    const cases::DepthBias bias = own.depth.bias.value_or(cases::DepthBias{});
    out.bias =
        std::bit_cast<std::array<uint32_t, 3>>(std::array{bias.constant, bias.clamp, bias.slope});
    out.tests_bounds = cases::tests_bounds(c);
    out.has_bounds = vulkan_of(own.depth.bounds.has_value());
    const cases::DepthBounds bounds = own.depth.bounds.value_or(cases::DepthBounds{});
    out.bounds = std::bit_cast<std::array<uint32_t, 2>>(std::array{bounds.min, bounds.max});
    out.blend_constants = std::bit_cast<std::array<uint32_t, 4>>(cases::blend_constants(own));
    out.has_stencil = c.target.has_stencil;
    out.stencil = {bits_of(own.stencil.front), bits_of(own.stencil.back)};
    out.viewports.assign(viewport_count(c), bits_of(cases::Viewport{0, 0, 1, 1, 0, 1}));
    out.scissors.assign(viewport_count(c), bits_of(VkRect2D{{0, 0}, {1, 1}}));
    const VkOffset2D origin = image_way(c).origin();
    const auto put = [&](const cases::Draw& draw) {
        cases::Viewport viewport = draw.viewport;
        viewport.x += static_cast<float>(origin.x);
        viewport.y += static_cast<float>(origin.y);
        out.viewports[draw.viewport_index] = bits_of(viewport);
        out.scissors[draw.viewport_index] = bits_of(moved(c, to_vulkan(draw.scissor)));
    };
    for (const cases::Draw& draw : c.draws) {
        put(draw);
    }
    put(own);
    if (c.variation.door == cases::Door::state_unused) {
        switch_on_unused(c, own, out);
    }
    return out;
}

DrawState without_numbers(DrawState state) {
    state.bias = {};
    state.bounds = {};
    state.blend_constants = {};
    for (DrawState::StencilFace& face : state.stencil) {
        auto own = std::bit_cast<VkStencilOpState>(face);
        own.compareMask = own.writeMask = own.reference = 0;
        face = std::bit_cast<DrawState::StencilFace>(own);
    }
    std::ranges::fill(state.viewports, DrawState::Viewport{});
    std::ranges::fill(state.scissors, DrawState::Scissor{});
    return state;
}

void replace_scissor(DrawState& state, const cases::Draw& own, const VkRect2D& scissor) {
    state.scissors[own.viewport_index] = bits_of(scissor);
}

DrawState other_state(const DrawState& state, Leaves leaves) {
    constexpr uint32_t kCompareOps = 8;
    DrawState out = state;
    out.cull = state.cull == VK_CULL_MODE_FRONT_AND_BACK
                   ? VkCullModeFlags{VK_CULL_MODE_NONE}
                   : VkCullModeFlags{VK_CULL_MODE_FRONT_AND_BACK};
    out.front_face = state.front_face == VK_FRONT_FACE_CLOCKWISE ? VK_FRONT_FACE_COUNTER_CLOCKWISE
                                                                 : VK_FRONT_FACE_CLOCKWISE;
    // Not a list, whose restarts need a feature.
    out.topology = state.topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP
                       ? VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN
                       : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    out.restart = VK_TRUE;  // without it the draw's restarts would be indices of no vertex
    out.compare =
        static_cast<VkCompareOp>((static_cast<uint32_t>(state.compare) + 4) % kCompareOps);
    out.depth_write = vulkan_of(state.depth_write == VK_FALSE);
    out.has_bias = vulkan_of(state.has_bias == VK_FALSE);
    // A clamp needs a feature.
    const std::array<float, 3> bias = floats(state.bias);
    out.bias = std::bit_cast<std::array<uint32_t, 3>>(std::array{bias[0] + 64, 0.0F, bias[2] + 1});
    out.has_bounds = vulkan_of(state.has_bounds == VK_FALSE);
    out.bounds = std::bit_cast<std::array<uint32_t, 2>>(floats(state.bounds)[0] > 0.5F
                                                            ? std::array{0.03125F, 0.0625F}
                                                            : std::array{0.9375F, 0.96875F});
    for (uint32_t& constant : out.blend_constants) {
        constant = std::bit_cast<uint32_t>(std::bit_cast<float>(constant) > 0.5F ? 0.25F : 0.75F);
    }
    for (DrawState::StencilFace& face : out.stencil) {
        face = other_face(face);
    }
    for (DrawState::Viewport& viewport : out.viewports) {
        viewport = bits_of(cases::Viewport{3, 5, 2, 2, 0.25F, 0.75F});
    }
    const bool is_off = leaves == Leaves::rasterization_off;
    out.discard = vulkan_of(is_off);
    const VkRect2D scissor = {{1, 1}, {is_off ? 1U : 0U, is_off ? 1U : 0U}};
    out.scissors.assign(state.scissors.size(), bits_of(scissor));
    return out;
}

void set_state(const Device& device, VkCommandBuffer commands, const DrawState& state,
               const cases::DepthBias& bias) {
    const VolkDeviceTable& vk = device.vk();
    const bool sets_modes = device.capabilities().core.dynamic_state;
    if (sets_modes) {
        vk.vkCmdSetCullMode(commands, state.cull);
        vk.vkCmdSetFrontFace(commands, state.front_face);
        vk.vkCmdSetRasterizerDiscardEnable(commands, state.discard);
        vk.vkCmdSetDepthCompareOp(commands, state.compare);
        vk.vkCmdSetDepthWriteEnable(commands, state.depth_write);
        vk.vkCmdSetDepthBiasEnable(commands, state.has_bias);
    }
    if (sets_modes && state.is_assembled) {
        vk.vkCmdSetPrimitiveTopology(commands, state.topology);
        vk.vkCmdSetPrimitiveRestartEnable(commands, state.restart);
    }
    if (bias.is_controlled()) {
        record_controlled_bias(device.set_depth_bias2(), commands, bias);
    } else {
        const auto [constant, clamp, slope] = floats(state.bias);
        vk.vkCmdSetDepthBias(commands, constant, clamp, slope);
    }
    if (state.tests_bounds) {
        if (sets_modes) {
            vk.vkCmdSetDepthBoundsTestEnable(commands, state.has_bounds);
        }
        const auto [min, max] = floats(state.bounds);
        vk.vkCmdSetDepthBounds(commands, min, max);
    }
    const std::array<float, 4> blend = floats(state.blend_constants);
    vk.vkCmdSetBlendConstants(commands, blend.data());
    for (size_t k = 0; state.has_stencil && k < state.stencil.size(); ++k) {
        const auto face = std::bit_cast<VkStencilOpState>(state.stencil.at(k));
        const VkStencilFaceFlags bit =
            k == 0 ? VK_STENCIL_FACE_FRONT_BIT : VK_STENCIL_FACE_BACK_BIT;
        if (sets_modes) {
            vk.vkCmdSetStencilOp(commands, bit, face.failOp, face.passOp, face.depthFailOp,
                                 face.compareOp);
        }
        vk.vkCmdSetStencilCompareMask(commands, bit, face.compareMask);
        vk.vkCmdSetStencilWriteMask(commands, bit, face.writeMask);
        vk.vkCmdSetStencilReference(commands, bit, face.reference);
    }
}

void set_viewports(const Device& device, VkCommandBuffer commands, const DrawState& state) {
    const std::vector<VkViewport> viewports = state.vulkan_viewports();
    const std::vector<VkRect2D> scissors = state.vulkan_scissors();
    const auto count = static_cast<uint32_t>(viewports.size());
    device.vk().vkCmdSetViewport(commands, 0, count, viewports.data());
    device.vk().vkCmdSetScissor(commands, 0, count, scissors.data());
}

}  // namespace vk_harness
