// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/lod_texture.hpp"

#include <algorithm>
#include <bit>
#include <vector>

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
    VkSampler sampler = VK_NULL_HANDLE;
    const VkResult result = device.vk().vkCreateSampler(device.get(), &info, nullptr, &sampler);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::pipeline, result, "vkCreateSampler"));
    }
    return Handle<VkSampler>(device.get(), sampler, device.vk().vkDestroySampler);
}

}  // namespace

Result<void> LodTextures::make_image(std::array<uint32_t, 2> size, Texture& texture) const {
    const VolkDeviceTable& vk = device_->vk();
    VkImageCreateInfo info = Typed{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = kTextureFormat;
    info.extent = {size[0], size[1], 1};
    info.mipLevels = static_cast<uint32_t>(std::bit_width(std::max(size[0], size[1])));
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT;
    VkImage image = VK_NULL_HANDLE;
    VkResult result = vk.vkCreateImage(device_->get(), &info, nullptr, &image);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::memory, result, "vkCreateImage"));
    }
    texture.image = Handle<VkImage>(device_->get(), image, vk.vkDestroyImage);
    auto memory = bind_memory(*device_, image);
    if (!memory) {
        return fail(memory.error());
    }
    texture.memory = std::move(*memory);
    VkImageViewCreateInfo view_info = Typed{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view_info.image = image;
    view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view_info.format = kTextureFormat;
    view_info.subresourceRange = kAllLevels;
    VkImageView view = VK_NULL_HANDLE;
    result = vk.vkCreateImageView(device_->get(), &view_info, nullptr, &view);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::memory, result, "vkCreateImageView"));
    }
    texture.view = Handle<VkImageView>(device_->get(), view, vk.vkDestroyImageView);
    return {};
}

Result<void> LodTextures::make_set(const PipelineCache& pipelines, Texture& texture) const {
    const VolkDeviceTable& vk = device_->vk();
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
    VkDescriptorPoolCreateInfo pool_info = Typed{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool_info.maxSets = 1;
    pool_info.poolSizeCount = 1;
    pool_info.pPoolSizes = &size;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkResult result = vk.vkCreateDescriptorPool(device_->get(), &pool_info, nullptr, &pool);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::memory, result, "vkCreateDescriptorPool"));
    }
    texture.pool = Handle<VkDescriptorPool>(device_->get(), pool, vk.vkDestroyDescriptorPool);
    const VkDescriptorSetLayout layout = pipelines.texture_set_layout();
    VkDescriptorSetAllocateInfo info = Typed{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    result = vk.vkAllocateDescriptorSets(device_->get(), &info, &texture.set);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::memory, result, "vkAllocateDescriptorSets"));
    }
    const VkDescriptorImageInfo image_info = {sampler_.get(), texture.view.get(),
                                              VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkWriteDescriptorSet write = Typed{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = texture.set;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &image_info;
    vk.vkUpdateDescriptorSets(device_->get(), 1, &write, 0, nullptr);
    return {};
}

Result<LodTextures::Texture> LodTextures::make(const PipelineCache& pipelines,
                                               std::array<uint32_t, 2> size) {
    if (!sampler_) {
        auto sampler = make_sampler(*device_);
        if (!sampler) {
            return fail(sampler.error());
        }
        sampler_ = std::move(*sampler);
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
        VkImageMemoryBarrier2 b = Typed{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
        b.dstStageMask = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
        b.dstAccessMask = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
        b.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        b.newLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        b.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        b.image = texture.image.get();
        b.subresourceRange = kAllLevels;
        barriers.push_back(b);
    }
    if (barriers.empty()) {
        return;
    }
    VkDependencyInfo info = Typed{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.imageMemoryBarrierCount = static_cast<uint32_t>(barriers.size());
    info.pImageMemoryBarriers = barriers.data();
    device_->vk().vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace vk_harness
