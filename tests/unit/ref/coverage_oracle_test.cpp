// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The fast reference against the oracle: equal in every sample of every random case.
#include <gtest/gtest.h>

#include <limits>

#include "ref/coverage/exact/exact.hpp"
#include "ref/coverage/fast/fast.hpp"
#include "ref/coverage/setup.hpp"
#include "tests/unit/ref/coverage_random.hpp"
#include "tests/unit/ref/same_expectations.hpp"

namespace ref::test {
namespace {

void expect_equal(const cases::Case& c, const Setting& s, uint64_t seed) {
    const Expectation fast = expect(c, s.limits, s.profile);
    const Expectation slow = exact::expect(c, s.limits, s.profile);
    ASSERT_TRUE(same_expectations(fast, slow))
        << "seed " << seed << ", profile " << cases::to_string(s.profile) << ", bits "
        << s.limits.subpixel_bits;
}

TEST(ExhaustiveCoverageOracle, RandomTriangles) {
    uint64_t samples = 0;
    uint64_t decided = 0;
    uint64_t open = 0;
    for (uint64_t seed = 1; samples < 1000000; ++seed) {
        RandomCases random(seed);
        const Setting s = setting(random);
        const cases::Case c = random.triangles();
        expect_equal(c, s, seed);
        if (HasFatalFailure()) {
            return;
        }
        const Expectation e = expect(c, s.limits, s.profile);
        samples += e.samples.size();
        decided += e.must_samples;
        open += e.either_samples;
    }
    EXPECT_GT(decided, samples / 20);  // the cases are about something
    EXPECT_GT(open, 1000U);
}

TEST(ExhaustiveCoverageOracle, RandomMeshes) {
    uint64_t open = 0;
    for (uint64_t seed = 1; seed <= 150; ++seed) {
        RandomCases random(seed);
        const Setting s = setting(random);
        const cases::Case c = random.mesh();
        expect_equal(c, s, seed);
        if (HasFatalFailure()) {
            return;
        }
        open += expect(c, s.limits, s.profile).either_samples;
    }
    EXPECT_GT(open, 100U);
}

// Meshes and triangles with bad numbers in some of their vertices.
TEST(ExhaustiveCoverageOracle, BadNumbers) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kMax = std::numeric_limits<float>::max();
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                         kInfinity,
                         -kInfinity,
                         kMax,
                         -kMax,
                         0x1p33F,
                         0x1p-149F,
                         -0x1p-149F,
                         0.0F,
                         -0.0F};
    uint64_t must = 0;
    uint64_t open = 0;
    for (uint64_t seed = 1; seed <= 300; ++seed) {
        RandomCases random(seed);
        const Setting s = setting(random);
        cases::Case c = random.flip() ? random.mesh() : random.triangles();
        auto& positions = c.draws[0].positions;
        const int64_t count = random.integer(1, 2);
        for (int64_t k = 0; k < count; ++k) {
            const auto v = static_cast<size_t>(random.integer(0, std::ssize(positions) - 1));
            const auto part = static_cast<glm::vec4::length_type>(random.integer(0, 3));
            positions[v][part] = bad[random.integer(0, 9)];
        }
        expect_equal(c, s, seed);
        if (HasFatalFailure()) {
            return;
        }
        const Expectation e = expect(c, s.limits, s.profile);
        must += e.must_samples;
        open += e.either_samples;
    }
    EXPECT_GT(must, 1000U);
    EXPECT_GT(open, 1000U);
}

// What a bad vertex frees, by hand: the triangles that use it, inside the scissor, and nothing
// else.
TEST(BadNumbers, OnlyTheirTrianglesAreFree) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    for (const cases::Profile profile : cases::kProfiles) {
        cases::Case c;
        c.target.width = 8;
        c.target.height = 4;
        cases::Draw d;
        d.viewport = {0, 0, 8, 4, 0, 1};
        d.scissor = {0, 0, 6, 4};
        // Columns 0 to 3 whole, by two triangles; the bad one is the second.
        d.positions = {{-1, -1, 0, 1}, {0, -1, 0, 1},   {-1, 3, 0, 1},
                       {0, 0, 0, 1},   {kNan, 0, 0, 1}, {0, 1, 0, 1}};
        c.draws.push_back(d);
        const Expectation e = expect(c, Limits{8}, profile);
        const auto bounds = [&](uint32_t x, uint32_t y) { return e.samples[y * 8 + x].hits; };
        EXPECT_EQ(bounds(0, 0).total_min, 1U);  // the good one covers it for certain
        EXPECT_EQ(bounds(0, 0).total_max, 2U);  // and the bad one may
        EXPECT_EQ(bounds(5, 3).total_min, 0U);
        EXPECT_EQ(bounds(5, 3).total_max, 1U);
        EXPECT_EQ(bounds(5, 3).front_max, 1U);  // of either face
        EXPECT_EQ(bounds(5, 3).back_max, 1U);
        EXPECT_EQ(bounds(6, 3).total_max, 0U);  // beyond the scissor nothing is free
        EXPECT_EQ(bounds(7, 0).total_max, 0U);
    }
}

// 2^33 is beyond what Vulkan guarantees and ordinary for binary32.
TEST(BadNumbers, RangeDependsOnTheProfile) {
    const glm::vec4 far(0x1p33F, 0, 0, 1);
    EXPECT_FALSE(is_representable(far, cases::Profile::vulkan));
    EXPECT_TRUE(is_representable(far, cases::Profile::practice));
    EXPECT_TRUE(is_representable({0x1p32F, 0, 0, 1}, cases::Profile::vulkan));
    EXPECT_FALSE(is_representable({0x1p125F, 0, 0, 1}, cases::Profile::direct3d));
    EXPECT_TRUE(is_representable({0x1p123F, 0, 0, 1}, cases::Profile::direct3d));
}

TEST(ExhaustiveCoverageOracle, ClassifyAgreesWithScan) {
    uint64_t covered = 0;
    for (uint64_t seed = 1; seed <= 200; ++seed) {
        RandomCases random(seed);
        const Setting s = setting(random);
        const cases::Case c = random.triangles();
        VertexBoxes boxes(c, s.limits, s.profile);
        for (const cases::Triangle& t : assemble(c)) {
            const TriangleSetup setup =
                set_up(c, t, s.limits, s.profile, boxes, window_of(c, c.draws[t.draw], s.profile));
            for (uint32_t j = 0; j < c.target.height; ++j) {
                for (uint32_t i = 0; i < c.target.width; ++i) {
                    const FixedPoint p = sample_position(i, j, 0, c.target);
                    const Coverage fast = fast::classify(setup, p);
                    ASSERT_EQ(fast, exact::classify(setup, p)) << "seed " << seed;
                    covered += fast != Coverage::must_not ? 1U : 0U;
                }
            }
        }
    }
    EXPECT_GT(covered, 1000U);
}

TEST(ExhaustiveCoverageOracle, HullAndWinding) {
    RandomCases random(7);
    const auto number = [&] { return random.integer(-6, 6); };
    int inside = 0;
    for (int k = 0; k < 20000; ++k) {
        std::vector<Box> boxes;
        const int64_t n = random.integer(1, 5);
        for (int64_t i = 0; i < n; ++i) {
            const int64_t x = number();
            const int64_t y = number();
            boxes.push_back({x, y, x + random.integer(0, 2), y + random.integer(0, 2)});
        }
        const FixedPoint p{number(), number()};
        ASSERT_EQ(fast::is_in_hull(boxes, p), exact::is_in_hull(boxes, p)) << k;
        inside += fast::is_in_hull(boxes, p) ? 1 : 0;
        std::vector<FixedPoint> polygon;
        for (const Box& b : boxes) {
            polygon.push_back({b.x0, b.y1});
        }
        ASSERT_EQ(fast::winding(polygon, p), exact::winding(polygon, p)) << k;
    }
    EXPECT_GT(inside, 1000);
}

}  // namespace
}  // namespace ref::test
