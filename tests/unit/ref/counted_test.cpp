// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What occlusion queries may count: random cases against the oracle, bounds by hand, and what the
// hits that a device shows leave open.
#include "ref/expectation/counted.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cases/model/sample.hpp"
#include "tests/unit/ref/same_expectations.hpp"
#include "tests/unit/ref/value_case.hpp"

namespace ref::test {
namespace {

using cases::Profile;
using value_test::Random;

cases::Case random_counted_case(uint64_t seed) {
    Random random(seed);
    cases::Case c;
    c.id = "random queries";
    c.target = {8, 8, random.one_in(3) ? 4U : 1U};
    c.target.has_stencil = random.one_in(2);
    c.target.depth_clear = 0.75F;
    const uint32_t draws = 1 + random.below(4);
    for (uint32_t k = 0; k < draws; ++k) {
        cases::Draw d;
        d.viewport = {0, 0, 8, 8, 0, 1};
        d.scissor = {0, 0, 8, 8 - random.below(4)};
        d.query = static_cast<cases::Query>(k == 0 ? 2 : random.below(3));
        d.discard = static_cast<cases::Discard>(random.one_in(3) ? random.below(6) : 0);
        d.early_tests = random.one_in(2);
        d.multisample.sample_mask = random.one_in(4) && !d.early_tests ? 5U : 0xffffffffU;
        d.cull = static_cast<cases::CullMode>(random.one_in(3) ? random.below(3) : 0);
        d.depth.compare = random.one_in(2) ? cases::CompareOp::always
                                           : static_cast<cases::CompareOp>(random.below(8));
        d.depth.write = !random.one_in(4);
        if (c.target.has_stencil && random.one_in(2)) {
            d.stencil.front.compare = static_cast<cases::CompareOp>(random.below(8));
            d.stencil.front.reference = random.below(3);
        }
        value_test::add_random_triangles(d, random, 8, 64);
        c.draws.push_back(d);
    }
    return c;
}

std::vector<CountBounds> without_hits(const Expectation& e, const cases::Case& c) {
    return count_bounds(e, c, {});
}

TEST(ExhaustiveCounted, ExpectationsAgreeWithTheOracle) {
    uint64_t least = 0, open = 0, hidden = 0;
    for (uint64_t seed = 1; seed <= 120; ++seed) {
        const cases::Case c = random_counted_case(seed);
        for (const Profile profile : cases::kProfiles) {
            const Expectation fast = expect(c, Limits{}, profile);
            const Expectation slow = exact::expect(c, Limits{}, profile);
            ASSERT_TRUE(same_expectations(fast, slow)) << "seed " << seed;
            for (const CountBounds& bounds : without_hits(fast, c)) {
                ASSERT_LE(bounds.least, bounds.most) << "seed " << seed;
                least += bounds.least;
                open += bounds.most - bounds.least;
            }
            for (size_t k = 0; k < fast.samples.size(); ++k) {
                for (uint32_t draw = 0; draw < c.draws.size(); ++draw) {
                    hidden += passed_at(fast, c, k, draw, {}, true).most -
                              passed_at(fast, c, k, draw, {}, false).most;
                }
            }
        }
    }
    EXPECT_GT(least, 2000U);
    EXPECT_GT(open, 100U);
    EXPECT_GT(hidden, 500U);
}

// A query alters nothing of what is drawn.
TEST(Counted, HitsAreThoseWithoutQueries) {
    for (uint64_t seed = 1; seed <= 120; ++seed) {
        const cases::Case c = random_counted_case(seed);
        cases::Case plain = c;
        for (cases::Draw& draw : plain.draws) {
            draw.query = cases::Query::none;
        }
        for (const Profile profile : cases::kProfiles) {
            const Expectation asked = expect(c, Limits{}, profile);
            const Expectation unasked = expect(plain, Limits{}, profile);
            for (size_t k = 0; k < asked.samples.size(); ++k) {
                // Paths know together what a list of triangles knows of each.
                const HitBounds& a = asked.samples[k].hits;
                const HitBounds& b = unasked.samples[k].hits;
                EXPECT_GE(a.total_min, b.total_min) << "seed " << seed << " sample " << k;
                EXPECT_LE(a.total_max, b.total_max) << "seed " << seed << " sample " << k;
            }
        }
    }
}

ShownSample of_hits(uint32_t hits) {
    ShownSample out{true, {}, hits};
    out.paths.hits = {path::SeenHits::Detail::total, hits, 0};
    return out;
}

cases::Case triangle_of_8() {
    cases::Case c;
    c.target = {8, 8, 1};
    cases::Draw d;
    d.viewport = {0, 0, 8, 8, 0, 1};
    d.scissor = {0, 0, 8, 8};
    d.positions = {{-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {-1, 1, 0.5F, 1}};
    d.query = cases::Query::occlusion_precise;
    c.draws.push_back(d);
    return c;
}

// 1 + 2 + ... + 7 centres lie inside, and 8 on the edge from the right to the left, which is no
// top-left edge.
TEST(Counted, TheDiagonalIsOpenWithoutTopLeftRule) {
    const cases::Case c = triangle_of_8();
    EXPECT_EQ(without_hits(expect(c, Limits{}, Profile::direct3d), c)[0], (CountBounds{28, 28}));
    const Expectation vulkan = expect(c, Limits{}, Profile::vulkan);
    EXPECT_EQ(without_hits(vulkan, c)[0], (CountBounds{28, 36}));
    // A device that shows every second sample of the diagonal counts 4 more, no others.
    const auto shown = [&](size_t index) {
        const size_t x = index % 8;
        const size_t y = index / 8;
        return of_hits(x + y < 7 || (x + y == 7 && x % 2 == 0) ? 1 : 0);
    };
    EXPECT_EQ(count_bounds(vulkan, c, shown)[0], (CountBounds{32, 32}));
}

TEST(Counted, TwoTrianglesShareTheirEdge) {
    cases::Case c = triangle_of_8();
    for (const glm::vec4& v : {glm::vec4(-1, 1, 0.5F, 1), {1, -1, 0.5F, 1}, {1, 1, 0.5F, 1}}) {
        c.draws[0].positions.push_back(v);
    }
    for (const Profile profile : cases::kProfiles) {
        EXPECT_EQ(without_hits(expect(c, Limits{}, profile), c)[0], (CountBounds{64, 64}));
    }
}

// Of the 28 pixels with x + y < 7, 2 + 4 + 6 have an odd x + y.
TEST(Counted, WhatIsDiscardedEarlyIsCountedFromPracticeOn) {
    cases::Case c = triangle_of_8();
    c.draws[0].discard = cases::Discard::checker;
    const auto at = [&](Profile profile) {
        return without_hits(expect(c, Limits{}, profile), c)[0];
    };
    EXPECT_EQ(at(Profile::direct3d), (CountBounds{16, 16}));
    c.draws[0].early_tests = true;
    EXPECT_EQ(at(Profile::direct3d), (CountBounds{28, 28}));
    EXPECT_EQ(at(Profile::vulkan).least, 16U);
    EXPECT_EQ(at(Profile::vulkan).most, 36U);
}

using Range = std::pair<uint32_t, uint32_t>;
// How many of some fragments pass where so many show.
Range passed(const path::Question& question, uint32_t hits, const std::vector<bool>& of,
             bool with_discarded) {
    path::Observed observed = of_hits(hits).paths;
    observed.counting.emplace(of, with_discarded);
    const auto counted = path::counted_by(question, observed);
    return counted ? Range(counted->least, counted->most) : Range(~0U, ~0U);
}

// Two fragments of draw 0 that may show or be discarded once they passed, and one of draw 1.
TEST(Counted, WhatShowsOrIsDiscardedCountsOnce) {
    path::Question question;
    path::Fragment open{&path::kKeepStencil, true, true, false, true};
    open.is_discard_open = true;
    question.fragments = {open, open, {&path::kKeepStencil, true, true, false, true}};
    const std::vector<bool> first = {true, true, false}, second = {false, false, true};
    for (const uint32_t hits : {1U, 2U, 3U}) {
        EXPECT_EQ(passed(question, hits, first, true), Range(2, 2));
        EXPECT_EQ(passed(question, hits, first, false), Range(hits - 1, hits - 1));
        EXPECT_EQ(passed(question, hits, second, true), Range(1, 1));
    }
}

TEST(Counted, OthersHitsLeaveLess) {
    path::Question question;
    const path::Fragment either{&path::kKeepStencil, false, true, false, true};
    path::Fragment sure = either;
    sure.is_sure = true;
    question.fragments = {either, either, sure, either, either};
    const std::vector<bool> first = {true, true, false, false, false};
    const std::vector<bool> second = {false, false, true, true, true};
    EXPECT_EQ(passed(question, 1, first, true), Range(0, 0));
    EXPECT_EQ(passed(question, 5, first, true), Range(2, 2));
    EXPECT_EQ(passed(question, 4, second, true), Range(2, 3));
    // Exactly one of a set is there, whichever it is.
    question.sets = {{1, 1}};
    question.fragments[0].set = question.fragments[1].set = 0;
    EXPECT_EQ(passed(question, 2, first, true), Range(1, 1));
    path::Observed observed;
    observed.counting.emplace(first, true);
    EXPECT_EQ(path::counted_by(question, observed)->least, 1U);
}

}  // namespace
}  // namespace ref::test
