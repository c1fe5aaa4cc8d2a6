// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Graphics pipelines by the state that cannot be dynamic; pipelines that read single samples.
#pragma once

#include <map>
#include <span>

#include "cases/case.hpp"
#include "vk_harness/device.hpp"

namespace vk_harness {

// What distinguishes two pipelines. Topology, culling, facing, viewport and scissor are dynamic.
struct PipelineKey {
    uint32_t attribute_count = 0;
    std::array<cases::Interpolation, cases::kMaxAttributes> modes{};  // unused ones: smooth
    uint32_t samples = 1;
    friend auto operator<=>(const PipelineKey&, const PipelineKey&) = default;
};

class PipelineCache {
  public:
    static Result<PipelineCache> create(const Device& device);

    // The pipeline of that key, made at the first call.
    Result<VkPipeline> get(const PipelineKey& key);
    // The compute pipeline that copies the samples of a colour or depth attachment to a buffer.
    Result<VkPipeline> get_copy(bool depth);

    VkPipelineLayout layout() const { return layout_.get(); }
    VkPipelineLayout copy_layout() const { return copy_layout_.get(); }
    VkDescriptorSetLayout copy_set_layout() const { return copy_set_layout_.get(); }

  private:
    explicit PipelineCache(const Device& device) : device_(&device) {}
    Result<VkShaderModule> shader_module(std::span<const uint32_t> code);
    Result<Handle<VkPipeline>> make_graphics(const PipelineKey& key);

    const Device* device_;
    Handle<VkPipelineCache> cache_;
    Handle<VkPipelineLayout> layout_;
    Handle<VkDescriptorSetLayout> copy_set_layout_;
    Handle<VkPipelineLayout> copy_layout_;
    std::map<const uint32_t*, Handle<VkShaderModule>> modules_;  // by the embedded code's address
    std::map<PipelineKey, Handle<VkPipeline>> pipelines_;
    std::map<bool, Handle<VkPipeline>> copies_;
};

// Words of push constants: the index of the draw (fragment stage).
inline constexpr uint32_t kDrawConstants = 1;
// Words of push constants: width, height, samples (compute stage).
inline constexpr uint32_t kCopyConstants = 3;
inline constexpr uint32_t kCopyGroupSize = 8;  // local size of copy_samples.comp

}  // namespace vk_harness
