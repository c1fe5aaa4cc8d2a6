// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/color/component_filter.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>

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

std::optional<bool> may_store(const Component& component, double low, double high, uint32_t code,
                              cases::Profile profile) {
    if (std::isinf(low)) {
        return true;
    }
    switch (component.kind()) {
        case ComponentKind::unorm:
        case ComponentKind::snorm: {
            // The code c may be stored if floor(units low) <= c <= ceil(units high), that is
            // units low < c + 1 and units high > c - 1; with a slack of 3/5 of a unit if
            // 5 units low <= 5 c + 3 and 5 units high >= 5 c - 3.
            const bool has_slack = profile == cases::Profile::direct3d;
            const double times = has_slack ? 5 : 1;
            const double slack = has_slack ? 3 : 1;
            const bool is_signed = component.kind() == ComponentKind::snorm;
            const auto bits = static_cast<int>(component.bits());
            const double whole = component.whole_of(code);
            const double scale = times * (std::ldexp(1.0, is_signed ? bits - 1 : bits) - 1);
            const double least = std::clamp(low, is_signed ? -1.0 : 0.0, 1.0) * scale;
            const double most = std::clamp(high, is_signed ? -1.0 : 0.0, 1.0) * scale;
            const double above = times * whole + slack;
            const double below = times * whole - slack;
            if (least < above && most > below) {
                return true;
            }
            if (least > above || most < below) {
                return false;
            }
            return std::nullopt;
        }
        case ComponentKind::half:
            if (component.bits() < 16) {
                return std::nullopt;
            }
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
        case ComponentKind::sint:
            return low <= component.whole_of(code) && high >= component.whole_of(code);
        case ComponentKind::srgb:
            break;
    }
    return std::nullopt;
}

}  // namespace ref::color
