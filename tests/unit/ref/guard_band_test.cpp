// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What devices with a guard band do to triangles that are cut: numbers that an NVIDIA H100 and an
// H200 (driver 580.159.04) left in single fragments, each shown by hand.
#include <gtest/gtest.h>

#include <bit>
#include <string>

#include "cases/load/loader.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"

namespace ref::test {
namespace {

using cases::Profile;

cases::Case case_of(const std::string& text) {
    const auto loaded = cases::load_text(
        "format = 1\ndescription = \"A case.\"\nrules = [\"cover.inside\"]\n" + text, "case.toml",
        "case");
    EXPECT_TRUE(loaded) << (loaded ? "" : loaded.error().front().message);
    return loaded ? loaded->front() : cases::Case{};
}

struct Numbers {
    float z, w, depth;
};
bool accepts(const cases::Case& c, uint32_t triangle, cases::SampleId id, const Numbers& n,
             bool is_oracle = false) {
    ValueReference values(c, Limits{}, Profile::direct3d);
    FragmentValues device;
    device.frag_coord = {0.5F, 0.5F, n.z, n.w};
    device.depth = n.depth;
    return (is_oracle ? values.judge_exact(triangle, id, device)
                      : values.judge(triangle, id, device))
        .ok;
}

// Cut by its clip distance alone, the triangle is (0.0625, 4.727) (0.0625, -4) (1.875, -5) and
// (0.264, 3.889), of which the first and the last are new and snap to 1210/256, 68/256 and 996/256.
// The device's 1/w is that of the plane through the last three at the pixel's centre, and nothing
// of it is cut by the viewport's border, which (1.875, -5) is beyond.
TEST(GuardBand, ValuesComeFromPiecesThatTheBordersDoNotCut) {
    const cases::Case c = case_of(R"(
[target]
size = [1, 1]
samples = 4
[[draw]]
depth = { bias = { slope = 1 } }
vertices = [[0.0625, 5, 0, 2], [0.0625, -4, 0, 0.25], [1.875, -5]]
[[draw.clip_distance]]
values = [-0.25, 1, 1]
)");
    const Numbers got{std::bit_cast<float>(0x3ec7ab3fU), std::bit_cast<float>(0x3fb3533eU),
                      std::bit_cast<float>(0x3efad028U)};
    for (const bool is_oracle : {false, true}) {
        EXPECT_TRUE(accepts(c, 0, {0, 0, 1}, got, is_oracle));
        EXPECT_FALSE(accepts(c, 0, {0, 0, 1}, {got.z, 1.75F, got.depth}, is_oracle));
        EXPECT_FALSE(accepts(c, 0, {0, 0, 1}, {got.z, got.w, got.depth + 0.125F}, is_oracle));
    }
}

// At the height of the sample the triangle is behind the eye or at most 3/4 * 7.34e-8 before it:
// 1/w is anything from 1.8e7 on. Exactly cut, nothing is left of it, and roundings leave a sliver.
TEST(GuardBand, WhatRoundingsLeaveHasNoHull) {
    const cases::Case c = case_of(R"(
[target]
size = [5, 1]
[[draw]]
vertices = [[-2, 1], [4, 0], [7, -1], [-3, -6, 0.5, -3], [-3, -6, 0.5, 2.75],
    [-3, -5.999999727521624]]
)");
    for (const Profile profile : cases::kProfiles) {
        ValueReference values(c, Limits{}, profile);
        FragmentValues device;
        device.frag_coord = {0.5F, 0.5F, 0.5F, std::bit_cast<float>(0x5ee1d10bU)};
        device.depth = 0.5F;
        EXPECT_TRUE(values.judge(1, {0, 0, 0}, device).ok) << cases::to_string(profile);
        EXPECT_TRUE(values.judge_exact(1, {0, 0, 0}, device).ok) << cases::to_string(profile);
        // Of a triangle that is there, it is no value at all.
        EXPECT_FALSE(values.judge(0, {0, 0, 0}, device).ok) << cases::to_string(profile);
        EXPECT_FALSE(values.judge_exact(0, {0, 0, 0}, device).ok) << cases::to_string(profile);
    }
}

// All depths are 0, which has no exponent: r is what a device makes of it, here 2^-125.
TEST(GuardBand, DepthsOfZeroHaveAUnitOfTheDevice) {
    const cases::Case c = case_of(R"(
[target]
size = [16, 16]
[[draw]]
viewport = { depth = [0, 0] }
depth = { bias = { constant = -131072 }, clamp = true }
vertices = [[0, 0, 0.109375], [11, 0, 0.0625], [0, 2, 0.203125]]
)");
    for (const bool is_oracle : {false, true}) {
        for (const float z : {0.0F, -0x1p-132F, -0x1p-108F}) {
            EXPECT_TRUE(accepts(c, 0, {0, 0, 0}, {z, 1, 0}, is_oracle)) << z;
        }
        EXPECT_FALSE(accepts(c, 0, {0, 0, 0}, {-0x1p-100F, 1, 0}, is_oracle));
    }
}

// The viewport begins at y = 1/4, and the sample at (3/8, 1/8) is drawn by a device that does not
// cut there: its depth lies beyond those of the polygon that is left below the border.
TEST(GuardBand, BesideABorderBetweenPixelsTheHullIsThatOfTheTriangle) {
    const cases::Case c = case_of(R"(
[target]
size = [1, 2]
samples = 4
[[draw]]
viewport = [-3, 0.25, 16, 16]
vertices = [[-6, -4], [24, 4], [2, 32], [-5, 1, 0], [16, -2], [2, -1]]
[[draw.clip_distance]]
half_space = [3, -3, 0, 0]
)");
    const Numbers got{std::bit_cast<float>(0x3d0fe53bU), 1, std::bit_cast<float>(0x3e27d7d8U)};
    EXPECT_TRUE(accepts(c, 1, {0, 0, 0}, got));
    EXPECT_FALSE(accepts(c, 1, {0, 0, 0}, {-0x1p-5F, got.w, got.depth}));
    EXPECT_FALSE(accepts(c, 1, {0, 0, 0}, {got.z, got.w, 0.6F}));
}

// Without depth clipping nothing cuts a triangle before w = 0, where z/w has no end: "the range of
// z values spanned by the primitive" has no maximum, and r may be anything from that of the corners
// on. With depth clipping it has one, and in fixed point r is a constant.
TEST(GuardBand, TheUnitOfABiasHasNoEndWhereZHasNone) {
    const auto text = [](const std::string& states, const std::string& target) {
        return "[target]\nsize = [1, 1]\n" + target + "[[draw]]\n" + states +
               "vertices = [[1, 0], [1, -0.25, 1, -2], [-0.25, 1]]\n";
    };
    const cases::Case open =
        case_of(text("depth = { bias = { constant = 1 }, clip = false }\n", ""));
    const auto accepts_z = [](const cases::Case& c, float z) {
        ValueReference values(c, Limits{}, Profile::direct3d);
        const ValueRange range = values.range(0, {0, 0, 0}, QuantityId::of_frag_coord(2));
        const auto has = [&](double low, double high) {
            return low <= static_cast<double>(z) && static_cast<double>(z) <= high;
        };
        return has(range.low, range.high) ||
               (range.has_biased && has(range.biased_low, range.biased_high));
    };
    const float huge = std::bit_cast<float>(0x52ffffffU);  // 2^39 - 2^15
    EXPECT_TRUE(accepts_z(open, huge));
    EXPECT_FALSE(accepts_z(open, -huge));
    EXPECT_FALSE(accepts_z(case_of(text("depth = { bias = { constant = 1 } }\n", "")), huge));
    EXPECT_FALSE(accepts_z(case_of(text("depth = { bias = { constant = 1 }, clip = false }\n",
                                        "depth = \"d16-unorm\"\n")),
                           huge));
}

// z/w is 1/2 throughout, and the volume -w <= z <= w, so that the near plane cuts where w is 0: a
// corner of what is left has 0/0 for its depth. An H100 has a unit of 2^15 there
// (docs/results/README.md).
TEST(GuardBand, ADepthPlaneThatCutsAtTheEyeBoundsNoUnit) {
    const auto text = [](const std::string& z) {
        return "[target]\nsize = [1, 1]\n[[draw]]\ndepth = { bias = { constant = 1 } }\n"
               "depth_volume = \"negative-one-to-one\"\n"
               "vertices = [[2, 1], [8, -2], [8, 2, " +
               z + ", -3.25]]\n";
    };
    const float seen = 32768.75F;
    EXPECT_TRUE(accepts(case_of(text("0.5")), 0, {0, 0, 0}, {seen, 1.40865385F, seen}));
    EXPECT_TRUE(accepts(case_of(text("0.5")), 0, {0, 0, 0}, {seen, 1.40865385F, seen}, true));
    EXPECT_FALSE(accepts(case_of(text("0.5")), 0, {0, 0, 0}, {-seen, 1.40865385F, -seen}));
    // A little before the eye it has a bound.
    EXPECT_FALSE(accepts(case_of(text("0.25")), 0, {0, 0, 0}, {seen, 1.40865385F, seen}));
}

// A shader that runs for two samples of four at once is at one of those that its triangle covers;
// those of the neighbouring pixels may be at others. From sample 1 to sample 3 beside it x grows by
// 3/4 and y by 1/2, to the one below by -1/4 and 3/2: (3/16 + 1/6) + (1/2 - 1/16) = 19/24.
TEST(GuardBand, DerivativesOfInvocationsForSeveralSamplesReachAnySampleOfTheQuad) {
    const auto accepts_width = [](const std::string& shading, float width) {
        cases::Case c = case_of("[target]\nsize = [1, 1]\nsamples = 4\n[[draw]]\n" + shading + R"(
vertices = [[4, -2], [0, 1], [4, 1]]
[[draw.attribute]]
probe = "fwidth"
values = [0, 0, 1]
)");
        ValueReference values(c, Limits{}, Profile::direct3d);
        FragmentValues device;
        device.frag_coord = {0.875F, 0.375F, 0.5F, 1};
        device.depth = 0.5F;
        device.attributes[0].x = width;
        return values.judge(0, {0, 0, 1}, device).ok;
    };
    const float got = std::bit_cast<float>(0x3f4aaaaaU);
    EXPECT_TRUE(accepts_width("min_sample_shading = 0.5", got));
    EXPECT_TRUE(accepts_width("min_sample_shading = 0.5", 7.0F / 12));
    EXPECT_FALSE(accepts_width("min_sample_shading = 0.5", 1.8F));
    EXPECT_TRUE(accepts_width("min_sample_shading = 1", 7.0F / 12));
    EXPECT_FALSE(accepts_width("min_sample_shading = 1", got));
}

// The left edge x = 1/2 runs from (0.5, 4) away from a vertex behind the eye. A device cuts it far
// above the picture, where its w is the small difference of two numbers, and may snap the cut to
// another column: whether (0.5, 0.5) lies on the edge is open. With all w > 0 it is a tie.
TEST(GuardBand, AnEdgeThroughTheEyesPlaneDecidesNoTie) {
    const auto hits = [](const std::string& vertices) {
        const cases::Case c = case_of("[target]\nsize = [4, 1]\n[[draw]]\nvertices = " + vertices);
        return expect(c, Limits{}, Profile::direct3d).samples[0].hits;
    };
    const HitBounds behind = hits("[[4, 4], [0.5, 4, 0, 3.25], [0.5, 5, 0, -4]]\n");
    EXPECT_EQ(behind.total_min, 0U);
    EXPECT_EQ(behind.total_max, 1U);
    const HitBounds before = hits("[[4, 4], [0.5, 4, 0, 3.25], [0.5, -50, 0, 4]]\n");
    EXPECT_EQ(before.total_min, 1U);
    EXPECT_EQ(before.total_max, 1U);
}

}  // namespace
}  // namespace ref::test
