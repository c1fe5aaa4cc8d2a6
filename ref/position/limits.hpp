// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "cases/model/sample.hpp"

namespace ref {

// What the reference has to know of the device it judges.
struct Limits {
    int subpixel_bits = 8;              // VkPhysicalDeviceLimits::subPixelPrecisionBits, 4..16
    int interpolation_offset_bits = 4;  // subPixelInterpolationOffsetBits, at least 4
    int mipmap_bits = 4;                // mipmapPrecisionBits, at least 4
    int viewport_bits = 0;              // viewportSubPixelBits, 0..16
    // triStripVertexOrderIndependentOfProvokingVertex: barycentrics of an odd triangle of a strip
    // have the vertex order of the first vertex convention with the last one, too.
    bool first_strip_order = false;
    // VkPhysicalDeviceConservativeRasterizationPropertiesEXT, pixels: primitiveOverestimationSize,
    // extraPrimitiveOverestimationSizeGranularity; and degenerateTrianglesRasterized.
    float overestimation = 0, overestimation_step = 0;
    bool rasterizes_degenerates = true;
    // Without standardSampleLocations: what gl_SamplePosition says, one entry a sample count.
    std::vector<cases::SampleLocations> sample_locations = {};
    friend bool operator==(const Limits&, const Limits&) = default;
};

// Of a device of which only this is known; `sample_locations` as cases::parse_sample_locations
// takes them, none if it does not.
Limits limits_of(uint32_t subpixel_bits, std::string_view sample_locations);

// The case with the device's own sample locations; nothing if it has its own, or the standard ones.
std::optional<cases::Case> with_own_samples(const cases::Case& c, const Limits& limits);

}  // namespace ref
