// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults planted in the stencil of cases whose draws test it.
#include <gtest/gtest.h>

#include "diff/verdict.hpp"
#include "rasterizers/captures.hpp"
#include "tests/unit/diff/perfect_capture.hpp"

namespace diff {
namespace {

using cases::CompareOp;
using cases::StencilOp;

// A triangle that replaces 3 by 9 in its pixels, and one that draws where there is 9 and inverts
// the rest.
cases::Case stencil_case() {
    cases::Case c = pixel_case(8, 8, {{0, 0}, {8, 0}, {0, 8}});
    c.target.has_stencil = true;
    c.target.stencil_clear = 3;
    c.draws[0].stencil.front = {.pass = StencilOp::replace, .reference = 9};
    c.draws[0].stencil.back = c.draws[0].stencil.front;
    cases::Draw next = c.draws[0];
    next.stencil.front = {.compare = CompareOp::equal,
                          .fail = StencilOp::invert,
                          .pass = StencilOp::increment_and_wrap,
                          .reference = 9};
    next.stencil.back = next.stencil.front;
    next.positions = pixel_case(8, 8, {{0, 0}, {8, 0}, {8, 8}}).draws[0].positions;
    c.draws.push_back(next);
    return c;
}

Verdict judged(const cases::Case& c, const capture::Capture& capture) {
    return compare(c, ref::expect(c, {}, cases::Profile::direct3d), capture);
}

TEST(StencilJudge, ARightStencilPassesAndEveryWrongOneIsFound) {
    const cases::Case c = stencil_case();
    const capture::Capture right = rasterizers::draw_by_reference(c);
    const Verdict ok = judged(c, right);
    EXPECT_TRUE(ok.ok()) << ok.error;
    EXPECT_EQ(right.stencil[3 * 8 + 1], 9U);     // replaced, beside the second triangle
    EXPECT_EQ(right.stencil[0 * 8 + 2], 10U);    // replaced, drawn
    EXPECT_EQ(right.stencil[3 * 8 + 7], 0xfcU);  // neither: inverted
    for (size_t k = 0; k < right.stencil.size(); ++k) {
        capture::Capture wrong = right;
        wrong.stencil[k] ^= 0x40U;
        const Verdict verdict = judged(c, wrong);
        ASSERT_EQ(verdict.findings.size(), 1U);
        EXPECT_EQ(verdict.findings[0].quantity, "stencil");
        EXPECT_EQ(verdict.findings[0].rule, "stencil.operation");
        EXPECT_EQ(verdict.findings[0].level, cases::Profile::vulkan);
        // On an edge, profile vulkan allows two.
        const std::string& expected = verdict.findings[0].expected;
        EXPECT_NE((", " + expected + ",").find(" " + std::to_string(right.stencil[k]) + ","),
                  std::string::npos)
            << expected;
    }
    capture::Capture missing = right;
    missing.stencil[5] = capture::kPoison;
    EXPECT_NE(judged(c, missing).error, "");
}

// The stencil of a device that is wrong about one thing names that.
TEST(StencilJudge, NamesTheRuleThatExplainsTheValue) {
    const auto rule_of = [](const cases::Case& c, const cases::Case& other) {
        capture::Capture capture = rasterizers::draw_by_reference(c);
        capture.stencil = rasterizers::draw_by_reference(other).stencil;
        const Verdict verdict = judged(c, capture);
        return verdict.findings.empty() ? "none" : verdict.findings[0].rule;
    };
    cases::Case c = stencil_case();
    c.draws[0].stencil.front.reference = 77;
    c.draws[0].stencil.back.write_mask = 0x0f;
    c.draws[1].depth.compare = CompareOp::never;
    c.draws[1].stencil.front.depth_fail = c.draws[1].stencil.back.depth_fail = StencilOp::zero;
    cases::Case exchanged = c;
    std::swap(exchanged.draws[0].stencil.front, exchanged.draws[0].stencil.back);
    EXPECT_EQ(rule_of(c, exchanged), "stencil.faces");
    cases::Case unmasked = c;
    unmasked.draws[0].stencil.back.write_mask = 0xff;
    unmasked.draws[0].stencil.front = unmasked.draws[0].stencil.back = {
        .pass = StencilOp::replace, .write_mask = 0xff, .reference = 9};
    cases::Case masked = unmasked;
    masked.draws[0].stencil.front.write_mask = masked.draws[0].stencil.back.write_mask = 0xf2;
    EXPECT_EQ(rule_of(masked, unmasked), "stencil.mask");
    cases::Case lost = c;
    for (cases::StencilFace* face : {&lost.draws[1].stencil.front, &lost.draws[1].stencil.back}) {
        face->depth_fail = face->pass;
        face->compare = CompareOp::always;
    }
    cases::Case always = c;
    for (cases::StencilFace* face :
         {&always.draws[1].stencil.front, &always.draws[1].stencil.back}) {
        face->compare = CompareOp::always;
    }
    EXPECT_EQ(rule_of(always, lost), "stencil.depth-outcome");
}

// Of a sample that is open the stencil has to go with the hits.
TEST(StencilJudge, TheStencilGoesWithTheHits) {
    // A pixel centre on an edge that no rule but top-left decides.
    cases::Case c = pixel_case(8, 8, {{0.5, 0.5}, {6.5, 0.5}, {0.5, 6.5}});
    c.target.has_stencil = true;
    c.target.stencil_clear = 3;
    c.draws[0].stencil.front = {.pass = StencilOp::replace, .reference = 9};
    c.draws[0].stencil.back = c.draws[0].stencil.front;
    const ref::Expectation e = ref::expect(c, {}, cases::Profile::vulkan);
    capture::Capture capture = rasterizers::draw_by_reference(c);
    ASSERT_TRUE(compare(c, e, capture).ok());
    bool was_open = false;
    for (size_t k = 0; k < capture.stencil.size(); ++k) {
        if (stencils_at(e, e.samples[k], std::nullopt).count() == 2) {
            was_open = true;
            capture.stencil[k] = capture.stencil[k] == 3 ? 9 : 3;
            EXPECT_FALSE(compare(c, e, capture).ok()) << k;
            capture.stencil[k] = capture.stencil[k] == 3 ? 9 : 3;
        }
    }
    EXPECT_TRUE(was_open);
}

}  // namespace
}  // namespace diff
