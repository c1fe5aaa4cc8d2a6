// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What may be stored of a value, answered in binary64. Nothing is approximate here. The numbers of
// a floating-point format are binary64 numbers, and so are their neighbours: comparisons with them
// are exact. For a fixed-point format one product is rounded and compared with a whole number that
// binary64 holds; rounding keeps the order, so that a rounded product on one side of the whole
// number lies there before it is rounded, too. Only equality does not tell.
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>

#include "ref/color/component.hpp"

namespace ref::color {

namespace {

using cases::ComponentKind;

double half_of(uint32_t code) {
    return static_cast<double>(glm::unpackHalf1x16(static_cast<uint16_t>(code)));
}

// The next half above a finite one; infinity above the largest.
double above_half(uint32_t code) {
    if ((code & 0x7fffU) == 0) {
        return half_of(1);
    }
    return half_of((code & 0x8000U) == 0 ? code + 1 : code - 1);
}

double above_float(float value) {
    return static_cast<double>(std::nextafter(value, std::numeric_limits<float>::infinity()));
}

// A number of a floating-point format with its neighbours, infinite beyond the largest numbers. It
// is stored of what lies between these: down(low) <= value says that no number of the format above
// the value is <= low. Beyond the largest number Component::down and up return that number, or x
// itself in infinity's place: then, too, the comparison with an infinite neighbour says the same.
bool is_stored(double low, double high, double below, double above) {
    return low < above && high > below;
}

}  // namespace

double Component::number(uint32_t code) const {
    switch (format_.kind) {
        case ComponentKind::unorm:
            return code / (std::ldexp(1.0, static_cast<int>(format_.bits)) - 1);
        case ComponentKind::half:
            return half_of(code);
        case ComponentKind::binary32:
            return static_cast<double>(std::bit_cast<float>(code));
        case ComponentKind::uint:
            return code;
        case ComponentKind::srgb:
            break;
    }
    mpq_class value;  // its table
    value_of(code, value);
    return value.get_d();
}

std::optional<bool> Component::may_store(double low, double high, uint32_t code,
                                         cases::Profile profile) const {
    if (std::isinf(low)) {
        return true;
    }
    switch (format_.kind) {
        case ComponentKind::unorm: {
            // The code c may be stored if floor(units low) <= c <= ceil(units high), that is
            // units low < c + 1 and units high > c - 1; with a slack of 3/5 of a unit if
            // 5 units low <= 5 c + 3 and 5 units high >= 5 c - 3.
            const bool has_slack = profile == cases::Profile::direct3d;
            const double times = has_slack ? 5 : 1;
            const double slack = has_slack ? 3 : 1;
            const double scale = times * (std::ldexp(1.0, static_cast<int>(format_.bits)) - 1);
            const double least = std::clamp(low, 0.0, 1.0) * scale;
            const double most = std::clamp(high, 0.0, 1.0) * scale;
            const double above = times * code + slack;
            const double below = times * code - slack;
            if (least < above && most > below) {
                return true;
            }
            if (least > above || most < below) {
                return false;
            }
            return std::nullopt;
        }
        case ComponentKind::half:
            if ((code & 0x7c00U) == 0x7c00U) {
                return code == 0x7c00U   ? high > half_of(0x7bffU)
                       : code == 0xfc00U ? low < half_of(0xfbffU)
                                         : false;
            }
            return is_stored(low, high, -above_half(code ^ 0x8000U), above_half(code));
        case ComponentKind::binary32: {
            const auto value = std::bit_cast<float>(code);
            if (!std::isfinite(value)) {
                const auto largest = static_cast<double>(std::numeric_limits<float>::max());
                return std::isnan(value) ? false : value > 0 ? high > largest : low < -largest;
            }
            return is_stored(low, high, -above_float(-value), above_float(value));
        }
        case ComponentKind::uint:
            return low <= code && high >= code;
        case ComponentKind::srgb:
            break;
    }
    return std::nullopt;
}

}  // namespace ref::color
