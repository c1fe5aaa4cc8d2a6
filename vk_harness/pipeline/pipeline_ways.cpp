// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Pipelines that are linked of libraries, derived from another one, or made with a cache of data
// (doors of the group `state`, cases/model/door.hpp).
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "vk_harness/pipeline/pipeline_cache.hpp"

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

Handle<VkPipeline> PipelineCache::make_from_library(const VkGraphicsPipelineCreateInfo& info) {
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
        auto library = create(own, cache_.get());
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
    auto made = create(whole, cache_.get());
    std::move(libraries.begin(), libraries.end(), std::back_inserter(libraries_));
    return made;
}

Handle<VkPipeline> PipelineCache::make_derived(const PipelineKey& key,
                                               VkGraphicsPipelineCreateInfo info) {
    PipelineKey other = key;
    other.made = PipelineWay::base;
    other.masked = std::numeric_limits<uint32_t>::max();
    for (ColorKey& color : other.colors) {
        color.write_mask = 0;
    }
    auto base = get(other);
    info.flags = VK_PIPELINE_CREATE_DERIVATIVE_BIT;
    info.basePipelineHandle = base;
    info.basePipelineIndex = -1;
    return create(info, cache_.get());
}

Handle<VkPipeline> PipelineCache::make_cached(const VkGraphicsPipelineCreateInfo& info) {
    const VolkDeviceTable& vk = device_->vk();
    VkPipelineCacheCreateInfo cache_info = Typed{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    const auto make_cache = [&] {
        return make(*device_, Stage::pipeline, "vkCreatePipelineCache", vk.vkCreatePipelineCache,
                    vk.vkDestroyPipelineCache, cache_info);
    };
    auto first = make_cache();
    create(info, first.get());
    size_t size = 0;
    std::vector<char> data;
    check(Stage::pipeline, vk.vkGetPipelineCacheData(device_->get(), first.get(), &size, nullptr),
          "vkGetPipelineCacheData");
    data.resize(size);
    check(Stage::pipeline,
          vk.vkGetPipelineCacheData(device_->get(), first.get(), &size, data.data()),
          "vkGetPipelineCacheData");
    cache_info.initialDataSize = size;
    cache_info.pInitialData = data.data();
    auto second = make_cache();
    return create(info, second.get());
}

}  // namespace vk_harness
