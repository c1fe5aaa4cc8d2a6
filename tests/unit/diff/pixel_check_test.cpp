// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What only the samples of a pixel together show.
#include <gtest/gtest.h>

#include "diff/verdict.hpp"
#include "perfect_capture.hpp"

namespace {

using cases::Profile;

constexpr ref::Limits kLimits{8};
constexpr size_t kPixel = (3 * 8 + 3) * 4;  // pixel (3,3) of 8x8 with four samples

cases::Case covered(float shading) {
    cases::Case c = pixel_case(8, 8, {{0, 0}, {16, 0}, {0, 16}});
    c.target.samples = 4;
    // All of the triangle lies in the viewport, so that it is not clipped.
    c.draws[0].viewport = {0, 0, 16, 16, 0, 1};
    c.draws[0].positions = {{-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {-1, 1, 0.5F, 1}};
    c.draws[0].multisample.min_sample_shading = shading;
    cases::Attribute mask;
    mask.source = cases::Source::sample_mask_in;
    c.draws[0].attributes = {mask};
    return c;
}

diff::Verdict judged(const cases::Case& c, const capture::Capture& capture) {
    return diff::compare(c, ref::expect(c, kLimits, Profile::vulkan), capture);
}

TEST(PixelCheck, RightCapturePasses) {
    const cases::Case c = covered(1);
    const diff::Verdict v = judged(c, perfect_capture(c, ref::expect(c, kLimits, Profile::vulkan)));
    EXPECT_EQ(v.error, "");
    EXPECT_TRUE(v.ok()) << (v.ok() ? "" : v.findings[0].rule);
}

TEST(PixelCheck, TooFewInvocations) {
    const cases::Case c = covered(1);
    capture::Capture capture = perfect_capture(c, ref::expect(c, kLimits, Profile::vulkan));
    for (size_t s = 1; s < 4; ++s) {
        capture.frag_coord[kPixel + s].x = capture.frag_coord[kPixel].x;
        capture.frag_coord[kPixel + s].y = capture.frag_coord[kPixel].y;
    }
    const diff::Verdict v = judged(c, capture);
    ASSERT_EQ(v.findings.size(), 1U);
    EXPECT_EQ(v.findings[0].rule, "sample.shading");
    EXPECT_EQ(v.findings[0].level, Profile::vulkan);
    EXPECT_EQ(v.findings[0].expected, "at least 4 places of FragCoord.xy in the pixel");
    EXPECT_EQ(v.findings[0].got, "1");
    EXPECT_EQ(v.findings[0].x, 3U);
}

TEST(PixelCheck, MasksOfInvocationsAreDisjoint) {
    const cases::Case c = covered(0.5F);
    capture::Capture capture = perfect_capture(c, ref::expect(c, kLimits, Profile::vulkan));
    // Two invocations a pixel: samples 0 and 1, samples 2 and 3.
    const float x[] = {0.375F, 0.375F, 0.125F, 0.125F};
    const float y[] = {0.125F, 0.125F, 0.625F, 0.625F};
    for (size_t index = 0; index < capture.sample_count(); ++index) {
        capture.frag_coord[index].x = static_cast<float>(index / 4 % 8) + x[index % 4];
        capture.frag_coord[index].y = static_cast<float>(index / 32) + y[index % 4];
        capture.attributes[0][index].x = index % 4 < 2 ? 3.0F : 12.0F;
    }
    EXPECT_TRUE(judged(c, capture).ok());
    capture.attributes[0][kPixel + 1].x = 2.0F + 4.0F;  // it and sample 2, which has another
    const diff::Verdict v = judged(c, capture);
    ASSERT_EQ(v.findings.size(), 1U);
    EXPECT_EQ(v.findings[0].rule, "sample.mask-in");
    EXPECT_EQ(v.findings[0].sample, 1U);
}

}  // namespace
