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

#include "ref/number/integer.hpp"
#include "ref/position/position_detail.hpp"
#include "ref/position/position_filter.hpp"

namespace ref {

namespace {

const mpq_class& power_of_two(int exponent) {
    static const std::vector<mpq_class> table = [] {
        std::vector<mpq_class> t(401);
        for (int e = -200; e <= 200; ++e) {
            mpq_class q = 1;
            if (e >= 0) {
                mpq_mul_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(e));
            } else {
                mpq_div_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(-e));
            }
            t[static_cast<size_t>(e + 200)] = q;
        }
        return t;
    }();
    return table[static_cast<size_t>(exponent + 200)];
}

mpq_class exact(float f) {
    return mpq_class(static_cast<double>(f));
}

// True for zero and for numbers that are a normal binary32.
bool is_normal_binary32(const mpq_class& q) {
    if (q == 0) {
        return true;
    }
    const auto f = static_cast<float>(q.get_d());
    return std::isnormal(f) && exact(f) == q;
}

// A power of two whose reciprocal is normal as well.
bool is_power_of_two(float w) {
    constexpr uint32_t kFractionBits = 0x007fffff;
    return (std::bit_cast<uint32_t>(w) & kFractionBits) == 0 && std::ilogb(w) > -126 &&
           std::ilogb(w) < 126;
}

struct Axis {
    mpq_class half;    // p/2
    mpq_class offset;  // o
};

Axis axis_x(const cases::Viewport& v) {
    const mpq_class half = exact(v.width) / 2;
    return {half, exact(v.x) + half};
}

Axis axis_y(const cases::Viewport& v) {
    const mpq_class half = exact(v.height) / 2;
    return {half, exact(v.y) + half};
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

mpq_class axis_error(float c, float w, const Axis& axis) {
    const mpq_class normalized = exact(c) / exact(w);
    const mpq_class t = normalized * axis.half;
    const mpq_class x_f = t + axis.offset;
    const mpq_class half(1, 2);
    if (is_power_of_two(w) && is_normal_binary32(normalized) && is_normal_binary32(axis.half) &&
        is_normal_binary32(t) && is_normal_binary32(axis.offset) &&
        is_normal_binary32(axis.offset - half) && is_normal_binary32(x_f) &&
        is_normal_binary32(x_f - half)) {
        return 0;
    }
    const mpq_class& u = power_of_two(-24);
    mpq_class error = rounding_bound(t, axis.offset, x_f, u);
    error += power_of_two(-120) * (1 + abs(axis.half)) * (1 + abs(exact(c)));
    if (std::abs(w) > 0x1p125F) {
        error += abs(t);  // 1/w is subnormal and may be flushed to zero
    }
    return error;
}

bool is_integer(float f) {
    return !(std::floor(f) < f);
}

// Floor and ceil of the two ends on the grid of `bits` bits, as S47.16.
void to_fixed(const mpz_class& low, const mpz_class& high, int bits, int64_t& x0, int64_t& x1) {
    x0 = low.get_si() * (int64_t{1} << (kFixedBits - bits));
    x1 = high.get_si() * (int64_t{1} << (kFixedBits - bits));
}

// What profile vulkan adds to the error of a coordinate before it is snapped: the operations above
// with about 1 part in 10^5 each (Vulkan, "Floating-Point Computation").
mpq_class vulkan_slack(const mpq_class& ideal, const Axis& axis, bool is_fractional) {
    mpq_class slack = rounding_bound(ideal - axis.offset, axis.offset, ideal, mpq_class(1, 100000));
    if (is_fractional) {
        slack += 1;  // viewportSubPixelBits may be 0: the viewport may move by less than a pixel
    }
    return slack;
}

void axis_box(const mpq_class& ideal, const mpq_class& error, const Axis& axis, bool is_fractional,
              const Limits& limits, cases::Profile profile, int64_t& x0, int64_t& x1) {
    const mpq_class scale = power_of_two(limits.subpixel_bits);
    if (profile == cases::Profile::direct3d) {
        // D3D 11.3, 3.2.4.1: 0.6 units of the last place of the result.
        const mpq_class reach = error * scale + mpq_class(3, 5);
        const mpq_class v = ideal * scale;
        to_fixed(ceil_of(v - reach), floor_of(v + reach), limits.subpixel_bits, x0, x1);
        return;
    }
    mpq_class reach = error;
    if (profile == cases::Profile::vulkan) {
        reach += vulkan_slack(ideal, axis, is_fractional);
    }
    to_fixed(floor_of((ideal - reach) * scale), ceil_of((ideal + reach) * scale),
             limits.subpixel_bits, x0, x1);
}

// The same for a point of an edge that a device may cut and snap elsewhere: all positions within
// the snapping error, off the grid too.
void axis_crossing(const mpq_class& ideal, const mpq_class& error, const Axis& axis,
                   bool is_fractional, const Limits& limits, cases::Profile profile, int64_t& x0,
                   int64_t& x1) {
    const mpq_class units = profile == cases::Profile::direct3d ? mpq_class(3, 5) : mpq_class(1);
    mpq_class reach = error + units * power_of_two(-limits.subpixel_bits);
    if (profile == cases::Profile::vulkan) {
        reach += vulkan_slack(ideal, axis, is_fractional);
    }
    x0 = floor_of((ideal - reach) * power_of_two(kFixedBits)).get_si();
    x1 = ceil_of((ideal + reach) * power_of_two(kFixedBits)).get_si();
}

bool is_in_range(const mpq_class& x, const mpq_class& y, const TransformError& error) {
    const mpq_class& limit = power_of_two(32);
    return abs(x) <= limit && abs(y) <= limit && error.x <= limit && error.y <= limit;
}

}  // namespace

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

mpq_class rounding_bound(const mpq_class& t, const mpq_class& o, const mpq_class& x_f,
                         const mpq_class& u) {
    return u * (4 * abs(t) + abs(o) + 2 * abs(x_f) + 1) * (1 + 8 * u);
}

IdealPosition ideal_position(const glm::vec4& clip, const cases::Viewport& viewport) {
    const mpq_class w = exact(clip.w);
    const Axis x = axis_x(viewport);
    const Axis y = axis_y(viewport);
    IdealPosition out;
    out.inv_w = 1 / w;
    out.x = x.half * exact(clip.x) / w + x.offset;
    out.y = y.half * exact(clip.y) / w + y.offset;
    const mpq_class range = exact(viewport.max_depth) - exact(viewport.min_depth);
    out.z = range * exact(clip.z) / w + exact(viewport.min_depth);
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
    if (!is_in_range(x, y, error)) {
        return std::nullopt;
    }
    Box box;
    axis_box(x, error.x, axis_x(viewport), !is_integer(viewport.x) || !is_integer(viewport.width),
             limits, profile, box.x0, box.x1);
    axis_box(y, error.y, axis_y(viewport), !is_integer(viewport.y) || !is_integer(viewport.height),
             limits, profile, box.y0, box.y1);
    return box;
}

std::optional<Box> box_around_crossing(const mpq_class& x, const mpq_class& y,
                                       const TransformError& error, const cases::Viewport& viewport,
                                       const Limits& limits, cases::Profile profile) {
    if (!is_in_range(x, y, error)) {
        return std::nullopt;
    }
    Box box;
    axis_crossing(x, error.x, axis_x(viewport),
                  !is_integer(viewport.x) || !is_integer(viewport.width), limits, profile, box.x0,
                  box.x1);
    axis_crossing(y, error.y, axis_y(viewport),
                  !is_integer(viewport.y) || !is_integer(viewport.height), limits, profile, box.y0,
                  box.y1);
    return box;
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
    const IdealPosition ideal = ideal_position(clip, viewport);
    const mpq_class& limit = power_of_two(32);
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

}  // namespace ref
