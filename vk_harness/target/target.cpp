// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/target/target.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace vk_harness {

VkDeviceSize attachment_bytes(const cases::Target& target,
                              const std::vector<Attachment>& attachments, const ImageWay& way) {
    // At most 16 bytes a sample and attachment; below 2^14 * 2^14 * 2^8 * 2^6 * 2^8 = 2^50.
    const VkDeviceSize bytes =
        std::accumulate(attachments.begin(), attachments.end(), VkDeviceSize{0},
                        [](VkDeviceSize sum, const Attachment& a) { return sum + a.sample_bytes; });
    const VkExtent2D whole = {target.width + way.more_columns, target.height + way.more_rows};
    return VkDeviceSize{whole.width} * whole.height * target.layers * target.samples * bytes;
}

TargetCache::Shelf& TargetCache::shelf(VkFormat format, const cases::Target& target,
                                       const ImageWay& way) {
    const auto found = std::ranges::find_if(shelves_, [&](const auto& s) {
        return s->format == format && s->width == target.width && s->height == target.height &&
               s->samples == target.samples && s->layers == target.layers &&
               s->sample_locations == target.sample_locations && s->way == way;
    });
    if (found != shelves_.end()) {
        return **found;
    }
    auto made = std::make_unique<Shelf>();
    made->format = format;
    made->width = target.width;
    made->height = target.height;
    made->samples = target.samples;
    made->layers = target.layers;
    made->sample_locations = target.sample_locations;
    made->way = way;
    shelves_.push_back(std::move(made));
    return *shelves_.back();
}

std::vector<const Image*> TargetCache::get(const cases::Target& target,
                                           const std::vector<Attachment>& attachments,
                                           const ImageWay& way, const ImageWay& resolved) {
    ++clock_;
    std::vector<const Image*> out;
    cases::Target single = target;  // what is resolved into
    single.samples = 1;
    single.sample_locations.clear();
    std::map<const Shelf*, size_t> taken;
    for (const Attachment& attachment : attachments) {
        if (attachment.is_beside_depth) {
            out.push_back(out.back());
            continue;
        }
        const cases::Target& shape = attachment.is_resolved() ? single : target;
        const ImageWay& part = attachment.is_resolved() ? resolved : way;
        Shelf& from = shelf(attachment.format, shape, part);
        from.last_use = clock_;
        const size_t nth = taken[&from]++;
        if (nth == from.images.size()) {
            const VkImageCreateFlags flags =
                attachment.is_depth_stencil() && !shape.sample_locations.empty()
                    ? VkImageCreateFlags{VK_IMAGE_CREATE_SAMPLE_LOCATIONS_COMPATIBLE_DEPTH_BIT_EXT}
                    : VkImageCreateFlags{0};
            auto image = Image::create(*device_, attachment.format, {target.width, target.height},
                                       shape.samples, shape.layers, flags, part);
            from.images.push_back(std::make_unique<Image>(std::move(image)));
        }
        out.push_back(from.images[nth].get());
    }
    return out;
}

void TargetCache::release(const Image* image) {
    for (const auto& shelf : shelves_) {
        std::erase_if(shelf->images, [image](const auto& held) { return held.get() == image; });
    }
}

void TargetCache::trim(VkDeviceSize limit) {
    std::ranges::sort(shelves_,
                      [](const auto& a, const auto& b) { return a->last_use > b->last_use; });
    VkDeviceSize held = 0;
    const auto end = std::ranges::find_if(shelves_, [&](const auto& s) {
        for (const auto& image : s->images) {
            held += image->memory_size();
        }
        return held > limit;
    });
    shelves_.erase(end, shelves_.end());
}

}  // namespace vk_harness
