// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The shaders of a draw as objects, without a pipeline (door shader_objects, cases/model/door.hpp).
#pragma once

#include <array>

#include "vk_harness/pipeline/pipeline_base.hpp"

namespace vk_harness {

using ShaderPair = std::array<ShaderObject, 2>;  // vertex, fragment

std::array<Handle<ShaderObject>, 2> make_objects(const PipelineBase& base, const PipelineKey& key);

// Binds the shaders, and none for the stages that a pipeline would not have.
void bind_objects(const Device& device, VkCommandBuffer commands, const ShaderPair& shaders);

}  // namespace vk_harness
