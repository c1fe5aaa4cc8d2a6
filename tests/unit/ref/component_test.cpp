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
                // UNORM is a rounded quotient; get_d() truncates.
                const mpq_class off = abs(mpq_class(number) - exact);
                const bool is_rounded = format.kind == ComponentKind::unorm;
                wrong += is_rounded ? off * 0x1p53 > exact : off != 0;
            }
        });
        EXPECT_EQ(wrong, 0U);
    });
}

TEST(ExhaustiveComponent, TheCodeOfItsValueIsTheCode) {
    for_each_component([](const Component& component, const cases::ComponentFormat& format) {
        const uint32_t sign = format.kind == ComponentKind::half ? 0x8000U : 0x80000000U;
        size_t wrong = 0;
        for_each_code(format.bits, [&](uint32_t code) {
            mpq_class value;
            if (component.value_of(code, value) &&
                !(is_floating(format.kind) && code == sign)) {  // -0 is 0
                wrong += component.code_of(value) != code ? 1U : 0U;
                wrong += component.may_convert(point(value), code) ? 0U : 1U;
                const Interval read = component.read(code);
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
