// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults planted in cases whose fragment shader discards.
#include <gtest/gtest.h>

#include <bit>
#include <string>

#include "cases/load/loader.hpp"
#include "diff/verdict.hpp"
#include "rasterizers/captures.hpp"
#include "tests/unit/diff/perfect_capture.hpp"

namespace diff {
namespace {

cases::Case discarding(bool early) {
    cases::Case c = pixel_case(8, 8, {{0, 0}, {8, 0}, {0, 8}});
    c.draws[0].discard = cases::Discard::odd_columns;
    c.draws[0].early_tests = early;
    c.draws[0].depth.compare = cases::CompareOp::not_equal;
    return c;
}

Verdict judged(const cases::Case& c, const capture::Capture& capture) {
    return compare(c, ref::expect(c, {}, cases::Profile::direct3d), capture);
}

constexpr size_t kKept = 8 + 2;       // pixel (2, 1)
constexpr size_t kDiscarded = 8 + 1;  // pixel (1, 1)

TEST(DiscardJudge, LateTestsStoreNothing) {
    const cases::Case c = discarding(false);
    const capture::Capture right = rasterizers::draw_by_reference(c);
    EXPECT_TRUE(judged(c, right).ok());
    EXPECT_EQ(right.hits[kKept].x + right.hits[kKept].y, 1);
    EXPECT_EQ(right.hits[kDiscarded].x + right.hits[kDiscarded].y, 0);
    capture::Capture wrong = right;
    wrong.depth[kDiscarded] = right.depth[kKept];
    const Verdict verdict = judged(c, wrong);
    ASSERT_EQ(verdict.findings.size(), 1U);
    EXPECT_EQ(verdict.findings[0].rule, "discard.fragment");
    EXPECT_EQ(verdict.findings[0].level, cases::Profile::vulkan);
}

TEST(DiscardJudge, EarlyTestsStoreDepthWithoutAHit) {
    const cases::Case c = discarding(true);
    const capture::Capture right = rasterizers::draw_by_reference(c);
    const Verdict ok = judged(c, right);
    EXPECT_TRUE(ok.ok()) << ok.error;
    EXPECT_EQ(right.hits[kDiscarded].x + right.hits[kDiscarded].y, 0);
    EXPECT_EQ(right.depth[kDiscarded], right.depth[kKept]);
    for (const float depth : {c.target.depth_clear, 0.25F}) {
        capture::Capture wrong = right;
        wrong.depth[kDiscarded] = depth;
        const Verdict verdict = judged(c, wrong);
        ASSERT_EQ(verdict.findings.size(), 1U) << depth;
        EXPECT_EQ(verdict.findings[0].rule, "discard.early-tests");
        EXPECT_EQ(verdict.findings[0].quantity, "depth");
        EXPECT_EQ(verdict.findings[0].level, cases::Profile::vulkan);
    }
    // Where nothing is covered a depth is a contradiction, early tests or not.
    capture::Capture wrong = right;
    wrong.depth.back() = 0.25F;
    ASSERT_EQ(judged(c, wrong).findings.size(), 1U);
}

TEST(DiscardJudge, ADiscardedFragmentThatShowsIsExtra) {
    const cases::Case c = discarding(false);
    cases::Case plain = c;
    plain.draws[0].discard = cases::Discard::none;
    const Verdict verdict = judged(c, rasterizers::draw_by_reference(plain));
    ASSERT_FALSE(verdict.findings.empty());
    EXPECT_EQ(verdict.findings[0].kind, FindingKind::extra);
    EXPECT_EQ(verdict.findings[0].rule, "discard.fragment");
}

// Where the colour alone says what was drawn, a discarded fragment leaves its depth beside the
// clear colour.
TEST(DiscardJudge, EarlyTestsStoreDepthBesideColours) {
    for (const bool early : {true, false}) {
        cases::Case c = discarding(early);
        c.draws[0].depth = {};  // only a plain write is judged there
        c.draws[0].color.value = {1, 1, 1, 1};
        c.target.color = {cases::ColorFormat::rgba8_unorm, {0, 0, 0, 0}};
        c.target.has_instruments = false;
        capture::Capture picture = rasterizers::draw_by_reference(c);
        const Verdict ok = judged(c, picture);
        EXPECT_TRUE(ok.ok()) << ok.error;
        EXPECT_EQ(std::bit_cast<uint32_t>(picture.depth[kDiscarded]) ==
                      std::bit_cast<uint32_t>(picture.depth[kKept]),
                  early);
        picture.depth[kDiscarded] = early ? c.target.depth_clear : picture.depth[kKept];
        const Verdict verdict = judged(c, picture);
        ASSERT_EQ(verdict.findings.size(), 1U) << early;
        EXPECT_EQ(verdict.findings[0].quantity, "depth");
        EXPECT_EQ(verdict.findings[0].level, cases::Profile::vulkan);
    }
}

// Two draws must not hit the pixel: one discards there, the other one fails its test everywhere.
// The writer says whose hit it is.
TEST(DiscardJudge, AHitIsBlamedOnTheDrawThatWroteIt) {
    cases::Case c = discarding(false);
    c.draws.push_back(c.draws[0]);
    c.draws[1].discard = cases::Discard::none;
    c.draws[1].depth.compare = cases::CompareOp::never;
    const capture::Capture right = rasterizers::draw_by_reference(c);
    ASSERT_TRUE(judged(c, right).ok());
    for (const uint32_t draw : {0U, 1U}) {
        capture::Capture wrong = right;
        wrong.hits[kDiscarded] = right.hits[kKept];
        wrong.writers[kDiscarded] = right.writers[kKept];
        wrong.writers[kDiscarded].draw = draw;
        wrong.frag_coord[kDiscarded] = {1.5F, 1.5F, 0.5F, 1};
        wrong.depth[kDiscarded] = right.depth[kKept];
        const Verdict verdict = judged(c, wrong);
        ASSERT_EQ(verdict.findings.size(), 1U);
        const Finding& finding = verdict.findings[0];
        EXPECT_EQ(finding.kind, FindingKind::extra);
        EXPECT_EQ(finding.rule, draw == 0 ? "discard.fragment" : "depth.compare");
        EXPECT_TRUE(finding.why.starts_with("triangle 0 of draw " + std::to_string(draw)))
            << finding.why;
    }
}

// Of four samples a pixel; in column 0 the value that is tested is 0 at the centre. `left` is the
// x of the leftmost corner, -16 and more lie in the view volume.
cases::Case sharing(int left) {
    const std::string text = R"(format = 1
description = "."
rules = ["cover.inside"]
[target]
size = [4, 4]
samples = 4
[[draw]]
viewport = [-16, -16, 32, 32]
discard = "negative"
vertices = [[)" + std::to_string(left) +
                             R"(, -8], [12, -8], [-4, 15]]
[[draw.attribute]]
name = "a"
plane = ["x-0.5"]
)";
    return cases::load_text(text, "sharing.toml", "sharing").value().front();
}

// A picture in which nothing is discarded but the samples of pixel (0, 0) that the mask names.
capture::Capture without(const cases::Case& c, uint32_t mask) {
    cases::Case all = c;
    all.draws[0].discard = cases::Discard::none;
    capture::Capture out = rasterizers::draw_by_reference(all);
    cases::Case none = c;
    none.draws[0].scissor = {3, 3, 1, 1};
    const capture::Capture clear = rasterizers::draw_by_reference(none);
    for (size_t s = 0; s < 4; ++s) {
        if ((mask >> s & 1U) != 0) {
            out.hits[s] = clear.hits[s];
            out.writers[s] = clear.writers[s];
            out.frag_coord[s] = clear.frag_coord[s];
            out.depth[s] = clear.depth[s];
            out.attributes[0][s] = clear.attributes[0][s];
        }
    }
    return out;
}

TEST(DiscardJudge, SamplesOfAPixelShareADecision) {
    const cases::Case c = sharing(-14);
    for (uint32_t mask = 0; mask < 16; ++mask) {
        const capture::Capture picture = without(c, mask);
        const bool is_shared = mask == 0 || mask == 15;
        const Verdict strict = judged(c, picture);
        EXPECT_EQ(strict.ok(), is_shared) << mask;
        if (!is_shared) {
            ASSERT_EQ(strict.findings.size(), 1U) << mask;
            EXPECT_EQ(strict.findings[0].rule, "discard.value");
            EXPECT_EQ(strict.findings[0].level, cases::Profile::direct3d);
        }
        for (const cases::Profile profile : {cases::Profile::vulkan, cases::Profile::practice}) {
            EXPECT_TRUE(compare(c, ref::expect(c, {}, profile), picture).ok()) << mask;
        }
    }
}

// Clipping may leave several pieces of a triangle, each with a fragment of its own in a pixel.
TEST(DiscardJudge, PiecesOfATriangleShareNoDecision) {
    const cases::Case c = sharing(-40);
    for (uint32_t mask = 0; mask < 16; ++mask) {
        EXPECT_TRUE(judged(c, without(c, mask)).ok()) << mask;
    }
}

}  // namespace
}  // namespace diff
