// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Coverage of one snapped triangle: edge functions with a fill-rule bias over 8x8 tiles.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "rasterizers/software/choice/device.hpp"
#include "rasterizers/software/planes.hpp"

namespace software {

// Half-open rectangle of pixels.
struct PixelRect {
    int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// A sample's place in its pixel, in units of 2^-subpixel_bits pixel.
struct SampleOffset {
    int64_t x = 0, y = 0;
};

// The target's own locations or the standard ones (Vulkan, "Standard sample locations"), as the
// device places them.
std::vector<SampleOffset> sample_offsets(const cases::Target& target, const Device& device);

// Which triangle to scan; vertices clockwise on screen unless a fault says otherwise.
struct ScanTriangle {
    std::array<WindowVertex, 3> v;
    std::array<bool, 3> inner{};  // edge k -> k+1 is a diagonal that the clipper introduced
    bool reversed = false;        // the vertices were exchanged to make them clockwise
};

// Twice the area in units of 2^-2bits pixel; positive is clockwise on screen.
int64_t twice_area(std::span<const WindowVertex> v);

// Calls emit(i, j, sample) for each covered sample inside the rectangle.
void scan(const ScanTriangle& triangle, const PixelRect& rect,
          std::span<const SampleOffset> samples, const Device& device,
          const std::function<void(int64_t, int64_t, uint32_t)>& emit);

}  // namespace software
