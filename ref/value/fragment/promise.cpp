// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/fragment/promise.hpp"

#include <algorithm>
#include <cmath>

#include "ref/position/clip.hpp"
#include "ref/position/position.hpp"

namespace ref::value {

namespace {

// Above it a sum of a few, or a difference of two, overflows binary32; 1/w below is a denormal w.
constexpr double kLargest = 0x1p126;

// No profile asks for a number where binary32 has none (NaN and infinity "yield unspecified
// results", Vulkan, "Floating-Point Computation"): 1/w of a vertex (w = 0 has no value at all,
// a denormal w may be flushed to 0), z/w, f/w of a smooth value or f itself.
bool is_unpromised(const Primitive& primitive, const Quantity& q) {
    if (!has_plane(q)) {
        return false;
    }
    Triple<float> values{1, 1, 1};
    if (q.id.is_attribute()) {
        values = attribute_values(primitive, q.id.attribute, q.id.component);
    } else if (q.plane == kPlaneDepth) {
        values = {primitive.clip[0].z, primitive.clip[1].z, primitive.clip[2].z};
    }
    for (size_t i = 0; i < 3; ++i) {
        const double f = std::fabs(static_cast<double>(values[i]));
        const double w = std::fabs(static_cast<double>(primitive.clip[i].w));
        const bool is_divided = !q.id.is_attribute() || is_quotient(q);
        // Products with a power of two: exact.
        if (!std::isfinite(f) || w * kLargest < 1 || f > kLargest ||
            (is_divided && f > w * kLargest)) {
            return true;
        }
    }
    return false;
}

// Vulkan guarantees magnitudes up to 2^32 only ("Floating-Point Computation").
constexpr double kGuaranteed = 0x1p32;

// Whether 1/w or a quotient by w of a vertex that a device may use is beyond it.
bool is_position_beyond(const Primitive& primitive) {
    if (!std::all_of(primitive.clip.begin(), primitive.clip.end(), [](const glm::vec4& v) {
            return is_representable(v, cases::Profile::vulkan) &&
                   is_in_guaranteed_range(v, cases::Profile::vulkan);
        })) {
        return true;
    }
    if (!primitive.needs_clipping) {
        return false;
    }
    const auto polygon =
        clip_triangle({*primitive.draw, primitive.triangle.vertex}, primitive.draw->viewport,
                      cases::Profile::vulkan, clip_volume_of(*primitive.draw).all());
    return std::any_of(polygon.begin(), polygon.end(), [](const ClippedVertex& v) {
        return v.clip[3] * mpq_class(kGuaranteed) < 1;
    });
}

// Whether an attribute f, or f/w if the quantity is a quotient, is beyond it.
bool is_attribute_beyond(const Primitive& primitive, const Quantity& q) {
    const auto values = attribute_values(primitive, q.id.attribute, q.id.component);
    for (size_t i = 0; i < 3; ++i) {
        const double f = std::fabs(static_cast<double>(values[i]));
        const double w = std::fabs(static_cast<double>(primitive.clip[i].w));
        if (f > kGuaranteed || (is_quotient(q) && w > 0 && f > kGuaranteed * w)) {
            return true;
        }
    }
    return false;
}

}  // namespace

std::vector<Promise> promises_of(const Primitive& primitive, std::span<const Quantity> quantities) {
    const bool is_everything = is_position_beyond(primitive);
    std::vector<Promise> out;
    for (const Quantity& q : quantities) {
        const bool is_numeric = has_plane(q);
        const bool is_beyond =
            is_numeric &&
            (is_everything || (q.id.is_attribute() && is_attribute_beyond(primitive, q)));
        out.push_back({!is_unpromised(primitive, q), !(is_numeric && is_beyond)});
    }
    return out;
}

}  // namespace ref::value
