// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Colours in the device's memory: formats, and conversion of a component to its code and back, as
// drivers do it: binary32 and integers, no exact numbers.
#pragma once

#include <array>
#include <cstdint>

#include "cases/format/color_format.hpp"
#include "cases/model/case.hpp"
#include "rasterizers/software/choice/device.hpp"

namespace software {

using Number = cases::ComponentKind;

struct Channel {
    Number number = Number::unorm;
    uint32_t bits = 0;  // 0: the format has no such component
};

struct FormatLayout {
    std::array<Channel, 4> channels;  // red, green, blue, alpha
    std::array<uint8_t, 4> position;  // of each in memory: BGRA starts with blue
};
FormatLayout layout_of(cases::ColorFormat format);

// The codes of a texel in the order of memory.
using Texel = std::array<uint32_t, 4>;

// The code of a number. UNORM and sRGB: clamped to [0, 1], SNORM to [-1, 1], NaN is 0.
uint32_t store_channel(float v, Channel channel, const Device& device);
// What a code means.
float load_channel(uint32_t code, Channel channel, const Device& device);

// binary16 and back. Overflow: infinity, or the largest number if the device rounds towards zero.
uint16_t to_half(float v, const Device& device);
float from_half(uint16_t bits);

}  // namespace software
