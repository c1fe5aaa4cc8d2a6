// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Fragments that their shader discards by pixel or face: random cases against the oracle, and
// against cases without discards that must come to the same. By values: discard_value_test.cpp.
#include <gtest/gtest.h>

#include "cases/model/sample.hpp"
#include "ref/expectation/expectation.hpp"
#include "tests/unit/ref/same_expectations.hpp"
#include "tests/unit/ref/value_case.hpp"

namespace ref::test {
namespace {

using cases::Discard;
using value_test::Random;

// Triangles of some draws, half of which discard; `early`: whether shaders may have early tests.
cases::Case random_case(uint64_t seed, bool early) {
    Random random(seed);
    cases::Case c;
    c.id = "random discard";
    c.target = {8, 8, random.one_in(3) ? 4U : 1U};
    c.target.has_stencil = random.one_in(2);
    c.target.layers = random.one_in(5) ? 2U : 1U;
    const uint32_t draws = 1 + random.below(4);
    for (uint32_t k = 0; k < draws; ++k) {
        cases::Draw d;
        d.viewport = {0, 0, 8, 8, 0, 1};
        d.scissor = {0, 0, 8, 8};
        d.layer = random.below(c.target.layers);
        d.discard = static_cast<Discard>(random.one_in(2) ? 0 : random.below(6));
        d.early_tests = early && random.one_in(2);
        d.depth.compare = random.one_in(2) ? cases::CompareOp::always
                                           : static_cast<cases::CompareOp>(random.below(8));
        d.depth.write = !random.one_in(4);
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

TEST(ExhaustiveDiscard, ExpectationsAgreeWithTheOracle) {
    uint64_t must = 0, open = 0, hidden = 0;
    for (uint64_t seed = 1; seed <= 120; ++seed) {
        const cases::Case c = random_case(seed, true);
        for (const cases::Profile profile : cases::kProfiles) {
            const Expectation fast = expect(c, Limits{}, profile);
            const Expectation slow = exact::expect(c, Limits{}, profile);
            ASSERT_TRUE(same_expectations(fast, slow)) << "seed " << seed;
            must += fast.must_samples;
            open += fast.either_samples;
            for (size_t k = 0; k < fast.samples.size(); ++k) {
                const SampleExpectation& sample = fast.samples[k];
                hidden += sample.hits == HitBounds{} && sample.depth_count > 0 ? 1U : 0U;
            }
        }
    }
    EXPECT_GT(must, 2500U);
    EXPECT_GT(open, 100U);
    EXPECT_GT(hidden, 500U);
}

// Where tests come late a pixel shows what it would if the draws that discard there were not, and
// every other one what it would without discards.
TEST(Discard, LateTestsLeaveNoTrace) {
    uint64_t discarded = 0;
    for (uint64_t seed = 1; seed <= 120; ++seed) {
        const cases::Case c = random_case(seed + 1000, false);
        for (const bool has_odd_x : {false, true}) {
            for (const bool has_odd_y : {false, true}) {
                cases::Case plain = c;
                for (cases::Draw& draw : plain.draws) {
                    if (discards_pixel(draw.discard, has_odd_x ? 1 : 0, has_odd_y ? 1 : 0)) {
                        draw.rasterizer_discard = true;
                        ++discarded;
                    }
                    if (draw.discard == Discard::front || draw.discard == Discard::back) {
                        draw.cull = draw.discard == Discard::front ? cases::CullMode::front
                                                                   : cases::CullMode::back;
                    }
                    draw.discard = Discard::none;
                }
                const Expectation ours = expect(c, Limits{}, cases::Profile::direct3d);
                const Expectation theirs = expect(plain, Limits{}, cases::Profile::direct3d);
                for (size_t k = 0; k < ours.samples.size(); ++k) {
                    const cases::SampleId id = cases::sample_at(c.target, k);
                    if ((id.x % 2 == 1) == has_odd_x && (id.y % 2 == 1) == has_odd_y) {
                        ASSERT_TRUE(is_same(ours, theirs, k))
                            << "seed " << seed << " pixel " << id.x << ',' << id.y;
                    }
                }
            }
        }
    }
    EXPECT_GT(discarded, 100U);
}

// Where all tests are early, depth and stencil are what they are without discards.
TEST(Discard, EarlyTestsStoreWhatIsDiscarded) {
    uint64_t stored = 0;
    for (uint64_t seed = 1; seed <= 120; ++seed) {
        cases::Case c = random_case(seed + 2000, true);
        c.target.stencil_clear = c.target.has_stencil ? 1 : 0;  // so that the stencil is followed
        bool is_early = true;
        for (cases::Draw& draw : c.draws) {
            draw.early_tests = draw.discard != Discard::none;
            draw.depth.write = true;
            is_early = is_early && draw.early_tests;
        }
        if (!is_early) {
            continue;
        }
        cases::Case plain = c;
        for (cases::Draw& draw : plain.draws) {
            draw.discard = Discard::none;
            draw.depth.compare = draw.depth.compare == cases::CompareOp::always
                                     ? cases::CompareOp::less_or_equal
                                     : draw.depth.compare;
        }
        for (size_t k = 0; k < c.draws.size(); ++k) {  // what stores depth is told alike
            c.draws[k].depth.compare = plain.draws[k].depth.compare;
        }
        const Expectation ours = expect(c, Limits{}, cases::Profile::direct3d);
        const Expectation theirs = expect(plain, Limits{}, cases::Profile::direct3d);
        for (size_t k = 0; k < ours.samples.size(); ++k) {
            const auto of = [k](const Expectation& e) { return e.depth_writers_of(e.samples[k]); };
            ASSERT_TRUE(std::ranges::equal(of(ours), of(theirs))) << "seed " << seed;
            ASSERT_EQ(stencils_at(ours, ours.samples[k], std::nullopt),
                      stencils_at(theirs, theirs.samples[k], std::nullopt))
                << "seed " << seed;
            stored += of(ours).size();
        }
    }
    EXPECT_GT(stored, 200U);
}

TEST(Discard, PixelsAreKnownByHand) {
    EXPECT_FALSE(discards_pixel(Discard::odd_columns, 2, 3));
    EXPECT_TRUE(discards_pixel(Discard::odd_columns, 3, 2));
    EXPECT_TRUE(discards_pixel(Discard::odd_rows, 2, 3));
    EXPECT_FALSE(discards_pixel(Discard::odd_rows, 3, 2));
    EXPECT_TRUE(discards_pixel(Discard::checker, 2, 3));
    EXPECT_FALSE(discards_pixel(Discard::checker, 3, 3));
    EXPECT_FALSE(discards_pixel(Discard::front, 3, 3));
    EXPECT_TRUE(discards_face(Discard::front, true));
    EXPECT_FALSE(discards_face(Discard::back, true));
}

}  // namespace
}  // namespace ref::test
