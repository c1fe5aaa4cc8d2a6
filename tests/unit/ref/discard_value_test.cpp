// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Fragments that their shader discards by the sign of an attribute: random cases against the
// oracle, samples by hand, and what else of the picture depends on them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "cases/model/sample.hpp"
#include "ref/expectation/counted.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/explain.hpp"
#include "ref/value/reference.hpp"
#include "tests/unit/ref/same_expectations.hpp"
#include "tests/unit/ref/value_case.hpp"

namespace ref::test {
namespace {

using cases::Discard;
using cases::Interpolation;
using cases::Profile;
using value_test::Random;

cases::Case random_case(uint64_t seed) {
    Random random(seed);
    cases::Case c;
    c.id = "random discards by values";
    c.target = {8, 8, random.one_in(3) ? 4U : 1U};
    c.target.has_stencil = random.one_in(3);
    const uint32_t draws = 1 + random.below(3);
    for (uint32_t k = 0; k < draws; ++k) {
        cases::Draw d;
        d.viewport = {0, 0, 8, 8, 0, 1};
        d.scissor = {0, 0, 8, 8};
        d.early_tests = random.one_in(3);
        d.depth.compare = random.one_in(2) ? cases::CompareOp::always : cases::CompareOp::less;
        d.query = random.one_in(3) ? cases::Query::occlusion_precise : cases::Query::none;
        value_test::add_random_triangles(d, random, 8, 64);
        // A mesh now and then: the second triangle lies at an edge of the first.
        if (random.one_in(2)) {
            d.positions.push_back(d.positions[1]);
            d.positions.push_back(d.positions[0]);
            d.positions.push_back(value_test::clip_of(random.below(9), random.below(9), 0.5, 1, 8));
        }
        cases::Attribute a;
        a.name = "a";
        a.interpolation = static_cast<Interpolation>(random.below(3));
        for (size_t v = 0; v < d.positions.size(); ++v) {
            const float value = static_cast<float>(random.below(9)) - 4;
            a.values.emplace_back(random.one_in(6) ? 0 : value, 0, 0, 0);
        }
        d.attributes.push_back(a);
        d.discard = random.one_in(4) ? Discard::none : Discard::negative;
        c.draws.push_back(d);
    }
    return c;
}

TEST(ExhaustiveDiscardValue, ExpectationsAgreeWithTheOracle) {
    uint64_t must = 0, open = 0, hidden = 0;
    for (uint64_t seed = 1; seed <= 60; ++seed) {
        const cases::Case c = random_case(seed);
        for (const Profile profile : cases::kProfiles) {
            const Expectation fast = expect(c, Limits{}, profile);
            const Expectation slow = exact::expect(c, Limits{}, profile);
            ASSERT_TRUE(same_expectations(fast, slow)) << "seed " << seed;
            must += fast.must_samples;
            open += fast.either_samples;
            for (size_t k = 0; k < fast.samples.size(); ++k) {
                hidden += fast.samples[k].hits == HitBounds{} && fast.samples[k].depth_count > 0;
            }
        }
    }
    EXPECT_GT(must, 1000U);
    EXPECT_GT(open, 100U);
    EXPECT_GT(hidden, 100U);
}

// What shows is among what shows without discards.
TEST(DiscardValue, NothingIsDrawnThatWouldNotBe) {
    uint64_t drawn = 0, gone = 0;
    for (uint64_t seed = 1; seed <= 60; ++seed) {
        cases::Case c = random_case(seed);
        for (cases::Draw& draw : c.draws) {
            draw.depth.compare = cases::CompareOp::always;
        }
        cases::Case plain = c;
        for (cases::Draw& draw : plain.draws) {
            draw.discard = Discard::none;
        }
        for (const Profile profile : cases::kProfiles) {
            const Expectation ours = expect(c, Limits{}, profile);
            const Expectation theirs = expect(plain, Limits{}, profile);
            for (size_t k = 0; k < ours.samples.size(); ++k) {
                const HitBounds& a = ours.samples[k].hits;
                const HitBounds& b = theirs.samples[k].hits;
                ASSERT_LE(a.total_min, b.total_min) << "seed " << seed << " sample " << k;
                ASSERT_LE(a.total_max, b.total_max) << "seed " << seed << " sample " << k;
                drawn += a.total_min > 0 ? 1U : 0U;
                gone += a.total_max < b.total_max ? 1U : 0U;
            }
        }
    }
    EXPECT_GT(drawn, 1000U);
    EXPECT_GT(gone, 1000U);
}

// The whole target, with a value of x at framebuffer x, less `zero`.
cases::Case of_target(float zero, Interpolation mode = Interpolation::smooth) {
    cases::Case c = value_test::make_case(
        8, {value_test::clip_of(0, 0, 0.5, 1, 8), value_test::clip_of(16, 0, 0.5, 1, 8),
            value_test::clip_of(0, 16, 0.5, 1, 8)});
    value_test::add_attribute(c, mode, 1,
                              {glm::vec4(-zero, 0, 0, 0), {16 - zero, 0, 0, 0}, {-zero, 0, 0, 0}});
    c.draws[0].discard = Discard::negative;
    return c;
}

HitBounds at(const Expectation& e, uint32_t x, uint32_t y) {
    return e.samples[y * 8 + x].hits;
}

TEST(DiscardValue, TheLineOfZeroDecidesByHand) {
    for (const Interpolation mode : {Interpolation::smooth, Interpolation::noperspective}) {
        for (const Profile profile : {Profile::practice, Profile::direct3d}) {
            const Expectation between = expect(of_target(4, mode), Limits{}, profile);
            const Expectation through = expect(of_target(3.5F, mode), Limits{}, profile);
            for (uint32_t y = 0; y < 8; ++y) {
                for (uint32_t x = 0; x < 8; ++x) {
                    EXPECT_EQ(at(between, x, y).total_min, x >= 4 ? 1U : 0U);
                    EXPECT_EQ(at(between, x, y).total_max, x >= 4 ? 1U : 0U);
                    // At the centres of column 3 the value is 0 but for what rounding makes of it.
                    EXPECT_EQ(at(through, x, y).total_min, x >= 4 ? 1U : 0U);
                    EXPECT_EQ(at(through, x, y).total_max, x >= 3 ? 1U : 0U);
                }
            }
        }
    }
}

// One triangle over the target, whose flat values are these.
HitBounds of_flat(float value) {
    cases::Case c = of_target(0, Interpolation::flat);
    c.draws[0].attributes[0].values.assign(3, glm::vec4(value, 0, 0, 0));
    return at(expect(c, Limits{}, Profile::vulkan), 2, 2);
}

// A mask of four columns is read at the value plus 1/2. Where that is less than a step of texel
// coordinates (1/16, or 1/256 of a texel, so 1/64 or 1/1024) from the middle, either is right.
TEST(DiscardValue, AMaskDecidesFurtherThanAStepOfItsTexels) {
    cases::Case c = of_target(4);
    c.draws[0].positions[1] = value_test::clip_of(8, 0, 0.5, 1, 8);
    c.draws[0].positions[2] = value_test::clip_of(0, 8, 0.5, 1, 8);
    c.target.has_instruments = c.target.has_depth = false;
    c.target.color.emplace();
    c.draws[0].color.from = cases::ColorFrom::mask;
    c.draws[0].color.value = glm::vec4(1);
    for (const Interpolation mode : {Interpolation::smooth, Interpolation::flat}) {
        for (const Profile profile : cases::kProfiles) {
            const bool is_wide = profile == Profile::vulkan;
            for (uint32_t x = 0; x < 7; ++x) {
                // At the centre of column x: (x - 3.5) / 64, or flat.
                const float value = (static_cast<float>(x) - 3.5F) / 64;
                cases::Attribute& a = c.draws[0].attributes[0];
                a.interpolation = mode;
                const bool is_flat = mode == Interpolation::flat;
                a.values = {glm::vec4(is_flat ? value : -4 / 64.0F, 0, 0, 0),
                            {4 / 64.0F, 0, 0, 0},
                            {-4 / 64.0F, 0, 0, 0}};
                const HitBounds hits = at(expect(c, Limits{}, profile), x, 0);
                EXPECT_EQ(hits.total_min, x >= (is_wide ? 5U : 4U) ? 1U : 0U) << x;
                EXPECT_EQ(hits.total_max, x >= (is_wide ? 3U : 4U) ? 1U : 0U) << x;
            }
        }
    }
}

TEST(DiscardValue, FlatValuesAreDecided) {
    for (const float kept : {0.0F, -0.0F, 0x1p-149F, 0x1p-126F, 3.0F}) {
        EXPECT_EQ(of_flat(kept).total_min, 1U) << kept;
    }
    for (const float discarded : {-0x1p-126F, -1.0F, -0x1p100F}) {
        EXPECT_EQ(of_flat(discarded).total_max, 0U) << discarded;
    }
    // A device may flush it to 0.
    EXPECT_EQ(of_flat(-0x1p-149F).total_min, 0U);
    EXPECT_EQ(of_flat(-0x1p-149F).total_max, 1U);
    // NaN and infinity need not arrive.
    for (const float none : {std::nanf(""), HUGE_VALF, -HUGE_VALF}) {
        EXPECT_EQ(of_flat(none).total_max, 1U) << none;
        EXPECT_EQ(of_flat(none).total_min, 0U) << none;
    }
}

// Two triangles share the diagonal, whose samples belong to one of them: where that one may be
// discarded there may be no hit.
TEST(DiscardValue, ASharedEdgeHasNoHitOfTheOneThatIsDiscarded) {
    cases::Case c = value_test::make_case(
        8, {value_test::clip_of(0, 0, 0.5, 1, 8), value_test::clip_of(8, 0, 0.5, 1, 8),
            value_test::clip_of(0, 8, 0.5, 1, 8)});
    cases::Draw& draw = c.draws[0];
    draw.positions.push_back(draw.positions[2]);
    draw.positions.push_back(draw.positions[1]);
    draw.positions.push_back(value_test::clip_of(8, 8, 0.5, 1, 8));
    cases::Attribute a;
    a.interpolation = Interpolation::flat;
    a.values.assign(3, glm::vec4(-1, 0, 0, 0));
    a.values.resize(6, glm::vec4(1, 0, 0, 0));
    draw.attributes.push_back(a);
    EXPECT_EQ(at(expect(c, Limits{}, Profile::vulkan), 3, 4).total_min, 1U);
    draw.discard = Discard::negative;
    for (const Profile profile : {Profile::vulkan, Profile::practice}) {
        const HitBounds diagonal = at(expect(c, Limits{}, profile), 3, 4);
        EXPECT_EQ(diagonal.total_min, 0U);
        EXPECT_EQ(diagonal.total_max, 1U);
    }
    // The diagonal is a right edge of the first triangle and a left one of the second.
    EXPECT_EQ(at(expect(c, Limits{}, Profile::direct3d), 3, 4).total_min, 1U);
    a.values[0] = a.values[1] = a.values[2] = glm::vec4(1, 0, 0, 0);
    draw.attributes[0] = a;
    for (const Profile profile : cases::kProfiles) {
        EXPECT_EQ(at(expect(c, Limits{}, profile), 3, 4).total_min, 1U);
    }
}

// After early tests an open fragment counts once, whichever becomes of it.
TEST(DiscardValue, QueriesCountWhatIsHiddenOrShownOnce) {
    cases::Case c = of_target(3.5F);
    c.draws[0].query = cases::Query::occlusion_precise;
    c.draws[0].early_tests = true;
    const auto counted = [&](Profile profile, const ShownAt& shown) {
        return count_bounds(expect(c, Limits{}, profile), c, shown)[0];
    };
    EXPECT_EQ(counted(Profile::direct3d, {}), (CountBounds{64, 64}));
    const auto is_shown_from = [](uint32_t column) {
        return [column](size_t index) {
            const uint32_t hits = index % 8 >= column ? 1 : 0;
            ShownSample out{true, {}, hits};
            out.paths.hits = {path::SeenHits::Detail::total, hits, 0};
            return out;
        };
    };
    EXPECT_EQ(counted(Profile::direct3d, is_shown_from(3)), (CountBounds{64, 64}));
    EXPECT_EQ(counted(Profile::direct3d, is_shown_from(4)), (CountBounds{64, 64}));
    c.draws[0].early_tests = false;
    EXPECT_EQ(counted(Profile::direct3d, {}), (CountBounds{32, 40}));
    EXPECT_EQ(counted(Profile::direct3d, is_shown_from(3)), (CountBounds{40, 40}));
}

// What is drawn shows no negative value, open or not.
TEST(DiscardValue, AShownNegativeValueIsWrong) {
    const cases::Case c = of_target(3.5F);
    for (const Profile profile : cases::kProfiles) {
        ValueReference values(c, Limits{}, profile);
        FragmentValues device;
        device.frag_coord = {3.5F, 2.5F, 0.5F, 1};
        device.depth = 0.5F;
        device.attributes[0] = glm::vec4(0x1p-24F, 0, 0, 0);
        EXPECT_TRUE(values.judge(0, {3, 2, 0, 0}, device).ok);
        device.attributes[0].x = -0x1p-24F;
        for (const FragmentVerdict& verdict :
             {values.judge(0, {3, 2, 0, 0}, device), values.judge_exact(0, {3, 2, 0, 0}, device)}) {
            ASSERT_EQ(verdict.mismatches.size(), 1U);
            EXPECT_EQ(verdict.mismatches[0].rule, "discard.value");
            EXPECT_EQ(verdict.mismatches[0].level, Profile::vulkan);
            EXPECT_EQ(verdict.mismatches[0].expected, "0 or more");
        }
        device.attributes[0].x = -HUGE_VALF;
        for (const FragmentVerdict& verdict :
             {values.judge(0, {3, 2, 0, 0}, device), values.judge_exact(0, {3, 2, 0, 0}, device)}) {
            EXPECT_TRUE(std::ranges::none_of(verdict.mismatches, [](const auto& mismatch) {
                return mismatch.rule == "discard.value";
            }));
        }
    }
}

TEST(DiscardValue, ExplanationsTellTheAttribute) {
    cases::Case c = of_target(3.5F);
    const auto told = [&](uint32_t x) {
        return explain_sample(c, Limits{}, Profile::direct3d, {x, 2, 0, 0}).triangles.at(0);
    };
    EXPECT_EQ(told(1).why(), ReasonKind::value_discarded);
    EXPECT_EQ(told(1).sentence,
              "the fragment shader of the draw discards where attribute 0 is negative, as it is "
              "here");
    EXPECT_EQ(told(3).why(), ReasonKind::near_zero);
    EXPECT_EQ(told(6).why(), ReasonKind::inside);
    c.draws[0].early_tests = true;
    EXPECT_EQ(told(1).why(), ReasonKind::discarded_late);
    EXPECT_EQ(
        told(1).sentence,
        "the fragment shader of the draw discards fragments of which attribute 0 is negative, "
        "once depth and stencil are stored");
    EXPECT_EQ(told(3).why(), ReasonKind::near_zero);
    EXPECT_EQ(told(3).decision.coverage, Coverage::either);
    EXPECT_EQ(told(6).why(), ReasonKind::inside);
}

}  // namespace
}  // namespace ref::test
