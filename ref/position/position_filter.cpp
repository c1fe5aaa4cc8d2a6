// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// With d = 2^-53: x_d = c/w has relative error d, t = x_d p/2 2d, o d, x_f = t + o d, so
// |x_f - computed| <= 4d (|t| + |o| + |x_f|). The error bound of position.cpp is a sum of products
// of positive terms, relative error below 16d. Both are taken four times as large.
#include "ref/position/position_filter.hpp"

#include <cmath>

#include "ref/position/position.hpp"
#include "ref/position/viewport_grid.hpp"

namespace ref {

namespace {

constexpr double kRound = 0x1p-53;
constexpr double kSmall = 0x1p-100;  // covers underflow of binary64 on the way
constexpr double kFar = 0x1p30;      // pixels; beyond it the rationals decide

// For |v| < 2^52, which holds for all that comes here: |x_f|, |o| < 2^30, so |t| = |c half / w| is
// below 2^31 and, w being at most 2^60, |c half| below 2^92; with |c| <= 2^90 and |half| < 2^128
// the error is below 2^18 pixels, and a pixel has at most 2^16 units. Conversion drops the
// fraction, and what is left is a binary64 again.
int64_t floor_of(double v) {
    const auto n = static_cast<int64_t>(v);
    return static_cast<double>(n) > v ? n - 1 : n;
}

// A number known to lie within `slack` of `value`.
struct Known {
    double value = 0, slack = 0;
};

// floor or ceil, if it is the same for all numbers that are possible.
bool certain_floor(const Known& k, int64_t& out) {
    out = floor_of(k.value - k.slack);
    return out == floor_of(k.value + k.slack);
}
bool certain_ceil(const Known& k, int64_t& out) {
    if (!certain_floor({-k.value, k.slack}, out)) {
        return false;
    }
    out = -out;
    return true;
}

// The position on one axis, and the error that a device's binary32 transform may have, pixels.
struct Transformed {
    double t = 0, o = 0, x_f = 0;
    bool is_exact = false;  // in binary32
    Known position;
    double error = 0;
};

std::optional<Transformed> transformed(float c, float w, float origin, float extent) {
    if (!(w >= 0x1p-60F) || !(w <= 0x1p60F) || !(std::abs(c) <= 0x1p90F)) {
        return std::nullopt;
    }
    Transformed out;
    const double half = static_cast<double>(extent) / 2;
    const double x_d = static_cast<double>(c) / static_cast<double>(w);
    const double t = out.t = x_d * half;
    const double o = out.o = static_cast<double>(origin) + half;
    const double x_f = out.x_f = t + o;
    if (!(std::abs(x_f) < kFar) || !(std::abs(o) < kFar)) {
        return std::nullopt;
    }
    out.is_exact = is_transform_exact(c, w, origin, extent);
    out.position.value = x_f;
    // position.cpp, "The binary32 error"
    constexpr double kUnit = 0x1p-24;
    if (!out.is_exact) {
        out.error =
            kUnit * (4 * std::abs(t) + std::abs(o) + 2 * std::abs(x_f) + 1) * (1 + 8 * kUnit) +
            0x1p-120 * (1 + std::abs(half)) * (1 + std::abs(static_cast<double>(c)));
        out.position.slack = 16 * kRound * (std::abs(t) + std::abs(o) + std::abs(x_f)) +
                             64 * kRound * out.error + kSmall;
    }
    return out;
}

}  // namespace

std::optional<int64_t> filtered_nearest(float c, float w, float origin, float extent,
                                        const Limits& limits) {
    const std::optional<Transformed> at = transformed(c, w, origin, extent);
    if (!at) {
        return std::nullopt;
    }
    // A power of two and, below 2^47, sums with 1/2 lose nothing that the slack does not hold; if
    // the transform is exact in binary32 nothing is lost at all.
    const double scale = static_cast<double>(int64_t{1} << limits.subpixel_bits);
    const double scaled = at->x_f * scale;
    int64_t n = 0;
    if (at->is_exact) {
        n = floor_of(scaled);
        const double rest = scaled - static_cast<double>(n);
        n += rest > 0.5 || (!(rest < 0.5) && n % 2 != 0) ? 1 : 0;
    } else if (!certain_floor(
                   {scaled + 0.5, at->position.slack * scale + 4 * kRound * (std::abs(scaled) + 1)},
                   n)) {
        return std::nullopt;
    }
    return n * (int64_t{1} << (kFixedBits - limits.subpixel_bits));
}

std::optional<FixedRange> filtered_range(float c, float w, float origin, float extent,
                                         const Limits& limits, cases::Profile profile) {
    const std::optional<Transformed> at = transformed(c, w, origin, extent);
    if (!at) {
        return std::nullopt;
    }
    const auto& [t, o, x_f, is_exact, ideal, binary32_error] = *at;
    Known position = ideal;
    double error = binary32_error;
    const double scale = static_cast<double>(int64_t{1} << limits.subpixel_bits);
    const bool is_direct3d = profile == cases::Profile::direct3d;
    const bool is_vulkan = profile == cases::Profile::vulkan;
    if (is_vulkan) {
        // vulkan_slack in position.cpp, u = 1e-5: as `error`, with the rounding of u itself.
        const bool is_moved = !is_on_viewport_grid(origin, extent, limits.viewport_bits);
        const double terms = 4 * std::abs(t) + std::abs(o) + 2 * std::abs(x_f) + 1;
        const double wide =
            1e-5 * terms * (1 + 8e-5) + (is_moved ? std::ldexp(1.0, -limits.viewport_bits) : 0);
        position.slack += 64 * kRound * (wide + std::abs(t) + std::abs(o) + std::abs(x_f));
        error += wide;
    }
    // 0.6 is no binary64 number: its rounding and that of the sum count as slack.
    const double reach = error * scale + (is_direct3d ? 0.6 : 0.0);
    const double slack =
        position.slack * scale + (is_exact && !is_direct3d && !is_vulkan
                                      ? 0
                                      : 4 * kRound * (std::abs(x_f) * scale + reach + 1));
    const Known low{x_f * scale - reach, slack};
    const Known high{x_f * scale + reach, slack};
    FixedRange out;
    const bool is_certain = is_direct3d
                                ? certain_ceil(low, out.low) && certain_floor(high, out.high)
                                : certain_floor(low, out.low) && certain_ceil(high, out.high);
    if (!is_certain) {
        return std::nullopt;
    }
    const int64_t unit = int64_t{1} << (kFixedBits - limits.subpixel_bits);
    out.low *= unit;
    out.high *= unit;
    return out;
}

}  // namespace ref
