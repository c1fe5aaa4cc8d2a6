// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults planted in cases whose fragment shader writes depths.
#include <gtest/gtest.h>

#include <cmath>

#include "diff/verdict.hpp"
#include "rasterizers/captures.hpp"
#include "tests/unit/diff/perfect_capture.hpp"

namespace diff {
namespace {

constexpr size_t kEven = 8 + 2;  // pixel (2, 1)
constexpr size_t kOdd = 8 + 1;   // pixel (1, 1)

cases::Case writing() {
    cases::Case c = pixel_case(8, 8, {{0, 0}, {8, 0}, {0, 8}});
    c.draws[0].frag_depth =
        cases::FragDepth{.value = 0.3F, .other = 0.7F, .where = cases::Discard::odd_columns};
    return c;
}

Verdict written_verdict(const cases::Case& c, const capture::Capture& capture) {
    return compare(c, ref::expect(c, {}, cases::Profile::direct3d), capture);
}

TEST(FragDepthJudge, NumbersAreJudgedBitForBit) {
    const cases::Case c = writing();
    const capture::Capture right = rasterizers::draw_by_reference(c);
    const Verdict ok = written_verdict(c, right);
    EXPECT_TRUE(ok.ok()) << ok.error;
    EXPECT_EQ(right.depth[kEven], 0.3F);
    EXPECT_EQ(right.depth[kOdd], 0.7F);
    for (const float depth : {0.5F, 0.3F, std::nextafter(0.7F, 0.0F)}) {
        capture::Capture wrong = right;
        wrong.depth[kOdd] = depth;
        const Verdict verdict = written_verdict(c, wrong);
        ASSERT_EQ(verdict.findings.size(), 1U) << depth;
        EXPECT_EQ(verdict.findings[0].rule, "depth.written");
        EXPECT_EQ(verdict.findings[0].quantity, "depth");
        EXPECT_EQ(verdict.findings[0].level, cases::Profile::vulkan);
    }
}

TEST(FragDepthJudge, FixedPointHasEitherNeighbour) {
    cases::Case c = writing();
    c.target.depth_format = cases::DepthFormat::d16_unorm;
    const capture::Capture right = rasterizers::draw_by_reference(c);
    EXPECT_TRUE(written_verdict(c, right).ok());
    // 0.3 is 19660.5 steps and a little more.
    for (const uint32_t code : {19659U, 19660U, 19661U, 19662U}) {
        capture::Capture other = right;
        other.depth[kEven] = cases::depth_of_code(code, c.target.depth_format);
        EXPECT_EQ(written_verdict(c, other).ok(), code == 19660 || code == 19661) << code;
    }
}

TEST(FragDepthJudge, CoordIsTheVeryNumber) {
    cases::Case c = writing();
    c.draws[0].frag_depth = cases::FragDepth{.is_coord = true};
    c.draws[0].positions[0].z = 0.25F;
    const capture::Capture right = rasterizers::draw_by_reference(c);
    const Verdict ok = written_verdict(c, right);
    EXPECT_TRUE(ok.ok()) << ok.error;
    EXPECT_EQ(right.depth[kOdd], right.frag_coord[kOdd].z);
    capture::Capture wrong = right;
    wrong.depth[kOdd] = std::nextafter(right.depth[kOdd], 1.0F);
    const Verdict verdict = written_verdict(c, wrong);
    ASSERT_EQ(verdict.findings.size(), 1U);
    EXPECT_EQ(verdict.findings[0].rule, "depth.written");
    EXPECT_EQ(verdict.findings[0].level, cases::Profile::vulkan);
    // Both together may be off by rounding.
    capture::Capture both = wrong;
    both.frag_coord[kOdd].z = wrong.depth[kOdd];
    EXPECT_TRUE(written_verdict(c, both).ok());
}

TEST(FragDepthJudge, EarlyTestsKeepTheOwnDepth) {
    cases::Case c = writing();
    c.draws[0].early_tests = true;
    const capture::Capture right = rasterizers::draw_by_reference(c);
    EXPECT_TRUE(written_verdict(c, right).ok());
    EXPECT_EQ(right.depth[kOdd], 0.5F);
    capture::Capture wrong = right;
    wrong.depth[kOdd] = 0.7F;
    EXPECT_FALSE(written_verdict(c, wrong).ok());
}

}  // namespace
}  // namespace diff
