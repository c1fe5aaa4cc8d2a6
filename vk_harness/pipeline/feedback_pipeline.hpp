// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The pipeline of the door transform_feedback (cases/model/door.hpp): nothing is rasterized.
#pragma once

#include "vk_harness/pipeline/pipeline_base.hpp"

namespace vk_harness {

// Writes positions and attributes, interleaved.
Handle<VkPipeline> make_feedback(PipelineBase& base, uint32_t attribute_count);

}  // namespace vk_harness
