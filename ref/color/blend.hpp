// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a colour target may hold after a fragment: what the shader wrote, converted
// (ref/color/component.hpp) and blended with what was there.
//
// Blending ("Blending"): "as if carried out in floating-point", "with a precision and dynamic range
// no lower than that used to represent destination components". So every intermediate (source,
// factor, product, sum) may be rounded to either neighbour in the destination's format, or not at
// all; what the format holds exactly stays exact, which covers factors 0 and 1 and sums that are
// representable. What an sRGB target holds is decoded first (Component::read). The computation may
// be done in another order (blend_order.hpp), of which then stays exact what is exact in both. With
// fixed-point targets that is within what neighbours allow (UNORM), or done in binary32 (sRGB);
// source, destination, constants, factors and the result are clamped to [0, 1], with SNORM to
// [-1, 1]. An unsigned float may lose what is negative wherever it is rounded.
//
// Logical operations (ref/color/logic.hpp) take the place of blending.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "cases/model/case.hpp"
#include "ref/color/component.hpp"

namespace ref::color {

using Color = std::array<Interval, 4>;  // red, green, blue, alpha

// Whether alpha to one ("Multisample Coverage") replaces the alpha that the shader wrote: the one
// of location 0 and index 0, and not that of a second source.
bool replaces_alpha(const cases::ColorOutput& output, cases::ColorFormat format);

// Computes the target's colour after one fragment; integer formats are not blended.
struct Unit {
    cases::ColorFormat format;
    cases::Profile profile;
    // `written`: by the shader; `before`: what the target held.
    Color write(const cases::ColorOutput& output, const Color& written, const Color& before) const;
    // Is the target's colour after a clear.
    Color cleared(const cases::ColorTarget& target) const;
    // Codes in the middle of what is allowed.
    std::array<uint32_t, 4> codes_of(const Color& color) const;
    bool allows(const Color& color, const std::array<uint32_t, 4>& codes) const;
    // "r 127 to 128, g 0, b 0, a 255"
    std::string text_of(const Color& color) const;
    std::string text_of(const std::array<uint32_t, 4>& codes) const;
    // ColorVerdict::may_overflow of such a colour, and whether a component is no finite number.
    bool may_overflow(const Color& color) const;
    bool has_overflown(const std::array<uint32_t, 4>& codes) const;
};

}  // namespace ref::color
