// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Expressions are exact; rounding to binary32 is to nearest, ties to even.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "cases/toml/binary32.hpp"
#include "cases/toml/expression.hpp"

namespace cases {

namespace {

mpq_class q(const char* text) {
    mpq_class value(text);
    value.canonicalize();
    return value;
}

Names with_k() {
    Names names;
    names.known = {"k"};
    names.find = [](std::string_view word) -> std::optional<Number> {
        return word == "k" ? std::optional(Number{mpq_class(7), false}) : std::nullopt;
    };
    return names;
}

uint32_t bits(const Rounded& r) {
    return std::bit_cast<uint32_t>(r.value);
}

mpq_class power_of_two(int exponent) {
    mpz_class one = 1;
    one <<= static_cast<unsigned long>(std::abs(exponent));
    return exponent >= 0 ? mpq_class(one) : mpq_class(1, one);
}

TEST(SpecialNumber, BitsArriveAsWritten) {
    const std::pair<const char*, uint32_t> rows[] = {
        {"nan", 0x7fc00000U},
        {"-nan", 0xffc00000U},
        {"inf", 0x7f800000U},
        {"-inf", 0xff800000U},
        {"bits(0x7fa00001)", 0x7fa00001U},  // signalling
        {"bits(0xFFC12345)", 0xffc12345U},
        {"bits(0x00000001)", 1U},
        {"bits(0x80000000)", 0x80000000U},
        {"bits(0x3f800000)", 0x3f800000U},
    };
    for (const auto& [text, bits] : rows) {
        const std::optional<Number> n = read_special_number(text);
        ASSERT_TRUE(n) << text;
        const Rounded rounded = round_to_binary32(*n);
        EXPECT_EQ(std::bit_cast<uint32_t>(rounded.value), bits) << text;
        EXPECT_TRUE(rounded.exact) << text;
    }
}

TEST(SpecialNumber, NothingElseIsOne) {
    for (const char* text :
         {"", "NaN", "nan ", "+inf", "bits(0x1)", "bits(0x7fc000001)", "bits(7fc00001)",
          "bits(0x7fc0000g)", "bits(0x7fc00001", "bits(0x-fc00001)"}) {
        EXPECT_FALSE(read_special_number(text)) << text;
    }
}

}  // namespace

TEST(Expression, HasExactValues) {
    const std::pair<const char*, const char*> rows[] = {
        {"0", "0"},
        {"42", "42"},
        {"0.1", "1/10"},
        {".5", "1/2"},
        {"5.", "5"},
        {"1e3", "1000"},
        {"1.25E-2", "1/80"},
        {"3+17/256", "785/256"},
        {"1-2-3", "-4"},
        {"12/2/3", "2"},
        {"2*3+4*5", "26"},
        {"2*(3+4)*5", "70"},
        {"-2^2", "-4"},
        {"(-2)^2", "4"},
        {"2^-20", "1/1048576"},
        {"2^k", "128"},
        {"2^(k-9)", "1/4"},
        {"(2/3)^-2", "9/4"},
        {"- - 3", "3"},
        {"0x1.8p-1", "3/4"},
        {"0XAp+1", "20"},
        {"0x.8", "1/2"},
        {"0x1.fffffep127", "340282346638528859811704183484516925440"},
        {"0x1p-149", "1/713623846352979940529142984724747568191373312"},
        {"0.1f", "13421773/134217728"},
        {"1/k", "1/7"},
        {" k * ( 1 + k ) ", "56"},
    };
    for (const auto& [text, value] : rows) {
        const tl::expected<Number, std::string> n = evaluate(text, with_k());
        ASSERT_TRUE(n) << text << ": " << n.error();
        EXPECT_EQ(n->value, q(value)) << text;
    }
}

TEST(Expression, KeepsTheSignOfZero) {
    EXPECT_TRUE(evaluate("-0", {})->negative_zero);
    EXPECT_TRUE(evaluate("-0.0", {})->negative_zero);
    EXPECT_FALSE(evaluate("0", {})->negative_zero);
    EXPECT_FALSE(evaluate("--0", {})->negative_zero);
    EXPECT_FALSE(evaluate("1-1", {})->negative_zero);
    EXPECT_EQ(bits(round_to_binary32(*evaluate("-0", {}))), 0x80000000U);
}

TEST(Expression, SaysWhatIsWrong) {
    const std::string many(65, '(');
    const std::pair<std::string, std::string> rows[] = {
        {"", "\"\" is not a number: the end stands where a number is expected"},
        {"3+", "\"3+\" is not a number: the end stands where a number is expected"},
        {"3 4", "\"3 4\" is not a number: '4' stands where an operator or the end is expected"},
        {"(3", "\"(3\" is not a number: the end stands where ')' is expected"},
        {"3)", "\"3)\" is not a number: ')' stands where an operator or the end is expected"},
        {"*3", "\"*3\" is not a number: '*' stands where a number is expected"},
        {"1/0", "\"1/0\" is not a number: it divides by zero"},
        {"1/(k-7)", "\"1/(k-7)\" is not a number: it divides by zero"},
        {"0^-1", "\"0^-1\" is not a number: it divides by zero"},
        {"2^0.5", "\"2^0.5\" is not a number: an exponent is an integer of at most 4096"},
        {"2^5000", "\"2^5000\" is not a number: an exponent is an integer of at most 4096"},
        {"1e5000", "\"1e5000\" is not a number: an exponent is an integer of at most 4096"},
        {"9^4096^2",
         "\"9^4096^2\" is not a number: '^' stands where an operator or the end is "
         "expected"},
        {"(9^4096)^4096", "\"(9^4096)^4096\" is not a number: it needs more than 16384 bits"},
        {"1e", "\"1e\" is not a number: the end stands where an exponent is expected"},
        {"0x", "\"0x\" is not a number: the end stands where a digit is expected"},
        {"0x1q", "\"0x1q\" is not a number: 'q' stands where an operator or the end is expected"},
        {"1.2.3", "\"1.2.3\" is not a number: '.' stands where an operator or the end is expected"},
        {".", "\".\" is not a number: the end stands where a digit is expected"},
        {"1x", "\"1x\" is not a number: 'x' stands where an operator or the end is expected"},
        {"1e40f", "\"1e40f\" is not a number: a number with f is larger than the largest binary32"},
        {"inf", "\"inf\" is not a number: inf is no number here"},
        {"nan", "\"nan\" is not a number: nan is no number here"},
        {"kk", "\"kk\" is not a number: the name kk is unknown; did you mean k?"},
        {"zebra",
         "\"zebra\" is not a number: the name zebra is unknown; names are the keys of "
         "[matrix]"},
        {"1\x01",
         "\"1\x01\" is not a number: the byte 0x01 stands where an operator or the end is "
         "expected"},
        {many, "\"" + many + "\" is not a number: it nests deeper than 64 levels"},
        {std::string(65, '-') + "1",
         "\"" + std::string(65, '-') + "1\" is not a number: it nests deeper than 64 levels"},
    };
    for (const auto& [text, message] : rows) {
        const tl::expected<Number, std::string> n = evaluate(text, with_k());
        ASSERT_FALSE(n) << text;
        EXPECT_EQ(n.error(), message);
    }
}

TEST(Binary32, RoundsTiesToEven) {
    const mpq_class half_unit = power_of_two(-24);  // half a unit in the last place of 1
    EXPECT_EQ(bits(round_to_binary32(mpq_class(1 + half_unit))), 0x3f800000U);
    EXPECT_EQ(bits(round_to_binary32(mpq_class(1 + 3 * half_unit))), 0x3f800002U);
    EXPECT_EQ(bits(round_to_binary32(mpq_class(1 + half_unit + power_of_two(-200)))), 0x3f800001U);
    EXPECT_EQ(bits(round_to_binary32(mpq_class(1 + half_unit - power_of_two(-200)))), 0x3f800000U);
    EXPECT_EQ(bits(round_to_binary32(mpq_class(-1 - 3 * half_unit))), 0xbf800002U);
    // A tie that carries into the next power of two.
    EXPECT_EQ(bits(round_to_binary32(mpq_class(2 - half_unit))), 0x40000000U);
}

TEST(Binary32, RoundsSubnormals) {
    EXPECT_EQ(bits(round_to_binary32(power_of_two(-149))), 1U);
    EXPECT_EQ(bits(round_to_binary32(power_of_two(-150))), 0U);  // a tie to even
    EXPECT_EQ(bits(round_to_binary32(mpq_class(3 * power_of_two(-150)))), 2U);
    EXPECT_EQ(bits(round_to_binary32(mpq_class(power_of_two(-150) + power_of_two(-300)))), 1U);
    EXPECT_EQ(bits(round_to_binary32(mpq_class(-power_of_two(-1000)))), 0x80000000U);
    EXPECT_EQ(bits(round_to_binary32(mpq_class(power_of_two(-126) - power_of_two(-150)))),
              0x00800000U);  // the largest subnormal's upper tie
    EXPECT_FALSE(round_to_binary32(power_of_two(-150)).exact);
    EXPECT_TRUE(round_to_binary32(power_of_two(-149)).exact);
}

TEST(Binary32, OverflowsAtHalfAUnitBeyondTheLargest) {
    const mpq_class largest = power_of_two(128) - power_of_two(104);
    EXPECT_EQ(bits(round_to_binary32(largest)), 0x7f7fffffU);
    EXPECT_TRUE(round_to_binary32(largest).exact);
    EXPECT_EQ(bits(round_to_binary32(mpq_class(largest + power_of_two(103) - 1))), 0x7f7fffffU);
    EXPECT_EQ(bits(round_to_binary32(mpq_class(largest + power_of_two(103)))), 0x7f800000U);
    EXPECT_EQ(bits(round_to_binary32(mpq_class(-power_of_two(5000)))), 0xff800000U);
    EXPECT_FALSE(round_to_binary32(power_of_two(128)).exact);
}

TEST(Binary32, AgreesWithTheProcessorOnEveryDouble) {
    EXPECT_TRUE(rc::check("a double rounds as its conversion does", [](uint64_t pattern) {
        const auto value = std::bit_cast<double>(pattern);
        RC_PRE(std::isfinite(value));
        const Rounded rounded = round_to_binary32(Number{exact(value), std::signbit(value)});
        const auto expected = static_cast<float>(value);
        RC_ASSERT(bits(rounded) == std::bit_cast<uint32_t>(expected));
        RC_ASSERT(rounded.exact == (exact(static_cast<double>(0.0F)) == exact(value) ||
                                    (std::isfinite(expected) &&
                                     exact(static_cast<double>(expected)) == exact(value))));
    }));
}

// Numerators and denominators of every length up to 64 bits and a little more, ties between two
// binary32 and numbers beside them, subnormals, and what overflows.
TEST(Binary32, IsTheSameIn128BitsAndInRationals) {
    std::mt19937_64 random(20261122);
    const auto whole = [&random](unsigned long most) -> mpz_class {
        mpz_class n = random() >> (random() % 64);
        if (random() % 4 == 0) {
            n = (n >> 40 << 1) + 1;  // short and odd
        }
        return mpz_class(n << (random() % most)) + (random() % 8 == 0 ? 1 : 0);
    };
    size_t ties = 0;
    size_t subnormal = 0;
    for (int n = 0; n < 200000; ++n) {
        mpz_class num = whole(3) + 1;
        mpz_class den = whole(3) + 1;
        if (n % 4 == 1) {  // a tie or next to one
            num = (mpz_class(random() % (1U << 24U)) << 1) + 1;
            den = 1;
            num <<= random() % 30;
            num += n % 8 == 1 ? 0 : 1;
            mpz_mul_2exp(den.get_mpz_t(), den.get_mpz_t(), random() % 63);
        } else if (n % 4 == 2) {  // some far below 1, some far above
            num <<= random() % 140;
            den <<= random() % 200;
        }
        mpq_class q(num, den);
        q.canonicalize();
        q = n % 3 == 0 ? mpq_class(-q) : q;
        const Rounded want = round_wide(q);
        const Rounded got = round_to_binary32(q);
        ASSERT_EQ(std::bit_cast<uint32_t>(got.value), std::bit_cast<uint32_t>(want.value)) << q;
        ASSERT_EQ(got.exact, want.exact) << q;
        subnormal += std::fpclassify(want.value) == FP_SUBNORMAL ? 1U : 0U;
        if (!want.exact && std::isfinite(want.value)) {
            const Neighbours near = neighbours(q);
            ties += 2 * q == exact(double{near.below}) + exact(double{near.above}) ? 1U : 0U;
        }
    }
    EXPECT_GT(ties, 1000U);
    EXPECT_GT(subnormal, 100U);
}

TEST(Binary32, NeighboursEnclose) {
    EXPECT_TRUE(rc::check("below < q < above, one unit apart", [](int64_t num, uint32_t den) {
        RC_PRE(den != 0);
        mpq_class value(mpz_class(static_cast<long>(num)), mpz_class(den));
        value.canonicalize();
        RC_PRE(!round_to_binary32(value).exact);
        const Neighbours n = neighbours(value);
        RC_ASSERT(exact(static_cast<double>(n.below)) < value);
        RC_ASSERT(value < exact(static_cast<double>(n.above)));
        const float up = std::nextafter(n.below, std::numeric_limits<float>::infinity());
        RC_ASSERT(std::bit_cast<uint32_t>(up) == std::bit_cast<uint32_t>(n.above) ||
                  std::fpclassify(n.above) == FP_ZERO);
    }));
    EXPECT_TRUE(std::isinf(neighbours(power_of_two(200)).above));
    EXPECT_TRUE(std::isinf(neighbours(mpq_class(-power_of_two(200))).below));
}

TEST(Binary32, TextsReadBackAsTheSameNumber) {
    EXPECT_TRUE(rc::check("hexadecimal and shortest decimal with f", [](uint32_t pattern) {
        const auto value = std::bit_cast<float>(pattern);
        RC_PRE(std::isfinite(value));
        const std::string decimal = shortest(value) + "f";
        const tl::expected<Number, std::string> n = evaluate(decimal, {});
        if (!n) {
            RC_FAIL(n.error());
        }
        RC_ASSERT(bits(round_to_binary32(*n)) == pattern);
    }));
}

}  // namespace cases
