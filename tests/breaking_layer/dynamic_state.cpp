// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "dynamic_state.hpp"

#include <cstring>

#include "driver.hpp"

namespace breaking {

namespace {

template <typename T>
bool differs(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() != b.size() ||
           (!a.empty() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) != 0);
}

}  // namespace

void change_state(VkCommandBuffer commands, const DynamicState& from, const DynamicState& to) {
    const Driver& driver = driver_of_handle(commands);
    if (differs(from.viewports, to.viewports)) {
        driver.CmdSetViewport(commands, 0, static_cast<uint32_t>(to.viewports.size()),
                              to.viewports.data());
    }
    if (differs(from.scissors, to.scissors)) {
        driver.CmdSetScissor(commands, 0, static_cast<uint32_t>(to.scissors.size()),
                             to.scissors.data());
    }
    const auto set = [&](auto member, auto command) {
        if (from.*member != to.*member) {
            command(commands, to.*member);
        }
    };
    set(&DynamicState::cull_mode, driver.CmdSetCullMode);
    set(&DynamicState::front_face, driver.CmdSetFrontFace);
    set(&DynamicState::topology, driver.CmdSetPrimitiveTopology);
    set(&DynamicState::discards, driver.CmdSetRasterizerDiscardEnable);
    set(&DynamicState::depth_compare, driver.CmdSetDepthCompareOp);
    set(&DynamicState::depth_write, driver.CmdSetDepthWriteEnable);
    set(&DynamicState::has_bias, driver.CmdSetDepthBiasEnable);
    for (size_t k = 0; k < to.stencil.size(); ++k) {
        const VkStencilFaceFlags face =
            k == 0 ? VK_STENCIL_FACE_FRONT_BIT : VK_STENCIL_FACE_BACK_BIT;
        const StencilOpSet& ops = to.stencil.at(k);
        if (std::memcmp(&from.stencil.at(k), &ops, sizeof ops) != 0) {
            driver.CmdSetStencilOp(commands, face, ops.fail, ops.pass, ops.depth_fail, ops.compare);
        }
        if (from.stencil_reference.at(k) != to.stencil_reference.at(k)) {
            driver.CmdSetStencilReference(commands, face, to.stencil_reference.at(k));
        }
    }
}

}  // namespace breaking
