// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The rendering of a case: attachments that are cleared, loaded and stored around its draws, in one
// piece or as a door of the group `recording` asks for (cases/model/door.hpp).
#pragma once

#include <functional>

#include "vk_harness/commands/case_plan.hpp"

namespace vk_harness {

// Ends a command buffer, has it executed after those before it, and begins another.
using NextCommands = std::function<VkCommandBuffer()>;

// How many secondary command buffers the case is recorded in, beside the primary one.
size_t secondaries_of(const CasePlan& plan);

// Records clearing and drawing of a case. Afterwards its attachments are in the layout that
// record_copies expects if `for_copies`. A case of several submissions ends `commands`, which then
// is the buffer to go on with.
void record_draws(const Device& device, const PipelineCache& pipelines, VkCommandBuffer& commands,
                  const CasePlan& plan, VkBuffer vertices, bool for_copies,
                  const NextCommands& next);

}  // namespace vk_harness
