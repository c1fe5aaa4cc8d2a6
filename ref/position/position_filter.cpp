// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// With d = 2^-53: x_d = c/w has relative error d, t = x_d p/2 2d, o d, x_f = t + o d, so
// |x_f - computed| <= 4d (|t| + |o| + |x_f|). The error bound of position.cpp is a sum of products
// of positive terms, relative error below 16d. Both are taken four times as large.
#include "ref/position/position_filter.hpp"

#include <bit>
#include <cmath>

namespace ref {

namespace {

constexpr double kRound = 0x1p-53;
constexpr double kSmall = 0x1p-100;  // covers underflow of binary64 on the way
constexpr double kFar = 0x1p30;      // pixels; beyond it the rationals decide

// The number is zero or a normal binary32.
bool is_binary32(double v) {
    const auto f = static_cast<float>(v);
    return !(static_cast<double>(f) < v) && !(static_cast<double>(f) > v) &&
           (std::isnormal(f) || std::fpclassify(f) == FP_ZERO);
}

bool is_equal(double a, double b) {
    return !(a < b) && !(a > b);
}

// The sum, if binary64 holds it exactly.
bool exact_sum(double a, double b, double& sum) {
    sum = a + b;
    return is_equal(sum - a, b) && is_equal(sum - b, a);
}

// As is_power_of_two in position.cpp, for the w > 0 that come here: normal, so that the biased
// exponent is ilogb + 127.
bool is_power_of_two(float w) {
    constexpr uint32_t kFractionBits = 0x007fffff;
    constexpr int kFractionSize = 23;
    constexpr uint32_t kBias = 127;
    const auto bits = std::bit_cast<uint32_t>(w);
    const uint32_t exponent = bits >> kFractionSize;
    return (bits & kFractionBits) == 0 && exponent > kBias - 126 && exponent < kBias + 126;
}

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

}  // namespace

std::optional<FilteredRange> filtered_range(float c, float w, float origin, float extent,
                                            const Limits& limits, cases::Profile profile) {
    if (!(w >= 0x1p-60F) || !(w <= 0x1p60F) || !(std::abs(c) <= 0x1p90F)) {
        return std::nullopt;
    }
    const double half = static_cast<double>(extent) / 2;
    const double x_d = static_cast<double>(c) / static_cast<double>(w);
    const double t = x_d * half;  // exact if x_d is a binary32: 24 + 24 bits
    double o = 0;
    double x_f = 0;
    double shifted = 0;
    const bool has_offset = exact_sum(static_cast<double>(origin), half, o);
    const bool has_position = exact_sum(t, o, x_f);
    if (!(std::abs(x_f) < kFar) || !(std::abs(o) < kFar)) {
        return std::nullopt;
    }
    const bool is_exact =
        is_power_of_two(w) && has_offset && has_position && is_binary32(x_d) && is_binary32(half) &&
        is_binary32(t) && is_binary32(o) && is_binary32(x_f) && exact_sum(x_f, -0.5, shifted) &&
        is_binary32(shifted) && exact_sum(o, -0.5, shifted) && is_binary32(shifted);
    // position.cpp, "The binary32 error"
    constexpr double kUnit = 0x1p-24;
    double error = 0;
    Known position{x_f, 0};
    if (!is_exact) {
        error = kUnit * (4 * std::abs(t) + std::abs(o) + 2 * std::abs(x_f) + 1) * (1 + 8 * kUnit) +
                0x1p-120 * (1 + std::abs(half)) * (1 + std::abs(static_cast<double>(c)));
        position.slack = 16 * kRound * (std::abs(t) + std::abs(o) + std::abs(x_f)) +
                         64 * kRound * error + kSmall;
    }
    const double scale = static_cast<double>(int64_t{1} << limits.subpixel_bits);
    const bool is_direct3d = profile == cases::Profile::direct3d;
    const bool is_vulkan = profile == cases::Profile::vulkan;
    if (is_vulkan) {
        // vulkan_slack in position.cpp, u = 1e-5: as `error`, with the rounding of u itself.
        const bool is_fractional = std::floor(origin) < origin || std::floor(extent) < extent;
        const double terms = 4 * std::abs(t) + std::abs(o) + 2 * std::abs(x_f) + 1;
        const double wide = 1e-5 * terms * (1 + 8e-5) + (is_fractional ? 1 : 0);
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
    FilteredRange out;
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
