// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Logical operations against their table in the Vulkan specification, by hand and by trying all
// codes; and what stays off beside them.
#include "ref/color/logic.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "ref/color/blend.hpp"

namespace ref::color {
namespace {

using cases::ColorFormat;
using cases::LogicOp;

constexpr uint32_t kOps = 16;

Color color_of(const std::array<double, 4>& values) {
    return {point(values[0]), point(values[1]), point(values[2]), point(values[3])};
}

cases::ColorOutput output_of(LogicOp op) {
    cases::ColorOutput out;
    out.logic = op;
    return out;
}

TEST(Logic, TheTableOfTheSpecification) {
    constexpr uint32_t s = 0b1100, d = 0b1010;
    const std::pair<LogicOp, uint32_t> table[] = {
        {LogicOp::clear, 0b0000},         {LogicOp::and_both, 0b1000},
        {LogicOp::and_reverse, 0b0100},   {LogicOp::copy, 0b1100},
        {LogicOp::and_inverted, 0b0010},  {LogicOp::no_op, 0b1010},
        {LogicOp::exclusive_or, 0b0110},  {LogicOp::or_both, 0b1110},
        {LogicOp::nor, 0b0001},           {LogicOp::equivalent, 0b1001},
        {LogicOp::invert, 0b0101},        {LogicOp::or_reverse, 0b1101},
        {LogicOp::copy_inverted, 0b0011}, {LogicOp::or_inverted, 0b1011},
        {LogicOp::nand, 0b0111},          {LogicOp::set, 0b1111}};
    for (uint32_t k = 0; k < kOps; ++k) {
        EXPECT_EQ(table[k].first, static_cast<LogicOp>(k));
        EXPECT_EQ(operated(table[k].first, s, d, 4), table[k].second) << k;
    }
    EXPECT_EQ(operated(LogicOp::nor, 0, 0, 10), 0x3ffU);
    EXPECT_EQ(operated(LogicOp::set, 0, 0, 32), UINT32_MAX);
}

RC_GTEST_PROP(Logic, IntervalsHoldWhatTheirCodesLeaveAndEndThere, ()) {
    const Component five({cases::ComponentKind::unorm, 5});
    const auto op = static_cast<LogicOp>(*rc::gen::inRange(0U, kOps));
    const auto range = [] {
        const uint32_t a = *rc::gen::inRange(0U, 32U), b = *rc::gen::inRange(0U, 32U);
        return std::pair(std::min(a, b), std::max(a, b));
    };
    const auto interval = [&](std::pair<uint32_t, uint32_t> codes) {
        Interval out;
        five.value_of(codes.first, out.low);
        five.value_of(codes.second, out.high);
        return out;
    };
    const auto source = range(), before = range();
    const Interval left = operated(op, five, interval(source), interval(before));
    bool meets_low = false, meets_high = false;
    for (uint32_t s = source.first; s <= source.second; ++s) {
        for (uint32_t d = before.first; d <= before.second; ++d) {
            const uint32_t code = operated(op, s, d, 5);
            RC_ASSERT(five.allows(code, left));
            meets_low = meets_low || interval({code, code}).low == left.low;
            meets_high = meets_high || interval({code, code}).high == left.high;
        }
    }
    RC_ASSERT(meets_low && meets_high);
}

TEST(Logic, OfManyPairsNothingIsClaimed) {
    const Component sixteen({cases::ComponentKind::unorm, 16});
    const Interval left = operated(LogicOp::clear, sixteen, {0, 1}, {0, 1});
    EXPECT_EQ(left, (Interval{0, 1}));
}

TEST(Logic, NothingIsBlendedBesideIt) {
    const Unit unit{ColorFormat::rgba8_unorm, cases::Profile::vulkan};
    cases::ColorOutput output = output_of(LogicOp::exclusive_or);
    output.blend = cases::Blend{{cases::BlendFactor::zero, cases::BlendFactor::zero}, {}, {}};
    const Color out = unit.write(output, color_of({1, 1, 0, 0}), color_of({1, 0, 1, 0}));
    EXPECT_EQ(unit.text_of(out), "r 0, g 255, b 255, a 0");
    output.write_mask = 0b1010;
    const Color masked = unit.write(output, color_of({1, 1, 0, 1}), color_of({1, 0, 1, 1}));
    EXPECT_EQ(unit.text_of(masked), "r 255, g 255, b 255, a 0");
}

TEST(Logic, IntegersOfAllWidths) {
    const Unit unit{ColorFormat::r32_uint, cases::Profile::vulkan};
    const Color out =
        unit.write(output_of(LogicOp::nor), color_of({0xc0, 0, 0, 0}), color_of({0x0c, 0, 0, 0}));
    EXPECT_EQ(unit.text_of(out), "r 4294967091");  // 0xffffff33
    EXPECT_TRUE(unit.allows(out, {0xffffff33, 0, 0, 0}));
    EXPECT_FALSE(unit.allows(out, {0x33, 0, 0, 0}));
}

// Alpha of an sRGB format is stored as UNORM, but the format has no logical operations.
TEST(Logic, FloatsAndSrgbAreWrittenAsTheyAre) {
    for (const ColorFormat format :
         {ColorFormat::rgba8_srgb, ColorFormat::rgba16_float, ColorFormat::rgba32_float}) {
        EXPECT_FALSE(takes_logic(format));
        const Unit unit{format, cases::Profile::vulkan};
        for (uint32_t k = 0; k < kOps; ++k) {
            cases::ColorOutput output = output_of(static_cast<LogicOp>(k));
            output.blend = cases::Blend{{cases::BlendFactor::one, cases::BlendFactor::one},
                                        {cases::BlendFactor::one, cases::BlendFactor::one},
                                        {}};
            const Color out = unit.write(output, color_of({1, 0, 1, 0}), color_of({0, 1, 1, 1}));
            EXPECT_EQ(out, color_of({1, 0, 1, 0})) << k;
        }
    }
    for (const ColorFormat format :
         {ColorFormat::rgba8_unorm, ColorFormat::r5g6b5_unorm, ColorFormat::rgba8_uint}) {
        EXPECT_TRUE(takes_logic(format));
    }
}

}  // namespace
}  // namespace ref::color
