// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "stored_color.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace histories {

namespace {

using Kind = ColorFormat::Kind;

double limited(const ColorFormat& format, double number) {
    const bool is_fixed = format.kind == Kind::unorm || format.kind == Kind::srgb;
    return is_fixed ? std::clamp(number, 0.0, 1.0) : number;
}

// Of numbers below the range's end, or near it where nobody looks (is_color_large).
uint32_t half_of(double number) {
    if (is_same(number, 0)) {
        return std::signbit(number) ? 0x8000U : 0U;
    }
    int exponent = 0;
    if (std::abs(number) < 0x1p-14) {  // a subnormal one
        const auto whole = static_cast<uint32_t>(std::nearbyint(std::abs(number) * 0x1p24));
        return whole | (number < 0 ? 0x8000U : 0U);
    }
    const double mantissa = std::frexp(std::abs(number), &exponent);  // in [1/2, 1)
    const auto whole = static_cast<uint32_t>(std::nearbyint(mantissa * 2048));
    const auto code = (static_cast<uint32_t>(exponent + 13) << 10) + whole;
    return code | (number < 0 ? 0x8000U : 0U);
}

double number_of_half(uint32_t code) {
    const int exponent = static_cast<int>(code >> 10 & 31);
    const double magnitude = exponent == 0 ? std::ldexp(code & 1023U, -24)
                                           : std::ldexp(1024 + (code & 1023U), exponent - 25);
    return (code & 0x8000U) != 0 ? -magnitude : magnitude;
}

uint32_t code_of(const ColorFormat& format, size_t c, double number) {
    const uint32_t bits = format.bits[c];
    if (bits == 0) {
        return 0;
    }
    switch (format.kind) {
        case Kind::integer:
            return static_cast<uint32_t>(number);
        case Kind::floating:
            return bits == 16 ? half_of(number)
                              : std::bit_cast<uint32_t>(static_cast<float>(number));
        default:
            break;
    }
    number = std::clamp(number, 0.0, 1.0);
    if (format.kind == Kind::srgb && c < 3) {
        number = number <= 0.0031308 ? 12.92 * number : 1.055 * std::pow(number, 1 / 2.4) - 0.055;
    }
    return static_cast<uint32_t>(std::nearbyint(number * ((1U << bits) - 1)));
}

double number_of(const ColorFormat& format, size_t c, uint32_t code) {
    const uint32_t bits = format.bits[c];
    if (bits == 0) {
        return c == 3 ? 1 : 0;
    }
    switch (format.kind) {
        case Kind::integer:
            return code;
        case Kind::floating:
            return bits == 16 ? number_of_half(code) : double{std::bit_cast<float>(code)};
        default:
            break;
    }
    const double number = static_cast<double>(code) / ((1U << bits) - 1);
    if (format.kind == Kind::srgb && c < 3) {
        return number <= 0.04045 ? number / 12.92 : std::pow((number + 0.055) / 1.055, 2.4);
    }
    return number;
}

// The numbers that the factors of one fragment are made of.
struct Sources {
    Numbers first, second, stored, constant;
};

double factor_of(Factor factor, size_t c, const Sources& s) {
    switch (factor) {
        case Factor::zero:
            return 0;
        case Factor::one:
            return 1;
        case Factor::src:
            return s.first[c];
        case Factor::inv_src:
            return 1 - s.first[c];
        case Factor::dst:
            return s.stored[c];
        case Factor::inv_dst:
            return 1 - s.stored[c];
        case Factor::src_alpha:
            return s.first[3];
        case Factor::inv_src_alpha:
            return 1 - s.first[3];
        case Factor::dst_alpha:
            return s.stored[3];
        case Factor::inv_dst_alpha:
            return 1 - s.stored[3];
        case Factor::constant:
            return s.constant[c];
        case Factor::inv_constant:
            return 1 - s.constant[c];
        case Factor::constant_alpha:
            return s.constant[3];
        case Factor::inv_constant_alpha:
            return 1 - s.constant[3];
        case Factor::saturate:
            return c == 3 ? 1 : std::min(s.first[3], 1 - s.stored[3]);
        case Factor::src1:
            return s.second[c];
        case Factor::inv_src1:
            return 1 - s.second[c];
        case Factor::src1_alpha:
            return s.second[3];
        case Factor::inv_src1_alpha:
            return 1 - s.second[3];
    }
    return 0;
}

double blended(const BlendPart& part, size_t c, const Sources& s) {
    const double source = s.first[c] * factor_of(part.source, c, s);
    const double stored = s.stored[c] * factor_of(part.destination, c, s);
    switch (part.op) {
        case BlendOp::add:
            return source + stored;
        case BlendOp::subtract:
            return source - stored;
        case BlendOp::reverse_subtract:
            return stored - source;
        case BlendOp::min:
            return std::min(s.first[c], s.stored[c]);
        case BlendOp::max:
            return std::max(s.first[c], s.stored[c]);
    }
    return 0;
}

uint32_t logic_of(uint32_t operation, uint32_t s, uint32_t d) {
    const std::array<uint32_t, 16> results = {0,     s & d,  s & ~d,   s,        ~s & d, d,
                                              s ^ d, s | d,  ~(s | d), ~(s ^ d), ~d,     s | ~d,
                                              ~s,    ~s | d, ~(s & d), ~0U};
    return results[operation];
}

}  // namespace

Codes clear_codes(const ColorTarget& target) {
    Codes codes{};
    for (size_t c = 0; c < 4; ++c) {
        codes[c] = code_of(target.about(), c, target.clear[c]);
    }
    return codes;
}

Codes written(const ColorFormat& format, const Codes& stored, const Draw& draw,
              const ColorState& state) {
    Sources s{state.value, draw.second, {}, draw.constants};
    if (draw.alpha_to_one && format.kind != Kind::integer) {
        s.first[3] = 1;
    }
    for (size_t c = 0; c < 4; ++c) {
        s.first[c] = limited(format, s.first[c]);
        s.second[c] = limited(format, s.second[c]);
        s.constant[c] = limited(format, s.constant[c]);
        s.stored[c] = number_of(format, c, stored[c]);
    }
    Codes codes = stored;
    for (size_t c = 0; c < 4; ++c) {
        if ((state.write_mask >> c & 1) == 0 || format.bits[c] == 0) {
            continue;
        }
        const bool is_logical =
            draw.logic && (format.kind == Kind::unorm || format.kind == Kind::integer);
        if (is_logical) {
            const uint32_t all = format.bits[c] == 32 ? ~0U : (1U << format.bits[c]) - 1;
            codes[c] = logic_of(*draw.logic, code_of(format, c, s.first[c]), stored[c]) & all;
        } else if (state.blend && !draw.logic) {
            codes[c] = code_of(format, c, blended((*state.blend)[c == 3 ? 1 : 0], c, s));
        } else {
            codes[c] = code_of(format, c, s.first[c]);
        }
    }
    return codes;
}

bool is_color_large(const ColorFormat& format, const Codes& codes) {
    for (size_t c = 0; c < 4; ++c) {
        if (format.kind == Kind::floating && std::abs(number_of(format, c, codes[c])) > 100) {
            return true;
        }
    }
    return false;
}

bool is_near(const ColorFormat& format, const Codes& a, const Codes& b) {
    for (size_t c = 0; c < 4; ++c) {
        if (a[c] == b[c]) {
            continue;
        }
        const double apart = std::abs(number_of(format, c, a[c]) - number_of(format, c, b[c]));
        // Few bits: what each blending may round adds up, its factors, products and sum, which are
        // as precise as what is stored.
        const double codes = format.bits[c] > 2 ? 5.5 : 2.5;
        const double steps = format.kind == Kind::floating || format.bits[c] > 16
                                 ? 0
                                 : codes / ((1U << format.bits[c]) - 1);
        if (format.bits[c] == 0 || format.kind == Kind::integer ||
            !(apart < std::max(1.0 / 16, steps))) {
            return false;
        }
    }
    return true;
}

}  // namespace histories
