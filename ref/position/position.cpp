// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The binary32 error of divide and viewport transform, u = 2^-24. A device may compute
//
//     r   = 1/w             1 ulp, that is 2u relative (D3D 11.3, 3.1.3.2: divide as x * (1/y))
//     x_d = x * r           3u
//     t   = x_d * (p/2)     4u          p/2 is exact
//     o   = x_v + p/2       u |o|       or u (|o| + 1/2), where the half pixel of the conversion to
//     x_f = t + o           u |x_f|     subpixels is folded into o
//     x_f - 1/2             u (|x_f| + 1/2)
//
// so |error| <= u (4|t| + |o| + 2|x_f| + 1) to first order. A fused multiply-add only drops a step.
// The products of two (1+u) are covered by the factor 1 + 8u: the longest chain has 4 + 1 + 1
// roundings, and (1+u)^6 - 1 <= 6u (1 + 3u) for this u. Results below 2^-126 may be flushed to
// zero, each step at most 2^-126 times the factors that follow; 2^-120 (1 + |p/2|) (1 + |x|) covers
// them.
#include "ref/position/position.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "ref/number/rational.hpp"
#include "ref/position/position_detail.hpp"
#include "ref/position/position_filter.hpp"
#include "ref/position/viewport_grid.hpp"

namespace ref {

namespace {

struct Axis {
    mpq_class half;    // p/2
    mpq_class offset;  // o
    float origin = 0, extent = 0;
};

Axis axis_of(float origin, float extent) {
    const mpq_class half = rational(extent) / 2;
    return {half, rational(origin) + half, origin, extent};
}

Axis axis_x(const cases::Viewport& v) {
    return axis_of(v.x, v.width);
}

Axis axis_y(const cases::Viewport& v) {
    return axis_of(v.y, v.height);
}

// True for zero and for numbers that are a normal binary32.
bool is_normal_binary32(double d) {
    const auto f = static_cast<float>(d);
    return !(std::fabs(d) > 0) || (std::isnormal(f) && !(std::fabs(double{f} - d) > 0));
}

// a + b, and whether it is exact in binary64 (Knuth's TwoSum: the rest is computed without error).
bool add_exactly(double a, double b, double& sum) {
    sum = a + b;
    const double b_used = sum - a;
    const double rest = (a - (sum - b_used)) + (b - b_used);
    return !(std::fabs(rest) > 0);
}

// Of a coordinate whose transform is not exact.
mpq_class axis_error(float c, float w, const Axis& axis) {
    const mpq_class t = rational(c) / rational(w) * axis.half;
    mpq_class error = rounding_bound<mpq_class>(t, axis.offset, t + axis.offset, power_of_two(-24));
    error += power_of_two(-120) * (1 + abs(axis.half)) * (1 + abs(rational(c)));
    if (std::abs(w) > 0x1p125F) {
        error += abs(t);  // 1/w is subnormal and may be flushed to zero
    }
    return error;
}

// What profile vulkan adds to the error of a coordinate before it is snapped: the operations above
// with about 1 part in 10^5 each (Vulkan, "Floating-Point Computation").
mpq_class vulkan_slack(const mpq_class& ideal, const Axis& axis, const Limits& limits,
                       cases::Profile profile) {
    if (profile != cases::Profile::vulkan) {
        return 0;
    }
    const mpq_class slack =
        rounding_bound<mpq_class>(ideal - axis.offset, axis.offset, ideal, mpq_class(1, 100000));
    // The viewport may move by less than a step of its grid (ref/position/viewport_grid.hpp).
    return is_on_viewport_grid(axis.origin, axis.extent, limits.viewport_bits)
               ? slack
               : mpq_class(slack + power_of_two(-limits.viewport_bits));
}

FixedRange axis_box(const mpq_class& ideal, const mpq_class& error, const Axis& axis,
                    const Limits& limits, cases::Profile profile) {
    const mpq_class scale = power_of_two(limits.subpixel_bits);
    const int64_t unit = int64_t{1} << (kFixedBits - limits.subpixel_bits);
    if (profile == cases::Profile::direct3d) {
        // D3D 11.3, 3.2.4.1: 0.6 units of the last place of the result.
        const mpq_class reach = error * scale + mpq_class(3, 5);
        const mpq_class v = ideal * scale;
        return {ceil_of(v - reach).get_si() * unit, floor_of(v + reach).get_si() * unit};
    }
    const mpq_class reach = error + vulkan_slack(ideal, axis, limits, profile);
    return {floor_of((ideal - reach) * scale).get_si() * unit,
            ceil_of((ideal + reach) * scale).get_si() * unit};
}

// The same for a point of an edge that a device may cut and snap elsewhere: all positions within
// the snapping error, off the grid too.
FixedRange axis_crossing(const mpq_class& ideal, const mpq_class& error, const Axis& axis,
                         const Limits& limits, cases::Profile profile) {
    const mpq_class units = profile == cases::Profile::direct3d ? mpq_class(3, 5) : mpq_class(1);
    const mpq_class reach = error + units * power_of_two(-limits.subpixel_bits) +
                            vulkan_slack(ideal, axis, limits, profile);
    return {floor_of((ideal - reach) * kFixedOne).get_si(),
            ceil_of((ideal + reach) * kFixedOne).get_si()};
}

// The box whose coordinates `range_of` gives: one of the two above.
template <class RangeOf>
std::optional<Box> box_by(RangeOf range_of, const mpq_class& x, const mpq_class& y,
                          const TransformError& error, const cases::Viewport& viewport,
                          const Limits& limits, cases::Profile profile) {
    const mpq_class limit = power_of_two(32);
    if (abs(x) > limit || abs(y) > limit || error.x > limit || error.y > limit) {
        return std::nullopt;
    }
    const FixedRange across = range_of(x, error.x, axis_x(viewport), limits, profile);
    const FixedRange down = range_of(y, error.y, axis_y(viewport), limits, profile);
    return Box{across.low, down.low, across.high, down.high};
}

}  // namespace

bool is_power_of_two(float w) {
    const auto bits = std::bit_cast<uint32_t>(w);
    const uint32_t exponent = bits >> 23U & 0xffU;
    return (bits & 0x007fffffU) == 0 && exponent > 1 && exponent < 253;
}

// Answered in binary64, where each step is exact or known not to be.
bool is_transform_exact(float c, float w, float origin, float extent) {
    if (!is_power_of_two(w)) {
        return false;
    }
    const double normalized = double{c} / double{w};  // exact: w is a power of two
    const double half = double{extent} / 2;
    if (!is_normal_binary32(normalized) || !is_normal_binary32(half)) {
        return false;
    }
    const double t = normalized * half;  // exact: 24 bits by 24 bits
    double offset = 0;
    double x_f = 0;
    double offset_rest = 0;
    double x_rest = 0;
    return add_exactly(double{origin}, half, offset) && add_exactly(t, offset, x_f) &&
           add_exactly(offset, -0.5, offset_rest) && add_exactly(x_f, -0.5, x_rest) &&
           is_normal_binary32(t) && is_normal_binary32(offset) && is_normal_binary32(x_f) &&
           is_normal_binary32(offset_rest) && is_normal_binary32(x_rest);
}

IdealPosition ideal_position(const glm::vec4& clip, const cases::Viewport& viewport) {
    const mpq_class w = rational(clip.w);
    const Axis x = axis_x(viewport);
    const Axis y = axis_y(viewport);
    IdealPosition out;
    out.inv_w = 1 / w;
    out.x = x.half * rational(clip.x) / w + x.offset;
    out.y = y.half * rational(clip.y) / w + y.offset;
    const mpq_class range = rational(viewport.max_depth) - rational(viewport.min_depth);
    out.z = range * rational(clip.z) / w + rational(viewport.min_depth);
    return out;
}

bool is_projectable(const glm::vec4& clip) {
    return std::isfinite(clip.x) && std::isfinite(clip.y) && std::isfinite(clip.z) &&
           std::isfinite(clip.w) && clip.w > 0;
}

bool is_representable(const glm::vec4& clip, cases::Profile profile) {
    const float limit =
        profile == cases::Profile::vulkan ? 0x1p32F : std::numeric_limits<float>::max() / 16;
    const auto is_within = [limit](float c) { return std::fabs(c) <= limit; };  // false for NaN
    return is_within(clip.x) && is_within(clip.y) && is_within(clip.z) && is_within(clip.w);
}

bool is_in_guaranteed_range(const glm::vec4& clip, cases::Profile profile) {
    // |c| <= 2^32 |w|; a binary64 holds the product exactly.
    const double bound = 0x1p32 * std::abs(static_cast<double>(clip.w));
    if (profile != cases::Profile::vulkan || !(bound > 0)) {
        return true;
    }
    return bound >= 1 && std::abs(static_cast<double>(clip.x)) <= bound &&
           std::abs(static_cast<double>(clip.y)) <= bound &&
           std::abs(static_cast<double>(clip.z)) <= bound;
}

TransformError transform_error(const glm::vec4& clip, const cases::Viewport& viewport) {
    TransformError error;  // zero
    if (!is_transform_exact(clip.x, clip.w, viewport.x, viewport.width)) {
        error.x = axis_error(clip.x, clip.w, axis_x(viewport));
    }
    if (!is_transform_exact(clip.y, clip.w, viewport.y, viewport.height)) {
        error.y = axis_error(clip.y, clip.w, axis_y(viewport));
    }
    return error;
}

std::optional<Box> box_around(const mpq_class& x, const mpq_class& y, const TransformError& error,
                              const cases::Viewport& viewport, const Limits& limits,
                              cases::Profile profile) {
    return box_by(axis_box, x, y, error, viewport, limits, profile);
}

std::optional<Box> box_around_crossing(const mpq_class& x, const mpq_class& y,
                                       const TransformError& error, const cases::Viewport& viewport,
                                       const Limits& limits, cases::Profile profile) {
    return box_by(axis_crossing, x, y, error, viewport, limits, profile);
}

std::optional<Box> position_box(const glm::vec4& clip, const cases::Viewport& viewport,
                                const Limits& limits, cases::Profile profile) {
    // A subnormal w may be flushed to zero, and 1/w then is anything.
    if (!is_projectable(clip) || clip.w < 0x1p-126F) {
        return std::nullopt;
    }
    if (!is_in_guaranteed_range(clip, profile)) {
        return std::nullopt;
    }
    const auto x = filtered_range(clip.x, clip.w, viewport.x, viewport.width, limits, profile);
    const auto y = filtered_range(clip.y, clip.w, viewport.y, viewport.height, limits, profile);
    if (x && y) {
        return Box{x->low, y->low, x->high, y->high};
    }
    return exact_position_box(clip, viewport, limits, profile);
}

std::optional<Box> exact_position_box(const glm::vec4& clip, const cases::Viewport& viewport,
                                      const Limits& limits, cases::Profile profile) {
    const IdealPosition ideal = ideal_position(clip, viewport);
    return box_around(ideal.x, ideal.y, transform_error(clip, viewport), viewport, limits, profile);
}

std::optional<FixedPoint> snap_nearest(const glm::vec4& clip, const cases::Viewport& viewport,
                                       const Limits& limits) {
    if (!is_projectable(clip)) {
        return std::nullopt;
    }
    const auto x = filtered_nearest(clip.x, clip.w, viewport.x, viewport.width, limits);
    const auto y = filtered_nearest(clip.y, clip.w, viewport.y, viewport.height, limits);
    return x && y ? FixedPoint{*x, *y} : exact_snap_nearest(clip, viewport, limits);
}

std::optional<FixedPoint> exact_snap_nearest(const glm::vec4& clip, const cases::Viewport& viewport,
                                             const Limits& limits) {
    const IdealPosition ideal = ideal_position(clip, viewport);
    const mpq_class limit = power_of_two(32);
    if (abs(ideal.x) > limit || abs(ideal.y) > limit) {
        return std::nullopt;
    }
    const auto snap = [&](const mpq_class& v) {
        const mpq_class scaled = v * power_of_two(limits.subpixel_bits);
        mpz_class n = floor_of(scaled);
        const mpq_class rest = scaled - n;
        const mpq_class half(1, 2);
        if (rest > half || (rest == half && mpz_odd_p(n.get_mpz_t()) != 0)) {
            n += 1;
        }
        return n.get_si() * (int64_t{1} << (kFixedBits - limits.subpixel_bits));
    };
    return FixedPoint{snap(ideal.x), snap(ideal.y)};
}

AreaRange area_range(const Box& a, const Box& b, const Box& c) {
    AreaRange out;
    bool is_first = true;
    for_each_choice(BoxCorners(a), BoxCorners(b), BoxCorners(c),
                    [&](const auto& p, const auto& q, const auto& r) {
                        const Int128 area = edge_function(p, q, r);
                        out.low = is_first ? area : std::min(out.low, area);
                        out.high = is_first ? area : std::max(out.high, area);
                        is_first = false;
                    });
    return out;
}

}  // namespace ref
