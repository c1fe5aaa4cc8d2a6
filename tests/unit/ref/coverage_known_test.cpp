// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Pixel counts known from exact rational arithmetic done elsewhere and confirmed on four drivers:
// profile direct3d, 8 subpixel bits, 64 x 64 unless said otherwise.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/ref/coverage_fixture.hpp"

namespace ref::test {
namespace {

constexpr double kSub = 1.0 / 256;

Expectation direct3d(const cases::Case& c) {
    return expect(c, {8}, cases::Profile::direct3d);
}

// How many samples are hit once, with no sample left open or hit twice.
uint64_t once(const cases::Case& c) {
    const Count count = count_hits(direct3d(c));
    EXPECT_EQ(count.open, 0U);
    EXPECT_EQ(count.twice + count.more, 0U);
    return count.once;
}
uint64_t once(const std::vector<Point>& points, uint32_t size = 64, uint32_t samples = 1) {
    return once(pixels(size, size, points, samples));
}

std::vector<Point> fan(Point center, const std::vector<Point>& ring) {
    std::vector<Point> out;
    for (size_t i = 0; i < ring.size(); ++i) {
        out.insert(out.end(), {center, ring[i], ring[(i + 1) % ring.size()]});
    }
    return out;
}

TEST(CoverageKnown, HalfSquares) {
    const Expectation e = direct3d(pixels(64, 64, {{4.5, 4.5}, {20.5, 4.5}, {4.5, 20.5}}));
    EXPECT_EQ(count_hits(e).once, 136U);
    EXPECT_EQ(e.must_samples, 136U);
    EXPECT_EQ(e.either_samples, 0U);
    EXPECT_EQ(hits_at(e, 4, 4).total_min, 1U);
    EXPECT_EQ(hits_at(e, 19, 4).total_min, 1U);
    EXPECT_EQ(hits_at(e, 20, 4).total_max, 0U);
    EXPECT_EQ(hits_at(e, 4, 19).total_min, 1U);
    EXPECT_EQ(hits_at(e, 4, 20).total_max, 0U);
    EXPECT_EQ(once({{20.5, 4.5}, {20.5, 20.5}, {4.5, 20.5}}), 120U);
    EXPECT_EQ(once({{4.5, 4.5}, {20.5, 4.5}, {4.5, 20.5}, {20.5, 4.5}, {20.5, 20.5}, {4.5, 20.5}}),
              256U);
}

TEST(CoverageKnown, FanAroundPixelCenter) {
    const auto f = fan({10.5, 10.5}, {{14.5, 10.5},
                                      {14.5, 14.5},
                                      {10.5, 14.5},
                                      {6.5, 14.5},
                                      {6.5, 10.5},
                                      {6.5, 6.5},
                                      {10.5, 6.5},
                                      {14.5, 6.5}});
    EXPECT_EQ(once(f), 64U);
    EXPECT_EQ(hits_at(direct3d(pixels(64, 64, f)), 10, 10).total_min, 1U);
}

TEST(CoverageKnown, SlopesThroughCenters) {
    EXPECT_EQ(once({{1.5, 1.5}, {29.5, 13.5}, {29.5, 1.5}}), 178U);
    EXPECT_EQ(once({{1.5, 1.5}, {29.5, 13.5}, {1.5, 13.5}}), 158U);
    EXPECT_EQ(once({{29.5, 1.5}, {1.5, 13.5}, {1.5, 1.5}}), 186U);
    EXPECT_EQ(once({{29.5, 1.5}, {1.5, 13.5}, {29.5, 13.5}}), 150U);
    const Expectation e = direct3d(pixels(64, 64, {{1.5, 1.5}, {29.5, 13.5}, {29.5, 1.5}}));
    for (const auto& [i, j] : {std::pair{8U, 4U}, {15U, 7U}, {22U, 10U}}) {
        EXPECT_EQ(hits_at(e, i, j).total_min, 1U) << i << " " << j;
    }
}

TEST(CoverageKnown, VertexAndApexOnCenter) {
    EXPECT_EQ(once({{10.5, 10.5}, {11.5, 10.5}, {10.5, 11.5}}), 1U);
    EXPECT_EQ(once({{10.5, 10.5}, {9.5, 10.5}, {10.5, 9.5}}), 0U);
    const Expectation down = direct3d(pixels(64, 64, {{9.5, 8}, {11.5, 8}, {10.5, 10.5}}));
    EXPECT_EQ(count_hits(down).once, 2U);
    EXPECT_EQ(hits_at(down, 10, 8).total_min + hits_at(down, 10, 9).total_min, 2U);
    const Expectation up = direct3d(pixels(64, 64, {{9.5, 13}, {11.5, 13}, {10.5, 10.5}}));
    EXPECT_EQ(count_hits(up).once, 2U);
    EXPECT_EQ(hits_at(up, 10, 11).total_min + hits_at(up, 10, 12).total_min, 2U);
}

TEST(CoverageKnown, FlatBottomOnCenters) {
    EXPECT_EQ(once({{4, 4.25}, {20, 4.25}, {12, 8.5}}), 40U);
    EXPECT_EQ(once({{4, 12.5}, {20, 12.5}, {12, 8.5}}), 24U);
}

// Only the middle column separates the roundings; nearest-even covers it in these cases, and a unit
// of 1/2 lies within 0.1 of the midpoint, where direct3d leaves both neighbours.
TEST(CoverageKnown, SnapRounding) {
    const auto at = [](double a, double b) {
        const Expectation e =
            direct3d(pixels(32, 32, {{10.5 + a * kSub, 2.5}, {10.5 + b * kSub, 30.5}, {30, 16}}));
        const HitBounds h = hits_at(e, 10, 16);
        return h.total_min == h.total_max ? (h.total_min == 1 ? 'Y' : 'n') : '?';
    };
    EXPECT_EQ(at(.75, 0), 'n');
    EXPECT_EQ(at(.25, 0), 'Y');
    EXPECT_EQ(at(.5, 0), '?');
    EXPECT_EQ(at(1.5, -1), '?');
    EXPECT_EQ(at(.38, 0), 'Y');
    EXPECT_EQ(at(.62, 0), 'n');
}

TEST(CoverageKnown, Slivers) {
    EXPECT_EQ(once({{1, 10.5}, {61, 10.5}, {61, 10.5 + kSub}}), 60U);
    EXPECT_EQ(once({{1, 10.5}, {61, 10.5}, {61, 10.5 - kSub}}), 0U);
    EXPECT_EQ(once({{10.5, 1}, {10.5, 61}, {10.5 + kSub, 61}}), 60U);
    EXPECT_EQ(once({{10.5, 1}, {10.5, 61}, {10.5 - kSub, 61}}), 0U);
    EXPECT_EQ(once({{1.5, 1.5}, {61.5, 61.5}, {61.5 + kSub, 61.5}}), 59U);
    EXPECT_EQ(once({{1.5, 1.5}, {61.5, 61.5}, {61.5 - kSub, 61.5}}), 0U);
    EXPECT_EQ(once({{10.5, 10.5}, {10.5 + kSub, 10.5}, {10.5, 10.5 + kSub}}), 1U);
    EXPECT_EQ(once({{10.55, 10.55}, {11.45, 10.55}, {11, 11.45}}), 0U);
    EXPECT_EQ(once({{2, 10.51}, {62, 10.51}, {2, 11.49}}), 0U);
}

TEST(CoverageKnown, ZeroArea) {
    EXPECT_EQ(once({{1.5, 1.5}, {31.5, 31.5}, {61.5, 61.5}}), 0U);
    EXPECT_EQ(once({{1.5, 1.5}, {31.5, 31.5}, {31.5, 31.5}}), 0U);
    EXPECT_EQ(once({{1.5, 1.5}, {31.5 + .39 * kSub, 31.5}, {61.5, 61.5}}), 0U);
}

TEST(CoverageKnown, DiagonalPairAt2048) {
    const Point p{.5, .5};
    const Point q{2040.5, 2040.5};
    const double m = 1020.5;
    const double d = 1.0 / 16;
    EXPECT_EQ(once({p, {m + d, m}, q, p, q, {m, m + d}}, 2048), 2039U);
}

TEST(CoverageKnown, NeedleFans) {
    const auto ring = [](int count, Point center) {
        std::vector<Point> out;
        for (int i = 0; i < count; ++i) {
            const double a = 2 * std::numbers::pi * i / count;
            // On the grid, so that the count does not depend on rounding.
            out.push_back({std::nearbyint((center[0] + 30 * std::cos(a)) * 256) / 256,
                           std::nearbyint((center[1] + 30 * std::sin(a)) * 256) / 256});
        }
        return fan(center, out);
    };
    EXPECT_EQ(once(ring(720, {32.5, 32.5})), 2819U);
    EXPECT_EQ(once(ring(64, {32, 32})), 2828U);
}

TEST(CoverageKnown, TileBorders) {
    EXPECT_EQ(once({{63.4, 0}, {64.6, 0}, {63.4, 128}, {64.6, 0}, {64.6, 128}, {63.4, 128}}, 128),
              256U);
    EXPECT_EQ(
        once({{64, 64}, {192, 64}, {64, 192}}, 256) + once({{192, 64}, {192, 192}, {64, 192}}, 256),
        16384U);
    EXPECT_EQ(
        once({{.5, .5}, {128.5, .5}, {.5, 128.5}, {128.5, .5}, {128.5 + kSub, 128.5}, {.5, 128.5}},
             256),
        16511U);
}

TEST(CoverageKnown, CoveringTriangles) {
    for (const double s : {1e2, 1e3, 1e4}) {
        const cases::Case c = pixels(64, 64, {{-3 * s, -s}, {3 * s, -s}, {.1 * s, 4 * s}});
        EXPECT_EQ(count_hits(direct3d(c)).once, 4096U) << s;
    }
}

TEST(CoverageKnown, BehindTheEye) {
    const auto one = [](const std::array<glm::vec4, 3>& v, uint32_t size) {
        cases::Case c = blank(size, size);
        cases::Draw d = whole(c);
        d.positions = {v[0], v[1], v[2]};
        c.draws = {d};
        return count_hits(direct3d(c));
    };
    const Count count = one({{{-.5F, -.5F, .5F, 1}, {.5F, -.5F, .5F, 1}, {0, .9F, -.5F, -1}}}, 32);
    EXPECT_LE(count.once, 718U);
    EXPECT_GE(count.once + count.open, 718U);
    EXPECT_LE(count.open, 4U);
}

TEST(CoverageKnown, Multisample) {
    EXPECT_EQ(once({{10.375, 10.125}, {10.875, 10.375}, {10.125, 10.625}}, 64, 4), 0U);
    EXPECT_EQ(once({{10.375, 10.125},
                    {10.875, 10.375},
                    {10.125, 10.625},
                    {10.875, 10.375},
                    {10.625, 10.875},
                    {10.125, 10.625}},
                   64, 4),
              1U);
    const double a = 10.125;
    const double b = 10.875;
    EXPECT_EQ(once({{a, a}, {b, a}, {a, b}, {b, a}, {b, b}, {a, b}}, 64, 4), 2U);
    EXPECT_EQ(once({{10.8, 10.3}, {10.95, 10.35}, {10.85, 10.45}}, 64, 4), 1U);
    EXPECT_EQ(once({{10.46, 10.40}, {10.56, 10.45}, {10.49, 10.60}}, 64, 4), 0U);
}

TEST(CoverageKnown, Junctions) {
    EXPECT_EQ(
        once({{8, 8}, {72, 40}, {70, 2}, {8, 8}, {20, 60}, {40, 24}, {40, 24}, {20, 60}, {72, 40}},
             128),
        2656U);
    const Point m{50.5 + 1.0 / 16, 50.5};
    const Point p{10.5, 10.5};
    const Point q{100.5, 100.5};
    const Expectation e =
        direct3d(pixels(128, 128, {p, q, {100.5, 10.5}, p, m, {10.5, 100.5}, m, q, {10.5, 100.5}}));
    EXPECT_EQ(count_hits(e).twice, 89U);
    EXPECT_EQ(count_hits(e).once, 4095U + 1869U + 2225U - 2U * 89U);
    const Expectation bow = direct3d(pixels(64, 64,
                                            {{10.5, 10.5},
                                             {30.5, 10.5},
                                             {10.5, 30.5},
                                             {30.5, 10.5},
                                             {10.5, 30.5},
                                             {30.5, 30.5},
                                             {30.5, 10.5},
                                             {10.5, 10.5},
                                             {30.5, 30.5}}));
    EXPECT_EQ(count_hits(bow).once, 190U);
    EXPECT_EQ(count_hits(bow).twice, 210U);
}

TEST(CoverageKnown, NegativeHeightMirrors) {
    cases::Case c = blank(32, 32);
    cases::Draw d = whole(c);
    for (const Point& p : {Point{4.5, 4.5}, {20.5, 4.5}, {4.5, 20.5}}) {
        d.positions.push_back(at_pixel(d, p[0], p[1]));
    }
    d.viewport = {0, 32, 32, -32};
    c.draws = {d};
    const Expectation e = direct3d(c);
    uint64_t row = 0;
    uint64_t column = 0;
    for (uint32_t i = 0; i < 32; ++i) {
        row += hits_at(e, i, 27).total_min;
        column += hits_at(e, 4, i).total_min;
    }
    EXPECT_EQ(row, 0U);
    EXPECT_EQ(column, 15U);
}

// The edge to the vertex behind the eye runs exactly through two samples. A device with a guard
// band cuts it beyond the border and snaps it there, one without at the border: either may be
// covered.
TEST(CoverageKnown, AGuardBandDecidesWhereAnEdgeIsSnapped) {
    cases::Case c = blank(64, 64);
    cases::Draw d = whole(c);
    d.positions = {{-0.5F, -0.5F, 0.5F, 1}, {0.5F, -0.5F, 0.5F, 1}, {0, -0.5F, -0.0625F, -0.125F}};
    c.draws.push_back(d);
    for (const cases::Profile profile : cases::kProfiles) {
        const Expectation e = expect(c, {8}, profile);
        for (const uint32_t i : {14U, 49U}) {
            EXPECT_EQ(hits_at(e, i, 2).total_min, 0U) << i;
            EXPECT_EQ(hits_at(e, i, 2).total_max, 1U) << i;
        }
        EXPECT_EQ(hits_at(e, 32, 2).total_min, 1U);
        EXPECT_EQ(hits_at(e, 32, 40).total_max, 0U);
    }
}

// An edge along an axis is snapped to the same coordinate wherever it is cut: the top-left rule
// decides the samples on it.
TEST(CoverageKnown, AnAxisAlignedEdgeIsTheSameForEveryGuardBand) {
    cases::Case c = blank(64, 64);
    cases::Draw d = whole(c);
    // y = 8.5 is the top edge; the others lie outside.
    const float top = -0.734375F;
    d.positions = {{-8, top, 0.5F, 1}, {8, top, 0.5F, 1}, {0, 4, 0.5F, 1}};
    c.draws.push_back(d);
    const Expectation e = direct3d(c);
    for (uint32_t i = 0; i < 64; ++i) {
        EXPECT_EQ(hits_at(e, i, 8).total_min, 1U) << i;
        EXPECT_EQ(hits_at(e, i, 7).total_max, 0U) << i;
    }
}

// 1/w = 2^50 is more than Vulkan guarantees: at profile vulkan every sample of the viewport is left
// open, whether the triangle is cut or not.
TEST(CoverageKnown, LiteralVulkanAsksNothingOfTinyW) {
    for (const float left : {-2.25F, -0.75F}) {
        cases::Case c = blank(32, 32);
        cases::Draw d = whole(c);
        d.viewport.width = 16;
        d.positions = {
            {left, 0.125F, 0.5F, 1}, {0.625F, -0.75F, 0.5F, 1}, {0.5F, 0.8125F, 0.5F, 1}};
        for (glm::vec4& p : d.positions) {
            p *= 0x1p-50F;
        }
        c.draws.push_back(d);
        const Expectation literal = expect(c, {8}, cases::Profile::vulkan);
        EXPECT_EQ(literal.must_samples, 0U);
        EXPECT_EQ(literal.either_samples, 16U * 32U);
        EXPECT_GT(expect(c, {8}, cases::Profile::practice).must_samples, 100U);
        EXPECT_GT(expect(c, {8}, cases::Profile::direct3d).must_samples, 100U);
    }
}

}  // namespace
}  // namespace ref::test
