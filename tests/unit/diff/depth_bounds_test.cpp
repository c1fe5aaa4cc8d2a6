// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults planted in cases with a depth bounds test.
#include <gtest/gtest.h>

#include "diff/verdict.hpp"
#include "rasterizers/captures.hpp"
#include "tests/unit/diff/perfect_capture.hpp"

namespace diff {
namespace {

constexpr size_t kInside = 8 + 1;   // pixel (1, 1), where the first triangle stored its depth
constexpr size_t kOutside = 8 + 6;  // pixel (6, 1), which only the second one covers

// The second draw covers all, and is drawn where the first one is.
cases::Case bounded() {
    cases::Case c = pixel_case(8, 8, {{0, 0}, {4, 0}, {0, 4}});
    c.target.depth_clear = 1;
    c.draws.push_back(pixel_case(8, 8, {{0, 0}, {16, 0}, {0, 16}}).draws[0]);
    c.draws[1].depth.bounds = cases::DepthBounds{0.25F, 0.75F};
    return c;
}

Verdict bounds_verdict(const cases::Case& c, const capture::Capture& capture) {
    return compare(c, ref::expect(c, {}, cases::Profile::direct3d), capture);
}

TEST(DepthBoundsJudge, AFragmentIsDrawnWithinTheBoundsAlone) {
    const cases::Case c = bounded();
    const capture::Capture right = rasterizers::draw_by_reference(c);
    const Verdict ok = bounds_verdict(c, right);
    EXPECT_TRUE(ok.ok()) << ok.error;
    EXPECT_EQ(right.hits[kInside].x + right.hits[kInside].y, 2);
    EXPECT_EQ(right.hits[kOutside].x + right.hits[kOutside].y, 0);

    cases::Case other = c;
    other.draws[1].depth.bounds.reset();
    const Verdict extra = bounds_verdict(c, rasterizers::draw_by_reference(other));
    ASSERT_FALSE(extra.findings.empty());
    size_t plain = 0;  // those that the edge of the first triangle leaves no question of
    for (const Finding& finding : extra.findings) {
        EXPECT_EQ(finding.rule, "depth.bounds");
        plain += finding.level == cases::Profile::vulkan && finding.expected == "0" ? 1U : 0U;
    }
    EXPECT_GT(plain, 10U);

    other.draws[1].depth.bounds = cases::DepthBounds{0.875F, 1};
    const Verdict missing = bounds_verdict(c, rasterizers::draw_by_reference(other));
    ASSERT_FALSE(missing.findings.empty());
    for (const Finding& finding : missing.findings) {
        EXPECT_EQ(finding.rule, "depth.bounds");
    }
}

TEST(DepthBoundsJudge, WhatFailsStoresNoDepth) {
    const cases::Case c = bounded();
    capture::Capture wrong = rasterizers::draw_by_reference(c);
    wrong.depth[kOutside] = 0.5F;
    const Verdict verdict = bounds_verdict(c, wrong);
    ASSERT_EQ(verdict.findings.size(), 1U);
    EXPECT_EQ(verdict.findings[0].rule, "depth.bounds");
}

TEST(DepthBoundsJudge, WhatFailsDoesNoStencilOperation) {
    cases::Case c = bounded();
    c.target.has_stencil = true;
    c.target.stencil_clear = 3;
    const capture::Capture right = rasterizers::draw_by_reference(c);
    ASSERT_TRUE(bounds_verdict(c, right).ok());
    EXPECT_EQ(right.stencil[kOutside], 3U);
    capture::Capture wrong = right;
    wrong.stencil[kOutside] = 2;  // a back face was counted
    const Verdict verdict = bounds_verdict(c, wrong);
    ASSERT_EQ(verdict.findings.size(), 1U);
    EXPECT_EQ(verdict.findings[0].rule, "depth.bounds");
    EXPECT_EQ(verdict.findings[0].quantity, "stencil");
}

}  // namespace
}  // namespace diff
