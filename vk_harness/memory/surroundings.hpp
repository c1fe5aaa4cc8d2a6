// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What an image has beside the attachment that is a part of it: texels of its level beyond the
// render area, other layers, other mip levels. No command of a case writes there, so that each
// texel must keep what was copied into it before ("Render Pass Store Operations": values outside
// the render area are preserved; "Image Subresources").
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "vk_harness/memory/memory.hpp"

namespace vk_harness {

// Larger images are drawn without a look beside the attachment.
inline constexpr VkDeviceSize kMostSurroundings = 1U << 19;  // bytes of an image and aspect

// Every byte of a texel beside an attachment: no clear value of the suite has it, and as a depth it
// is in 0..1.
inline constexpr std::byte kSurrounding{0x3a};

// The texels beside one aspect of an attachment of `size` pixels, read back behind the drawing.
class Surroundings {
  public:
    // No size: of an aspect that is not drawn to. `is_d24`: so is the depth, if that is the aspect.
    // `texel_bytes` as they are copied. Nothing if the image is the attachment's alone, its texels
    // cannot be copied from and to buffers, or there are too many.
    static std::optional<Surroundings> of(const Image& image, VkExtent2D size,
                                          VkImageAspectFlags aspect, uint32_t texel_bytes,
                                          bool is_d24);

    // Bytes that each level's texels take in a buffer, all layers one after the other.
    VkDeviceSize bytes() const { return bytes_; }
    // They are copied to read-back memory from byte `begin` on; returns the end.
    VkDeviceSize place(VkDeviceSize begin);

    // Fills all of the aspect from `pattern`, which has bytes() of kSurrounding; the image is in
    // VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL.
    void record_fill(const Device& device, VkCommandBuffer commands, VkBuffer pattern) const;
    // All of the image is in VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL.
    void record_copy(const Device& device, VkCommandBuffer commands, VkBuffer readback) const;

    // A texel that has changed, the first in the order of levels, layers and rows.
    struct Change {
        uint32_t level = 0, layer = 0, x = 0, y = 0;
        uint32_t got = 0;      // its word that has changed; less of smaller texels
        uint64_t changed = 0;  // texels
    };
    // The first bytes of a texel that has not changed, up to four.
    uint32_t expected() const { return 0x3a3a3a3aU >> (32 - 8 * std::min(texel_bytes_, 4U)); }
    VkImageAspectFlags aspect() const { return aspect_; }
    // What was recorded has run.
    std::optional<Change> read(std::span<const std::byte> memory) const;

  private:
    std::vector<VkBufferImageCopy> regions() const;

    const Image* image_ = nullptr;
    VkRect2D inside_{};  // of the attachment's level
    VkImageAspectFlags aspect_ = 0;
    uint32_t texel_bytes_ = 0;
    // Bytes of a texel that have a value: not the last one of a 24-bit depth ("Copying Data Between
    // Buffers and Images").
    uint32_t held_bytes_ = 0;
    VkDeviceSize bytes_ = 0, begin_ = 0;
};

// What of the image no rendering shows: its layout is not changed with that of the attachment.
std::vector<VkImageSubresourceRange> ranges_beside(const Image& image);

}  // namespace vk_harness
