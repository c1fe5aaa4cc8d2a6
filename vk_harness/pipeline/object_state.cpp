// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/object_state.hpp"

#include "vk_harness/device/sample_locations.hpp"
#include "vk_harness/pipeline/output_state.hpp"
#include "vk_harness/pipeline/pipeline_state.hpp"

namespace vk_harness {

namespace {

void set_inputs(const Device& device, VkCommandBuffer commands, const PipelineKey& key) {
    const VertexInputState own(key);
    std::vector<VkVertexInputBindingDescription2EXT> bindings;
    for (const VkVertexInputBindingDescription& b : own.bindings) {
        bindings.push_back(
            {VK_STRUCTURE_TYPE_VERTEX_INPUT_BINDING_DESCRIPTION_2_EXT, nullptr, b.binding, b.stride,
             b.inputRate, key.way.is_of_instance(b.binding) ? key.way.divisors.at(b.binding) : 1});
    }
    std::vector<VkVertexInputAttributeDescription2EXT> inputs;
    for (const VkVertexInputAttributeDescription& i : own.inputs) {
        inputs.push_back({VK_STRUCTURE_TYPE_VERTEX_INPUT_ATTRIBUTE_DESCRIPTION_2_EXT, nullptr,
                          i.location, i.binding, i.format, i.offset});
    }
    device.vk().vkCmdSetVertexInputEXT(commands, static_cast<uint32_t>(bindings.size()),
                                       bindings.data(), static_cast<uint32_t>(inputs.size()),
                                       inputs.data());
}

void set_samples(const Device& device, VkCommandBuffer commands, const PipelineKey& key) {
    const VolkDeviceTable& vk = device.vk();
    vk.vkCmdSetRasterizationSamplesEXT(commands, static_cast<VkSampleCountFlagBits>(key.samples));
    if (device.capabilities().location_counts == 0) {
        return;
    }
    const std::vector<VkSampleLocationEXT> places = sample_places(key.sample_locations);
    vk.vkCmdSetSampleLocationsEnableEXT(commands, places.empty() ? VK_FALSE : VK_TRUE);
    if (!places.empty()) {
        const VkSampleLocationsInfoEXT info = sample_locations_info(places);
        vk.vkCmdSetSampleLocationsEXT(commands, &info);
    }
}

bool clips_depth(const PipelineKey& key) {
    // Without a word on it a pipeline clips where it does not clamp.
    return key.depth_clip.value_or(!key.depth_clamp);
}

VkProvokingVertexModeEXT provoking_mode(const PipelineKey& key) {
    return key.provoking == cases::ProvokingVertex::last
               ? VK_PROVOKING_VERTEX_MODE_LAST_VERTEX_EXT
               : VK_PROVOKING_VERTEX_MODE_FIRST_VERTEX_EXT;
}

void set_rasterization(const Device& device, VkCommandBuffer commands, const PipelineKey& key) {
    const VolkDeviceTable& vk = device.vk();
    const Capabilities& c = device.capabilities();
    const RasterizationState own(key);
    vk.vkCmdSetPolygonModeEXT(commands, own.info.polygonMode);
    if (c.depth_clamp) {
        vk.vkCmdSetDepthClampEnableEXT(commands, own.info.depthClampEnable);
    }
    if (c.depth_clip_enable) {
        vk.vkCmdSetDepthClipEnableEXT(commands, clips_depth(key) ? VK_TRUE : VK_FALSE);
    }
    if (c.clip.depth_clip_control) {
        vk.vkCmdSetDepthClipNegativeOneToOneEXT(commands,
                                                key.negative_one_to_one ? VK_TRUE : VK_FALSE);
    }
    if (c.clip.last_provoking_vertex) {
        vk.vkCmdSetProvokingVertexModeEXT(commands, provoking_mode(key));
    }
    if (c.has_conservative) {
        vk.vkCmdSetConservativeRasterizationModeEXT(commands,
                                                    own.conservative.conservativeRasterizationMode);
        vk.vkCmdSetExtraPrimitiveOverestimationSizeEXT(
            commands, own.conservative.extraPrimitiveOverestimationSize);
    }
    if (c.fragment_sizes.is_supported) {
        const auto size = fragment_size_state(key);
        vk.vkCmdSetFragmentShadingRateKHR(commands, &size.fragmentSize, size.combinerOps);
    }
}

}  // namespace

void set_object_state(const Device& device, VkCommandBuffer commands, const PipelineKey& key) {
    const VolkDeviceTable& vk = device.vk();
    set_inputs(device, commands, key);
    set_samples(device, commands, key);
    set_rasterization(device, commands, key);
    const VkPipelineDepthStencilStateCreateInfo depth = depth_state(key);
    vk.vkCmdSetDepthTestEnable(commands, depth.depthTestEnable);
    vk.vkCmdSetStencilTestEnable(commands, depth.stencilTestEnable);
    if (device.capabilities().depth_bounds && !key.tests_bounds) {
        vk.vkCmdSetDepthBoundsTestEnable(commands, VK_FALSE);
    }
    set_outputs(device, commands, output_state(key));
}

PipelineKey without_rasterization(PipelineKey key) {
    key.depth_clamp = false;
    key.depth_clip.reset();
    key.provoking = cases::ProvokingVertex::first;
    key.sample_mask = 0;
    key.rasterization_is_dynamic = true;
    return key;
}

void set_dynamic_rasterization(const Device& device, VkCommandBuffer commands,
                               const PipelineKey& key) {
    const VolkDeviceTable& vk = device.vk();
    const auto samples = static_cast<VkSampleCountFlagBits>(key.samples);
    vk.vkCmdSetRasterizationSamplesEXT(commands, samples);
    vk.vkCmdSetSampleMaskEXT(commands, samples, &key.sample_mask);
    vk.vkCmdSetPolygonModeEXT(commands, VK_POLYGON_MODE_FILL);
    vk.vkCmdSetDepthClampEnableEXT(commands, key.depth_clamp ? VK_TRUE : VK_FALSE);
    vk.vkCmdSetDepthClipEnableEXT(commands, clips_depth(key) ? VK_TRUE : VK_FALSE);
    vk.vkCmdSetProvokingVertexModeEXT(commands, provoking_mode(key));
}

void set_counted_viewports(const Device& device, VkCommandBuffer commands, const DrawState& state) {
    const std::vector<VkViewport> viewports = state.vulkan_viewports();
    const std::vector<VkRect2D> scissors = state.vulkan_scissors();
    const auto count = static_cast<uint32_t>(viewports.size());
    device.vk().vkCmdSetViewportWithCount(commands, count, viewports.data());
    device.vk().vkCmdSetScissorWithCount(commands, count, scissors.data());
}

}  // namespace vk_harness
