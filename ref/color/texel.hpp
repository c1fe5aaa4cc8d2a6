// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Stored codes and the numbers they stand for, in rationals. [Vulkan, fundamentals-fixedconv,
// fundamentals-fp-conversion; Khronos Data Format, sRGB transfer functions]
#pragma once

#include <gmpxx.h>

#include <cstdint>

#include "cases/load/color.hpp"

namespace ref {

// lo <= hi.
struct RationalInterval {
    mpq_class lo, hi;
};

// The number of a stored code: a point, except for sRGB, whose curve is irrational: there what
// half a code more or less stands for (Direct3D allows 0.5 of a code, 3.2.3; Vulkan names no
// bound), computed in binary64 and moved outwards by 2^-40.
RationalInterval number_of(uint32_t code, const cases::ComponentFormat& format);

// False for the codes of NaN and infinity.
bool is_number(uint32_t code, const cases::ComponentFormat& format);

// True if a device may store `code` for some number of the interval. UNORM and sRGB: either
// neighbouring code, exactly representable ones themselves, [0, 1] after clamping. Floats: either
// neighbour. (Direct3D's 0.6 of a code is a rule of its own stores; it has no blit.)
bool may_store(uint32_t code, const RationalInterval& number, const cases::ComponentFormat& format);

// The code nearest to a number, halves upwards.
uint32_t nearest_code(const mpq_class& number, const cases::ComponentFormat& format);

// The number of one unit of the last place at 1: 1 / (2^bits - 1) for UNORM and sRGB, 0 for others.
mpq_class code_step(const cases::ComponentFormat& format);

}  // namespace ref
