// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The stencil test: operations known by hand, the fast answer to random questions against the
// oracle's, and expectations of random cases.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "ref/expectation/expectation.hpp"
#include "ref/path/exact.hpp"
#include "ref/path/path.hpp"
#include "tests/unit/ref/random_questions.hpp"
#include "tests/unit/ref/same_expectations.hpp"
#include "tests/unit/ref/value_case.hpp"

namespace ref::test {
namespace {

using cases::CompareOp;
using cases::StencilFace;
using cases::StencilOp;

TEST(Stencil, OperationsAreKnownByHand) {
    struct Row {
        StencilOp op;
        uint32_t of_0, of_255, of_0x5a;
    };
    constexpr std::array kRows = {
        Row{StencilOp::keep, 0, 255, 0x5a},
        Row{StencilOp::zero, 0, 0, 0},
        Row{StencilOp::replace, 0x93, 0x93, 0x93},
        Row{StencilOp::increment_and_clamp, 1, 255, 0x5b},
        Row{StencilOp::decrement_and_clamp, 0, 254, 0x59},
        Row{StencilOp::invert, 255, 0, 0xa5},
        Row{StencilOp::increment_and_wrap, 1, 0, 0x5b},
        Row{StencilOp::decrement_and_wrap, 255, 254, 0x59},
    };
    StencilFace face;
    face.reference = 0x93;
    face.compare_mask = 0x0f;  // is not applied to what is written
    for (const Row& row : kRows) {
        EXPECT_EQ(stencil::updated(row.op, face, 0), row.of_0);
        EXPECT_EQ(stencil::updated(row.op, face, 255), row.of_255);
        EXPECT_EQ(stencil::updated(row.op, face, 0x5a), row.of_0x5a);
    }
    face.write_mask = 0xffffff0f;
    // 0x5f + 1 carries into bits that are not written; 0x5a is replaced in the lower half.
    EXPECT_EQ(stencil::updated(StencilOp::increment_and_wrap, face, 0x5f), 0x50U);
    EXPECT_EQ(stencil::updated(StencilOp::replace, face, 0x5a), 0x53U);
    EXPECT_EQ(stencil::updated(StencilOp::invert, face, 0x5a), 0x55U);
    EXPECT_EQ(stencil::updated(StencilOp::increment_and_clamp, face, 0xff), 0xffU);
}

TEST(Stencil, TheReferenceStandsOnTheLeft) {
    StencilFace face;
    face.reference = 4;
    face.compare = CompareOp::less;
    EXPECT_FALSE(stencil::passes(face, 3));
    EXPECT_FALSE(stencil::passes(face, 4));
    EXPECT_TRUE(stencil::passes(face, 5));
    EXPECT_TRUE(stencil::passes(face, 0x80));  // unsigned
    face.compare = CompareOp::equal;
    face.reference = 0x54;
    face.compare_mask = 0x0f;
    EXPECT_TRUE(stencil::passes(face, 0xa4));
    EXPECT_FALSE(stencil::passes(face, 0xa5));
}

TEST(ExhaustiveStencil, OperationsAgreeWithTheOracle) {
    RandomQuestions random(7);
    for (uint32_t k = 0; k < 20000; ++k) {
        const cases::StencilState state = random.state();
        path::Question question;
        question.clear = random.below(256);
        question.fragments = {{&state, true, true, false, true}};
        const path::Resolution fast = path::resolve(question);
        const path::Resolution slow = path::exact::resolve(question);
        ASSERT_EQ(fast.outcomes, slow.outcomes) << k;
        ASSERT_EQ(fast.fates, slow.fates) << k;
    }
}

TEST(ExhaustiveStencil, QuestionsAgreeWithTheOracle) {
    uint64_t open = 0, free = 0;
    for (uint64_t seed = 1; seed <= 4000; ++seed) {
        RandomQuestions random(seed);
        std::vector<cases::StencilState> states;
        const path::Question question = random.question(states);
        const path::Resolution fast = path::resolve(question);
        const path::Resolution slow = path::exact::resolve(question);
        ASSERT_EQ(fast.is_free, slow.is_free) << seed;
        free += fast.is_free ? 1 : 0;
        if (fast.is_free) {
            continue;  // sets that nothing satisfies
        }
        ASSERT_EQ(fast.outcomes, slow.outcomes) << seed;
        ASSERT_EQ(fast.is_last, slow.is_last) << seed;
        ASSERT_EQ(fast.is_stored, slow.is_stored) << seed;
        ASSERT_EQ(fast.may_be_clear, slow.may_be_clear) << seed;
        ASSERT_EQ(fast.fates, slow.fates) << seed;
        open += fast.outcomes.size() > 1 || fast.outcomes[0].values.count() > 1 ? 1U : 0U;
    }
    EXPECT_GT(open, 2000U);
    EXPECT_LT(free, 100U);
}

// So many open fragments that not all paths are followed: nothing is claimed.
TEST(Stencil, TooManyPathsClaimNothing) {
    std::vector<cases::StencilState> states(40);
    path::Question question;
    for (uint32_t k = 0; k < states.size(); ++k) {
        states[k].front.pass = StencilOp::replace;
        states[k].front.reference = k * 5;
        states[k].back.pass = StencilOp::increment_and_wrap;
        question.fragments.push_back({&states[k], false, true, true, true});
    }
    EXPECT_TRUE(path::resolve(question).is_free);
}

cases::Case random_case(uint64_t seed) {
    RandomQuestions random(seed);
    cases::Case c;
    c.id = "random stencil";
    c.target = {8, 8, random.one_in(3) ? 4U : 1U};
    c.target.has_stencil = true;
    c.target.stencil_clear = random.below(256);
    c.target.layers = random.one_in(5) ? 2U : 1U;
    const uint32_t draws = 1 + random.below(4);
    for (uint32_t k = 0; k < draws; ++k) {
        if (k > 0 && random.one_in(4)) {
            c.draws.push_back(c.draws.back());
            continue;
        }
        cases::Draw d;
        d.viewport = {0, 0, 8, 8, 0, 1};
        d.scissor = {0, 0, 8, 8};
        d.stencil = random.state();
        d.layer = random.below(c.target.layers);
        d.depth.compare =
            random.one_in(2) ? CompareOp::always : static_cast<CompareOp>(random.below(8));
        d.depth.write = !random.one_in(4);
        value_test::add_random_triangles(d, random, 8, 128);
        c.draws.push_back(d);
    }
    return c;
}

TEST(ExhaustiveStencil, ExpectationsAgreeWithTheOracle) {
    uint64_t must = 0, open = 0, sets = 0;
    for (uint64_t seed = 1; seed <= 120; ++seed) {
        const cases::Case c = random_case(seed);
        for (const cases::Profile profile : cases::kProfiles) {
            const Expectation fast = expect(c, Limits{}, profile);
            const Expectation slow = exact::expect(c, Limits{}, profile);
            ASSERT_TRUE(same_expectations(fast, slow)) << "seed " << seed;
            must += fast.must_samples;
            open += fast.either_samples;
            for (size_t k = 0; k < fast.samples.size(); ++k) {
                const auto values = stencils_at(fast, fast.samples[k], std::nullopt);
                ASSERT_TRUE(values.any());
                sets += values.count() > 1 ? 1U : 0U;
            }
        }
    }
    EXPECT_GT(must, 2500U);
    EXPECT_GT(open, 100U);
    EXPECT_GT(sets, 100U);
}

// Whatever a looser profile is sure of, a stricter one is sure of too.
TEST(Stencil, ProfilesNest) {
    for (uint64_t seed = 1; seed <= 120; ++seed) {
        const cases::Case c = random_case(seed + 1000);
        const Expectation loose = expect(c, Limits{}, cases::Profile::vulkan);
        const Expectation strict = expect(c, Limits{}, cases::Profile::direct3d);
        for (size_t k = 0; k < loose.samples.size(); ++k) {
            const stencil::Values wide = stencils_at(loose, loose.samples[k], std::nullopt);
            const stencil::Values narrow = stencils_at(strict, strict.samples[k], std::nullopt);
            ASSERT_TRUE((narrow & ~wide).none()) << "seed " << seed << " sample " << k;
        }
    }
}

// Draws of default state count: the stencil that follows from the hits.
TEST(Stencil, TheDefaultsCountHits) {
    cases::Case c = random_case(3);
    for (cases::Draw& draw : c.draws) {
        draw.stencil = {};
        draw.depth = {};
    }
    c.target.stencil_clear = 0;
    EXPECT_FALSE(stencil::is_needed(c));
    c.target.stencil_clear = 5;
    EXPECT_TRUE(stencil::is_needed(c));
    const Expectation e = expect(c, Limits{}, cases::Profile::direct3d);
    for (size_t k = 0; k < e.samples.size(); ++k) {
        for (const path::Outcome& o : e.stencils_of(e.samples[k])) {
            EXPECT_EQ(o.values.count(), 1U);
            EXPECT_TRUE(o.values[(5 + o.front - o.back) & 0xffU]);
        }
    }
}

}  // namespace
}  // namespace ref::test
