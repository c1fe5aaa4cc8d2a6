// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Shaders without a pipeline, whose state is all dynamic: the door shader_objects
// (cases/model/door.hpp).
#pragma once

#include "vk_harness/pipeline/pipeline_cache.hpp"

namespace vk_harness {

// Binds the shaders, and none for the stages that a pipeline would not have.
void bind_objects(const Device& device, VkCommandBuffer commands, const ShaderPair& shaders);

// Sets what a pipeline of that key has for itself. What is dynamic there, too, is set_state()'s,
// but the number of viewports: set_counted_viewports().
void set_object_state(const Device& device, VkCommandBuffer commands, const PipelineKey& key);
void set_counted_viewports(const Device& device, VkCommandBuffer commands, const DrawState& state);

}  // namespace vk_harness
