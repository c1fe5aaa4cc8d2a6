// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Sample locations of a case's choice (VK_EXT_sample_locations): the same for every pixel.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "vk_harness/device/api.hpp"

namespace vk_harness {

// In pixels, from sixteenths of a pixel; exact.
inline std::vector<VkSampleLocationEXT> sample_places(
    std::span<const std::array<uint8_t, 2>> sixteenths) {
    std::vector<VkSampleLocationEXT> places;
    for (const std::array<uint8_t, 2>& s : sixteenths) {
        places.push_back({static_cast<float>(s[0]) / 16.0F, static_cast<float>(s[1]) / 16.0F});
    }
    return places;
}

// `places` must outlive the result.
inline VkSampleLocationsInfoEXT sample_locations_info(
    const std::vector<VkSampleLocationEXT>& places) {
    VkSampleLocationsInfoEXT info = Typed{VK_STRUCTURE_TYPE_SAMPLE_LOCATIONS_INFO_EXT};
    // The bits' values are the counts.
    info.sampleLocationsPerPixel = static_cast<VkSampleCountFlagBits>(places.size());
    info.sampleLocationGridSize = {1, 1};
    info.sampleLocationsCount = static_cast<uint32_t>(places.size());
    info.pSampleLocations = places.data();
    return info;
}

}  // namespace vk_harness
