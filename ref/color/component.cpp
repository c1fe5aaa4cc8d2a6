// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/color/component.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <vector>

#include "ref/number/rational.hpp"

namespace ref::color {

namespace {

using cases::ComponentKind;
using ref::ceil_of;
using ref::floor_of;

// Of x times a whole number; without a quotient that has to be reduced.
mpz_class floor_of(const mpq_class& x, const mpz_class& times) {
    mpz_class out = x.get_num() * times;
    mpz_fdiv_q(out.get_mpz_t(), out.get_mpz_t(), x.get_den_mpz_t());
    return out;
}

mpz_class ceil_of(const mpq_class& x, const mpz_class& times) {
    mpz_class out = x.get_num() * times;
    mpz_cdiv_q(out.get_mpz_t(), out.get_mpz_t(), x.get_den_mpz_t());
    return out;
}

// A binary floating-point format: `fraction` stored bits, exponents from `least` (of the smallest
// normal number) to `most`.
struct Floating {
    long fraction, least, most;
};
constexpr Floating kHalf = {10, -14, 15};
constexpr Floating kBinary32 = {23, -126, 127};

const Floating& floating_of(ComponentKind kind) {
    return kind == ComponentKind::half ? kHalf : kBinary32;
}

// The spacing of the format's numbers around x != 0.
mpq_class spacing(const Floating& format, const mpq_class& x) {
    const mpq_class size = abs(x);
    // 2^e <= size < 2^(e+1); the difference of the lengths is e or e + 1.
    long e = static_cast<long>(mpz_sizeinbase(size.get_num_mpz_t(), 2)) -
             static_cast<long>(mpz_sizeinbase(size.get_den_mpz_t(), 2));
    if (power_of_two(e) > size) {
        --e;
    }
    return power_of_two(std::max(e, format.least) - format.fraction);
}

const mpq_class& largest_of(const Floating& format) {
    static const auto make = [](const Floating& f) {
        return mpq_class(power_of_two(f.most + 1) - power_of_two(f.most - f.fraction));
    };
    static const mpq_class half = make(kHalf);
    static const mpq_class binary32 = make(kBinary32);
    return format.fraction == kHalf.fraction ? half : binary32;
}

mpq_class round_to(const Floating& format, const mpq_class& x, bool upwards) {
    const mpq_class& largest = largest_of(format);
    if (abs(x) > largest) {  // towards zero the largest number, away from it the overflow itself
        return upwards == (sgn(x) > 0) ? x : sgn(x) > 0 ? largest : mpq_class(-largest);
    }
    if (sgn(x) == 0) {
        return x;
    }
    const mpq_class step = spacing(format, x);
    const mpq_class count = x / step;
    return (upwards ? mpq_class(ceil_of(count)) : mpq_class(floor_of(count))) * step;
}

// The Khronos Data Format Specification, "sRGB transfer functions", of codes and parts of them.
double linear_of(double code) {
    const double c = code / 255;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
double code_of_linear(double l) {
    return 255 * (l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055);
}

const std::vector<mpq_class>& srgb_values() {
    static const std::vector<mpq_class> values = [] {
        std::vector<mpq_class> out;
        for (uint32_t code = 0; code < 256; ++code) {
            out.emplace_back(linear_of(code));
        }
        return out;
    }();
    return values;
}

mpq_class value_of_floating(const Floating& format, uint32_t code, bool& is_number) {
    const uint32_t fraction_bits = static_cast<uint32_t>(format.fraction);
    const uint32_t exponent_bits = fraction_bits == 10 ? 5 : 8;
    const uint32_t fraction = code & ((1U << fraction_bits) - 1);
    const uint32_t exponent = code >> fraction_bits & ((1U << exponent_bits) - 1);
    const bool is_negative = (code >> (fraction_bits + exponent_bits) & 1U) != 0;
    is_number = exponent != (1U << exponent_bits) - 1;
    const uint32_t whole = exponent == 0 ? fraction : fraction | 1U << fraction_bits;
    const long scale =
        (exponent == 0 ? format.least : format.least + static_cast<long>(exponent) - 1) -
        format.fraction;
    const mpq_class size = mpq_class(whole) * power_of_two(scale);
    return is_negative ? mpq_class(-size) : size;
}

}  // namespace

Interval point(const mpq_class& value) {
    return {value, value};
}

Interval clamped(const Interval& v) {
    const auto clamp = [](const mpq_class& x) -> mpq_class {
        return x < 0 ? mpq_class(0) : x > 1 ? mpq_class(1) : x;
    };
    return {clamp(v.low), clamp(v.high)};
}

const mpz_class& Component::units() const {
    static const std::vector<mpz_class> all = [] {
        std::vector<mpz_class> out;
        for (mp_bitcnt_t bits = 0; bits <= 32; ++bits) {
            out.emplace_back((mpz_class(1) << bits) - 1);
        }
        return out;
    }();
    return all.at(format_.bits);
}

Interval Component::anything() {
    static const mpq_class far = power_of_two(4096);  // beyond all that is computed
    return {-far, far};
}

bool Component::is_anything(const Interval& v) {
    static const Interval all = anything();
    return v == all;
}

bool Component::may_be_infinite(const Interval& v) const {
    if (format_.kind != ComponentKind::half && format_.kind != ComponentKind::binary32) {
        return false;
    }
    const mpq_class& largest = largest_of(floating_of(format_.kind));
    return v.high > largest || v.low < -largest;
}

bool Component::is_fixed_point() const {
    return format_.kind == ComponentKind::unorm || format_.kind == ComponentKind::srgb;
}

mpq_class Component::neighbour(const mpq_class& x, bool upwards) const {
    switch (format_.kind) {
        case ComponentKind::unorm:
            return fraction(upwards ? ceil_of(x, units()) : floor_of(x, units()), units());
        case ComponentKind::srgb: {
            // A value within kSrgbError of a code's is that code.
            const auto& values = srgb_values();
            if (upwards) {
                const auto at =
                    std::lower_bound(values.begin(), values.end(), mpq_class(x - kSrgbError));
                return at == values.end() ? x : *at;
            }
            const auto above =
                std::upper_bound(values.begin(), values.end(), mpq_class(x + kSrgbError));
            return above == values.begin() ? x : *(above - 1);
        }
        case ComponentKind::half:
        case ComponentKind::binary32:
            return round_to(floating_of(format_.kind), x, upwards);
        case ComponentKind::uint:
            break;
    }
    return x;
}

Interval Component::stored(const Interval& v, cases::Profile profile, bool is_blended) const {
    if (!is_fixed_point()) {
        return either(v);
    }
    const Interval in = clamped(v);
    if (format_.kind == ComponentKind::unorm && profile == cases::Profile::direct3d &&
        !is_blended) {
        const mpq_class slack(3, 5);  // of a unit on the integer side
        const mpq_class low = fraction(ceil_of(in.low * units() - slack), units());
        const mpq_class high = fraction(floor_of(in.high * units() + slack), units());
        return clamped({low, high});
    }
    return either(in);
}

double Component::number(uint32_t code) const {
    switch (format_.kind) {
        case ComponentKind::unorm:
            return code / (std::ldexp(1.0, static_cast<int>(format_.bits)) - 1);
        case ComponentKind::half:
            return static_cast<double>(glm::unpackHalf1x16(static_cast<uint16_t>(code)));
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

bool Component::value_of(uint32_t code, mpq_class& value) const {
    bool is_number = true;
    switch (format_.kind) {
        case ComponentKind::unorm:
            value = fraction(code, units());
            break;
        case ComponentKind::srgb:
            is_number = code < 256;
            value = srgb_values()[is_number ? code : 0];
            break;
        case ComponentKind::half:
        case ComponentKind::binary32:
            value = value_of_floating(floating_of(format_.kind), code, is_number);
            break;
        case ComponentKind::uint:
            value = code;
            break;
    }
    return is_number;
}

bool Component::allows(uint32_t code, const Interval& stored) const {
    if (is_anything(stored)) {
        return true;
    }
    mpq_class value;
    if (value_of(code, value)) {
        return value >= stored.low && value <= stored.high;
    }
    const bool is_half = format_.kind == ComponentKind::half;
    const mpq_class& largest = largest_of(floating_of(format_.kind));
    return code == (is_half ? 0x7c00U : 0x7f800000U)   ? stored.high > largest
           : code == (is_half ? 0xfc00U : 0xff800000U) ? stored.low < -largest
                                                       : false;
}

bool Component::may_convert(const Interval& v, uint32_t code) const {
    if (format_.kind == ComponentKind::uint) {
        const mpq_class largest(units());
        return allows(code, {std::min(v.low, largest), std::min(v.high, largest)});
    }
    return allows(code, stored(v, cases::Profile::vulkan, /*is_blended=*/false));
}

Interval Component::read(uint32_t code) const {
    constexpr uint32_t kLastCode = 255;
    if (format_.kind == ComponentKind::srgb && code > 0 && code < kLastCode) {
        constexpr double kOutwards = 0x1p-40;
        return {mpq_class(linear_of(code - 0.5) - kOutwards),
                mpq_class(linear_of(code + 0.5) + kOutwards)};
    }
    mpq_class value;
    value_of(code, value);
    return point(value);
}

uint32_t Component::code_of(const mpq_class& value) const {
    switch (format_.kind) {
        case ComponentKind::unorm:
        case ComponentKind::srgb: {
            const mpq_class v = clamped(point(value)).low;
            const mpq_class code = format_.kind == ComponentKind::unorm
                                       ? mpq_class(v * units())
                                       : mpq_class(code_of_linear(v.get_d()));
            return static_cast<uint32_t>(floor_of(mpq_class(code + mpq_class(1, 2))).get_ui());
        }
        case ComponentKind::half:
        case ComponentKind::binary32: {
            const bool is_half = format_.kind == ComponentKind::half;
            const mpq_class& largest = largest_of(floating_of(format_.kind));
            const mpq_class v = std::clamp(value, mpq_class(-largest), largest);
            const Interval neighbours = either(point(v));
            const bool is_up = neighbours.high - v <= v - neighbours.low;
            // A number of the format: the conversions are exact.
            const auto nearest =
                static_cast<float>((is_up ? neighbours.high : neighbours.low).get_d());
            return is_half ? glm::packHalf1x16(nearest) : std::bit_cast<uint32_t>(nearest);
        }
        case ComponentKind::uint:
            break;
    }
    const mpq_class whole = std::min(value, mpq_class(units()));
    return static_cast<uint32_t>(floor_of(mpq_class(whole + mpq_class(1, 2))).get_ui());
}

mpq_class Component::step() const {
    return is_fixed_point() ? fraction(1, units()) : mpq_class(0);
}

std::string Component::text_of(const Interval& v) const {
    if (is_anything(v)) {
        return "anything";
    }
    const auto text = [&](const mpq_class& x) -> std::string {
        switch (format_.kind) {
            case ComponentKind::unorm:
                return mpz_class(floor_of(x * units())).get_str();
            case ComponentKind::srgb: {
                const auto& values = srgb_values();
                return std::to_string(std::lower_bound(values.begin(), values.end(), x) -
                                      values.begin());
            }
            case ComponentKind::uint:
                return mpz_class(ref::floor_of(x)).get_str();
            case ComponentKind::half:
            case ComponentKind::binary32:
                break;
        }
        return fmt::format("{:.9g}", x.get_d());
    };
    const std::string low = text(v.low);
    const std::string high = text(v.high);
    return low == high ? low : fmt::format("{} to {}", low, high);
}

}  // namespace ref::color
