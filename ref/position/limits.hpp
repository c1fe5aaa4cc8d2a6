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
    // The depth that shares an image with a stencil, where a case names none: what D32S8 holds, or
    // what D24S8 holds of a device that has no other.
    cases::DepthFormat beside_stencil = cases::DepthFormat::d32_float;
    friend bool operator==(const Limits&, const Limits&) = default;
};

// Limits::beside_stencil of the word "d24-unorm", or of any other.
cases::DepthFormat depth_beside_stencil(std::string_view word);

// Of a device of which only this is known; `sample_locations` as cases::parse_sample_locations
// takes them, none if it does not; `beside_stencil` as depth_beside_stencil takes it. Of the bits
// those that are judged (cases::judged_subpixel_bits).
Limits limits_of(uint32_t subpixel_bits, std::string_view sample_locations,
                 std::string_view beside_stencil = {});

// The case as the device draws it: with its own sample locations, if it does not have the standard
// ones, and its own depth beside a stencil. Nothing if it draws the case as it is.
std::optional<cases::Case> as_drawn(const cases::Case& c, const Limits& limits);

}  // namespace ref
