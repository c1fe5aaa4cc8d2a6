// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/color/texel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "ref/number/integer.hpp"

namespace ref {

namespace {

using cases::ComponentFormat;
using cases::ComponentKind;

mpz_class top_code(const ComponentFormat& format) {
    return (mpz_class(1) << format.bits) - 1;
}

// binary16 and binary32 codes of finite numbers.
double float_of(uint32_t code, ComponentKind kind) {
    if (kind == ComponentKind::binary32) {
        return static_cast<double>(std::bit_cast<float>(code));
    }
    const double sign = (code & 0x8000U) != 0 ? -1.0 : 1.0;
    const auto exponent = static_cast<int>(code >> 10U & 31U);
    const auto fraction = static_cast<double>(code & 0x3ffU);
    return sign * (exponent == 0 ? std::ldexp(fraction, -24)
                                 : std::ldexp(1024.0 + fraction, exponent - 25));
}

bool is_finite(uint32_t code, ComponentKind kind) {
    return kind == ComponentKind::binary32 ? std::isfinite(std::bit_cast<float>(code))
                                           : (code >> 10U & 31U) != 31U;
}

// Codes in the order of the numbers they stand for; +0 and -0 are both 0.
int64_t rank_of(uint32_t code, ComponentKind kind) {
    const uint32_t sign = kind == ComponentKind::binary32 ? 0x80000000U : 0x8000U;
    const auto magnitude = static_cast<int64_t>(code & (sign - 1U));
    return (code & sign) != 0 ? -magnitude : magnitude;
}

uint32_t code_of_rank(int64_t rank, ComponentKind kind) {
    const uint32_t sign = kind == ComponentKind::binary32 ? 0x80000000U : 0x8000U;
    return rank < 0 ? static_cast<uint32_t>(-rank) | sign : static_cast<uint32_t>(rank);
}

// sRGB transfer functions [Khronos Data Format 13.3], binary64: relative error below 2^-48.
double decode_srgb(double s) {
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}
double encode_srgb(double l) {
    return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055;
}

constexpr double kOutwards = 0x1p-40;

mpq_class clamp01(const mpq_class& v) {
    return v < 0 ? mpq_class(0) : v > 1 ? mpq_class(1) : v;
}

bool may_store_steps(uint32_t code, const mpq_class& lo, const mpq_class& hi) {
    return mpz_class(code) >= floor_of(lo) && mpz_class(code) <= ceil_of(hi);
}

}  // namespace

bool is_number(uint32_t code, const ComponentFormat& format) {
    const bool is_float =
        format.kind == ComponentKind::half || format.kind == ComponentKind::binary32;
    return !is_float || is_finite(code, format.kind);
}

mpq_class code_step(const ComponentFormat& format) {
    return format.kind == ComponentKind::unorm || format.kind == ComponentKind::srgb
               ? mpq_class(mpz_class(1), top_code(format))
               : mpq_class(0);
}

RationalInterval number_of(uint32_t code, const ComponentFormat& format) {
    switch (format.kind) {
        case ComponentKind::unorm: {
            mpq_class value(mpz_class(code), top_code(format));
            value.canonicalize();
            return {value, value};
        }
        case ComponentKind::srgb: {
            const auto top = top_code(format).get_d();
            const auto at = [&](double c) { return decode_srgb(std::clamp(c, 0.0, top) / top); };
            return {mpq_class(std::max(0.0, at(code - 0.5) - kOutwards)),
                    mpq_class(std::min(1.0, at(code + 0.5) + kOutwards))};
        }
        case ComponentKind::half:
        case ComponentKind::binary32: {
            const mpq_class value(float_of(code, format.kind));
            return {value, value};
        }
        case ComponentKind::uint:
            break;
    }
    const mpq_class value{mpz_class(code)};
    return {value, value};
}

bool may_store(uint32_t code, const RationalInterval& number, const ComponentFormat& format) {
    switch (format.kind) {
        case ComponentKind::unorm: {
            const mpq_class top(top_code(format));
            return may_store_steps(code, clamp01(number.lo) * top, clamp01(number.hi) * top);
        }
        case ComponentKind::srgb: {
            const double top = top_code(format).get_d();
            const double lo = encode_srgb(clamp01(number.lo).get_d()) * top - kOutwards * top;
            const double hi = encode_srgb(clamp01(number.hi).get_d()) * top + kOutwards * top;
            return may_store_steps(code, mpq_class(std::max(lo, 0.0)),
                                   mpq_class(std::min(hi, top)));
        }
        case ComponentKind::half:
        case ComponentKind::binary32: {
            if (!is_finite(code, format.kind)) {
                return false;
            }
            // The neighbours of the code; beyond the largest number lies infinity, which the
            // patterns never reach.
            const int64_t rank = rank_of(code, format.kind);
            const uint32_t above = code_of_rank(rank + 1, format.kind);
            const uint32_t below = code_of_rank(rank - 1, format.kind);
            return (!is_finite(above, format.kind) ||
                    mpq_class(float_of(above, format.kind)) > number.lo) &&
                   (!is_finite(below, format.kind) ||
                    mpq_class(float_of(below, format.kind)) < number.hi);
        }
        case ComponentKind::uint:
            break;
    }
    const mpq_class top(top_code(format));
    const mpq_class lo = std::min(number.lo, top);
    const mpq_class hi = std::min(number.hi, top);
    return mpq_class(mpz_class(code)) >= lo && mpq_class(mpz_class(code)) <= hi;
}

uint32_t nearest_code(const mpq_class& number, const ComponentFormat& format) {
    const auto steps = [&](const mpq_class& v) {
        return static_cast<uint32_t>(floor_of(v + mpq_class(1, 2)).get_ui());
    };
    switch (format.kind) {
        case ComponentKind::unorm:
            return steps(clamp01(number) * mpq_class(top_code(format)));
        case ComponentKind::srgb:
            return steps(mpq_class(encode_srgb(clamp01(number).get_d())) *
                         mpq_class(top_code(format)));
        case ComponentKind::half:
        case ComponentKind::binary32: {
            // The code whose number is the largest not above, then the nearer neighbour.
            int64_t low =
                rank_of(format.kind == ComponentKind::half ? 0xfbffU : 0xff7fffffU, format.kind);
            int64_t high = -low;
            while (low < high) {
                const int64_t middle = low + (high - low + 1) / 2;
                if (mpq_class(float_of(code_of_rank(middle, format.kind), format.kind)) <= number) {
                    low = middle;
                } else {
                    high = middle - 1;
                }
            }
            const uint32_t below = code_of_rank(low, format.kind);
            const uint32_t above = code_of_rank(low + 1, format.kind);
            if (!is_finite(above, format.kind)) {
                return below;
            }
            const mpq_class down = number - mpq_class(float_of(below, format.kind));
            const mpq_class up = mpq_class(float_of(above, format.kind)) - number;
            return up <= down ? above : below;
        }
        case ComponentKind::uint:
            break;
    }
    return steps(std::min(number, mpq_class(top_code(format))));
}

}  // namespace ref
