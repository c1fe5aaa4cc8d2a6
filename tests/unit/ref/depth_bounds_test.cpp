// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The depth bounds test: random cases against the oracle, answers known by hand, and what fails
// against cases without it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cases/model/sample.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/path/exact.hpp"
#include "tests/unit/ref/same_expectations.hpp"
#include "tests/unit/ref/value_case.hpp"

namespace ref::test {
namespace {

using cases::DepthBounds;
using cases::DepthFormat;
using value_test::Random;

cases::Case random_bounds_case(uint64_t seed) {
    Random random(seed);
    cases::Case c;
    c.id = "random bounds";
    c.target = {8, 8, random.one_in(3) ? 4U : 1U};
    c.target.has_stencil = random.one_in(2);
    c.target.depth_format = static_cast<DepthFormat>(random.one_in(2) ? 0 : random.below(3));
    c.target.depth_clear = random.eighth();
    const uint32_t draws = 1 + random.below(4);
    for (uint32_t k = 0; k < draws; ++k) {
        cases::Draw d;
        d.viewport = {0, 0, 8, 8, 0, 1};
        d.scissor = {0, 0, 8, 8};
        d.discard = static_cast<cases::Discard>(random.one_in(3) ? random.below(6) : 0);
        d.early_tests = random.one_in(2);
        d.depth.compare = random.one_in(2) ? cases::CompareOp::always
                                           : static_cast<cases::CompareOp>(random.below(8));
        d.depth.write = !random.one_in(4);
        if (!random.one_in(3)) {
            const float a = random.eighth();
            const float b = random.eighth();
            d.depth.bounds = DepthBounds{std::min(a, b), std::max(a, b)};
        }
        if (c.target.has_stencil && random.one_in(2)) {
            d.stencil.front.compare = static_cast<cases::CompareOp>(random.below(8));
            d.stencil.front.reference = random.below(3);
            d.stencil.back.fail = static_cast<cases::StencilOp>(random.below(8));
        }
        value_test::add_random_triangles(d, random, 8, 64);
        c.draws.push_back(d);
    }
    return c;
}

TEST(ExhaustiveDepthBounds, ExpectationsAgreeWithTheOracle) {
    uint64_t must = 0, open = 0, fails = 0;
    for (uint64_t seed = 1; seed <= 120; ++seed) {
        const cases::Case c = random_bounds_case(seed);
        cases::Case plain = c;
        for (cases::Draw& draw : plain.draws) {
            draw.depth.bounds.reset();
        }
        for (const cases::Profile profile : cases::kProfiles) {
            const Expectation fast = expect(c, Limits{}, profile);
            const Expectation slow = exact::expect(c, Limits{}, profile);
            ASSERT_TRUE(same_expectations(fast, slow)) << "seed " << seed;
            const Expectation all = expect(plain, Limits{}, profile);
            must += fast.must_samples;
            open += fast.either_samples;
            for (size_t k = 0; k < fast.samples.size(); ++k) {
                fails += fast.samples[k].hits.total_max < all.samples[k].hits.total_max ? 1U : 0U;
            }
        }
    }
    EXPECT_GT(must, 2000U);
    EXPECT_GT(open, 100U);
    EXPECT_GT(fails, 2000U);
}

// One square over the whole target, with bounds, on what is cleared.
HitBounds hits_over(float clear, DepthBounds bounds, DepthFormat format) {
    cases::Case c;
    c.target = {4, 4, 1};
    c.target.depth_format = format;
    c.target.depth_clear = clear;
    cases::Draw d;
    d.viewport = {0, 0, 4, 4, 0, 1};
    d.scissor = {0, 0, 4, 4};
    d.positions = {{-1, -1, 0.875F, 1}, {3, -1, 0.875F, 1}, {-1, 3, 0.875F, 1}};
    d.depth.bounds = bounds;
    c.draws.push_back(d);
    const Expectation e = expect(c, Limits{}, cases::Profile::vulkan);
    EXPECT_EQ(exact::expect(c, Limits{}, cases::Profile::vulkan).samples[5].hits,
              e.samples[5].hits);
    return e.samples[5].hits;
}

TEST(DepthBounds, EndsAreKnownByHand) {
    struct Row {
        float clear;
        DepthBounds bounds;
        DepthFormat format;
        uint32_t least, most;
    };
    constexpr auto kFloat = DepthFormat::d32_float;
    constexpr auto kFixed = DepthFormat::d16_unorm;
    const float above = std::nextafter(0.5F, 1.0F);
    const float below = std::nextafter(0.5F, 0.0F);
    for (const Row& row : {
             // The bounds belong to what lies in them, and nothing beyond does.
             Row{0.5F, {0.5F, 1}, kFloat, 1, 1},
             Row{0.5F, {0, 0.5F}, kFloat, 1, 1},
             Row{0.5F, {0.5F, 0.5F}, kFloat, 1, 1},
             Row{0.5F, {above, 1}, kFloat, 0, 0},
             Row{0.5F, {0, below}, kFloat, 0, 0},
             // The fragment lies at 0.875, which is not what is tested.
             Row{0.5F, {0.75F, 1}, kFloat, 0, 0},
             // 0.5 is no step of 16 bits: 32767.5 / 65535 may be held as either neighbour.
             Row{0.5F, {0.5F, 1}, kFixed, 0, 1},
             Row{0.5F, {0.5F + 0x1p-13F, 1}, kFixed, 0, 0},
             Row{0.5F, {0.5F - 0x1p-13F, 1}, kFixed, 1, 1},
             // The ends are steps of every format.
             Row{0, {0, 0}, kFixed, 1, 1},
             Row{1, {1, 1}, kFixed, 1, 1},
             Row{1, {0, 0.9375F}, kFixed, 0, 0},
         }) {
        const HitBounds hits = hits_over(row.clear, row.bounds, row.format);
        EXPECT_EQ(hits.total_min, row.least) << row.clear << ' ' << row.bounds.min;
        EXPECT_EQ(hits.total_max, row.most) << row.clear << ' ' << row.bounds.max;
    }
}

TEST(DepthBounds, AreTestedBeforeTheStencil) {
    const cases::StencilFace counts{.fail = cases::StencilOp::increment_and_wrap,
                                    .depth_fail = cases::StencilOp::increment_and_wrap,
                                    .pass = cases::StencilOp::increment_and_wrap};
    const cases::StencilState state{counts, counts};
    for (const DepthOutcome bounds :
         {DepthOutcome::fails, DepthOutcome::open, DepthOutcome::passes}) {
        path::Question question;
        question.clear = 7;
        question.fragments.push_back({&state, true, true, false, true});
        question.bounds = [bounds](int, uint32_t) { return bounds; };
        const path::Resolution got = path::resolve(question);
        EXPECT_EQ(got.outcomes, path::exact::resolve(question).outcomes);
        EXPECT_EQ(got.fates, path::exact::resolve(question).fates);
        EXPECT_EQ(got.fates[0].fails_bounds, bounds != DepthOutcome::passes);
        EXPECT_EQ(got.fates[0].passes, bounds != DepthOutcome::fails);
        EXPECT_EQ(got.outcomes.size(), bounds == DepthOutcome::open ? 2U : 1U);
        EXPECT_TRUE(got.outcomes[0].values[bounds == DepthOutcome::passes ? 8 : 7]);
        EXPECT_EQ(got.may_be_clear, bounds != DepthOutcome::passes);
    }
}

}  // namespace
}  // namespace ref::test
