// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// vkCmdBlitImage from an image with a known pattern to a cleared one, and the copy back.
#pragma once

#include <array>
#include <vector>

#include "vk_harness/device/rejection.hpp"
#include "vk_harness/memory/memory.hpp"

namespace vk_harness {

// Throws why the device cannot do a case's blit, if it cannot.
void check_blit(const Capabilities& capabilities, const cases::Case& c);

// The bytes of texels with these codes, one after the other, as VkFormat lays them out.
std::vector<std::byte> encode_texels(cases::ColorFormat format,
                                     const std::vector<cases::TexelCodes>& texels);

// Images of one case's blit; they must live until the commands have run.
class BlitImages {
  public:
    // The case has a blit. The source's texels are written to host memory here.
    BlitImages(const Device& device, const cases::Case& c);

    // Records the upload of the source, clearing of the destination, the blit, and, unless
    // `readback` is null, the copy of the destination to byte `offset` of it.
    void record(const Device& device, VkCommandBuffer commands, const cases::Case& c,
                VkClearColorValue clear, VkBuffer readback, VkDeviceSize offset) const;

    Guard* guard() const { return destination_.memory.guard.get(); }  // may be null

  private:
    struct PlainImage {
        ImageMemory memory;  // freed after the image
        Handle<VkImage> image;
    };
    static PlainImage make_image(const Device& device, cases::ColorFormat format, uint32_t width,
                                 uint32_t height);

    Buffer upload_;
    size_t poison_offset_ = 0;  // in it
    PlainImage source_, destination_;
};

}  // namespace vk_harness
