// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Graphics pipelines by the state that cannot be dynamic; pipelines that read single samples.
#pragma once

#include <array>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "shaders/spirv_variant.hpp"
#include "vk_harness/pipeline/clear_pipeline.hpp"
#include "vk_harness/pipeline/input_pipeline.hpp"
#include "vk_harness/pipeline/pipeline_key.hpp"
#include "vk_harness/pipeline/shader_stage.hpp"
#include "vk_harness/target/attachments.hpp"

namespace vk_harness {

using ShaderPair = std::array<ShaderObject, 2>;

class PipelineCache {
  public:
    static PipelineCache create(const Device& device);

    // The pipeline of that key, made at the first call.
    VkPipeline get(const PipelineKey& key);
    // The render pass of that key, made at the first call.
    VkRenderPass get_pass(const PassKey& key);
    // The shaders of that key as objects, made at the first call: vertex, fragment.
    ShaderPair get_objects(const PipelineKey& key);
    // The pipeline that writes positions and attributes by transform feedback, interleaved as they
    // are read.
    VkPipeline get_feedback(uint32_t attribute_count);
    // The pipeline that clears by a draw, made at the first call.
    VkPipeline get_clear(const ClearKey& key);
    // The pipeline that reads an input attachment, made at the first call.
    VkPipeline get_input(const InputKey& key);
    // The compute pipeline that copies the samples of an attachment to a buffer.
    VkPipeline get_copy(const Attachment& attachment);
    // That which copies depth of one sample, as it reads that of several.
    VkPipeline get_code_copy();

    // Lets go of all pipelines and shader objects of draws if there are more than `most` of them,
    // and of what those were linked from. Nothing on the device may need them any more.
    void trim(size_t most);

    VkPipelineLayout layout() const { return layout_.get(); }
    // Set 0 of a draw: binding 0, the texture whose level of detail is asked for.
    VkDescriptorSetLayout texture_set_layout() const { return texture_set_layout_.get(); }
    // Of a vertex shader that reads its inputs from set kPulledSet; what is bound or
    // pushed with layout() stays in force.
    VkPipelineLayout pulled_layout() const { return pulled_layout_.get(); }
    VkDescriptorSetLayout pulled_set_layout() const { return pulled_set_layout_.get(); }
    VkPipelineLayout input_layout() const { return input_layout_.get(); }
    VkDescriptorSetLayout input_set_layout() const { return input_set_layout_.get(); }
    VkPipelineLayout copy_layout() const { return copy_layout_.get(); }
    VkDescriptorSetLayout copy_set_layout() const { return copy_set_layout_.get(); }

  private:
    explicit PipelineCache(const Device& device) : device_(&device) {}
    VkPipeline get_copy(std::span<const uint32_t> source);
    // What a map has for the key, else what is made for it, which the map then keeps.
    template <class Key, class Object, class Make>
    static Object get_or_make(std::map<Key, Handle<Object>>& kept, const Key& key,
                              const Make& make) {
        const auto found = kept.find(key);
        if (found != kept.end()) {
            return found->second.get();
        }
        auto made = make();
        return kept.emplace(key, std::move(made)).first->second.get();
    }
    // The module `code`, embedded in the program, with changes.
    VkShaderModule shader_module(std::span<const uint32_t> code, ShaderChanges changes = {});
    Handle<VkPipeline> make_graphics(const PipelineKey& key);
    // As PipelineKey::made asks for, of what describes a usual pipeline; the first of one for
    // dynamic rendering, which is all that its pNext names.
    Handle<VkPipeline> make_from_library(const VkGraphicsPipelineCreateInfo& info);
    Handle<VkPipeline> make_derived(const PipelineKey& key, VkGraphicsPipelineCreateInfo info);
    Handle<VkPipeline> make_cached(const VkGraphicsPipelineCreateInfo& info);
    Handle<ShaderObject> make_object(VkShaderStageFlagBits stage, std::span<const uint32_t> code,
                                     const VkSpecializationInfo* specialization);
    Handle<VkPipeline> make_feedback(uint32_t attribute_count);
    Handle<VkPipeline> make_input(const InputKey& key);
    Handle<VkPipeline> make_clear(const ClearKey& key);
    Handle<VkPipeline> create(const VkGraphicsPipelineCreateInfo& info, VkPipelineCache cache);

    const Device* device_;
    Handle<VkPipelineCache> cache_;
    Handle<VkDescriptorSetLayout> texture_set_layout_;
    Handle<VkPipelineLayout> layout_;
    Handle<VkDescriptorSetLayout> pulled_set_layout_;
    Handle<VkPipelineLayout> pulled_layout_;
    Handle<VkDescriptorSetLayout> input_set_layout_;
    Handle<VkPipelineLayout> input_layout_;
    Handle<VkDescriptorSetLayout> copy_set_layout_;
    Handle<VkPipelineLayout> copy_layout_;
    // By the embedded code's address and the changes.
    std::map<std::tuple<const uint32_t*, ShaderChanges>, Handle<VkShaderModule>> modules_;
    std::map<PassKey, Handle<VkRenderPass>> passes_;
    std::map<ClearKey, Handle<VkPipeline>> clears_;
    std::map<InputKey, Handle<VkPipeline>> inputs_;
    std::map<uint32_t, Handle<VkPipeline>> feedbacks_;  // by attributes
    std::map<PipelineKey, std::array<Handle<ShaderObject>, 2>> objects_;
    std::map<PipelineKey, Handle<VkPipeline>> pipelines_;
    std::vector<Handle<VkPipeline>> libraries_;             // of those that are linked
    std::map<const uint32_t*, Handle<VkPipeline>> copies_;  // by the embedded code's address
};

// Stages that see shaders::DrawConstants.
VkShaderStageFlags draw_stages(const Device& device);
// Words of push constants: width, height, samples, first column, first row (compute stage).
inline constexpr uint32_t kCopyConstants = 5;
// The same of the pipelines that read input attachments: width, samples (fragment stage).
inline constexpr uint32_t kInputConstants = 2;
inline constexpr uint32_t kCopyGroupSize = 8;  // local size of copy_samples.comp

}  // namespace vk_harness
