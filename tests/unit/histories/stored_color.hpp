// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a fragment makes of the colour that is stored, by the text of Vulkan's chapter "The
// Framebuffer", in binary64. Exact for the numbers of scenes, or within is_near of what is.
#pragma once

#include <array>
#include <cstdint>

#include "scene.hpp"

namespace histories {

using Codes = std::array<uint32_t, 4>;

Codes clear_codes(const ColorTarget& target);
Codes written(const ColorFormat& format, const Codes& stored, const Draw& draw,
              const ColorState& state);
// Whether a number is so large that binary16 may not hold what comes of it.
bool is_color_large(const ColorFormat& format, const Codes& codes);
// Whether codes are so near that nobody should tell wrong from right by them: numbers less than
// 1/16 or a few codes apart, integers that are equal.
bool is_near(const ColorFormat& format, const Codes& a, const Codes& b);

}  // namespace histories
