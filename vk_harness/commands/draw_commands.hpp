// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// One draw of a case as commands within a rendering.
#pragma once

#include "vk_harness/commands/case_plan.hpp"

namespace vk_harness {

// Records the draw with all state and inputs that it needs: nothing is taken over from what was
// recorded before. A draw without vertices records nothing but
// its query.
void record_draw(const Device& device, const PipelineCache& pipelines, VkCommandBuffer commands,
                 const CasePlan& of, uint32_t draw_index, VkBuffer vertices);

}  // namespace vk_harness
