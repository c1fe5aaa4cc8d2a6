// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// FragCoord.z of a draw with a depth bias, worked out by hand.
#include <gtest/gtest.h>

#include "ref/value/reference.hpp"
#include "tests/unit/ref/value_case.hpp"

namespace ref::test {
namespace {

using cases::Profile;

// A triangle of depth 1/2 over half of the 4x4 target.
cases::Case level_half() {
    const auto vertex = [](double x, double y) { return value_test::clip_of(x, y, 0.5, 1, 4); };
    return value_test::make_case(4, {vertex(0, 0), vertex(4, 0), vertex(0, 4)});
}

// FragCoord.z has the bias or not: 1/2 or, with 2^20 2^-24, 9/16. Half of a bias is neither, and
// nor is a tenth of it, or a tenth more.
TEST(FragCoordBias, IsAllOfItOrNone) {
    cases::Case c = level_half();
    const auto accepts_z = [&](double z, Profile profile, bool is_oracle) {
        ValueReference values(c, Limits{}, profile);
        FragmentValues device;
        device.frag_coord = {0.5F, 0.5F, static_cast<float>(z), 1};
        device.depth = 0.5625F;
        const FragmentVerdict verdict =
            is_oracle ? values.judge_exact(0, {0, 0, 0}, device, FragmentPart::all_but_depth)
                      : values.judge(0, {0, 0, 0}, device, FragmentPart::all_but_depth);
        return verdict.ok;
    };
    for (const double sign : {1.0, -1.0}) {
        c.draws[0].depth.bias = cases::DepthBias{static_cast<float>(sign * 0x1p20), 0, 0};
        for (const Profile profile : {Profile::practice, Profile::direct3d}) {
            for (const bool is_oracle : {false, true}) {
                for (const double part : {0.0, 1.0}) {
                    EXPECT_TRUE(accepts_z(0.5 + sign * part / 16, profile, is_oracle)) << part;
                }
                for (const double part : {-0.1, 0.1, 0.5, 0.9, 1.1}) {
                    EXPECT_FALSE(accepts_z(0.5 + sign * part / 16, profile, is_oracle)) << part;
                }
            }
            ValueReference values(c, Limits{}, profile);
            const ValueRange range = values.range(0, {0, 0, 0}, QuantityId::of_frag_coord(2));
            ASSERT_TRUE(range.is_promised && range.has_biased);
            EXPECT_TRUE(range.low <= 0.5 && range.high >= 0.5 && range.high - range.low < 1e-5);
            const double biased = 0.5 + sign / 16;
            EXPECT_TRUE(range.biased_low <= biased && range.biased_high >= biased &&
                        range.biased_high - range.biased_low < 1e-5);
        }
    }
    // Both numbers are told: of what is right, and of what is wrong.
    ValueReference values(c, Limits{}, Profile::direct3d);
    for (const ExpectedValue& e : values.expected(0, {0, 0, 0})) {
        if (e.quantity == QuantityId::of_frag_coord(2)) {
            EXPECT_EQ(e.also, "or 0.4375 with the bias");
        }
    }
    FragmentValues device;
    device.frag_coord = {0.5F, 0.5F, 0.46875F, 1};
    const FragmentVerdict verdict = values.judge(0, {0, 0, 0}, device, FragmentPart::all_but_depth);
    ASSERT_EQ(verdict.mismatches.size(), 1U);
    const std::string& expected = verdict.mismatches[0].expected;
    EXPECT_TRUE(expected.starts_with("0.5 = 1/2 within ")) << expected;
    EXPECT_TRUE(expected.ends_with(", or 0.4375 or near it with the bias")) << expected;
    // Both answers are clamped where depth is.
    c.draws[0].depth.bias = cases::DepthBias{0x1p20F, 0, 0};
    c.draws[0].depth.clamp = true;
    c.draws[0].viewport.max_depth = 0.28125F;  // 9/64 without bias
    c.draws[0].depth.bias->clamp = 0.25F;
    c.draws[0].depth.bias->constant = 0x1p26F;
    for (const double z : {0.140625, 0.390625, 0.28125}) {
        EXPECT_TRUE(accepts_z(z, Profile::direct3d, false)) << z;
    }
    EXPECT_FALSE(accepts_z(0.25, Profile::direct3d, false));
    EXPECT_FALSE(accepts_z(0.375, Profile::direct3d, false));
}

}  // namespace
}  // namespace ref::test
