// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Several viewports: all of a case are bound at once, and each draw picks its own by
// gl_ViewportIndex. Several layers: each draw picks its own by gl_Layer.
#pragma once

#include "cases/model/case.hpp"
#include "vk_harness/device/device.hpp"

namespace vk_harness {

// Binds the viewport and scissor of each draw at its index, those of `own` at the last; what no
// draw has is a viewport of one pixel. `own_scissor` is bound instead of the scissor of `own`.
void bind_viewports(const Device& device, VkCommandBuffer commands, const cases::Case& c,
                    const cases::Draw& own, const VkRect2D& own_scissor);

}  // namespace vk_harness
