// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Logical operations: what a component's code becomes of the source's and the stored one.
//
// Vulkan specification, "Logical Operations" (Table "Logical Operations"): applied "prior to
// updating the framebuffer attachment", so to the code into which the fragment's colour was
// converted (ref/color/component.hpp), "independently for each of the red, green, blue, and alpha
// components". "Logical operations are not applied to floating-point or sRGB format color
// attachments"; those "simply pass through the color values unmodified", and blending "is treated
// as if it were disabled" for all.
#pragma once

#include <cstdint>

#include "cases/model/color_state.hpp"
#include "ref/color/component.hpp"

namespace ref::color {

// Whether targets of this format have logical operations.
bool takes_logic(cases::ColorFormat format);

// The lowest `bits` bits of the operation; the others are 0.
uint32_t operated(cases::LogicOp op, uint32_t source, uint32_t before, uint32_t bits);

// The smallest interval that holds what may be left where the codes of two intervals of the
// component's values meet; [0, all bits] where there are more than 2^12 pairs of codes. Exact where
// both are decided; else it may hold codes that no pair leaves, which condemns nothing.
Interval operated(cases::LogicOp op, const Component& component, const Interval& source,
                  const Interval& before);

}  // namespace ref::color
