// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "memory_map.hpp"

#include <cstddef>
#include <cstring>
#include <iterator>
#include <map>
#include <mutex>
#include <set>

namespace breaking {

namespace {

// Handles may be used again: what is noted last counts.
struct Map {
    struct Contents {
        std::map<VkDeviceSize, VkBuffer> buffers;
        std::map<VkImage, VkDeviceSize> images;
    };
    std::mutex mutex;
    std::map<VkBuffer, VkDeviceSize> sizes;
    std::set<VkBuffer> imported;
    std::map<VkImageView, VkImage> images;
    std::map<VkImage, ImageFacts> facts;
    std::map<VkDeviceMemory, Contents> memories;
    std::map<VkImage, VkDeviceMemory> memory_of;
    std::map<VkBuffer, std::pair<VkDeviceMemory, VkDeviceSize>> place_of;
    std::map<VkDeviceMemory, const std::byte*> mapped;  // byte 0
};

Map& map() {
    static Map the_map;
    return the_map;
}

}  // namespace

void note_buffer(VkBuffer buffer, const VkBufferCreateInfo& info) {
    const std::lock_guard lock(map().mutex);
    map().sizes[buffer] = info.size;
    const auto* chained = static_cast<const VkBaseInStructure*>(info.pNext);
    if (chained != nullptr &&
        chained->sType == VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_BUFFER_CREATE_INFO) {
        map().imported.insert(buffer);
    } else {
        map().imported.erase(buffer);
    }
}

bool is_imported(VkBuffer buffer) {
    const std::lock_guard lock(map().mutex);
    return map().imported.contains(buffer);
}

void note_view(VkImageView view, VkImage image) {
    const std::lock_guard lock(map().mutex);
    map().images[view] = image;
}

void note_binding(VkBuffer buffer, VkDeviceMemory memory, VkDeviceSize offset) {
    const std::lock_guard lock(map().mutex);
    map().memories[memory].buffers[offset] = buffer;
    map().place_of[buffer] = {memory, offset};
}

void note_binding(VkImage image, VkDeviceMemory memory, VkDeviceSize offset) {
    const std::lock_guard lock(map().mutex);
    std::map<VkImage, VkDeviceSize>& images = map().memories[memory].images;
    for (const auto& [other, place] : images) {
        if (other != image && place == offset) {
            map().facts[image].is_aliased = map().facts[other].is_aliased = true;
        }
    }
    images[image] = offset;
    map().memory_of[image] = memory;
}

void forget_memory(VkDeviceMemory memory) {
    const std::lock_guard lock(map().mutex);
    map().memories.erase(memory);
    map().mapped.erase(memory);
}

void note_image(VkImage image, const VkImageCreateInfo& info) {
    const std::lock_guard lock(map().mutex);
    map().facts[image] = {info.extent, info.mipLevels, info.usage,  false,
                          info.tiling, false,          info.samples};
}

void note_dedicated(VkImage image) {
    const std::lock_guard lock(map().mutex);
    map().facts[image].is_dedicated = true;
}

ImageFacts facts_of(VkImage image) {
    const std::lock_guard lock(map().mutex);
    return map().facts[image];
}

ImageFacts facts_of(VkImageView view) {
    const std::lock_guard lock(map().mutex);
    return map().facts[map().images[view]];
}

void note_map(VkDeviceMemory memory, VkDeviceSize offset, void* data) {
    const std::lock_guard lock(map().mutex);
    map().mapped[memory] = static_cast<const std::byte*>(data) - offset;
}

std::optional<uint32_t> word_at(VkBuffer buffer, VkDeviceSize offset) {
    const std::lock_guard lock(map().mutex);
    const auto place = map().place_of.find(buffer);
    if (place == map().place_of.end() || offset + sizeof(uint32_t) > map().sizes[buffer]) {
        return std::nullopt;
    }
    const auto mapped = map().mapped.find(place->second.first);
    if (mapped == map().mapped.end()) {
        return std::nullopt;
    }
    uint32_t word = 0;
    std::memcpy(&word, mapped->second + place->second.second + offset, sizeof word);
    return word;
}

Neighbours neighbours_of(VkImageView view) {
    const std::lock_guard lock(map().mutex);
    const VkImage image = map().images[view];
    const Map::Contents& contents = map().memories[map().memory_of[image]];
    const auto place = contents.images.find(image);
    if (place == contents.images.end()) {
        return {};
    }
    Neighbours out;
    const auto after = contents.buffers.upper_bound(place->second);
    if (after != contents.buffers.end()) {
        out.after = {after->second, map().sizes[after->second]};
    }
    if (after != contents.buffers.begin()) {
        const VkBuffer before = std::prev(after)->second;
        out.before = {before, map().sizes[before]};
    }
    return out;
}

}  // namespace breaking
