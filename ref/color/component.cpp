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
constexpr Floating kHalf = {10, -14, 15}, kEleven = {6, -14, 15}, kTen = {5, -14, 15};
constexpr Floating kBinary32 = {23, -126, 127};

const Floating& floating_of(const cases::ComponentFormat& format) {
    return format.kind != ComponentKind::half ? kBinary32
           : format.bits == 16                ? kHalf
           : format.bits == 11                ? kEleven
                                              : kTen;
}

// The bits of the binary16 number that a `half` of so many bits is: a short one lacks the sign and
// the last places.
uint32_t bits_of_half(uint32_t code, uint32_t bits) {
    return bits == 16 ? code : code << (15 - bits);
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
    static const mpq_class half = make(kHalf), eleven = make(kEleven), ten = make(kTen);
    static const mpq_class binary32 = make(kBinary32);
    return &format == &kHalf     ? half
           : &format == &kEleven ? eleven
           : &format == &kTen    ? ten
                                 : binary32;
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
    const uint32_t exponent_bits = format.most == kHalf.most ? 5 : 8;
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

Interval Component::clamped(const Interval& v) const {
    const mpq_class least = format_.kind == ComponentKind::snorm ? -1 : 0, most = 1;
    return is_fixed_point()
               ? Interval{std::clamp(v.low, least, most), std::clamp(v.high, least, most)}
           : is_unsigned_float() && !is_anything(v)
               ? Interval{std::max(v.low, least), std::max(v.high, least)}
               : v;
}

const mpz_class& Component::units() const {
    static const std::vector<mpz_class> all = [] {
        std::vector<mpz_class> out;
        for (mp_bitcnt_t bits = 0; bits <= 32; ++bits) {
            out.emplace_back((mpz_class(1) << bits) - 1);
        }
        return out;
    }();
    return all.at(format_.bits - (is_signed(format_.kind) && format_.bits > 0 ? 1 : 0));
}

uint32_t Component::code_of_whole(const mpz_class& whole) const {
    return static_cast<uint32_t>(whole.get_si()) & (UINT32_MAX >> (32 - format_.bits));
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
    if (!is_floating(format_.kind)) {
        return false;
    }
    const mpq_class& largest = largest_of(floating_of(format_));
    return v.high > largest || v.low < -largest;
}

bool Component::is_fixed_point() const {
    return format_.kind == ComponentKind::unorm || format_.kind == ComponentKind::srgb ||
           format_.kind == ComponentKind::snorm;
}

bool Component::is_unsigned_float() const {
    return format_.kind == ComponentKind::half && format_.bits < 16;
}

double Component::least_step(double magnitude) const {
    const Floating& format = floating_of(format_);
    return std::ldexp(std::max(magnitude, std::ldexp(1, static_cast<int>(format.least))),
                      static_cast<int>(-format.fraction));
}

mpq_class Component::neighbour(const mpq_class& x, bool upwards) const {
    switch (format_.kind) {
        case ComponentKind::unorm:
        case ComponentKind::snorm:
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
            return round_to(floating_of(format_), x, upwards);
        case ComponentKind::uint:
        case ComponentKind::sint:
            break;
    }
    return x;
}

Interval Component::stored(const Interval& v, cases::Profile profile, bool is_blended) const {
    const Interval in = clamped(v);
    if (is_fixed_point() && format_.kind != ComponentKind::srgb &&
        profile == cases::Profile::direct3d && !is_blended) {
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
        case ComponentKind::snorm:
            return whole_of(code) / units().get_d();
        case ComponentKind::half:
            return static_cast<double>(
                glm::unpackHalf1x16(static_cast<uint16_t>(bits_of_half(code, format_.bits))));
        case ComponentKind::binary32:
            return static_cast<double>(std::bit_cast<float>(code));
        case ComponentKind::uint:
        case ComponentKind::sint:
            return whole_of(code);
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
        case ComponentKind::snorm:
            value = fraction(cases::signed_code(code, format_.bits), units());
            break;
        case ComponentKind::srgb:
            is_number = code < 256;
            value = srgb_values()[is_number ? code : 0];
            break;
        case ComponentKind::half:
        case ComponentKind::binary32:
            value = value_of_floating(floating_of(format_), code, is_number);
            break;
        case ComponentKind::uint:
        case ComponentKind::sint:
            value = whole_of(code);
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
    const mpq_class& largest = largest_of(floating_of(format_));
    const double infinity = number(code);
    return std::isnan(infinity) ? false
           : infinity > 0       ? stored.high > largest
                                : stored.low < -largest;
}

bool Component::may_convert(const Interval& v, uint32_t code) const {
    if (is_integer(format_.kind)) {
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
    return clamped(point(value));
}

uint32_t Component::code_of(const mpq_class& value) const {
    switch (format_.kind) {
        case ComponentKind::unorm:
        case ComponentKind::snorm:
        case ComponentKind::srgb: {
            const bool is_least = format_.kind == ComponentKind::snorm && value < -1;
            const mpq_class v = clamped(point(value)).low;
            const mpq_class code =
                is_least ? mpq_class(std::max<mpq_class>(value * units(), -units() - 1))
                : format_.kind != ComponentKind::srgb ? mpq_class(v * units())
                                                      : mpq_class(code_of_linear(v.get_d()));
            return code_of_whole(floor_of(mpq_class(code + mpq_class(1, 2))));
        }
        case ComponentKind::half:
        case ComponentKind::binary32: {
            const bool is_half = format_.kind == ComponentKind::half;
            const mpq_class& largest = largest_of(floating_of(format_));
            const mpq_class v = std::clamp(clamped(point(value)).low, mpq_class(-largest), largest);
            const Interval neighbours = either(point(v));
            const bool is_up = neighbours.high - v <= v - neighbours.low;
            // A number of the format: the conversions are exact.
            const auto nearest =
                static_cast<float>((is_up ? neighbours.high : neighbours.low).get_d());
            // Floats below 16 bits are halves without a sign and with fewer bits of the fraction.
            const unsigned lost_bits = is_half && format_.bits < 16 ? 15U - format_.bits : 0;
            return is_half ? uint32_t{glm::packHalf1x16(nearest)} >> lost_bits
                           : std::bit_cast<uint32_t>(nearest);
        }
        case ComponentKind::uint:
        case ComponentKind::sint:
            break;
    }
    const mpq_class whole = std::min(value, mpq_class(units()));
    return code_of_whole(floor_of(mpq_class(whole + mpq_class(1, 2))));
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
            case ComponentKind::snorm:
                return mpz_class(floor_of(x * units())).get_str();
            case ComponentKind::srgb: {
                const auto& values = srgb_values();
                return std::to_string(std::lower_bound(values.begin(), values.end(), x) -
                                      values.begin());
            }
            case ComponentKind::uint:
            case ComponentKind::sint:
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
