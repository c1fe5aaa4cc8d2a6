// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Positions as the rasterizer holds them.
#pragma once

#include <cstdint>

#include "rasterizers/software/choice/device.hpp"

namespace software {

// The value with 11 significant bits, as a 16-bit float has.
float to_half_precision(float v);

// A window coordinate in units of 2^-subpixel_bits pixel.
int64_t to_fixed(float v, const Device& device);

}  // namespace software
