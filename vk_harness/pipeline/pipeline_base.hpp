// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What pipelines are made of: layouts, shader modules, the driver's cache.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <tuple>

#include "vk_harness/pipeline/shader_stage.hpp"

namespace vk_harness {

struct PipelineLayouts {
    explicit PipelineLayouts(const Device& device);

    // Set 0 of a draw: binding 0, the texture whose level of detail is asked for.
    Handle<VkDescriptorSetLayout> texture_set;
    Handle<VkPipelineLayout> draw;
    // Of a vertex shader that reads its inputs from set kPulledSet; what is bound or pushed with
    // `draw` stays in force.
    Handle<VkDescriptorSetLayout> pulled_set;
    Handle<VkPipelineLayout> pulled;
    // Of a fragment shader that reads its colour from set 0, binding 0 (ColorFrom::uniform and
    // those behind it).
    struct Colored {
        Handle<VkDescriptorSetLayout> set;
        Handle<VkPipelineLayout> layout;
    };
    std::array<Colored, 4> all_colored;
    const Colored& colored(cases::ColorFrom from) const {
        return all_colored.at(std::min(static_cast<size_t>(from), size_t{5}) - 2);
    }
    // Of what reads an attachment (binding 0) and writes it to a buffer (binding 1): an input
    // attachment in a fragment shader, single samples in a compute shader.
    Handle<VkDescriptorSetLayout> input_set;
    Handle<VkPipelineLayout> input;
    Handle<VkDescriptorSetLayout> copy_set;
    Handle<VkPipelineLayout> copy;
};

class PipelineBase {
  public:
    explicit PipelineBase(const Device& device);

    const Device& device() const { return *device_; }
    const PipelineLayouts& layouts() const { return layouts_; }
    VkPipelineCache cache() const { return cache_.get(); }
    // The module `code`, embedded in the program, with changes.
    VkShaderModule shader_module(std::span<const uint32_t> code, ShaderChanges changes = {});
    // `cache`: another than the usual one, if not null.
    Handle<VkPipeline> create(const VkGraphicsPipelineCreateInfo& info,
                              VkPipelineCache cache = VK_NULL_HANDLE) const;

  private:
    const Device* device_;
    Handle<VkPipelineCache> cache_;
    PipelineLayouts layouts_;
    // By the embedded code's address and the changes.
    std::map<std::tuple<const uint32_t*, ShaderChanges>, Handle<VkShaderModule>> modules_;
};

// `initial`: what the cache begins with.
Handle<VkPipelineCache> make_cache(const Device& device, std::span<const char> initial = {});

// Stages that see shaders::DrawConstants.
VkShaderStageFlags draw_stages(const Device& device);
// Words of push constants: width, height, samples, first column, first row (compute stage).
inline constexpr uint32_t kCopyConstants = 5;
// The same of the pipelines that read input attachments: width, samples (fragment stage).
inline constexpr uint32_t kInputConstants = 2;
inline constexpr uint32_t kCopyGroupSize = 8;  // local size of copy_samples.comp

}  // namespace vk_harness
