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
    explicit VertexInputState(const PipelineKey& key);
    std::vector<VkVertexInputBindingDescription> bindings;
    std::vector<VkVertexInputAttributeDescription> inputs;
    std::vector<VkVertexInputBindingDivisorDescriptionEXT> divisors;
    VkPipelineVertexInputDivisorStateCreateInfoEXT divided{};
    VkPipelineVertexInputStateCreateInfo info{};
};
// The location of an input that no shader has: a device has 16 at least.
inline constexpr uint32_t kUnusedInput = 15;

struct RasterizationState {
    explicit RasterizationState(const PipelineKey& key);
    VkPipelineRasterizationProvokingVertexStateCreateInfoEXT provoking{};
    VkPipelineRasterizationConservativeStateCreateInfoEXT conservative{};
    VkPipelineRasterizationStateCreateInfo info{};
    VkPipelineRasterizationDepthClipStateCreateInfoEXT depth_clip{};
};

// The fragment size, which alone decides the rate ("KEEP").
VkPipelineFragmentShadingRateStateCreateInfoKHR fragment_size_state(const PipelineKey& key);

VkPipelineInputAssemblyStateCreateInfo assembly_state(const PipelineKey& key);

struct ViewportState {
    explicit ViewportState(const PipelineKey& key);
    std::vector<VkViewport> viewports;
    std::vector<VkRect2D> scissors;
    VkPipelineViewportDepthClipControlCreateInfoEXT depth_clip_control{};
    VkPipelineViewportStateCreateInfo info{};
};

struct MultisampleState {
    explicit MultisampleState(const PipelineKey& key);
    uint32_t sample_mask = 0;
    std::vector<VkSampleLocationEXT> places;
    VkPipelineSampleLocationsStateCreateInfoEXT locations{};
    VkPipelineMultisampleStateCreateInfo info{};
};

VkPipelineDepthStencilStateCreateInfo depth_state(const PipelineKey& key);

// Colour attachments of a draw, in order, and how each is blended.
struct ColorState {
    explicit ColorState(const PipelineKey& key);
    std::vector<VkFormat> formats;
    std::vector<VkPipelineColorBlendAttachmentState> blends;
    VkPipelineColorBlendStateCreateInfo info{};
};

// The formats of dynamic rendering.
VkPipelineRenderingCreateInfo rendering_info(const std::vector<VkFormat>& colors, VkFormat depth,
                                             VkFormat stencil);

// A triangle over the whole target, of a vertex shader without inputs; viewport and scissor are
// dynamic, and what is added to `dynamic`. apply() is the last thing before the pipeline is made.
struct FullTargetState {
    std::vector<VkDynamicState> dynamic = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};

    FullTargetState();
    void apply(VkGraphicsPipelineCreateInfo& info);

  private:
    VkPipelineVertexInputStateCreateInfo inputs_{};
    VkPipelineInputAssemblyStateCreateInfo assembly_{};
    VkPipelineViewportStateCreateInfo viewport_{};
    VkPipelineRasterizationStateCreateInfo rasterization_{};
    VkPipelineDynamicStateCreateInfo dynamic_{};
};

// What is given when a draw is recorded.
std::vector<VkDynamicState> dynamic_states(const PipelineKey& key);

}  // namespace vk_harness
