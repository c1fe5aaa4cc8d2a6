// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the text leaves to a blend unit (ref/color/blend.hpp): the order of its computation, and how
// it decodes what an sRGB target holds.
#include <gmock/gmock.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>

#include "ref/color/blend.hpp"

namespace ref::color {
namespace {

using cases::ColorFormat;
using cases::Profile;

Color color_with(const std::array<double, 4>& values) {
    return {point(values[0]), point(values[1]), point(values[2]), point(values[3])};
}

// Of r32-float: what a unit leaves of 1 - 2^-24 on 1 with the factors 1/2 and 1 - 1/2.
Interval halves(cases::BlendOp op, cases::BlendFactor source, cases::BlendFactor destination) {
    cases::ColorOutput output;
    output.blend.emplace();
    output.blend->color = {source, destination, op};
    output.blend->constants = glm::vec4(0.5F);
    const double s = 1 - 0x1p-24;
    return Unit{ColorFormat::r32_float, Profile::direct3d}
        .write(output, color_with({s, s, s, s}), color_with({1, 1, 1, 1}))
        .front();
}

TEST(BlendOrder, AProductOfASumIsAnotherOrder) {
    using enum cases::BlendFactor;
    using enum cases::BlendOp;
    // s + d = 2 - 2^-24 lies between the numbers 2 - 2^-23 and 2, halves of which are 1 - 2^-24 and
    // 1: s minus these is 0 or -2^-24. In the order of the text it is -2^-25.
    for (const auto& [f, g] : {std::pair(constant_color, one_minus_constant_color),
                               std::pair(one_minus_constant_color, constant_color)}) {
        const Interval less = halves(subtract, f, g), more = halves(reverse_subtract, f, g);
        EXPECT_EQ(less.low, mpq_class(-0x1p-24));
        EXPECT_EQ(less.high, 0);
        EXPECT_EQ(more.low, 0);
        EXPECT_EQ(more.high, mpq_class(0x1p-24));
    }
    // With the same factor twice it is half of s - d, which is exact; with other ones there is
    // nothing to save.
    for (const cases::BlendFactor g : {constant_color, constant_alpha}) {
        const Interval plain = halves(subtract, constant_color, g);
        EXPECT_EQ(plain.low, mpq_class(-0x1p-25));
        EXPECT_EQ(plain.high, plain.low);
    }
}

// 1 - 1 is 0, so d + 1 (s - d) is an order of s + 0 d as well, and the only one of the two in which
// d counts. 1/4 + 2^-25 less -1 lies between 5/4 and 5/4 + 2^-23.
TEST(BlendOrder, OneAndZeroAreAFactorAndOneMinusIt) {
    using enum cases::BlendFactor;
    for (const bool is_source_one : {true, false}) {
        cases::ColorOutput output;
        output.blend.emplace();
        output.blend->color = {is_source_one ? one : zero, is_source_one ? zero : one,
                               cases::BlendOp::add};
        const double taken = 0.25 + 0x1p-25, other = -1;
        const double s = is_source_one ? taken : other, d = is_source_one ? other : taken;
        const Interval left = Unit{ColorFormat::r32_float, Profile::vulkan}
                                  .write(output, color_with({s, s, s, s}), color_with({d, d, d, d}))
                                  .front();
        EXPECT_EQ(left.low, mpq_class(0.25));
        EXPECT_EQ(left.high, mpq_class(0.25 + 0x1p-23));
    }
}

// A target without alpha has 1 for it, whatever names it, as has alpha after alpha to one, and a
// saturated alpha of alpha.
TEST(BlendOrder, StateMakesOneOfAFactor) {
    using enum cases::BlendFactor;
    const double s = 0.25 + 0x1p-25;
    const auto left = [&](ColorFormat format, cases::BlendEquation color, bool is_one,
                          double alpha = -1) {
        cases::ColorOutput output;
        output.blend.emplace();
        output.blend->color = output.blend->alpha = color;
        output.alpha_to_one = is_one;
        return Unit{format, Profile::vulkan}.write(output, color_with({s, s, s, s}),
                                                   color_with({-1, -1, -1, alpha}));
    };
    const auto is_open = [](const Interval& v) {
        return v.low == mpq_class(0.25) && v.high == mpq_class(0.25 + 0x1p-23);
    };
    const cases::BlendEquation target{dst_alpha, zero, cases::BlendOp::add};
    EXPECT_TRUE(is_open(left(ColorFormat::r32_float, target, false, 1)[0]));
    EXPECT_FALSE(is_open(left(ColorFormat::rgba32_float, target, false, 1)[0]));
    const cases::BlendEquation source{src_alpha, zero, cases::BlendOp::add};
    EXPECT_TRUE(is_open(left(ColorFormat::rgba32_float, source, true)[0]));
    EXPECT_FALSE(is_open(left(ColorFormat::rgba32_float, source, false)[0]));
    const cases::BlendEquation saturated{src_alpha_saturate, zero, cases::BlendOp::add};
    EXPECT_TRUE(is_open(left(ColorFormat::rgba32_float, saturated, false)[3]));
}

// 3e38 - 1e38 is a number, and d + (s - d) may be one beside 3e38.
TEST(BlendOrder, DifferencesThatDoNotOverflowAreComputed) {
    cases::ColorOutput output;
    output.blend.emplace();
    output.blend->color = {cases::BlendFactor::one, cases::BlendFactor::zero, cases::BlendOp::add};
    const auto width = [&](double s, double d) {
        const Interval v = Unit{ColorFormat::r32_float, Profile::vulkan}
                               .write(output, color_with({s, s, s, s}), color_with({d, d, d, d}))
                               .front();
        return mpq_class(v.high - v.low);
    };
    const double s = 0x1.c00002p127, d = 0x1.4p20;
    EXPECT_GT(width(s, d), 0);
    EXPECT_EQ(width(0x1.fffffep127, -0x1.fffffep127), 0);  // their difference is beyond binary32
}

TEST(BlendOrder, OfAlphaAColorIsItsAlpha) {
    using enum cases::BlendFactor;
    cases::ColorOutput output;
    output.blend.emplace();
    output.blend->color = {constant_color, one_minus_constant_alpha, cases::BlendOp::subtract};
    output.blend->alpha = output.blend->color;
    output.blend->constants = glm::vec4(0.5F);
    const double s = 1 - 0x1p-24;
    const Color left = Unit{ColorFormat::rgba32_float, Profile::direct3d}.write(
        output, color_with({s, s, s, s}), color_with({1, 1, 1, 1}));
    EXPECT_EQ(left[0].low, mpq_class(-0x1p-25));  // of red the factors are two things
    EXPECT_EQ(left[3].low, mpq_class(-0x1p-24));
}

// Half of 60000 twice is 0. 120000 is beyond binary16, whose dynamic range is what is asked for.
TEST(BlendOrder, SumsThatOverflowAreNotComputed) {
    cases::ColorOutput output;
    output.blend.emplace();
    output.blend->color = {cases::BlendFactor::constant_color,
                           cases::BlendFactor::one_minus_constant_color, cases::BlendOp::subtract};
    output.blend->constants = glm::vec4(0.5F);
    const Color half = color_with({60000, 30000, 0, 0});
    const Color left = Unit{ColorFormat::rgba16_float, Profile::direct3d}.write(output, half, half);
    EXPECT_EQ(left[0].low, 0);
    EXPECT_EQ(left[0].high, 0);
}

// 3/4 of 1 and of 1.25 * 2^-24: by two products 3/4 + 2^-24, or the number below it; by one 1 +
// 2^-23 may be the sum.
TEST(BlendOrder, AFactorThatBothHaveIsAnotherOrder) {
    cases::ColorOutput output;
    output.blend.emplace();
    output.blend->color = {cases::BlendFactor::constant_color, cases::BlendFactor::constant_color,
                           cases::BlendOp::add};
    output.blend->constants = glm::vec4(0.75F);
    const Interval sum = Unit{ColorFormat::r32_float, Profile::direct3d}
                             .write(output, color_with({1, 1, 1, 1}),
                                    color_with({0x1.4p-24, 0x1.4p-24, 0x1.4p-24, 0x1.4p-24}))
                             .front();
    EXPECT_EQ(sum.low, mpq_class(0.75));
    EXPECT_EQ(sum.high, mpq_class(0.75 + 0x1p-23));
}

TEST(BlendOrder, WhatAnSrgbTargetHoldsIsDecodedFirst) {
    const Unit unit{ColorFormat::rgba8_srgb, Profile::direct3d};
    cases::ColorOutput output;
    output.blend.emplace();
    output.blend->color = {cases::BlendFactor::one, cases::BlendFactor::one,
                           cases::BlendOp::reverse_subtract};
    const auto left = [&](double source, uint32_t code) {
        mpq_class held;
        Component(cases::component_of(unit.format, 0)).value_of(code, held);
        const Color before = {point(held), point(held), point(held), point(0)};
        return unit.write(output, color_with({source, source, source, 0}), before);
    };
    const auto allows = [&](const Color& color, uint32_t code) {
        return unit.allows(color, {code, code, code, unit.codes_of(color)[3]});
    };
    // Code 120 is the number 0.18782; half a code less and more is 0.1860 and 0.1896.
    // The source is code 110.1, so that 0.1559 to 0.1590 is subtracted, or a code more of the
    // product: 0.0240 to 0.0337, codes 42.7 to 51.5.
    const Color dark = left(0.15625, 120);
    EXPECT_FALSE(allows(dark, 41));
    EXPECT_TRUE(allows(dark, 50));
    EXPECT_TRUE(allows(dark, 51));
    EXPECT_TRUE(allows(dark, 52));
    EXPECT_FALSE(allows(dark, 53));
    // Nothing added leaves the code; 0 and 1 are decoded exactly.
    const Color same = left(0, 120);
    EXPECT_TRUE(allows(same, 120));
    EXPECT_FALSE(allows(same, 119) || allows(same, 121));
    output.blend->color.op = cases::BlendOp::subtract;
    EXPECT_EQ(left(0, 0).front().high, 0);
    // Code 120.3 is the smaller one for a device that decodes 120 as 120.4; it stores 121, or 120.
    mpq_class held;
    Component(cases::component_of(unit.format, 0)).value_of(120, held);
    output.blend->color.op = cases::BlendOp::min;
    EXPECT_TRUE(allows(left(held.get_d() * 1.005, 120), 121));
    EXPECT_FALSE(allows(left(held.get_d() * 1.005, 120), 122));
    EXPECT_FALSE(allows(left(held.get_d() * 1.2, 120), 121));
}

// A source of 0 to 2^-23 on 1 + 2^-12: a source within that is cut off by the difference, and the
// sum is a unit of binary32 below what both ends give.
TEST(BlendOrder, BetweenTheEndsOfAnIntervalRoundingGoesOn) {
    cases::ColorOutput output;
    output.blend.emplace();
    output.blend->color = {cases::BlendFactor::constant_color,
                           cases::BlendFactor::one_minus_constant_color, cases::BlendOp::add};
    const float f = 0x1p-11F, g = 1 - f, d = 1 + 0x1p-12F;
    output.blend->constants = glm::vec4(f);
    const Interval source{0, mpq_class(0x1p-23)};
    const Unit unit{ColorFormat::r32_float, Profile::direct3d};
    const auto y = static_cast<double>(d);
    const Color allowed =
        unit.write(output, {source, source, source, source}, color_with({y, y, y, y}));
    for (int part = 0; part <= 64; ++part) {
        const float s = std::ldexp(static_cast<float>(part), -23 - 6);
        const float by_sum = s + g * (d - s);
        EXPECT_TRUE(unit.allows(allowed, {std::bit_cast<uint32_t>(by_sum)})) << part;
        EXPECT_TRUE(unit.allows(allowed, {std::bit_cast<uint32_t>(d + f * (s - d))})) << part;
    }
    EXPECT_FALSE(unit.allows(allowed, {std::bit_cast<uint32_t>(1 - 0x1p-12F - 0x1p-20F)}));
    EXPECT_FALSE(unit.allows(allowed, {std::bit_cast<uint32_t>(1 - 0x1p-12F + 0x1p-20F)}));
}

// Interpolated colours are intervals: a unit has some number of them.
RC_GTEST_PROP(BlendOrder, AllowsBinary32UnitsOfOneProductOfAnyNumber, ()) {
    const auto number = [] {
        return static_cast<float>(*rc::gen::inRange(-1000000, 1200000)) / 1000000.0F;
    };
    const float low = number() * 0x1p-20F, width = std::fabs(number()) * 0x1p-22F;
    const float part = std::fabs(number());
    const float s = std::min(low + part * width, low + width), d = number();
    const float f = std::ldexp(number(), *rc::gen::inRange(-14, 1)), g = 1 - f;
    cases::ColorOutput output;
    output.blend.emplace();
    output.blend->color = {cases::BlendFactor::constant_color,
                           cases::BlendFactor::one_minus_constant_color, cases::BlendOp::add};
    output.blend->constants = glm::vec4(f);
    const Unit unit{ColorFormat::r32_float, Profile::direct3d};
    const Interval of_source{mpq_class(static_cast<double>(low)),
                             mpq_class(static_cast<double>(low + width))};
    const auto y = static_cast<double>(d);
    const Color allowed =
        unit.write(output, {of_source, of_source, of_source, of_source}, color_with({y, y, y, y}));
    RC_ASSERT(unit.allows(allowed, {std::bit_cast<uint32_t>(d + f * (s - d))}));
    RC_ASSERT(unit.allows(allowed, {std::bit_cast<uint32_t>(s + g * (d - s))}));
    RC_ASSERT(!unit.allows(allowed, {std::bit_cast<uint32_t>(d + f * (s - d) + 0x1p-16F)}));
}

// A unit that saves a product where the factors are f and 1 - f.
RC_GTEST_PROP(BlendOrder, AllowsBinary32UnitsOfOneProduct, ()) {
    const auto number = [] {
        return static_cast<float>(*rc::gen::inRange(-100000, 1200000)) / 1000000.0F;
    };
    const float s = number(), d = number(), f = number(), g = 1 - f;
    const auto op = *rc::gen::element(cases::BlendOp::add, cases::BlendOp::subtract,
                                      cases::BlendOp::reverse_subtract);
    const bool is_first = *rc::gen::arbitrary<bool>();
    const bool is_less = op != cases::BlendOp::add;
    const float sum = is_less ? s + d : is_first ? s - d : d - s;
    float got =
        is_first ? (is_less ? f * sum - d : d + f * sum) : (is_less ? s - g * sum : s + g * sum);
    got = op == cases::BlendOp::reverse_subtract ? -got : got;
    cases::ColorOutput output;
    output.blend.emplace();
    output.blend->color = {cases::BlendFactor::constant_color,
                           cases::BlendFactor::one_minus_constant_color, op};
    output.blend->constants = glm::vec4(f);
    const Unit unit{ColorFormat::r32_float, Profile::direct3d};
    const auto x = static_cast<double>(s), y = static_cast<double>(d);
    const Color allowed = unit.write(output, color_with({x, x, x, x}), color_with({y, y, y, y}));
    RC_ASSERT(unit.allows(allowed, {std::bit_cast<uint32_t>(got)}));
    RC_ASSERT(!unit.allows(allowed, {std::bit_cast<uint32_t>(got + 0x1p-18F)}));
}

}  // namespace
}  // namespace ref::color
