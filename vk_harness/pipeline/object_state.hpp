// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The state of shaders without a pipeline, which is all dynamic: the door shader_objects
// (cases/model/door.hpp).
#pragma once

#include "vk_harness/pipeline/pipeline_key.hpp"

namespace vk_harness {

// Sets what a pipeline of that key has for itself. What is dynamic there, too, is set_state()'s,
// but the number of viewports: set_counted_viewports().
void set_object_state(const Device& device, VkCommandBuffer commands, const PipelineKey& key);
// The same pipeline with dynamic rasterization, behind the door state_rasterization.
PipelineKey without_rasterization(PipelineKey key);
// Sets what it leaves out of `key`, and what else VK_EXT_extended_dynamic_state3 has of it.
void set_dynamic_rasterization(const Device& device, VkCommandBuffer commands,
                               const PipelineKey& key);
void set_counted_viewports(const Device& device, VkCommandBuffer commands, const DrawState& state);

}  // namespace vk_harness
