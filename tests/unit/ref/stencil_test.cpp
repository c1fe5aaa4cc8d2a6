// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The stencil test: operations known by hand, the fast answer to random questions against the
// oracle's, and expectations of random cases.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "ref/expectation/expectation.hpp"
#include "ref/stencil/exact.hpp"
#include "ref/stencil/outcome.hpp"
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

class RandomQuestions : public value_test::Random {
  public:
    using Random::Random;

    StencilFace face() {
        StencilFace out;
        out.compare = static_cast<CompareOp>(below(8));
        for (StencilOp* op : {&out.fail, &out.depth_fail, &out.pass}) {
            *op = static_cast<StencilOp>(below(8));
        }
        out.compare_mask = mask();
        out.write_mask = mask();
        out.reference = value();
        return out;
    }
    cases::StencilState state() { return {face(), face()}; }

    // States outlive the question.
    stencil::Question question(std::vector<cases::StencilState>& states) {
        stencil::Question out;
        out.clear = value();
        const uint32_t count = 1 + below(7);
        states.resize(count);
        for (uint32_t m = 0; m < count; ++m) {
            states[m] = state();
            stencil::Fragment fragment{&states[m], one_in(2), !one_in(3), false, !one_in(3)};
            fragment.can_be_back = !fragment.can_be_front || one_in(3);
            fragment.is_discarded_front = one_in(6);
            fragment.is_discard_open = one_in(6);
            if (m > 0 && one_in(5)) {
                fragment.twin = static_cast<int>(below(m));
                fragment.is_sure = out.fragments[static_cast<size_t>(fragment.twin)].is_sure;
            }
            out.fragments.push_back(fragment);
        }
        if (count > 2 && one_in(2)) {
            out.sets.push_back({below(2), 1 + below(2)});
            for (const uint32_t m : {0U, count - 2, count - 1}) {
                stencil::Fragment& fragment = out.fragments[m];
                fragment.is_sure = false;
                fragment.twin = -1;
                fragment.set = 0;
            }
            for (stencil::Fragment& fragment : out.fragments) {
                fragment.twin = -1;
            }
        }
        if (one_in(3)) {
            const uint64_t salt = bits();
            out.bounds = [salt](int stored, uint32_t m) {
                std::mt19937_64 of(salt + m * 64 + static_cast<uint64_t>(stored + 1));
                return static_cast<DepthOutcome>(of() % 3);
            };
        }
        if (!one_in(3)) {
            const uint64_t salt = bits();
            out.depth = [salt](int stored, uint32_t m) {
                std::mt19937_64 of(salt + m * 64 + static_cast<uint64_t>(stored + 1));
                return static_cast<DepthOutcome>(of() % 3);
            };
        }
        return out;
    }

  private:
    uint32_t value() {
        constexpr std::array<uint32_t, 8> kEnds = {0, 1, 254, 255, 0x7f, 0x80, 3, 0x5a};
        return one_in(4) ? below(256) : kEnds.at(below(8));
    }
    uint32_t mask() { return one_in(2) ? 0xffU : one_in(4) ? below(1U << 12U) : value(); }
};

TEST(ExhaustiveStencil, OperationsAgreeWithTheOracle) {
    RandomQuestions random(7);
    for (uint32_t k = 0; k < 20000; ++k) {
        const cases::StencilState state = random.state();
        stencil::Question question;
        question.clear = random.below(256);
        question.fragments = {{&state, true, true, false, true}};
        const stencil::Resolution fast = stencil::resolve(question);
        const stencil::Resolution slow = stencil::exact::resolve(question);
        ASSERT_EQ(fast.outcomes, slow.outcomes) << k;
        ASSERT_EQ(fast.fates, slow.fates) << k;
    }
}

TEST(ExhaustiveStencil, QuestionsAgreeWithTheOracle) {
    uint64_t open = 0, free = 0;
    for (uint64_t seed = 1; seed <= 4000; ++seed) {
        RandomQuestions random(seed);
        std::vector<cases::StencilState> states;
        const stencil::Question question = random.question(states);
        const stencil::Resolution fast = stencil::resolve(question);
        const stencil::Resolution slow = stencil::exact::resolve(question);
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

// So many open fragments that not all courses are followed: nothing is claimed.
TEST(Stencil, TooManyCoursesClaimNothing) {
    std::vector<cases::StencilState> states(40);
    stencil::Question question;
    for (uint32_t k = 0; k < states.size(); ++k) {
        states[k].front.pass = StencilOp::replace;
        states[k].front.reference = k * 5;
        states[k].back.pass = StencilOp::increment_and_wrap;
        question.fragments.push_back({&states[k], false, true, true, true});
    }
    EXPECT_TRUE(stencil::resolve(question).is_free);
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
        for (const stencil::Outcome& o : e.stencils_of(e.samples[k])) {
            EXPECT_EQ(o.values.count(), 1U);
            EXPECT_TRUE(o.values[(5 + o.front - o.back) & 0xffU]);
        }
    }
}

}  // namespace
}  // namespace ref::test
