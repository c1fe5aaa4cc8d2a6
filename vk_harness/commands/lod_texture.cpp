// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/lod_texture.hpp"

#include <algorithm>
#include <bit>
#include <vector>

#include "vk_harness/memory/barrier.hpp"

namespace vk_harness {

namespace {

// One component of 8 bits; every device samples it.
constexpr VkFormat kTextureFormat = VK_FORMAT_R8_UNORM;
constexpr VkImageSubresourceRange kAllLevels = {VK_IMAGE_ASPECT_COLOR_BIT, 0,
                                                VK_REMAINING_MIP_LEVELS, 0, 1};

Handle<VkSampler> make_sampler(const Device& device) {
    VkSamplerCreateInfo info = Typed{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.magFilter = VK_FILTER_LINEAR;
    info.minFilter = VK_FILTER_LINEAR;
    info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    info.addressModeU = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    info.addressModeV = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    info.maxLod = VK_LOD_CLAMP_NONE;
    return make(device, Stage::pipeline, "vkCreateSampler", device.vk().vkCreateSampler,
                device.vk().vkDestroySampler, info);
}

}  // namespace

LodTextures::Texture LodTextures::make(const PipelineCache& pipelines,
                                       std::array<uint32_t, 2> size) {
    if (!sampler_) {
        sampler_ = make_sampler(*device_);
    }
    VkImageCreateInfo info =
        image_info(kTextureFormat, {size[0], size[1]}, VK_IMAGE_USAGE_SAMPLED_BIT);
    info.mipLevels = static_cast<uint32_t>(std::bit_width(std::max(size[0], size[1])));
    Texture texture;
    texture.image = make_sampled(*device_, info, VK_IMAGE_VIEW_TYPE_2D, kAllLevels);
    constexpr VkDescriptorType kType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    texture.set = make_sets(*device_, {kType}, pipelines.layouts().texture_set.get());
    DescriptorWrites writes;
    writes.add(
        texture.set.sets.front(), 0, kType,
        {sampler_.get(), texture.image.view.get(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
    writes.write(*device_);
    return texture;
}

VkDescriptorSet LodTextures::get(const PipelineCache& pipelines, std::array<uint32_t, 2> size) {
    const auto found = textures_.find(size);
    if (found != textures_.end()) {
        return found->second.set.sets.front();
    }
    auto texture = make(pipelines, size);
    return textures_.emplace(size, std::move(texture)).first->second.set.sets.front();
}

void LodTextures::record_transitions(VkCommandBuffer commands) {
    std::vector<VkImageMemoryBarrier2> barriers;
    for (auto& [size, texture] : textures_) {
        if (!texture.is_new) {
            continue;
        }
        texture.is_new = false;
        barriers.push_back(image_barrier(
            texture.image.image.get(), kAllLevels, {0, 0, VK_IMAGE_LAYOUT_UNDEFINED},
            {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
             VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}));
    }
    if (!barriers.empty()) {
        record_barriers(*device_, commands, barriers);
    }
}

}  // namespace vk_harness
