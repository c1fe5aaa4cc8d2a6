// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The fast reference against the oracle: equal in every sample of every random case.
#include <gtest/gtest.h>

#include "ref/coverage_exact.hpp"
#include "ref/coverage_fast.hpp"
#include "ref/coverage_setup.hpp"
#include "tests/unit/ref/coverage_random.hpp"

namespace ref::test {
namespace {

std::string describe(const SampleExpectation& s) {
    const HitBounds& b = s.hits;
    return "front " + std::to_string(b.front_min) + ".." + std::to_string(b.front_max) + " back " +
           std::to_string(b.back_min) + ".." + std::to_string(b.back_max) + " signed " +
           std::to_string(b.signed_min) + ".." + std::to_string(b.signed_max) + " total " +
           std::to_string(b.total_min) + ".." + std::to_string(b.total_max) + " writers " +
           std::to_string(s.writers_begin) + "+" + std::to_string(s.writers_count);
}

void expect_equal(const cases::Case& c, const Setting& s, uint64_t seed) {
    const Expectation fast = expect(c, s.limits, s.profile);
    const Expectation slow = exact::expect(c, s.limits, s.profile);
    ASSERT_EQ(fast.samples.size(), slow.samples.size());
    for (size_t k = 0; k < fast.samples.size(); ++k) {
        ASSERT_EQ(fast.samples[k], slow.samples[k])
            << "seed " << seed << ", profile " << cases::to_string(s.profile) << ", bits "
            << s.limits.subpixel_bits << ", sample " << k << ": fast " << describe(fast.samples[k])
            << ", oracle " << describe(slow.samples[k]);
    }
    ASSERT_EQ(fast.writers, slow.writers) << "seed " << seed;
    ASSERT_EQ(fast.must_samples, slow.must_samples);
    ASSERT_EQ(fast.either_samples, slow.either_samples);
}

TEST(CoverageOracle, RandomTriangles) {
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

TEST(CoverageOracle, RandomMeshes) {
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

TEST(CoverageOracle, ClassifyAgreesWithScan) {
    uint64_t covered = 0;
    for (uint64_t seed = 1; seed <= 200; ++seed) {
        RandomCases random(seed);
        const Setting s = setting(random);
        const cases::Case c = random.triangles();
        VertexBoxes boxes(c, s.limits, s.profile);
        for (const Triangle& t : assemble(c)) {
            const TriangleSetup setup =
                set_up(c, t, s.limits, s.profile, boxes, window_of(c, c.draws[t.draw], s.profile));
            for (uint32_t j = 0; j < c.target.height; ++j) {
                for (uint32_t i = 0; i < c.target.width; ++i) {
                    const FixedPoint p = sample_position(i, j, 0, c.target);
                    const Classification fast = fast::classify(setup, p);
                    const Classification slow = exact::classify(setup, p);
                    ASSERT_EQ(fast.coverage, slow.coverage) << "seed " << seed;
                    if (fast.coverage != Coverage::must_not) {
                        ASSERT_EQ(fast.on_edge, slow.on_edge) << "seed " << seed;
                        ++covered;
                    }
                }
            }
        }
    }
    EXPECT_GT(covered, 1000U);
}

TEST(CoverageOracle, HullAndWinding) {
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
