// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Depths that the fragment shader writes: random cases against the oracle, and against cases whose
// triangles have these depths of their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cases/model/sample.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/sample_values.hpp"
#include "tests/unit/ref/same_expectations.hpp"
#include "tests/unit/ref/value_case.hpp"

namespace ref::test {
namespace {

using cases::DepthFormat;
using cases::FragDepth;
using value_test::Random;

FragDepth random_frag_depth(Random& random) {
    FragDepth out;
    if (random.one_in(3)) {
        out.is_coord = true;
        return out;
    }
    out.value = random.eighth();
    if (random.one_in(2)) {
        out.where = static_cast<cases::Discard>(1 + random.below(3));
        out.other = random.eighth();
    }
    return out;
}

cases::Case random_frag_depth_case(uint64_t seed) {
    Random random(seed);
    cases::Case c;
    c.id = "random frag depth";
    c.target = {8, 8, random.one_in(3) ? 4U : 1U};
    c.target.has_stencil = random.one_in(3);
    c.target.depth_format = static_cast<DepthFormat>(random.one_in(2) ? 0 : random.below(3));
    const uint32_t draws = 1 + random.below(4);
    for (uint32_t k = 0; k < draws; ++k) {
        cases::Draw d;
        d.viewport = {0, 0, 8, 8, 0, 1};
        d.scissor = {0, 0, 8, 8};
        d.early_tests = random.one_in(4);
        d.depth.compare = random.one_in(3) ? cases::CompareOp::always
                                           : static_cast<cases::CompareOp>(random.below(8));
        d.depth.write = !random.one_in(4);
        d.depth.clamp = random.one_in(3);
        if (random.one_in(3)) {
            d.viewport.min_depth = 0.25F;
            d.viewport.max_depth = 0.75F;
            d.depth.clamp = true;
        }
        if (!random.one_in(4)) {
            d.frag_depth = random_frag_depth(random);
        }
        if (c.target.has_stencil && random.one_in(2)) {
            d.stencil.front.depth_fail = static_cast<cases::StencilOp>(random.below(8));
            d.stencil.back.compare = static_cast<cases::CompareOp>(random.below(8));
        }
        value_test::add_random_triangles(d, random, 8, 64);
        c.draws.push_back(d);
    }
    return c;
}

TEST(ExhaustiveFragDepth, ExpectationsAgreeWithTheOracle) {
    uint64_t must = 0, open = 0, others = 0;
    for (uint64_t seed = 1; seed <= 150; ++seed) {
        const cases::Case c = random_frag_depth_case(seed);
        cases::Case plain = c;
        for (cases::Draw& draw : plain.draws) {
            draw.frag_depth.reset();
        }
        for (const cases::Profile profile : cases::kProfiles) {
            const Expectation fast = expect(c, Limits{}, profile);
            const Expectation slow = exact::expect(c, Limits{}, profile);
            ASSERT_TRUE(same_expectations(fast, slow)) << "seed " << seed;
            const Expectation own = expect(plain, Limits{}, profile);
            must += fast.must_samples;
            open += fast.either_samples;
            for (size_t k = 0; k < fast.samples.size(); ++k) {
                others += is_same(fast, own, k) ? 0U : 1U;
            }
        }
    }
    EXPECT_GT(must, 3000U);
    EXPECT_GT(open, 100U);
    EXPECT_GT(others, 1000U);
}

// With early tests a case is what it would be if its shaders wrote no depth.
TEST(FragDepth, EarlyTestsIgnoreIt) {
    for (uint64_t seed = 1; seed <= 60; ++seed) {
        cases::Case c = random_frag_depth_case(seed + 1000);
        for (cases::Draw& draw : c.draws) {
            draw.early_tests = true;
        }
        cases::Case plain = c;
        for (cases::Draw& draw : plain.draws) {
            draw.frag_depth.reset();
        }
        const Expectation ours = expect(c, Limits{}, cases::Profile::direct3d);
        const Expectation theirs = expect(plain, Limits{}, cases::Profile::direct3d);
        ASSERT_TRUE(same_expectations(ours, theirs)) << "seed " << seed;
    }
}

// Squares over the whole target, whose own depths are what the first ones write.
TEST(FragDepth, OutcomesAreThoseOfPlanesWithTheseDepths) {
    Random random(5);
    uint64_t hits = 0;
    for (uint32_t k = 0; k < 200; ++k) {
        cases::Case written;
        written.target = {4, 4, random.one_in(2) ? 4U : 1U};
        written.target.depth_clear = random.eighth();
        cases::Case plain = written;
        for (uint32_t d = 0; d < 3; ++d) {
            cases::Draw draw;
            draw.viewport = {0, 0, 4, 4, 0, 1};
            draw.scissor = {0, 0, 4, 4};
            draw.depth.compare = static_cast<cases::CompareOp>(random.below(8));
            draw.depth.write = random.one_in(2);
            // Thirds of steps, so that a plane's error decides nothing.
            const float z = random.eighth() * 0.75F + 0.0625F * static_cast<float>(d);
            draw.positions = {{-1, -1, z, 1}, {3, -1, z, 1}, {-1, 3, z, 1}};
            plain.draws.push_back(draw);
            draw.positions = {{-1, -1, 0.25F, 1}, {3, -1, 0.875F, 1}, {-1, 3, 0.5F, 1}};
            draw.frag_depth = FragDepth{.value = z};
            draw.depth.bias = cases::DepthBias{.constant = 1e6F};
            written.draws.push_back(draw);
        }
        const Expectation ours = expect(written, Limits{}, cases::Profile::direct3d);
        const Expectation theirs = expect(plain, Limits{}, cases::Profile::direct3d);
        for (size_t index = 0; index < ours.samples.size(); ++index) {
            const HitBounds& a = ours.samples[index].hits;
            const HitBounds& b = theirs.samples[index].hits;
            // A number is exact, a plane has an error: it may leave open what a number decides.
            ASSERT_GE(a.total_min, b.total_min) << k;
            ASSERT_LE(a.total_max, b.total_max) << k;
            ASSERT_TRUE(a.is_decided()) << k;
            hits += a.total_min;
        }
    }
    EXPECT_GT(hits, 1000U);
}

TEST(FragDepth, StoredNumbersAreKnownByHand) {
    cases::Draw draw;
    draw.viewport = {0, 0, 4, 4, 0.75F, 0.25F};
    draw.depth.clamp = true;
    constexpr auto kVulkan = cases::Profile::vulkan;
    constexpr auto kDirect3D = cases::Profile::direct3d;
    const auto stored = [&](DepthFormat format, float z) {
        return value::StoredDepth(draw, format, z);
    };
    EXPECT_TRUE(stored(DepthFormat::d32_float, 0.3F).may_be(0.3F, kDirect3D));
    EXPECT_FALSE(stored(DepthFormat::d32_float, 0.3F).may_be(std::nextafter(0.3F, 1.0F), kVulkan));
    EXPECT_TRUE(stored(DepthFormat::d32_float, 0.125F).may_be(0.25F, kDirect3D));  // clamped
    EXPECT_FALSE(stored(DepthFormat::d32_float, 0.125F).may_be(0.125F, kVulkan));
    EXPECT_TRUE(stored(DepthFormat::d32_float, 2).may_be(0.75F, kDirect3D));
    // 0.5 is 32767.5 steps of 65535.
    const float low = cases::depth_of_code(32767, DepthFormat::d16_unorm);
    const float high = cases::depth_of_code(32768, DepthFormat::d16_unorm);
    EXPECT_TRUE(stored(DepthFormat::d16_unorm, 0.5F).may_be(low, kDirect3D));
    EXPECT_TRUE(stored(DepthFormat::d16_unorm, 0.5F).may_be(high, kDirect3D));
    EXPECT_FALSE(stored(DepthFormat::d16_unorm, 0.5F).may_be(0.5F, kVulkan));
    // 0.5 + 2^-18 is 32767.75 steps: Direct3D rounds within 0.6 of one.
    EXPECT_TRUE(stored(DepthFormat::d16_unorm, 0.5F + 0x1p-18F).may_be(low, kVulkan));
    EXPECT_FALSE(stored(DepthFormat::d16_unorm, 0.5F + 0x1p-18F).may_be(low, kDirect3D));
    EXPECT_TRUE(stored(DepthFormat::d16_unorm, 0.5F + 0x1p-18F).may_be(high, kDirect3D));
    draw.depth.clamp = false;
    EXPECT_TRUE(stored(DepthFormat::d32_float, 0.125F).may_be(0.5F, kVulkan));  // undefined
}

TEST(FragDepth, PixelsAreKnownByHand) {
    cases::Case c;
    c.draws.emplace_back();
    cases::Draw& draw = c.draws[0];
    draw.viewport = {0, 0, 4, 4, 0, 1};
    EXPECT_FALSE(cases::written_depth(draw, 0, 0));
    draw.frag_depth = FragDepth{.value = 0.25F, .other = 0.5F, .where = cases::Discard::odd_rows};
    EXPECT_EQ(cases::written_depth(draw, 3, 2), 0.25F);
    EXPECT_EQ(cases::written_depth(draw, 2, 3), 0.5F);
    draw.early_tests = true;
    EXPECT_FALSE(cases::written_depth(draw, 2, 3));
}

}  // namespace
}  // namespace ref::test
