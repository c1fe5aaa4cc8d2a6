// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/target.hpp"

#include <algorithm>

namespace vk_harness {

VkDeviceSize Target::memory_size() const {
    VkDeviceSize size = depth.memory_size();
    for (const Image& image : color) {
        size += image.memory_size();
    }
    return size;
}

VkDeviceSize attachment_bytes(const cases::Target& key, uint32_t color_count) {
    // 16 bytes a colour sample, 4 bytes a depth sample; below 2^14 * 2^14 * 2^6 * 2^7 = 2^41.
    return VkDeviceSize{key.width} * key.height * key.samples * (16 * color_count + 4);
}

Result<Target*> TargetCache::get(const cases::Target& key, uint32_t color_count) {
    auto found = std::find_if(targets_.begin(), targets_.end(),
                              [&key](const auto& target) { return target->key == key; });
    if (found == targets_.end()) {
        auto target = std::make_unique<Target>();
        target->key = key;
        const VkImageCreateFlags flags =
            key.sample_locations.empty()
                ? VkImageCreateFlags{0}
                : VkImageCreateFlags{VK_IMAGE_CREATE_SAMPLE_LOCATIONS_COMPATIBLE_DEPTH_BIT_EXT};
        auto depth =
            Image::create(*device_, depth_format(key.depth_format), {key.width, key.height}, key.samples, flags);
        if (!depth) {
            return fail(depth.error());
        }
        target->depth = std::move(*depth);
        targets_.push_back(std::move(target));
        found = std::prev(targets_.end());
    }
    Target& target = **found;
    target.last_use = ++clock_;
    while (target.color.size() < color_count) {
        auto image = Image::create(*device_, kColorFormat, {key.width, key.height}, key.samples);
        if (!image) {
            return fail(image.error());
        }
        target.color.push_back(std::move(*image));
    }
    return &target;
}

void TargetCache::trim(VkDeviceSize limit) {
    std::sort(targets_.begin(), targets_.end(),
              [](const auto& a, const auto& b) { return a->last_use > b->last_use; });
    VkDeviceSize held = 0;
    const auto end = std::find_if(targets_.begin(), targets_.end(), [&](const auto& target) {
        held += target->memory_size();
        return held > limit;
    });
    targets_.erase(end, targets_.end());
}

}  // namespace vk_harness
