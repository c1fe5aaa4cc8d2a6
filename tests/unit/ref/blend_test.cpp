// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The intervals of ref/color/blend.hpp hold what every legal blend unit computes (an integer unit
// of the destination's width, binary32, binary64), by hand and by property; and little more.
#include "ref/color/blend.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>

namespace ref::color {
namespace {

using cases::BlendFactor;
using cases::BlendOp;
using cases::ColorFormat;
using cases::Profile;

Color color_of(const std::array<double, 4>& values) {
    return {point(values[0]), point(values[1]), point(values[2]), point(values[3])};
}

cases::ColorOutput alpha_blend() {
    cases::ColorOutput out;
    out.blend =
        cases::Blend{{BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha, BlendOp::add},
                     {BlendFactor::one, BlendFactor::one_minus_src_alpha, BlendOp::add}};
    return out;
}

TEST(Store, UnormIsOneOfTheTwoNearestCodes) {
    const Component eight({cases::ComponentKind::unorm, 8});
    const auto codes = [&](double value, Profile profile) {
        return eight.text_of(eight.stored(point(value), profile, false));
    };
    EXPECT_EQ(codes(0, Profile::vulkan), "0");
    EXPECT_EQ(codes(1, Profile::vulkan), "255");
    EXPECT_EQ(codes(-3, Profile::vulkan), "0");
    EXPECT_EQ(codes(7, Profile::vulkan), "255");
    EXPECT_EQ(codes(0.5, Profile::vulkan), "127 to 128");    // r = 127.5
    EXPECT_EQ(codes(0.5, Profile::direct3d), "127 to 128");  // both within 0.6
    EXPECT_EQ(codes(0.25, Profile::vulkan), "63 to 64");     // r = 63.75
    EXPECT_EQ(codes(0.25, Profile::direct3d), "64");
    // The trap: 100/255 in binary32 is 100.00000056.../255.
    const double trap = static_cast<double>(100.0F / 255.0F);
    EXPECT_EQ(codes(trap, Profile::vulkan), "100 to 101");
    EXPECT_EQ(codes(trap, Profile::direct3d), "100");
}

TEST(Store, HalvesAndFloats) {
    const Component half({cases::ComponentKind::half, 16});
    EXPECT_EQ(half.either(point(1)), point(1));
    EXPECT_EQ(half.either(point(mpq_class(1, 3))),
              (Interval{mpq_class(1365, 4096), mpq_class(683, 2048)}));
    EXPECT_EQ(half.either(point(mpq_class(-1, 3))),
              (Interval{mpq_class(-683, 2048), mpq_class(-1365, 4096)}));
    EXPECT_EQ(half.either(point(mpq_class(3, 1 << 25))),  // below the smallest denormal, 2^-24
              (Interval{mpq_class(1, 1 << 24), mpq_class(1, 1 << 23)}));
    mpq_class value;
    EXPECT_TRUE(half.value_of(0xc000, value));
    EXPECT_EQ(value, -2);
    EXPECT_TRUE(half.value_of(0x0001, value));
    EXPECT_EQ(value, mpq_class(1, 1 << 24));
    EXPECT_FALSE(half.value_of(0x7c00, value));
    EXPECT_FALSE(half.value_of(0x7e00, value));
    const Component binary32({cases::ComponentKind::binary32, 32});
    EXPECT_FALSE(binary32.value_of(0x7fc00000, value));
    rc::check("every binary32 is its own neighbour and its code means it", [&](uint32_t bits) {
        const auto f = std::bit_cast<float>(bits);
        RC_PRE(std::isfinite(f));
        mpq_class v;
        RC_ASSERT(binary32.value_of(bits, v));
        RC_ASSERT(v == mpq_class(static_cast<double>(f)));
        RC_ASSERT(binary32.either(point(v)) == point(v));
        // Between neighbours only they are allowed.
        const float next = std::nextafter(f, 1e38F);
        if (f < next && std::isfinite(next)) {
            const mpq_class w(static_cast<double>(next));
            RC_ASSERT((binary32.either(point((v + w) / 2)) == Interval{v, w}));
        }
    });
}

// What a hunt tells colours by that a format of 16-bit floats cannot hold.
TEST(Store, KnowsWhatMayOverflow) {
    const Unit unit{ColorFormat::rgba16_float, Profile::vulkan};
    const auto may_overflow = [&](double low, double high) {
        Color color = color_of({0, 0, 0, 0});
        color[3] = {mpq_class(low), mpq_class(high)};
        return unit.may_overflow(color);
    };
    EXPECT_TRUE(may_overflow(65504, 131072));
    EXPECT_TRUE(may_overflow(65504, 81920));
    EXPECT_TRUE(may_overflow(-81920, -65504));
    // Blending may end within the range, or far beyond it.
    EXPECT_TRUE(may_overflow(-4514752, -65472));
    EXPECT_FALSE(may_overflow(-4514752, 65472));
    EXPECT_FALSE(may_overflow(-4514752, -1));
    EXPECT_FALSE(may_overflow(0, 70000));
    EXPECT_FALSE(may_overflow(1, 1));
    EXPECT_FALSE(may_overflow(-65504, -65472));
    for (const uint32_t code : {0x7fffU, 0x7d00U, 0xfd00U, 0x7c00U}) {
        EXPECT_TRUE(unit.has_overflown({0, 0, code, 0})) << code;
    }
    EXPECT_FALSE(unit.has_overflown({0, 0x7bff, 0x3c00, 0}));
    EXPECT_FALSE((Unit{ColorFormat::rgba8_unorm, Profile::vulkan}.has_overflown({255, 0, 0, 0})));
}

// Beyond the largest half, 65504 = (2 - 2^-10) 2^15: that one, or infinity, of the value's sign.
// The exponent of a device that adds 15 and forgets the limit runs into NaN or back to small
// numbers.
TEST(Store, HalvesThatOverflow) {
    const Unit unit{ColorFormat::rgba16_float, Profile::vulkan};
    const auto allows = [&](double value, uint32_t code) {
        const Color color =
            unit.write(cases::ColorOutput{}, color_of({value, 0, 0, 0}), color_of({0, 0, 0, 0}));
        return unit.allows(color, {code, 0, 0, 0});
    };
    constexpr uint32_t kLargest = 0x7bff, kInfinity = 0x7c00, kSign = 0x8000;
    for (const double value : {65505.0, 65519.0, 65520.0, 65536.0, 70000.0, 1e9, 1e30}) {
        for (const uint32_t sign : {0U, kSign}) {
            const double v = sign == 0 ? value : -value;
            EXPECT_TRUE(allows(v, sign | kLargest)) << v;
            EXPECT_TRUE(allows(v, sign | kInfinity)) << v;
            EXPECT_FALSE(allows(v, (sign ^ kSign) | kLargest)) << v;
            EXPECT_FALSE(allows(v, (sign ^ kSign) | kInfinity)) << v;
            for (const uint32_t wrong :
                 {0x7bfeU, 0x7c01U, 0x7ce2U, 0x7e00U, 0x7fffU, 0x0400U, 0U}) {
                EXPECT_FALSE(allows(v, sign | wrong)) << v << " as " << wrong;
            }
        }
    }
    // The largest half itself is exact, and what lies below it has two neighbours.
    EXPECT_TRUE(allows(65504, kLargest));
    EXPECT_FALSE(allows(65504, kInfinity));
    EXPECT_FALSE(allows(65504, kLargest - 1));
    EXPECT_TRUE(allows(65503, kLargest));
    EXPECT_TRUE(allows(65503, kLargest - 1));
    EXPECT_FALSE(allows(65503, kInfinity));
}

TEST(Store, SrgbEncodesColourAndNotAlpha) {
    const Unit unit{ColorFormat::rgba8_srgb, Profile::vulkan};
    const Color before = unit.cleared({ColorFormat::rgba8_srgb, {0, 0, 0, 0}});
    const Color out = unit.write({}, color_of({0.5, 0, 1, 0.5}), before);
    // 255 * (1.055 * 0.5^(1/2.4) - 0.055) = 187.52; alpha 127.5.
    EXPECT_EQ(unit.text_of(out), "r 187 to 188, g 0, b 255, a 127 to 128");
    for (uint32_t code = 0; code < 256; ++code) {
        const Component srgb({cases::ComponentKind::srgb, 8});
        mpq_class value;
        ASSERT_TRUE(srgb.value_of(code, value));
        EXPECT_EQ(srgb.either(point(value)), point(value)) << code;
    }
}

TEST(Blend, ByHand) {
    // 8 bits: 0.5 over white; a is 127 or 128 of 255. Blue: 128 * 128 / 255 = 64.25, so at most 65
    // + 128.
    const Unit unit{ColorFormat::rgba8_unorm, Profile::vulkan};
    const Color white = unit.cleared({ColorFormat::rgba8_unorm, {1, 1, 1, 1}});
    EXPECT_EQ(unit.text_of(unit.write(alpha_blend(), color_of({0, 1, 0.5, 0.5}), white)),
              "r 127 to 128, g 254 to 255, b 190 to 193, a 254 to 255");
    // binary32: exact where every step is representable.
    const Unit exact{ColorFormat::rgba32_float, Profile::vulkan};
    const Color before = exact.cleared({ColorFormat::rgba32_float, {0.5F, 4, -2, 1}});
    EXPECT_EQ(exact.text_of(exact.write(alpha_blend(), color_of({1, 8, 2, 0.25}), before)),
              "r 0.625, g 5, b -1, a 1");
}

// A denormal number of binary32 may be taken for 0 or become it, and the smallest normal one may
// not; a blend unit alone is free to, and halves are held to their denormals.
TEST(Blend, DenormalsOfBinary32MayBeZero) {
    cases::ColorOutput output;
    output.blend = cases::Blend{{BlendFactor::one, BlendFactor::one, BlendOp::add},
                                {BlendFactor::one, BlendFactor::one, BlendOp::max}};
    const Unit unit{ColorFormat::rgba32_float, Profile::direct3d};
    const Color before = color_of({0, 0x1p-127, 0x1p-126, -0x1p-149});
    const Color out = unit.write(output, color_of({-0x1p-149, 0, 0, -0x1p-149}), before);
    EXPECT_EQ(out[0], (Interval{mpq_class(-0x1p-149), 0}));
    EXPECT_EQ(out[1], (Interval{0, mpq_class(0x1p-127)}));
    EXPECT_EQ(out[2], point(0x1p-126));
    EXPECT_EQ(out[3], (Interval{mpq_class(-0x1p-149), 0}));
    output.blend.reset();
    EXPECT_EQ(unit.write(output, color_of({-0x1p-149, 0, 0, 0}), before)[0], point(-0x1p-149));
    output.blend = cases::Blend{{BlendFactor::one, BlendFactor::one, BlendOp::add}, {}};
    const Unit halves{ColorFormat::rgba16_float, Profile::direct3d};
    EXPECT_EQ(halves.write(output, color_of({0x1p-24, 0, 0, 0}), color_of({0, 0, 0, 0}))[0],
              point(0x1p-24));
}

TEST(Blend, MaskedComponentsAndMissingOnes) {
    const Unit unit{ColorFormat::r5g6b5_unorm, Profile::vulkan};
    const Color before = unit.cleared({ColorFormat::r5g6b5_unorm, {0, 1, 0, 0}});
    cases::ColorOutput output;
    output.write_mask = 0b101;
    EXPECT_EQ(unit.text_of(unit.write(output, color_of({1, 0, 1, 0}), before)), "r 31, g 63, b 31");
    // A target without alpha has destination alpha 1.
    output.write_mask = 0xf;
    output.blend = cases::Blend{{BlendFactor::dst_alpha, BlendFactor::zero, BlendOp::add}, {}};
    EXPECT_EQ(unit.text_of(unit.write(output, color_of({1, 0, 1, 0}), before)), "r 31, g 0, b 31");
    output.write_mask = 0b010;
    EXPECT_EQ(unit.text_of(unit.write(output, color_of({1, 0, 1, 0}), before)), "r 0, g 0, b 0");
}

TEST(Blend, MinAndMaxIgnoreFactors) {
    const Unit unit{ColorFormat::rgba8_unorm, Profile::vulkan};
    const Color before = unit.cleared({ColorFormat::rgba8_unorm, {0, 1, 0, 1}});
    cases::ColorOutput output;
    output.blend = cases::Blend{{BlendFactor::zero, BlendFactor::zero, BlendOp::max},
                                {BlendFactor::zero, BlendFactor::zero, BlendOp::min}};
    EXPECT_EQ(unit.text_of(unit.write(output, color_of({1, 0, 0, 0}), before)),
              "r 255, g 255, b 0, a 0");
}

// Infinity times 0 and infinity less infinity are NaN: nothing is known of what comes of them,
// until it is replaced. Red overflows where it is stored, green in two products.
TEST(Blend, NothingIsKnownOfInfinity) {
    const Unit unit{ColorFormat::rg16_float, Profile::vulkan};
    const Color before = unit.write({}, color_of({70000, 60000, 0, 1}), {});
    EXPECT_EQ(unit.text_of(before), "r 65504 to 70000, g 60000");
    cases::ColorOutput output;
    output.blend = cases::Blend{{BlendFactor::constant_color, BlendFactor::zero, BlendOp::add}, {}};
    const Color after = unit.write(output, color_of({1, 1, 0, 1}), before);
    EXPECT_EQ(unit.text_of(after), "r anything, g 0");
    EXPECT_TRUE(unit.allows(after, {0x7e00, 0, 0, 0}));   // NaN
    EXPECT_FALSE(unit.allows(after, {0x7e00, 1, 0, 0}));  // green is known
    // Minimum and maximum compute nothing, so that infinity is a number to them.
    output.blend->color.op = BlendOp::min;
    EXPECT_EQ(unit.text_of(unit.write(output, color_of({1, 1, 0, 1}), before)), "r 1, g 1");
    EXPECT_EQ(unit.text_of(unit.write(output, color_of({1, 1, 0, 1}), after)), "r anything, g 0");
    EXPECT_EQ(unit.text_of(unit.write({}, color_of({1, 1, 0, 1}), after)), "r 1, g 1");
    output.blend = cases::Blend{
        {BlendFactor::constant_color, BlendFactor::constant_color, BlendOp::subtract}, {}};
    output.blend->constants = {1, 2, 1, 1};
    EXPECT_EQ(unit.text_of(unit.write(output, color_of({1, 60000, 0, 1}), before)),
              "r anything, g anything");
}

// A half that may have become infinity on the way: whichever of the factors it is, and where the
// product alone overflows.
TEST(Blend, NothingIsKnownOfAnInfiniteFactor) {
    const Unit unit{ColorFormat::rg16_float, Profile::vulkan};
    const Color source = color_of({0, 1, 0, 1}), before = color_of({0, 1, 0, 1});
    cases::ColorOutput output;
    output.blend = cases::Blend{{BlendFactor::src1_color, BlendFactor::zero, BlendOp::add}, {}};
    output.blend->second = {70000, 0.5F, 0, 1};
    EXPECT_EQ(unit.text_of(unit.write(output, source, before)), "r anything, g 0.5");
    output.blend->color.source = BlendFactor::one_minus_src1_color;
    EXPECT_EQ(unit.text_of(unit.write(output, source, before)), "r anything, g 0.5");
    output.blend->color.source = BlendFactor::src1_alpha;  // 1: the red one does not take part
    EXPECT_EQ(unit.text_of(unit.write(output, source, before)), "r 0, g 1");
    output.blend->second.w = 70000;
    EXPECT_EQ(unit.text_of(unit.write(output, source, before)), "r anything, g anything");
    // 2 * 60000 - 60000 is 60000, or 65504 - 60000, or infinity.
    output.blend->color = {BlendFactor::constant_color, BlendFactor::one, BlendOp::subtract};
    output.blend->constants = {2, 1, 1, 1};
    const Color large = color_of({60000, 60000, 0, 1});
    const Color difference = unit.write(output, large, large);
    EXPECT_EQ(unit.text_of(difference), "r 5504 to 120000, g 0");
    EXPECT_TRUE(unit.allows(difference, {0x7c00, 0, 0, 0}));   // infinity
    EXPECT_FALSE(unit.allows(difference, {0xfc00, 0, 0, 0}));  // minus infinity
    output.blend->color.op = BlendOp::reverse_subtract;
    EXPECT_TRUE(unit.allows(unit.write(output, large, large), {0xfc00, 0, 0, 0}));
}

// By hand: 1/4 * 1/2 + 3/4 * (1 - 1/8) and so on, exact in binary32.
TEST(Blend, SecondSource) {
    const Unit unit{ColorFormat::rgba32_float, Profile::vulkan};
    cases::ColorOutput output;
    output.blend =
        cases::Blend{{BlendFactor::src1_color, BlendFactor::one_minus_src1_alpha, BlendOp::add},
                     {BlendFactor::one_minus_src1_color, BlendFactor::src1_alpha, BlendOp::add}};
    output.blend->second = {0.5F, 2.0F, -1.0F, 0.125F};
    const Color out =
        unit.write(output, color_of({0.25, 0.5, 1, 0.75}), color_of({0.75, 1, 0.5, 8}));
    EXPECT_EQ(out[0], point(mpq_class(25, 32)));  // 1/8 + 21/32
    EXPECT_EQ(out[1], point(mpq_class(15, 8)));   // 1 + 7/8
    EXPECT_EQ(out[2], point(mpq_class(-9, 16)));  // -1 + 7/16
    EXPECT_EQ(out[3], point(mpq_class(53, 32)));  // 3/4 * 7/8 + 8 * 1/8
    // Fixed point: 2 and -1 are 1 and 0.
    const Unit fixed{ColorFormat::rgba8_unorm, Profile::vulkan};
    output.blend->color = {BlendFactor::one_minus_src1_color, BlendFactor::src1_color,
                           BlendOp::add};
    output.blend->second.x = -1;
    output.blend->second.w = 1;
    EXPECT_EQ(fixed.text_of(fixed.write(output, color_of({1, 0, 1, 0}), color_of({0, 1, 0, 1}))),
              "r 255, g 255, b 255, a 255");
}

TEST(Blend, AlphaToOneIsOfTheFirstSourceAlone) {
    const Unit unit{ColorFormat::rgba32_float, Profile::vulkan};
    cases::ColorOutput output;
    output.alpha_to_one = true;
    const Color before = color_of({0.5, 0.5, 0.5, 0.25});
    EXPECT_EQ(unit.write(output, color_of({1, 0, 1, -3}), before), color_of({1, 0, 1, 1}));
    output.blend = cases::Blend{{BlendFactor::src_alpha, BlendFactor::src1_alpha, BlendOp::add},
                                {BlendFactor::src1_alpha, BlendFactor::zero, BlendOp::add}};
    output.blend->second = {0, 0, 0, 0.125F};
    // 1/4 + 1/16 and 1 * 1/8
    EXPECT_EQ(unit.write(output, color_of({0.25, 0.25, 0.25, 0.5}), before),
              color_of({0.3125, 0.3125, 0.3125, 0.125}));
    output.blend.reset();
    const Unit integers{ColorFormat::rgba8_uint, Profile::vulkan};
    EXPECT_EQ(integers.text_of(integers.write(output, color_of({1, 2, 3, 200}), before)),
              "r 1, g 2, b 3, a 200");
}

// A blend unit written for this test: numbers of type T, rounded after every step by `round`.
template <class T, class Round>
std::array<T, 4> simulate(const cases::Blend& blend, std::array<T, 4> s, std::array<T, 4> d,
                          bool clamps, Round round) {
    const auto fit = [&](T v) { return round(clamps ? std::clamp(v, T(0), T(1)) : v); };
    std::array<T, 4> c{}, t{};
    for (size_t k = 0; k < 4; ++k) {
        s[k] = fit(s[k]);
        c[k] = fit(static_cast<T>(blend.constants[static_cast<int>(k)]));
        t[k] = fit(static_cast<T>(blend.second[static_cast<int>(k)]));
    }
    const auto factor = [&](BlendFactor f, size_t k) -> T {
        const std::array<T, 7> of = {0, s[k], d[k], s[3], d[3], c[k], c[3]};
        const auto number = static_cast<size_t>(f);
        if (f == BlendFactor::src_alpha_saturate) {
            return k == 3 ? T(1) : std::min(s[3], round(T(1) - d[3]));
        }
        if (cases::is_second(f)) {
            const T value = f == BlendFactor::src1_color || f == BlendFactor::one_minus_src1_color
                                ? t[k]
                                : t[3];
            return number % 2 == 1 ? value : round(T(1) - value);
        }
        const T value = of[number / 2];
        return number % 2 == 0 ? value : round(T(1) - value);
    };
    // zero, one, then pairs (value, one minus value): 2k is the value of kind k, but 0 is zero.
    std::array<T, 4> out{};
    for (size_t k = 0; k < 4; ++k) {
        const cases::BlendEquation& e = k == 3 ? blend.alpha : blend.color;
        const T a = round(s[k] * factor(e.source, k));
        const T b = round(d[k] * factor(e.destination, k));
        switch (e.op) {
            case BlendOp::add:
                out[k] = fit(a + b);
                break;
            case BlendOp::subtract:
                out[k] = fit(a - b);
                break;
            case BlendOp::reverse_subtract:
                out[k] = fit(b - a);
                break;
            case BlendOp::min:
                out[k] = std::min(s[k], d[k]);
                break;
            case BlendOp::max:
                out[k] = std::max(s[k], d[k]);
                break;
        }
    }
    return out;
}

cases::Blend any_blend() {
    cases::Blend blend;
    for (cases::BlendEquation* e : {&blend.color, &blend.alpha}) {
        e->source = static_cast<BlendFactor>(*rc::gen::inRange(0, 19));
        e->destination = static_cast<BlendFactor>(*rc::gen::inRange(0, 19));
        e->op = static_cast<BlendOp>(*rc::gen::inRange(0, 5));
    }
    for (int k = 0; k < 4; ++k) {
        blend.constants[k] = static_cast<float>(*rc::gen::inRange(-64, 320)) / 256.0F;
        blend.second[k] = static_cast<float>(*rc::gen::inRange(-64, 320)) / 256.0F;
    }
    return blend;
}

std::array<float, 4> any_color() {
    std::array<float, 4> out{};
    for (float& v : out) {
        v = static_cast<float>(*rc::gen::inRange(-100, 1200)) / 1000.0F;
    }
    return out;
}

RC_GTEST_PROP(Blend, AllowsEveryEightBitUnit, ()) {
    const Unit unit{ColorFormat::rgba8_unorm, Profile::direct3d};
    const cases::Blend blend = any_blend();
    const std::array<float, 4> source = any_color();
    std::array<uint32_t, 4> codes{};
    std::array<double, 4> d{}, s{};
    Color before;
    for (size_t k = 0; k < 4; ++k) {
        codes[k] = static_cast<uint32_t>(*rc::gen::inRange(0, 256));
        d[k] = codes[k] / 255.0;
        before[k] = point(mpq_class(codes[k]) / 255);
        s[k] = static_cast<double>(source[k]);
    }
    cases::ColorOutput output;
    output.blend = blend;
    const Color allowed = unit.write(output, color_of({s[0], s[1], s[2], s[3]}), before);
    // Units that round each step to nearest, down, up, or not at all. A whole number of units that
    // binary64 misses by its rounding is that number.
    const std::array<double (*)(double), 4> roundings = {
        [](double v) { return std::nearbyint(v * 255) / 255; },
        [](double v) { return std::floor(v * 255 + 1e-9) / 255; },
        [](double v) { return std::ceil(v * 255 - 1e-9) / 255; }, [](double v) { return v; }};
    for (const auto& round : roundings) {
        const auto out = simulate<double>(blend, s, d, true, round);
        std::array<uint32_t, 4> got{};
        for (size_t k = 0; k < 4; ++k) {
            got[k] = static_cast<uint32_t>(std::nearbyint(out[k] * 255));
        }
        RC_ASSERT(unit.allows(allowed, got));
    }
    // And little more: at most three units either way of the exact result.
    const auto exact = simulate<double>(blend, s, d, true, roundings[3]);
    for (size_t k = 0; k < 4; ++k) {
        RC_ASSERT(allowed[k].low.get_d() * 255 >= exact[k] * 255 - 5);
        RC_ASSERT(allowed[k].high.get_d() * 255 <= exact[k] * 255 + 5);
    }
}

RC_GTEST_PROP(Blend, AllowsBinary32UnitsAndNothingFarFromThem, ()) {
    const Unit unit{ColorFormat::rgba32_float, Profile::direct3d};
    const cases::Blend blend = any_blend();
    const std::array<float, 4> s = any_color();
    const std::array<float, 4> d = any_color();
    Color before, source;
    for (size_t k = 0; k < 4; ++k) {
        before[k] = point(static_cast<double>(d[k]));
        source[k] = point(static_cast<double>(s[k]));
    }
    cases::ColorOutput output;
    output.blend = blend;
    const Color allowed = unit.write(output, source, before);
    const auto got = simulate<float>(blend, s, d, false, [](float v) { return v; });
    std::array<uint32_t, 4> codes{};
    for (size_t k = 0; k < 4; ++k) {
        codes[k] = std::bit_cast<uint32_t>(got[k]);
    }
    RC_ASSERT(unit.allows(allowed, codes));
    for (size_t k = 0; k < 4; ++k) {
        auto wrong = codes;
        wrong[k] = std::bit_cast<uint32_t>(got[k] + 0x1p-18F);
        RC_ASSERT(!unit.allows(allowed, wrong));
    }
}

}  // namespace
}  // namespace ref::color
