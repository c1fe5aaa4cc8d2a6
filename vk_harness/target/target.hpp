// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The images that a case is drawn to, kept from case to case.
#pragma once

#include <memory>
#include <vector>

#include "cases/model/case.hpp"
#include "vk_harness/memory/memory.hpp"
#include "vk_harness/target/attachments.hpp"

namespace vk_harness {

// Bytes that drawing a case takes: what the device has to hold in attachments, or, that way, in
// what they are a part of.
VkDeviceSize attachment_bytes(const cases::Target& target,
                              const std::vector<Attachment>& attachments, const ImageWay& way = {});

class TargetCache {
  public:
    explicit TargetCache(const Device& device) : device_(&device) {}

    // One image an attachment, of the size, layers and sample count of the target, or of which it
    // is a part that way, or what it is resolved into the other one; no image twice in one answer.
    // Valid until trim().
    std::vector<const Image*> get(const cases::Target& target,
                                  const std::vector<Attachment>& attachments,
                                  const ImageWay& way = {}, const ImageWay& resolved = {});

    // Frees an image, with what it holds of the device's memory; null is left alone.
    void release(const Image* image);

    // Frees the images that were not used for longest until at most `limit` bytes are held.
    void trim(VkDeviceSize limit);

  private:
    // Images of one kind, as many as a case needed at most.
    struct Shelf {
        VkFormat format = VK_FORMAT_UNDEFINED;
        uint32_t width = 0, height = 0, samples = 1, layers = 1;
        std::vector<std::array<uint8_t, 2>> sample_locations;
        ImageWay way;
        std::vector<std::unique_ptr<Image>> images;
        uint64_t last_use = 0;
    };
    Shelf& shelf(VkFormat format, const cases::Target& target, const ImageWay& way);

    const Device* device_;
    std::vector<std::unique_ptr<Shelf>> shelves_;
    uint64_t clock_ = 0;
};

}  // namespace vk_harness
