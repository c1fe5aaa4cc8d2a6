// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a stored code means, in every format: binary64 against rationals, and codes there and back.
#include "ref/color/component.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace ref::color {
namespace {

using cases::ComponentKind;
using cases::Profile;

// All codes of up to 16 bits; of 32 bits every code near the borders of its exponents, and more.
template <class Visit>
void for_each_code(uint32_t bits, const Visit& visit) {
    if (bits <= 16) {
        for (uint32_t code = 0; code < 1U << bits; ++code) {
            visit(code);
        }
        return;
    }
    for (uint64_t at = 0; at <= 0x100000000U; at += 0x10001U) {
        visit(static_cast<uint32_t>(at));
    }
    for (uint64_t at = 0; at <= 0x100000000U; at += 0x800000U) {
        for (uint32_t k = 0; k < 7; ++k) {
            visit(static_cast<uint32_t>(at + k - 3));
        }
    }
}

// Each kind of component once.
template <class Visit>
void for_each_component(const Visit& visit) {
    std::set<std::pair<ComponentKind, uint32_t>> seen;
    for (const cases::ColorFormatRow& row : cases::kColorFormats) {
        for (uint32_t k = 0; k < 4; ++k) {
            const cases::ComponentFormat format = cases::component_of(row.format, k);
            if (format.bits != 0 && seen.emplace(format.kind, format.bits).second) {
                SCOPED_TRACE(std::string(row.word) + " component " + std::to_string(k));
                visit(Component(format), format);
            }
        }
    }
}

}  // namespace

TEST(Component, BinarySixtyFourSaysWhatRationalsSay) {
    for_each_component([](const Component& component, const cases::ComponentFormat& format) {
        size_t wrong = 0;
        for_each_code(format.bits, [&](uint32_t code) {
            mpq_class exact;
            const bool is_number = component.value_of(code, exact);
            const double number = component.number(code);
            wrong += std::isfinite(number) != is_number ? 1U : 0U;
            if (is_number) {
                // UNORM and SNORM are rounded quotients; get_d() truncates.
                const mpq_class off = abs(mpq_class(number) - exact);
                const bool is_rounded =
                    format.kind == ComponentKind::unorm || format.kind == ComponentKind::snorm;
                wrong += is_rounded ? off * 0x1p53 > abs(exact) : off != 0;
            }
        });
        EXPECT_EQ(wrong, 0U);
    });
}

TEST(ExhaustiveComponent, TheCodeOfItsValueIsTheCode) {
    for_each_component([](const Component& component, const cases::ComponentFormat& format) {
        const uint32_t sign = 1U << (format.bits - 1);
        size_t wrong = 0;
        for_each_code(format.bits, [&](uint32_t code) {
            mpq_class value;
            if (component.value_of(code, value) &&
                !(is_floating(format.kind) && !component.is_unsigned_float() &&
                  code == sign)) {  // -0 is 0
                wrong += component.code_of(value) != code ? 1U : 0U;
                const bool is_beyond = format.kind == ComponentKind::snorm && value < -1;
                wrong += component.may_convert(point(value), code) != is_beyond ? 0U : 1U;
                const Interval read = component.read(code);
                // One code of SNORM lies below -1, and is read as that.
                value = format.kind == ComponentKind::snorm && value < -1 ? mpq_class(-1) : value;
                wrong += value < read.low || value > read.high ? 1U : 0U;
            }
        });
        EXPECT_EQ(wrong, 0U);
    });
}

TEST(Component, NearestCodesByHand) {
    const Component unorm({ComponentKind::unorm, 8});
    EXPECT_EQ(unorm.code_of(mpq_class(3, 510)), 2U);  // 1.5 of a step
    EXPECT_EQ(unorm.code_of(2), 255U);
    EXPECT_EQ(unorm.code_of(-1), 0U);
    const Component half({ComponentKind::half, 16});
    EXPECT_EQ(half.code_of(mpq_class(4097, 4096)), 0x3c00U);  // a quarter of a step above 1
    EXPECT_EQ(half.code_of(mpq_class(2049, 2048)), 0x3c01U);  // a half
    EXPECT_EQ(half.code_of(100000), 0x7bffU);
    EXPECT_EQ(half.code_of(-100000), 0xfbffU);
    const Component srgb({ComponentKind::srgb, 8});
    EXPECT_EQ(srgb.code_of(mpq_class(1, 2)), 188U);  // 1.055 * 0.5^(1/2.4) - 0.055 = 0.735357
    const Component integer({ComponentKind::uint, 8});
    EXPECT_EQ(integer.code_of(300), 255U);
    const Component whole({ComponentKind::sint, 8});
    EXPECT_EQ(whole.code_of(-2), 254U);
    EXPECT_EQ(whole.code_of(300), 127U);
}

// [Vulkan, "Conversion From Normalized Fixed-Point to Floating-Point"]: of 8 bits -127 is -1, and
// -128, which no number is stored as, is read as -1, too.
TEST(Component, SignedCodesByHand) {
    const Component snorm({ComponentKind::snorm, 8});
    EXPECT_EQ(snorm.code_of(-1), 0x81U);
    EXPECT_EQ(snorm.code_of(mpq_class(-1, 2)), 0xc1U);  // of -63.5 the upper one
    EXPECT_EQ(snorm.code_of(3), 127U);
    EXPECT_EQ(snorm.read(0x80), point(-1));
    EXPECT_EQ(snorm.read(0xff), point(mpq_class(-1, 127)));
    const Interval half = snorm.stored(point(mpq_class(-1, 2)), cases::Profile::vulkan, false);
    EXPECT_EQ(snorm.text_of(half), "-64 to -63");
    EXPECT_TRUE(snorm.allows(0xc0, half) && snorm.allows(0xc1, half));
    EXPECT_FALSE(snorm.allows(0xbf, half) || snorm.allows(0x40, half));
    const Interval least = snorm.stored(point(-7), cases::Profile::vulkan, false);
    EXPECT_TRUE(snorm.allows(0x81, least));
    EXPECT_FALSE(snorm.allows(0x80, least));
    // -0.3 of 127 is -38.1, and Direct3D's 0.6 of a unit reaches -38 alone.
    const Interval near = snorm.stored(point(mpq_class(-3, 10)), cases::Profile::direct3d, false);
    EXPECT_EQ(snorm.text_of(near), "-38");
}

// Khronos Data Format Specification: E of 5 bits, biased by 15; M of 6 bits is 64 to the unit, of 5
// bits 32.
TEST(Component, FloatsWithoutASignByHand) {
    const Component eleven({ComponentKind::half, 11}), ten({ComponentKind::half, 10});
    EXPECT_EQ(eleven.code_of(1), 15U << 6U);
    EXPECT_EQ(ten.code_of(mpq_class(33, 32)), 15U << 5U | 1U);
    EXPECT_EQ(eleven.code_of(mpq_class(1, 1 << 20)), 1U);  // 2^-14 / 64
    EXPECT_EQ(ten.code_of(-5), 0U);
    EXPECT_EQ(eleven.code_of(100000), 0x7bfU);
    EXPECT_DOUBLE_EQ(eleven.number(0x7bf), 65024);
    EXPECT_DOUBLE_EQ(ten.number(0x3df), 64512);
    const Interval negative = ten.stored(point(-3), cases::Profile::vulkan, false);
    EXPECT_EQ(negative, point(0));
    const Interval large = eleven.stored(point(65025), cases::Profile::vulkan, false);
    EXPECT_TRUE(eleven.allows(0x7bf, large) && eleven.allows(0x7c0, large));
    EXPECT_FALSE(eleven.allows(0x7c1, large));
    // 1.01 lies between 1 and 1 + 1/64, or 1 + 1/32.
    const Interval some = eleven.stored(point(mpq_class(101, 100)), cases::Profile::vulkan, false);
    EXPECT_EQ(some, (Interval{1, mpq_class(65, 64)}));
}

// [Vulkan, fundamentals-fp-conversion]: a finite number beyond the largest one "may be rounded
// either to the closest representable finite value or to the appropriately signed infinity".
TEST(Component, WhatATransferMayLeaveByHand) {
    const Component half({ComponentKind::half, 16});
    EXPECT_TRUE(half.may_convert(point(65536), 0x7bff));
    EXPECT_TRUE(half.may_convert(point(65536), 0x7c00));
    EXPECT_FALSE(half.may_convert(point(65536), 0xfc00));
    EXPECT_FALSE(half.may_convert(point(65504), 0x7c00));
    EXPECT_FALSE(half.may_convert(point(65536), 0x7e00));
    // Zero and one have exact codes in sRGB, too.
    const Component srgb({ComponentKind::srgb, 8});
    EXPECT_TRUE(srgb.may_convert(point(0), 0));
    EXPECT_FALSE(srgb.may_convert(point(0), 1));
    EXPECT_FALSE(srgb.may_convert(point(1), 254));
    EXPECT_TRUE(srgb.may_convert(point(mpq_class(1, 2)), 187));
    EXPECT_TRUE(srgb.may_convert(point(mpq_class(1, 2)), 188));
    EXPECT_FALSE(srgb.may_convert(point(mpq_class(1, 2)), 189));
    // 1.5 of a step has two neighbours, whatever Direct3D allows a shader's store.
    const Component unorm({ComponentKind::unorm, 8});
    EXPECT_TRUE(unorm.may_convert(point(mpq_class(3, 510)), 1));
    EXPECT_FALSE(unorm.may_convert(point(mpq_class(3, 510)), 3));
    const Component integer({ComponentKind::uint, 8});
    EXPECT_TRUE(integer.may_convert(point(300), 255));
    EXPECT_FALSE(integer.may_convert(point(300), 44));
}

}  // namespace ref::color
