// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The fixed state of a graphics pipeline, one function a concept. Where a structure points to
// others, it is kept together with them in one object, which must not be moved once it is filled.
#pragma once

#include <vector>

#include "vk_harness/device/device.hpp"
#include "vk_harness/pipeline/pipeline_key.hpp"

namespace vk_harness {

struct VertexInputState {
    std::vector<VkVertexInputBindingDescription> bindings;
    std::vector<VkVertexInputAttributeDescription> inputs;
    std::vector<VkVertexInputBindingDivisorDescriptionEXT> divisors;
    VkPipelineVertexInputDivisorStateCreateInfoEXT divided{};
    VkPipelineVertexInputStateCreateInfo info{};
};
// The location of an input that no shader has: a device has 16 at least.
inline constexpr uint32_t kUnusedInput = 15;
void vertex_input_state(const PipelineKey& key, VertexInputState& state);

struct RasterizationState {
    VkPipelineRasterizationProvokingVertexStateCreateInfoEXT provoking{};
    VkPipelineRasterizationConservativeStateCreateInfoEXT conservative{};
    VkPipelineRasterizationStateCreateInfo info{};
    VkPipelineRasterizationDepthClipStateCreateInfoEXT depth_clip{};
};
void rasterization_state(const PipelineKey& key, RasterizationState& state);

VkPipelineInputAssemblyStateCreateInfo assembly_state(const PipelineKey& key);

struct ViewportState {
    std::vector<VkViewport> viewports;
    std::vector<VkRect2D> scissors;
    VkPipelineViewportDepthClipControlCreateInfoEXT depth_clip_control{};
    VkPipelineViewportStateCreateInfo info{};
};
void viewport_state(const PipelineKey& key, ViewportState& state);

struct MultisampleState {
    uint32_t sample_mask = 0;
    std::vector<VkSampleLocationEXT> places;
    VkPipelineSampleLocationsStateCreateInfoEXT locations{};
    VkPipelineMultisampleStateCreateInfo info{};
};
void multisample_state(const PipelineKey& key, MultisampleState& state);

VkPipelineDepthStencilStateCreateInfo depth_state(const PipelineKey& key);

// Colour attachments of a draw, in order, and how each is blended.
struct ColorState {
    std::vector<VkFormat> formats;
    std::vector<VkPipelineColorBlendAttachmentState> blends;
    VkPipelineColorBlendStateCreateInfo info{};
};
void color_state(const PipelineKey& key, ColorState& state);

// What is given when a draw is recorded.
std::vector<VkDynamicState> dynamic_states(const PipelineKey& key);

}  // namespace vk_harness
