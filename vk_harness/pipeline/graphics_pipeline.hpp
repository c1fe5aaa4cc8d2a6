// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The pipeline of a draw.
#pragma once

#include <vector>

#include "vk_harness/pipeline/pipeline_base.hpp"

namespace vk_harness {

// The key of the pipeline from which one that is derived may be: all masked.
PipelineKey base_key(const PipelineKey& key);

// `pass`: of key.pass, `derived_from`: of base_key(), if there are. What a pipeline is linked of
// goes to `libraries`, to live as long.
Handle<VkPipeline> make_graphics(PipelineBase& base, const PipelineKey& key, VkRenderPass pass,
                                 VkPipeline derived_from,
                                 std::vector<Handle<VkPipeline>>& libraries);

}  // namespace vk_harness
