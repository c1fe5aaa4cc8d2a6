// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/toml/binary32.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

namespace cases {

namespace {

constexpr int kPrecision = 24;      // bits of a binary32 significand
constexpr int kMinExponent = -149;  // of the unit of the subnormals
constexpr int kOverflowExponent = 128;

// floor(log2 |q|) for q != 0.
long floor_log2(const mpq_class& q) {
    const mpz_class num = abs(q.get_num());
    const mpz_class& den = q.get_den();
    // 2^(a-1) <= num < 2^a, 2^(b-1) <= den < 2^b, so 2^(a-b-1) < |q| < 2^(a-b+1).
    const auto a = static_cast<long>(mpz_sizeinbase(num.get_mpz_t(), 2));
    const auto b = static_cast<long>(mpz_sizeinbase(den.get_mpz_t(), 2));
    const long e = a - b;
    mpz_class left = num;
    mpz_class right = den;
    if (e >= 0) {
        right <<= static_cast<unsigned long>(e);
    } else {
        left <<= static_cast<unsigned long>(-e);
    }
    return left >= right ? e : e - 1;
}

__extension__ typedef unsigned __int128 Uint128;

// n units of 2^unit, n <= 2^24.
Rounded rounded(float sign, double n, long unit, bool is_exact) {
    // n is a double, its product with a power of two >= 2^-149 too.
    const double magnitude = std::ldexp(n, static_cast<int>(unit));
    if (magnitude >= 0x1p128) {
        return {sign * std::numeric_limits<float>::infinity(), false};
    }
    return {sign * static_cast<float>(magnitude), is_exact};
}

// round_to_binary32 step by step, for num, den < 2^64 where 128 bits hold every number on the way;
// nothing elsewhere.
std::optional<Rounded> round_narrow(float sign, uint64_t num, uint64_t den) {
    const auto num_bits = static_cast<long>(std::bit_width(num));
    const long e = num_bits - static_cast<long>(std::bit_width(den));
    const uint64_t left = e >= 0 ? num : num << -e;  // as long as the other then
    const uint64_t right = e >= 0 ? den << e : den;
    const long exponent = left >= right ? e : e - 1;
    const long unit = std::max<long>(exponent - (kPrecision - 1), kMinExponent);
    // unit < 64 - 23, and 2^unit den <= num if it is not negative.
    if (num_bits - unit > 128) {
        return std::nullopt;
    }
    const Uint128 above = unit < 0 ? Uint128{num} << -unit : Uint128{num};
    const Uint128 below = unit < 0 ? Uint128{den} : Uint128{den} << unit;
    auto n = static_cast<uint64_t>(above / below);
    const Uint128 rest = above - n * below;
    // Twice the rest against the divisor, without the carry.
    const Uint128 other = below - rest;
    if (rest > other || (rest == other && n % 2 != 0)) {
        n += 1;
    }
    return rounded(sign, static_cast<double>(n), unit, rest == 0);
}

constexpr uint32_t kSignBit = 0x80000000U;
constexpr uint32_t kExponentBits = 0x7f800000U;
constexpr uint32_t kQuietNan = 0x7fc00000U;

}  // namespace

Number number_of_bits(uint32_t bits) {
    if ((bits & kExponentBits) == kExponentBits) {
        return {0, false, bits};
    }
    return {exact(static_cast<double>(std::bit_cast<float>(bits))), bits == kSignBit};
}

std::optional<Number> read_special_number(std::string_view text) {
    constexpr std::array<std::pair<std::string_view, uint32_t>, 4> kWords = {
        {{"nan", kQuietNan},
         {"-nan", kQuietNan | kSignBit},
         {"inf", kExponentBits},
         {"-inf", kExponentBits | kSignBit}}};
    for (const auto& [word, bits] : kWords) {
        if (text == word) {
            return number_of_bits(bits);
        }
    }
    constexpr std::string_view kBefore = "bits(0x";
    if (text.size() != kBefore.size() + 9 || text.substr(0, kBefore.size()) != kBefore ||
        text.back() != ')') {
        return std::nullopt;
    }
    uint32_t bits = 0;
    const char* const end = text.data() + text.size() - 1;
    const auto [last, error] = std::from_chars(text.data() + kBefore.size(), end, bits, 16);
    return error == std::errc() && last == end ? std::optional(number_of_bits(bits)) : std::nullopt;
}

Rounded round_to_binary32(const mpq_class& q) {
    if (q == 0) {
        return {0.0F, true};
    }
    const float sign = sgn(q) < 0 ? -1.0F : 1.0F;
    if (mpz_size(q.get_num_mpz_t()) == 1 && mpz_size(q.get_den_mpz_t()) == 1) {
        if (const std::optional<Rounded> narrow = round_narrow(
                sign, mpz_getlimbn(q.get_num_mpz_t(), 0), mpz_getlimbn(q.get_den_mpz_t(), 0))) {
            return *narrow;
        }
    }
    return round_wide(q);
}

Rounded round_wide(const mpq_class& q) {
    const float sign = sgn(q) < 0 ? -1.0F : 1.0F;
    const long exponent = floor_log2(q);
    if (exponent >= kOverflowExponent) {
        return {sign * std::numeric_limits<float>::infinity(), false};
    }
    // The unit in the last place; |q| / unit < 2^24.
    const long unit = std::max<long>(exponent - (kPrecision - 1), kMinExponent);
    mpz_class num = abs(q.get_num());
    mpz_class den = q.get_den();
    if (unit >= 0) {
        den <<= static_cast<unsigned long>(unit);
    } else {
        num <<= static_cast<unsigned long>(-unit);
    }
    mpz_class n;
    mpz_class rest;
    mpz_fdiv_qr(n.get_mpz_t(), rest.get_mpz_t(), num.get_mpz_t(), den.get_mpz_t());
    const bool is_exact = rest == 0;
    rest *= 2;
    const int half = cmp(rest, den);
    if (half > 0 || (half == 0 && mpz_odd_p(n.get_mpz_t()) != 0)) {
        n += 1;
    }
    return rounded(sign, n.get_d(), unit, is_exact);
}

Rounded round_to_binary32(const Number& n) {
    if (n.non_finite) {
        return {std::bit_cast<float>(*n.non_finite), true};
    }
    if (n.value == 0 && n.negative_zero) {
        return {-0.0F, true};
    }
    return round_to_binary32(n.value);
}

Neighbours neighbours(const mpq_class& q) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const float nearest = round_to_binary32(q).value;
    if (std::isinf(nearest)) {
        constexpr float kMax = std::numeric_limits<float>::max();
        return nearest > 0 ? Neighbours{kMax, kInfinity} : Neighbours{-kInfinity, -kMax};
    }
    if (exact(static_cast<double>(nearest)) < q) {
        return {nearest, std::nextafter(nearest, kInfinity)};
    }
    return {std::nextafter(nearest, -kInfinity), nearest};
}

mpq_class exact(double value) {
    return mpq_class(value);
}

std::string shortest(float value) {
    return fmt::format("{}", value);
}

}  // namespace cases
