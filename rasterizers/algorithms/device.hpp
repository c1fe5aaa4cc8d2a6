// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Devices made of one scan and one way to interpolate, so that the suite can judge them. They snap
// to the nearest 1/256 pixel, draw triangles that reach beyond the viewport whole (a guard band of
// 2^21 pixels) and cut nothing else.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/model/case.hpp"
#include "rasterizers/algorithms/interpolation.hpp"
#include "rasterizers/algorithms/raster.hpp"
#include "ref/value/reference.hpp"

namespace rasterizers {

struct Device {
    std::string_view name;
    std::string_view description;  // for help
    Scan scan = nullptr;
    float (*linear)(const Areas&, const Values&) = nullptr;
    // Perspective: Brown's products of w, as they are or block-normalised to this many bits; or
    // the quotient of two linear interpolations (equation 4) if 0.
    bool has_w_products = false;
    int w_bits = 0;
};
std::span<const Device> all_devices();
const Device* find_device(std::string_view name);

// Why the case cannot be drawn by such a device, one sentence; empty if it can.
std::string unsupported_reason(const cases::Case& c);

struct DrawnSample {
    uint32_t front = 0, back = 0;  // hits
    cases::Triangle last;          // the triangle that wrote last, if there were hits
    ref::FragmentValues values;
};

// Samples as in a capture, [(j * width + i) * samples + s]. Only for cases without an
// unsupported_reason().
std::vector<DrawnSample> draw(const cases::Case& c, const Device& device);

}  // namespace rasterizers
