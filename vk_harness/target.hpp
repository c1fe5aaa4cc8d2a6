// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The attachments that a case is drawn to, kept from case to case.
#pragma once

#include <memory>
#include <vector>

#include "cases/case.hpp"
#include "vk_harness/memory.hpp"

namespace vk_harness {

// hits, writer, frag_coord, one image an attribute, and depth, all of one size and sample count.
struct Target {
    cases::Target key;
    std::vector<Image> color;  // hits, writer, frag_coord, attributes in order
    Image depth;
    uint64_t last_use = 0;

    VkDeviceSize memory_size() const;
};

// Bytes that drawing a case of this size takes: what the device has to hold in attachments.
VkDeviceSize attachment_bytes(const cases::Target& key, uint32_t color_count);

class TargetCache {
  public:
    explicit TargetCache(const Device& device) : device_(&device) {}

    // The target of that size with at least `color_count` colour attachments. Valid until trim().
    Result<Target*> get(const cases::Target& key, uint32_t color_count);

    // Frees the targets that were not used for longest until at most `limit` bytes are held.
    void trim(VkDeviceSize limit);

  private:
    const Device* device_;
    std::vector<std::unique_ptr<Target>> targets_;
    uint64_t clock_ = 0;
};

}  // namespace vk_harness
