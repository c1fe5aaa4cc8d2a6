// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A stricter profile forbids whatever a looser one does; and edges that clipping leaves alone.
#include <gtest/gtest.h>

#include "ref/coverage/exact/exact.hpp"
#include "tests/unit/ref/coverage_random.hpp"

namespace ref::test {
namespace {

using cases::Profile;

HitBounds middle(const std::vector<Point>& points, Profile profile) {
    return hits_at(expect(pixels(64, 64, points), {8}, profile), 20, 20);
}

// The right edge of a triangle that leaves the view volume on the left: both ends on the grid and
// inside, the sample in its middle.
TEST(CoverageClippedEdge, TieOfAnUnclippedEdgeIsDecided) {
    const std::vector<Point> left{{20.5, .5}, {20.5, 40.5}, {-40, 20.5}};
    const std::vector<Point> right{{20.5, 40.5}, {20.5, .5}, {40, 20.5}};
    const HitBounds l = middle(left, Profile::direct3d);
    EXPECT_EQ(l.total_max, 0U);  // a right edge
    const HitBounds r = middle(right, Profile::direct3d);
    EXPECT_EQ(r.total_min, 1U);
    EXPECT_EQ(middle(left, Profile::practice).total_max, 1U);
    std::vector<Point> both = left;
    both.insert(both.end(), right.begin(), right.end());
    for (const Profile profile : {Profile::practice, Profile::direct3d}) {
        const HitBounds b = middle(both, profile);
        EXPECT_EQ(b.total_min, 1U);
        EXPECT_EQ(b.total_max, 1U);
    }
    // Mirrored: the left edge of a triangle that leaves the view volume on the right.
    const HitBounds m = middle({{20.5, .5}, {20.5, 40.5}, {100, 20.5}}, Profile::direct3d);
    EXPECT_EQ(m.total_min, 1U);
}

// The cut ends of two edges fall within a pixel of each other: the border edge between them may
// point nearly anywhere, but it does not reach this sample.
TEST(CoverageClippedEdge, ShortBorderEdgeSettlesNothing) {
    const cases::Case c =
        pixels(8, 8, {{6.74414062, 6.49804688}, {0.49609375, 8.00195312}, {3.49414062, 5.8828125}});
    for (const Profile profile : {Profile::practice, Profile::direct3d}) {
        EXPECT_EQ(hits_at(expect(c, {8}, profile), 3, 6).total_min, 1U);
        EXPECT_EQ(hits_at(exact::expect(c, {8}, profile), 3, 6).total_min, 1U);
    }
}

// Samples on the border itself (x = 0 and y = 0 of 16 samples) are not settled by the viewport
// where ties are free.
TEST(CoverageClippedEdge, SampleOnTheBorderStaysOpen) {
    cases::Case c = pixels(8, 8, {{-8, -8}, {24, -8}, {-8, 24}}, 16);
    uint32_t on_border = 0;
    const Expectation e = expect(c, {8}, Profile::practice);
    for (uint32_t s = 0; s < 16; ++s) {
        if (sample_position(0, 3, s, c.target).x == 0) {
            EXPECT_EQ(hits_at(e, 0, 3, s).total_min, 0U);
            EXPECT_EQ(hits_at(e, 0, 3, s).total_max, 1U);
            ++on_border;
        }
    }
    EXPECT_EQ(on_border, 1U);
}

// A coordinate inside, at, or far beyond the borders of 8 pixels: on centres, on the grid, on
// midpoints of the grid, or a little beside centres.
double coordinate(RandomCases& random, bool leaves) {
    const bool is_far = leaves && random.integer(0, 2) == 0;
    const int64_t low = is_far ? -20 : 0;
    const int64_t high = is_far ? 28 : 8;
    switch (random.integer(0, 3)) {
        case 0:
            return static_cast<double>(random.integer(low * 2, high * 2)) / 2;
        case 1:
            return static_cast<double>(random.integer(low * 256, high * 256)) / 256;
        case 2:
            return static_cast<double>(random.integer(low * 512, high * 512)) / 512;
        default:
            return static_cast<double>(random.integer(low * 2, high * 2)) / 2 +
                   static_cast<double>(random.integer(-3, 3)) / 512;
    }
}

// Whether `strict` allows hits that `loose` does not.
bool escapes(const HitBounds& strict, const HitBounds& loose) {
    for (uint32_t front = 0; front <= 5; ++front) {
        for (uint32_t back = 0; back <= 5; ++back) {
            if (strict.allows(front, back) && !loose.allows(front, back)) {
                return true;
            }
        }
    }
    return false;
}

TEST(ExhaustiveCoverageNesting, StricterProfilesForbidNoLess) {
    RandomCases random(11);
    uint64_t compared = 0;
    uint64_t decided_later = 0;
    for (int n = 0; n < 2000; ++n) {
        const bool leaves = n % 2 == 1;
        std::vector<Point> pool;
        const int64_t vertices = random.integer(4, 6);
        for (int64_t k = 0; k < vertices; ++k) {
            const double x = coordinate(random, leaves);
            pool.push_back({x, coordinate(random, leaves)});
        }
        std::vector<Point> fan;
        const int64_t triangles = random.integer(2, 5);
        const size_t rim = pool.size() - 1;
        for (size_t t = 0; t < static_cast<size_t>(triangles); ++t) {
            fan.insert(fan.end(), {pool[0], pool[1 + t % rim], pool[1 + (t + 1) % rim]});
        }
        const cases::Case c = pixels(8, 8, fan);
        const Expectation loosest = expect(c, {8}, Profile::vulkan);
        const Expectation middle = expect(c, {8}, Profile::practice);
        const Expectation strictest = expect(c, {8}, Profile::direct3d);
        for (size_t k = 0; k < strictest.samples.size(); ++k) {
            const HitBounds& v = loosest.samples[k].hits;
            const HitBounds& p = middle.samples[k].hits;
            const HitBounds& d = strictest.samples[k].hits;
            ASSERT_FALSE(escapes(p, v))
                << "case " << n << ", sample " << k << ": practice " << p.total_min << ".."
                << p.total_max << ", vulkan " << v.total_min << ".." << v.total_max;
            ASSERT_FALSE(escapes(d, p))
                << "case " << n << ", sample " << k << ": direct3d " << d.total_min << ".."
                << d.total_max << ", practice " << p.total_min << ".." << p.total_max;
            compared += 2;
            decided_later += d.is_decided() && !p.is_decided() ? 1U : 0U;
        }
    }
    EXPECT_GT(compared, 200000U);
    EXPECT_GT(decided_later, 200U);
}

}  // namespace
}  // namespace ref::test
