// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Pipelines, shader objects and render passes, kept by what distinguishes them.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "vk_harness/pipeline/clear_pipeline.hpp"
#include "vk_harness/pipeline/input_pipeline.hpp"
#include "vk_harness/pipeline/pipeline_base.hpp"
#include "vk_harness/pipeline/shader_object.hpp"

namespace vk_harness {

class PipelineCache {
  public:
    explicit PipelineCache(const Device& device) : base_(device) {}

    const PipelineLayouts& layouts() const { return base_.layouts(); }
    // Each is made at the first call.
    VkPipeline get(const PipelineKey& key);
    VkRenderPass get_pass(const PassKey& key);
    ShaderPair get_objects(const PipelineKey& key);
    // Writes positions and attributes by transform feedback, interleaved as they are read.
    VkPipeline get_feedback(uint32_t attribute_count);
    // Clears by a draw.
    VkPipeline get_clear(const ClearKey& key);
    // Reads an input attachment.
    VkPipeline get_input(const InputKey& key);
    // Copies the samples of an attachment to a buffer, in a compute shader.
    VkPipeline get_copy(const Attachment& attachment);
    // Copies depth of one sample, read as get_copy() reads that of several.
    VkPipeline get_code_copy();

    // Lets go of all pipelines and shader objects of draws if there are more than `most` of them,
    // and of what those were linked from. Nothing on the device may need them any more.
    void trim(size_t most);

  private:
    VkPipeline get_copy(std::span<const uint32_t> source);

    PipelineBase base_;
    std::map<PassKey, Handle<VkRenderPass>> passes_;
    std::map<ClearKey, Handle<VkPipeline>> clears_;
    std::map<InputKey, Handle<VkPipeline>> inputs_;
    std::map<uint32_t, Handle<VkPipeline>> feedbacks_;  // by attributes
    std::map<PipelineKey, std::array<Handle<ShaderObject>, 2>> objects_;
    std::map<PipelineKey, Handle<VkPipeline>> pipelines_;
    std::vector<Handle<VkPipeline>> libraries_;             // of those that are linked
    std::map<const uint32_t*, Handle<VkPipeline>> copies_;  // by the embedded code's address
};

}  // namespace vk_harness
