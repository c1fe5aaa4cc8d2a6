// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/pipeline_ways.hpp"

#include <algorithm>
#include <array>

namespace vk_harness {

namespace {

// The state of one part of a pipeline; what belongs to the others is left out.
VkGraphicsPipelineCreateInfo part_of(const VkGraphicsPipelineCreateInfo& whole,
                                     VkGraphicsPipelineLibraryFlagsEXT part,
                                     std::vector<VkPipelineShaderStageCreateInfo>& stages) {
    VkGraphicsPipelineCreateInfo out = whole;
    if (part != VK_GRAPHICS_PIPELINE_LIBRARY_VERTEX_INPUT_INTERFACE_BIT_EXT) {
        out.pVertexInputState = nullptr;
        out.pInputAssemblyState = nullptr;
    }
    const bool is_before = part == VK_GRAPHICS_PIPELINE_LIBRARY_PRE_RASTERIZATION_SHADERS_BIT_EXT;
    const bool is_fragment = part == VK_GRAPHICS_PIPELINE_LIBRARY_FRAGMENT_SHADER_BIT_EXT;
    const bool is_output = part == VK_GRAPHICS_PIPELINE_LIBRARY_FRAGMENT_OUTPUT_INTERFACE_BIT_EXT;
    if (!is_before) {
        out.pViewportState = nullptr;
        out.pRasterizationState = nullptr;
        out.pTessellationState = nullptr;
    }
    if (!is_fragment) {
        out.pDepthStencilState = nullptr;
    }
    if (!is_fragment && !is_output) {
        out.pMultisampleState = nullptr;
    }
    if (!is_output) {
        out.pColorBlendState = nullptr;
    }
    stages.clear();
    for (uint32_t k = 0; k < whole.stageCount; ++k) {
        const bool is_of_fragment = whole.pStages[k].stage == VK_SHADER_STAGE_FRAGMENT_BIT;
        if ((is_of_fragment && is_fragment) || (!is_of_fragment && is_before)) {
            stages.push_back(whole.pStages[k]);
        }
    }
    out.stageCount = static_cast<uint32_t>(stages.size());
    out.pStages = stages.data();
    if (!is_before && !is_fragment) {
        out.layout = VK_NULL_HANDLE;
    }
    return out;
}

}  // namespace

Handle<VkPipeline> make_from_library(const PipelineBase& base,
                                     const VkGraphicsPipelineCreateInfo& info,
                                     std::vector<Handle<VkPipeline>>& kept) {
    constexpr std::array<VkGraphicsPipelineLibraryFlagBitsEXT, 4> kParts = {
        VK_GRAPHICS_PIPELINE_LIBRARY_VERTEX_INPUT_INTERFACE_BIT_EXT,
        VK_GRAPHICS_PIPELINE_LIBRARY_PRE_RASTERIZATION_SHADERS_BIT_EXT,
        VK_GRAPHICS_PIPELINE_LIBRARY_FRAGMENT_SHADER_BIT_EXT,
        VK_GRAPHICS_PIPELINE_LIBRARY_FRAGMENT_OUTPUT_INTERFACE_BIT_EXT};
    const auto whole_rendering = *static_cast<const VkPipelineRenderingCreateInfo*>(info.pNext);
    std::vector<Handle<VkPipeline>> libraries;
    std::vector<VkPipeline> handles;
    for (const VkGraphicsPipelineLibraryFlagBitsEXT part : kParts) {
        std::vector<VkPipelineShaderStageCreateInfo> stages;
        VkGraphicsPipelineCreateInfo own = part_of(info, part, stages);
        VkGraphicsPipelineLibraryCreateInfoEXT which =
            Typed{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_LIBRARY_CREATE_INFO_EXT};
        which.flags = part;
        // Formats belong to the outputs, the view mask to all that draws.
        VkPipelineRenderingCreateInfo rendering = whole_rendering;
        if (part != VK_GRAPHICS_PIPELINE_LIBRARY_FRAGMENT_OUTPUT_INTERFACE_BIT_EXT) {
            rendering = Typed{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
            rendering.viewMask = whole_rendering.viewMask;
        }
        // The fragment size is state of all shaders but of nothing beside them.
        const bool has_shaders =
            part == VK_GRAPHICS_PIPELINE_LIBRARY_PRE_RASTERIZATION_SHADERS_BIT_EXT ||
            part == VK_GRAPHICS_PIPELINE_LIBRARY_FRAGMENT_SHADER_BIT_EXT;
        rendering.pNext = has_shaders ? whole_rendering.pNext : nullptr;
        which.pNext = &rendering;
        own.pNext = &which;
        own.flags |= VK_PIPELINE_CREATE_LIBRARY_BIT_KHR;
        auto library = base.create(own);
        handles.push_back(library.get());
        libraries.push_back(std::move(library));
    }
    VkPipelineLibraryCreateInfoKHR linked =
        Typed{VK_STRUCTURE_TYPE_PIPELINE_LIBRARY_CREATE_INFO_KHR};
    linked.libraryCount = static_cast<uint32_t>(handles.size());
    linked.pLibraries = handles.data();
    VkGraphicsPipelineCreateInfo whole = Typed{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    whole.pNext = &linked;
    whole.layout = info.layout;
    auto made = base.create(whole);
    std::ranges::move(libraries, std::back_inserter(kept));
    return made;
}

Handle<VkPipeline> make_cached(const PipelineBase& base, const VkGraphicsPipelineCreateInfo& info) {
    const Device& device = base.device();
    const Handle<VkPipelineCache> first = make_cache(device);
    base.create(info, first.get());
    size_t size = 0;
    const auto ask = [&](char* to) {
        check(Stage::pipeline,
              device.vk().vkGetPipelineCacheData(device.get(), first.get(), &size, to),
              "vkGetPipelineCacheData");
    };
    ask(nullptr);
    std::vector<char> data(size);
    ask(data.data());
    return base.create(info, make_cache(device, std::span(data).first(size)).get());
}

}  // namespace vk_harness
