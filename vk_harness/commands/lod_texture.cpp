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

Result<Handle<VkSampler>> make_sampler(const Device& device) {
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

Result<void> LodTextures::make_image(std::array<uint32_t, 2> size, Texture& texture) const {
    VkImageCreateInfo info =
        image_info(kTextureFormat, {size[0], size[1]}, VK_IMAGE_USAGE_SAMPLED_BIT);
    info.mipLevels = static_cast<uint32_t>(std::bit_width(std::max(size[0], size[1])));
    if (auto made = put(texture.image, vk_harness::make_image(*device_, info)); !made) {
        return made;
    }
    const VkImage image = texture.image.get();
    if (auto made = put(texture.memory, bind_memory(*device_, image)); !made) {
        return made;
    }
    VkImageViewCreateInfo view_info = Typed{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view_info.image = image;
    view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view_info.format = kTextureFormat;
    view_info.subresourceRange = kAllLevels;
    return put(texture.view, vk_harness::make(*device_, Stage::memory, "vkCreateImageView",
                                              device_->vk().vkCreateImageView,
                                              device_->vk().vkDestroyImageView, view_info));
}

Result<void> LodTextures::make_set(const PipelineCache& pipelines, Texture& texture) const {
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
    const VkDescriptorSetLayout layout = pipelines.texture_set_layout();
    auto made = make_sets(*device_, {&size, 1}, {&layout, 1});
    if (!made) {
        return fail(made.error());
    }
    texture.pool = std::move(made->pool);
    texture.set = made->sets.front();
    const VkDescriptorImageInfo image_info = {sampler_.get(), texture.view.get(),
                                              VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkWriteDescriptorSet write = Typed{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = texture.set;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &image_info;
    device_->vk().vkUpdateDescriptorSets(device_->get(), 1, &write, 0, nullptr);
    return {};
}

Result<LodTextures::Texture> LodTextures::make(const PipelineCache& pipelines,
                                               std::array<uint32_t, 2> size) {
    if (!sampler_) {
        if (auto done = put(sampler_, make_sampler(*device_)); !done) {
            return fail(done.error());
        }
    }
    Texture texture;
    if (auto done = make_image(size, texture); !done) {
        return fail(done.error());
    }
    if (auto done = make_set(pipelines, texture); !done) {
        return fail(done.error());
    }
    return texture;
}

Result<VkDescriptorSet> LodTextures::get(const PipelineCache& pipelines,
                                         std::array<uint32_t, 2> size) {
    const auto found = textures_.find(size);
    if (found != textures_.end()) {
        return found->second.set;
    }
    auto texture = make(pipelines, size);
    if (!texture) {
        return fail(texture.error());
    }
    return textures_.emplace(size, std::move(*texture)).first->second.set;
}

void LodTextures::record_transitions(VkCommandBuffer commands) {
    std::vector<VkImageMemoryBarrier2> barriers;
    for (auto& [size, texture] : textures_) {
        if (!texture.is_new) {
            continue;
        }
        texture.is_new = false;
        barriers.push_back(image_barrier(
            texture.image.get(), kAllLevels, {0, 0, VK_IMAGE_LAYOUT_UNDEFINED},
            {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
             VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}));
    }
    if (!barriers.empty()) {
        record_barriers(*device_, commands, barriers);
    }
}

}  // namespace vk_harness
