// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Pipelines that are linked of libraries, derived from another one, or made with a cache of data
// (doors of the group `state`, cases/model/door.hpp).
#pragma once

#include <vector>

#include "vk_harness/pipeline/pipeline_base.hpp"

namespace vk_harness {

// Links the pipeline that `info` describes, for dynamic rendering, which is the first that its
// pNext names. The libraries go to `kept`, to live as long.
Handle<VkPipeline> make_from_library(const PipelineBase& base,
                                     const VkGraphicsPipelineCreateInfo& info,
                                     std::vector<Handle<VkPipeline>>& kept);

// Makes the pipeline with the data of a cache in which it has been made before.
Handle<VkPipeline> make_cached(const PipelineBase& base, const VkGraphicsPipelineCreateInfo& info);

}  // namespace vk_harness
