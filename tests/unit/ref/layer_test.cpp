// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Targets with several layers: a triangle exists in the layer of its draw alone, for coverage,
// shared edges, depth and colours.
#include <gtest/gtest.h>

#include <random>

#include "cases/model/sample.hpp"
#include "coverage_fixture.hpp"
#include "ref/expectation/explain.hpp"
#include "tests/unit/ref/same_expectations.hpp"

namespace ref::test {
namespace {

using cases::Profile;

// One draw a layer of `layers`, each of the triangles in it.
cases::Case layered(uint32_t size, uint32_t layers, const std::vector<std::vector<Point>>& draws,
                    const std::vector<uint32_t>& layer_of, uint32_t samples = 1) {
    cases::Case c = blank(size, size, samples);
    c.target.layers = layers;
    for (size_t d = 0; d < draws.size(); ++d) {
        cases::Draw draw = whole(c);
        draw.layer = layer_of[d];
        for (const Point& p : draws[d]) {
            draw.positions.push_back(at_pixel(draw, p[0], p[1]));
        }
        c.draws.push_back(draw);
    }
    return c;
}

// The samples of a layer, as a case of that layer's draws alone has them.
void expect_same_as_alone(const cases::Case& c, const Limits& limits, Profile profile) {
    const Expectation all = expect(c, limits, profile);
    for (uint32_t layer = 0; layer < c.target.layers; ++layer) {
        cases::Case alone = c;
        alone.target.layers = 1;
        alone.draws.clear();
        for (const cases::Draw& draw : c.draws) {
            if (draw.layer == layer) {
                alone.draws.push_back(draw);
                alone.draws.back().layer = 0;
            }
        }
        const Expectation single = expect(alone, limits, profile);
        const size_t first = single.samples.size() * layer;
        for (size_t k = 0; k < single.samples.size(); ++k) {
            ASSERT_EQ(all.samples[first + k].hits, single.samples[k].hits)
                << "layer " << layer << " sample " << k << " at " << cases::to_string(profile);
            ASSERT_EQ(all.samples[first + k].writers_count, single.samples[k].writers_count);
            ASSERT_EQ(all.samples[first + k].depth_count, single.samples[k].depth_count);
        }
    }
}

const std::vector<Point> kUpper = {{0, 0}, {8, 0}, {0, 8}};
const std::vector<Point> kLower = {{8, 0}, {8, 8}, {0, 8}};

}  // namespace

TEST(Layers, AreStacked) {
    cases::Target target{5, 3, 4};
    target.layers = 7;
    EXPECT_EQ(target.rows(), 21U);
    EXPECT_EQ(index_of(target, {2, 1, 3, 6}), ((6U * 3U + 1U) * 5U + 2U) * 4U + 3U);
    for (size_t index = 0; index < size_t{5} * 21 * 4; ++index) {
        const cases::SampleId id = sample_at(target, index);
        EXPECT_LT(id.x, 5U);
        EXPECT_LT(id.y, 3U);
        EXPECT_LT(id.sample, 4U);
        EXPECT_EQ(index_of(target, id), index);
    }
    EXPECT_EQ(sample_at(target, 419).layer, 6U);
}

TEST(Layers, ATriangleIsInItsLayerAlone) {
    const cases::Case c = layered(8, 3, {kUpper}, {1});
    const Expectation e = expect(c, Limits{8}, Profile::direct3d);
    ASSERT_EQ(e.samples.size(), 3U * 64U);
    EXPECT_EQ(count_hits(e), (Count{3 * 64 - 28, 28, 0, 0, 0}));
    for (uint32_t j = 0; j < 8; ++j) {
        for (uint32_t i = 0; i < 8; ++i) {
            EXPECT_EQ(hits_at(e, i, j, 0, 0).total_max, 0U);
            EXPECT_EQ(hits_at(e, i, j, 0, 1).total_min, i + j < 7 ? 1U : 0U);
            EXPECT_EQ(hits_at(e, i, j, 0, 2).total_max, 0U);
        }
    }
}

// In one layer the samples on the diagonal belong to exactly one of both; the same two triangles in
// two layers have no common edge, so that Vulkan leaves each alone free there.
TEST(Layers, AnEdgeIsSharedInOneLayerOnly) {
    const cases::Case together = layered(8, 2, {kUpper, kLower}, {1, 1});
    const cases::Case apart = layered(8, 2, {kUpper, kLower}, {0, 1});
    for (const Profile profile : {Profile::vulkan, Profile::practice}) {
        const Expectation one = expect(together, Limits{8}, profile);
        const Expectation two = expect(apart, Limits{8}, profile);
        for (uint32_t k = 0; k < 8; ++k) {
            const HitBounds& both = hits_at(one, k, 7 - k, 0, 1);
            EXPECT_EQ(both.total_min, 1U) << k;
            EXPECT_EQ(both.total_max, 1U) << k;
            for (const uint32_t layer : {0U, 1U}) {
                const HitBounds& alone = hits_at(two, k, 7 - k, 0, layer);
                EXPECT_EQ(alone.total_min, 0U) << k;
                EXPECT_EQ(alone.total_max, 1U) << k;
            }
        }
    }
    // At direct3d a triangle that is decided does not settle a neighbour in another layer, either.
    const Expectation e = expect(apart, Limits{8}, Profile::direct3d);
    for (uint32_t k = 0; k < 8; ++k) {
        EXPECT_EQ(hits_at(e, k, 7 - k, 0, 0).total_max, 0U);  // its right edge
        EXPECT_EQ(hits_at(e, k, 7 - k, 0, 1).total_min, 1U);  // its left edge
    }
}

// A vertical edge half a subpixel from the centres of a column: it may snap to either side of them.
// In one layer one of both triangles has each centre; in two layers each triangle may have it or
// not. A neighbour that does not show in the layer settles nothing there, at direct3d either.
TEST(Layers, OpenSamplesStayOpen) {
    constexpr double kEdge = 4.5 + 1.0 / 512;
    const std::vector<Point> left = {{0, 0}, {kEdge, 0}, {kEdge, 8}};
    const std::vector<Point> right = {{kEdge, 0}, {8, 0}, {kEdge, 8}};
    for (const Profile profile : cases::kProfiles) {
        const Expectation one = expect(layered(8, 2, {left, right}, {1, 1}), Limits{8}, profile);
        const Expectation two = expect(layered(8, 2, {left, right}, {1, 0}), Limits{8}, profile);
        for (uint32_t j = 1; j < 6; ++j) {
            EXPECT_EQ(hits_at(one, 4, j, 0, 1).total_min, 1U) << cases::to_string(profile);
            EXPECT_EQ(hits_at(one, 4, j, 0, 1).total_max, 1U) << cases::to_string(profile);
            for (const uint32_t layer : {0U, 1U}) {
                EXPECT_EQ(hits_at(two, 4, j, 0, layer).total_min, 0U) << cases::to_string(profile);
                EXPECT_EQ(hits_at(two, 4, j, 0, layer).total_max, 1U) << cases::to_string(profile);
            }
        }
    }
}

// Random triangles over shared vertices, in random layers, with and without depth test: each layer
// is what it would be alone, and both implementations agree.
TEST(ExhaustiveLayers, EachIsAsAloneAndExactAgrees) {
    std::mt19937_64 random(4711);
    const auto below = [&](uint64_t n) { return random() % n; };
    uint64_t open = 0;
    for (int round = 0; round < 16; ++round) {
        const uint32_t samples = round % 3 == 0 ? 4 : 1;
        std::vector<Point> points;
        for (int k = 0; k < 6; ++k) {
            const double grid = round % 2 == 0 ? 2 : 1000;
            points.push_back({static_cast<double>(below(8 * static_cast<uint64_t>(grid))) / grid,
                              static_cast<double>(below(8 * static_cast<uint64_t>(grid))) / grid});
        }
        std::vector<std::vector<Point>> draws;
        std::vector<uint32_t> layers;
        for (int d = 0; d < 6; ++d) {
            draws.push_back({points[below(6)], points[below(6)], points[below(6)], points[below(6)],
                             points[below(6)], points[below(6)]});
            layers.push_back(static_cast<uint32_t>(below(3)));
        }
        cases::Case c = layered(8, 3, draws, layers, samples);
        if (round % 5 == 0) {
            for (cases::Draw& draw : c.draws) {
                draw.depth.compare = cases::CompareOp::less_or_equal;
            }
        }
        for (const Profile profile : cases::kProfiles) {
            expect_same_as_alone(c, Limits{round % 4 == 0 ? 4 : 8}, profile);
            const Expectation fast = expect(c, Limits{8}, profile);
            const Expectation slow = exact::expect(c, Limits{8}, profile);
            ASSERT_TRUE(same_expectations(fast, slow)) << round;
            open += fast.either_samples;
        }
    }
    EXPECT_GT(open, 0U);
}

TEST(Layers, ExplanationsNameTheLayerOfTheDraw) {
    const cases::Case c = layered(8, 3, {kUpper, kLower}, {1, 2});
    const SampleExplanation here = explain_sample(c, Limits{8}, Profile::direct3d, {1, 1, 0, 1});
    ASSERT_EQ(here.triangles.size(), 2U);
    EXPECT_FALSE(here.of_all);
    EXPECT_FALSE(here.triangles[0].has(ReasonKind::other_layer));
    EXPECT_EQ(here.triangles[0].decision.coverage, Coverage::must);
    EXPECT_TRUE(here.triangles[1].has(ReasonKind::other_layer));
    EXPECT_EQ(here.triangles[1].sentence, "the draw goes to layer 2");
    const SampleExplanation none = explain_sample(c, Limits{8}, Profile::direct3d, {1, 1, 0, 0});
    EXPECT_EQ(none.of_all, ReasonKind::other_layer);
    EXPECT_EQ(none.triangles[0].decision.coverage, Coverage::must_not);
    EXPECT_EQ(none.triangles[0].sentence, "the draw goes to layer 1");
    EXPECT_EQ(none.hits.total_max, 0U);
}

}  // namespace ref::test
