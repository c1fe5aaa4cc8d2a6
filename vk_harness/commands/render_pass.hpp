// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The rendering of a case as an instance of a render pass object.
#pragma once

#include "vk_harness/commands/case_plan.hpp"

namespace vk_harness {

// The attachments of the case as the pass names them.
Handle<VkFramebuffer> make_framebuffer(const Device& device, const CasePlan& plan,
                                       VkRenderPass pass);

// Records the instance: clears, draws, resolves. `plan.framebuffer` is that of `plan.pass`.
void render_by_pass(const Device& device, const PipelineCache& pipelines, VkCommandBuffer commands,
                    const CasePlan& plan, VkBuffer vertices);

}  // namespace vk_harness
