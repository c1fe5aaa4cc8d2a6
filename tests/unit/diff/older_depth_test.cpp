// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Depth that another fragment than the last one has stored.
#include <gtest/gtest.h>

#include <algorithm>

#include "diff/verdict.hpp"
#include "rasterizers/captures.hpp"
#include "tests/unit/diff/perfect_capture.hpp"

namespace diff {
namespace {

// Three triangles at the same place: the second one's plane is the first one's, so that either may
// have stored its depth, since its shader is another one, and the third stores none.
cases::Case with_equal_planes() {
    cases::Case c = pixel_case(8, 8, {{0, 0}, {8, 0}, {0, 8}});
    c.draws.resize(3, c.draws[0]);
    c.draws[1].depth.compare = cases::CompareOp::less;
    c.draws[1].discard_by = cases::DiscardBy::demote;
    c.draws[2].depth.write = false;
    return c;
}

TEST(OlderDepth, WhatTwoPlanesHaveIsToldOnce) {
    const cases::Case c = with_equal_planes();
    const ref::Expectation expectation = ref::expect(c, {}, cases::Profile::direct3d);
    const size_t index = 8 + 1;  // pixel (1, 1)
    ASSERT_EQ(expectation.samples[index].depth_count, 2U);
    capture::Capture wrong = rasterizers::draw_by_reference(c);
    ASSERT_TRUE(compare(c, expectation, wrong).ok());
    wrong.depth[index] = 0.875F;
    const Verdict verdict = compare(c, expectation, wrong);
    ASSERT_EQ(verdict.findings.size(), 1U);
    EXPECT_EQ(verdict.findings[0].quantity, "depth");
    EXPECT_NE(verdict.findings[0].expected, "");
    EXPECT_EQ(verdict.findings[0].expected.find(", or "), std::string::npos)
        << verdict.findings[0].expected;
}

// What a draw stores where it must not be lets a later one pass its depth test there: the first hit
// is told, and not the test.
TEST(Attribution, TheFirstOfTwoHitsTooManyIsTheRoot) {
    cases::Case plain = pixel_case(8, 8, {{0, 0}, {8, 0}, {0, 8}});
    plain.draws.resize(2, plain.draws[0]);
    plain.target.depth_clear = 0.25F;
    plain.draws[1].depth.compare = cases::CompareOp::less;
    for (glm::vec4& position : plain.draws[1].positions) {
        position.z = 0.4375F;
    }
    cases::Case c = plain;
    c.draws[0].scissor = {4, 0, 4, 8};
    const Verdict verdict = compare(c, ref::expect(c, {}, cases::Profile::direct3d),
                                    rasterizers::draw_by_reference(plain));
    const auto two = std::ranges::find_if(verdict.findings, [](const Finding& finding) {
        return finding.kind == FindingKind::extra && finding.got.starts_with("2");
    });
    ASSERT_NE(two, verdict.findings.end());
    EXPECT_EQ(two->rule, "scissor.half-open");
    EXPECT_EQ(two->why.find("triangle 0 of draw 0: "), 0U) << two->why;
}

}  // namespace
}  // namespace diff
