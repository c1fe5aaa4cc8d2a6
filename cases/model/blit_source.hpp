// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the source of a blit holds, and clipping at the destination.
#pragma once

#include <string>
#include <vector>

#include "cases/model/case.hpp"

namespace cases {

// The source image, texel (x, y) at y * source_width + x. `unique`: no two texels have the same
// codes as long as the format has enough of them; every value is finite and representable, of
// floats whole numbers below 2^11. `ramp`: codes (floats: numbers) grow by the same step to the
// right, and by another downwards.
std::vector<TexelCodes> blit_source(const Blit& blit);

// A blit is clipped against the destination by adjusting its two rectangles. This is the part of it
// that falls on a destination of width x height texels, if whole numbers can describe it: the
// source corner moves by the same share of its side as the destination corner. If they cannot,
// `error` says why in one sentence.
struct ClippedBlit {
    Corners source, destination;
    std::string error;
};
ClippedBlit clip_to_destination(const Corners& source, const Corners& destination, uint32_t width,
                                uint32_t height);

}  // namespace cases
