// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Textures that are never read: textureQueryLod asks for the level of detail that reading would
// use. One a size, with all its levels, kept for good.
#pragma once

#include <array>
#include <map>

#include "vk_harness/memory/descriptor.hpp"
#include "vk_harness/memory/memory.hpp"
#include "vk_harness/pipeline/pipeline_cache.hpp"

namespace vk_harness {

class LodTextures {
  public:
    explicit LodTextures(const Device& device) : device_(&device) {}

    // The descriptor set (PipelineCache::texture_set_layout) of a texture of width x height texels,
    // made at the first call. The sampler interpolates between levels, without bias or bounds.
    VkDescriptorSet get(const PipelineCache& pipelines, std::array<uint32_t, 2> size);

    // Records what new textures need before a shader may look at them. Outside of rendering.
    void record_transitions(VkCommandBuffer commands);

  private:
    struct Texture {
        SampledImage image;
        DescriptorSets set;
        bool is_new = true;  // its layout is undefined
    };
    Texture make(const PipelineCache& pipelines, std::array<uint32_t, 2> size);

    const Device* device_;
    Handle<VkSampler> sampler_;
    std::map<std::array<uint32_t, 2>, Texture> textures_;
};

}  // namespace vk_harness
