// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/memory/surroundings.hpp"

#include <algorithm>
#include <cstring>

namespace vk_harness {

namespace {

VkExtent2D size_of_level(const ImageWhole& whole, uint32_t level) {
    return {std::max(whole.extent.width >> level, 1U), std::max(whole.extent.height >> level, 1U)};
}

}  // namespace

std::optional<Surroundings> Surroundings::of(const Image& image, VkExtent2D size,
                                             VkImageAspectFlags aspect, uint32_t texel_bytes,
                                             bool is_d24) {
    const ImageWhole& whole = image.whole();
    if (!whole.is_copied) {
        return std::nullopt;
    }
    Surroundings out;
    out.image_ = &image;
    out.inside_ = {whole.origin, size};
    out.aspect_ = aspect;
    out.texel_bytes_ = texel_bytes;
    out.held_bytes_ = is_d24 && aspect == VK_IMAGE_ASPECT_DEPTH_BIT ? 3 : texel_bytes;
    for (const VkBufferImageCopy& region : out.regions()) {
        out.bytes_ = region.bufferOffset + VkDeviceSize{region.imageExtent.width} *
                                               region.imageExtent.height * whole.layers *
                                               texel_bytes;
    }
    out.bytes_ = (out.bytes_ + 3) & ~VkDeviceSize{3};
    return out.bytes_ <= kMostSurroundings ? std::optional(out) : std::nullopt;
}

std::vector<VkBufferImageCopy> Surroundings::regions() const {
    std::vector<VkBufferImageCopy> out;
    const ImageWhole& whole = image_->whole();
    VkDeviceSize offset = begin_;
    for (uint32_t level = 0; level < whole.levels; ++level) {
        const VkExtent2D size = size_of_level(whole, level);
        VkBufferImageCopy region{};
        region.bufferOffset = offset;
        region.imageSubresource = {aspect_, level, 0, whole.layers};
        region.imageExtent = {size.width, size.height, 1};
        out.push_back(region);
        const VkDeviceSize bytes =
            VkDeviceSize{size.width} * size.height * whole.layers * texel_bytes_;
        offset = (offset + bytes + 15) & ~VkDeviceSize{15};  // a multiple of any texel's bytes
    }
    return out;
}

VkDeviceSize Surroundings::place(VkDeviceSize begin) {
    begin_ = (begin + 15) & ~VkDeviceSize{15};
    return begin_ + bytes_;
}

void Surroundings::record_fill(const Device& device, VkCommandBuffer commands,
                               VkBuffer pattern) const {
    std::vector<VkBufferImageCopy> from = regions();
    for (VkBufferImageCopy& region : from) {
        region.bufferOffset -= begin_;
    }
    device.vk().vkCmdCopyBufferToImage(commands, pattern, image_->get(),
                                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                       static_cast<uint32_t>(from.size()), from.data());
}

void Surroundings::record_copy(const Device& device, VkCommandBuffer commands,
                               VkBuffer readback) const {
    const std::vector<VkBufferImageCopy> to = regions();
    device.vk().vkCmdCopyImageToBuffer(commands, image_->get(),
                                       VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, readback,
                                       static_cast<uint32_t>(to.size()), to.data());
}

std::optional<Surroundings::Change> Surroundings::read(std::span<const std::byte> memory) const {
    const VkImageSubresourceRange& drawn = image_->range();
    std::optional<Change> found;
    const auto check = [&](const std::byte* texel, const Change& place) {
        const std::byte* other =
            std::find_if(texel, texel + held_bytes_, [](std::byte b) { return b != kSurrounding; });
        if (other == texel + held_bytes_) {
            return;
        }
        if (!found) {
            found = place;
            const std::byte* word = texel + (other - texel) / 4 * 4;
            std::memcpy(&found->got, word, std::min(texel_bytes_, 4U));
        }
        ++found->changed;
    };
    for (const VkBufferImageCopy& region : regions()) {
        const std::byte* texel = memory.data() + region.bufferOffset;
        const uint32_t level = region.imageSubresource.mipLevel;
        for (uint32_t layer = 0; layer < region.imageSubresource.layerCount; ++layer) {
            const bool is_own =
                layer >= drawn.baseArrayLayer && layer - drawn.baseArrayLayer < drawn.layerCount;
            const bool is_drawn =
                level == drawn.baseMipLevel && (is_own || (image_->views() >> layer & 1U) != 0);
            const auto left = static_cast<uint32_t>(inside_.offset.x);
            const auto top = static_cast<uint32_t>(inside_.offset.y);
            for (uint32_t y = 0; y < region.imageExtent.height; ++y) {
                const bool is_row = is_drawn && y >= top && y - top < inside_.extent.height;
                for (uint32_t x = 0; x < region.imageExtent.width; ++x) {
                    if (is_row && x == left) {
                        x += inside_.extent.width;
                        texel += size_t{inside_.extent.width} * texel_bytes_;
                        if (x >= region.imageExtent.width) {
                            break;
                        }
                    }
                    check(texel, {level, layer, x, y});
                    texel += texel_bytes_;
                }
            }
        }
    }
    return found;
}

std::vector<VkImageSubresourceRange> ranges_beside(const Image& image) {
    const VkImageSubresourceRange& drawn = image.drawn();
    const ImageWhole& whole = image.whole();
    std::vector<VkImageSubresourceRange> out;
    const auto add = [&](uint32_t level, uint32_t levels, uint32_t layer, uint32_t layers) {
        if (levels > 0 && layers > 0) {
            out.push_back({drawn.aspectMask, level, levels, layer, layers});
        }
    };
    const uint32_t level = drawn.baseMipLevel;
    const uint32_t behind = drawn.baseArrayLayer + drawn.layerCount;
    add(0, level, 0, whole.layers);
    add(level, 1, 0, drawn.baseArrayLayer);
    add(level, 1, behind, whole.layers - behind);
    add(level + 1, whole.levels - level - 1, 0, whole.layers);
    return out;
}

}  // namespace vk_harness
