// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/fault/neighbour.hpp"

#include <optional>

#include "cases/model/derive.hpp"

namespace cases {

namespace {

bool take_state(ColorOutput& own, const ColorOutput& other, bool is_integer) {
    const std::optional<Blend> blend = is_integer ? std::nullopt : other.blend;
    const bool is_other = !(own.blend == blend) || own.write_mask != other.write_mask;
    own.blend = blend;
    own.write_mask = other.write_mask;
    return is_other;
}

bool take_color(ColorOutput& own, const ColorOutput& other) {
    const bool is_other = own.attribute != other.attribute || !(own.value == other.value);
    own.attribute = other.attribute;
    own.value = other.value;
    return is_other;
}

}  // namespace

bool take_from(Case& c, uint32_t location, Taken taken) {
    const ColorTarget other = c.target.color_at(location);
    const bool writes_integers = is_integer(c.target.color->format);
    const bool is_of_class = writes_integers == is_integer(other.format);
    if (taken != Taken::state && !is_of_class) {
        return false;
    }
    bool is_changed = false;
    for (Draw& draw : c.draws) {
        const ColorOutput output = output_at(c.target, draw, location);
        if (taken == Taken::state || taken == Taken::all) {
            is_changed = take_state(draw.color, output, writes_integers) || is_changed;
        }
        if (taken == Taken::color || taken == Taken::all) {
            is_changed = take_color(draw.color, output) || is_changed;
        }
    }
    if (taken == Taken::clear || taken == Taken::all) {
        is_changed = is_changed || !(c.target.color->clear == other.clear);
        c.target.color->clear = other.clear;
    }
    return is_changed;
}

}  // namespace cases
