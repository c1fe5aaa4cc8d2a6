// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/position/clip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "ref/number/rational.hpp"
#include "tests/unit/ref/clip_float.hpp"
#include "tests/unit/ref/coverage_random.hpp"
#include "tests/unit/ref/rational_clip.hpp"

namespace ref::test {
namespace {

using cases::Profile;

constexpr cases::Viewport kSquare{0, 0, 64, 64, 0, 1};

TEST(Clip, InsideIsUnchanged) {
    const Triple t{{{-1, -1, 0, 1}, {1, -1, 1, 1}, {0, 1, 0.5F, 1}}};
    const auto polygon = clip_triangle(t, kSquare, Profile::practice);
    ASSERT_EQ(polygon.size(), 3U);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(polygon[i].original, static_cast<int>(i));
        EXPECT_EQ(polygon[i].edge, i);
        EXPECT_EQ(polygon[i].weights[i], 1);
        EXPECT_EQ(polygon[i].error.x, 0);
    }
}

TEST(Clip, OneCornerCut) {
    const Triple t{{{0, 0, 0.5F, 1}, {3, 0, 0.5F, 1}, {0, 1, 0.5F, 1}}};
    const auto polygon = clip_triangle(t, kSquare, Profile::practice);
    ASSERT_EQ(polygon.size(), 4U);
    EXPECT_EQ(polygon[0].original, 0);
    EXPECT_EQ(polygon[0].edge, 0);
    EXPECT_EQ(polygon[1].position.x, 64);
    EXPECT_EQ(polygon[1].position.y, 32);
    EXPECT_EQ(polygon[1].weights[1], mpq_class(1, 3));
    EXPECT_EQ(polygon[1].edge, kFirstClipEdge + static_cast<int>(ClipPlane::x_high));
    EXPECT_EQ(polygon[2].position.y, 32 + mpq_class(64, 3));
    EXPECT_EQ(polygon[2].edge, 1);
    EXPECT_EQ(polygon[3].original, 2);
    EXPECT_GT(polygon[1].error.x, 0);
    EXPECT_LT(polygon[1].error.x, mpq_class(1, 10000));
}

TEST(Clip, BehindTheEyeOnlyTheVisiblePartRemains) {
    const Triple t{{{-0.5F, -0.5F, 0.5F, 1}, {0.5F, -0.5F, 0.5F, 1}, {0, 0.9F, -0.5F, -1}}};
    const auto polygon = clip_triangle(t, kSquare, Profile::practice);
    ASSERT_GE(polygon.size(), 3U);
    for (const ClippedVertex& v : polygon) {
        EXPECT_GT(v.clip[3], 0);
        EXPECT_GE(v.position.x, 0);
        EXPECT_LE(v.position.x, 64);
        EXPECT_GE(v.position.y, 16);  // the point behind would project above the edge
    }
}

TEST(Clip, OutsideIsEmpty) {
    const Triple t{{{2, 0, 0, 1}, {3, 0, 0, 1}, {2, 1, 0, 1}}};
    EXPECT_TRUE(is_trivially_outside(t));
    EXPECT_TRUE(clip_triangle(t, kSquare, Profile::practice).empty());
    // Outside of no single plane, but past a corner.
    const Triple corner{{{1.5F, 0.9F, 0, 1}, {0.9F, 1.5F, 0, 1}, {2, 2, 0, 1}}};
    EXPECT_FALSE(is_trivially_outside(corner));
    EXPECT_TRUE(clip_triangle(corner, kSquare, Profile::practice).empty());
}

// A triangle through the eye: x >= -w leaves a corner with w = 1.3e-7, which lies beyond y <= w by
// less than 1e-9. A device whose arithmetic is binary32 may find it inside.
TEST(Clip, WhatRoundingErrorsMayLeaveIsNotSurelyEmpty) {
    const Triple t{{{-4.266690254211426F, 3.896033763885498F, 1.875F, 3.75F},
                    {-2.6960227489471436F, 2.925961494445801F, 1, 2},
                    {0.28444603085517883F, -0.2597355842590332F, -0.125F, -0.25F}}};
    bool is_sure = true;
    EXPECT_TRUE(
        clip_triangle(t, kSquare, Profile::practice, std::span(kViewVolume), &is_sure).empty());
    EXPECT_FALSE(is_sure);
    // Past a corner of the volume by a tenth of its size, and by a corner of the triangle.
    const Triple corner{{{1.5F, 0.9F, 0, 1}, {0.9F, 1.5F, 0, 1}, {2, 2, 0, 1}}};
    EXPECT_TRUE(
        clip_triangle(corner, kSquare, Profile::vulkan, std::span(kViewVolume), &is_sure).empty());
    EXPECT_TRUE(is_sure);
    const Triple beyond{{{1.0000001F, 0, 0, 1}, {2, 0, 0, 1}, {2, 1, 0, 1}}};
    EXPECT_TRUE(
        clip_triangle(beyond, kSquare, Profile::vulkan, std::span(kViewVolume), &is_sure).empty());
    EXPECT_TRUE(is_sure);
}

TEST(Clip, BordersAreInside) {
    EXPECT_TRUE(is_inside({1, -1, 0, 1}));
    EXPECT_TRUE(is_inside({0, 0, 1, 1}));
    EXPECT_FALSE(is_inside({std::nextafter(1.0F, 2.0F), 0, 0, 1}));
    EXPECT_FALSE(is_inside({0, 0, -0x1p-149F, 1}));
    EXPECT_FALSE(is_inside({0, 0, NAN, 1}));
    EXPECT_FALSE(is_inside({0, 0, 0, -1}));
}

TEST(Clip, VertexAtTheEyeHasNoBound) {
    const Triple t{{{0, 0, 0, 0}, {0.5F, 0, 0.5F, 1}, {0, 2, 0.5F, 1}}};
    const auto polygon = clip_triangle(t, kSquare, Profile::practice);
    EXPECT_TRUE(std::any_of(polygon.begin(), polygon.end(),
                            [](const ClippedVertex& v) { return !v.is_bounded; }));
}

glm::vec4 random_vertex(RandomCases& random, double reach) {
    return {random.real(-reach, reach), random.real(-reach, reach), random.real(-0.5, 1.5),
            random.real(-0.5, 2)};
}

TEST(Clip, VerticesAreTheirWeightsAndInside) {
    RandomCases random(11);
    int cut = 0;
    for (int k = 0; k < 300; ++k) {
        const Triple t{random_vertex(random, 3), random_vertex(random, 3),
                       random_vertex(random, 3)};
        for (const ClippedVertex& v : clip_triangle(t, kSquare, Profile::practice)) {
            ASSERT_EQ(v.weights[0] + v.weights[1] + v.weights[2], 1);
            for (int c = 0; c < 4; ++c) {
                mpq_class sum = 0;
                for (size_t i = 0; i < 3; ++i) {
                    ASSERT_GE(v.weights[i], 0);
                    sum += v.weights[i] * mpq_class(static_cast<double>(t[i][c]));
                }
                ASSERT_EQ(sum, v.clip[static_cast<size_t>(c)]);
            }
            ASSERT_LE(abs(v.clip[0]), v.clip[3]);
            ASSERT_LE(abs(v.clip[1]), v.clip[3]);
            ASSERT_GE(v.clip[2], 0);
            ASSERT_LE(v.clip[2], v.clip[3]);
            cut += v.original < 0 ? 1 : 0;
        }
    }
    EXPECT_GT(cut, 300);
}

TEST(Clip, ErrorBoundsBinary32) {
    RandomCases random(12);
    int compared = 0;
    double worst = 0;
    for (int k = 0; k < 2000; ++k) {
        const double reach = std::pow(10.0, random.real(0, 5));
        const Triple t{random_vertex(random, reach), random_vertex(random, reach),
                       random_vertex(random, reach)};
        if (is_trivially_outside(t)) {
            continue;
        }
        const auto polygon = clip_triangle(t, kSquare, Profile::practice);
        const auto device = float_clip(t, random.flip(), static_cast<int>(random.integer(0, 2)));
        for (size_t i = 0; i < polygon.size(); ++i) {
            const ClippedVertex& v = polygon[i];
            const EdgeLabel in = polygon[(i + polygon.size() - 1) % polygon.size()].edge;
            for (size_t m = 0; m < device.size(); ++m) {
                const glm::vec4& p = device[m].p;
                if (v.original >= 0 || !v.is_bounded || device[m].edge != v.edge ||
                    device[(m + device.size() - 1) % device.size()].edge != in) {
                    continue;
                }
                const float x = p.x * (1.0F / p.w) * 32 + 32;
                const float y = p.y * (1.0F / p.w) * 32 + 32;
                const mpq_class ex = abs(mpq_class(static_cast<double>(x)) - v.position.x);
                const mpq_class ey = abs(mpq_class(static_cast<double>(y)) - v.position.y);
                ASSERT_LE(ex, v.error.x) << "case " << k << " vertex " << i;
                ASSERT_LE(ey, v.error.y) << "case " << k << " vertex " << i;
                worst = std::max(
                    {worst, mpq_class(ex / v.error.x).get_d(), mpq_class(ey / v.error.y).get_d()});
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 500);
    EXPECT_GT(worst, 0.1);
}

// Weights, positions and edges are those of the rationals, and bounds theirs, rounded up.
TEST(ExhaustiveClip, AgreesWithRationals) {
    RandomCases random(13);
    int cut = 0, bounds = 0;
    const auto is_bound = [&](const mpq_class& bound, const mpq_class& exact) {
        ++bounds;
        return bound >= exact && bound <= exact * mpq_class(1 + 0x1p-30) + power_of_two(-390);
    };
    for (int k = 0; k < 3000; ++k) {
        const double reach = std::pow(10.0, random.real(-1, 5));
        ClipInput input;
        input.distance_count = static_cast<uint32_t>(random.integer(0, 2));
        // Some lie far apart in size, and some on the planes.
        const float scale =
            k % 5 == 0 ? std::ldexp(1.0F, static_cast<int>(random.integer(-100, 60))) : 1.0F;
        for (size_t i = 0; i < 3; ++i) {
            input.clip[i] = random_vertex(random, reach);
            if (k % 4 == 0) {
                input.clip[i] = glm::round(input.clip[i]);
            }
            input.distance[i] = {random.real(-1, 2), random.real(-2, 1), 0, 0};
        }
        input.clip[0] *= scale;
        const cases::Viewport viewport{3, -2.5F, 64, k % 2 == 0 ? 33.25F : -64.0F, 0.25F, 1};
        for (const Profile profile : {Profile::vulkan, Profile::practice}) {
            std::vector<ClipPlane> planes(std::begin(kViewVolume), std::end(kViewVolume));
            planes.push_back(ClipPlane::user_0);
            planes.push_back(ClipPlane::user_1);
            planes.resize(std::size(kViewVolume) + input.distance_count);
            const auto ours = clip_triangle(input, viewport, profile, planes);
            const auto exact = rational_clip(input, viewport, profile, planes);
            ASSERT_EQ(ours.size(), exact.size()) << k;
            for (size_t i = 0; i < ours.size(); ++i) {
                const ClippedVertex &a = ours[i], &b = exact[i];
                ASSERT_EQ(a.weights, b.weights) << k;
                ASSERT_EQ(a.clip, b.clip) << k;
                ASSERT_EQ(a.edge, b.edge) << k;
                ASSERT_EQ(a.original, b.original) << k;
                ASSERT_EQ(a.is_bounded, b.is_bounded) << k;
                ASSERT_EQ(a.position.x, b.position.x) << k;
                ASSERT_EQ(a.position.y, b.position.y) << k;
                ASSERT_EQ(a.position.z, b.position.z) << k;
                ASSERT_EQ(a.position.inv_w, b.position.inv_w) << k;
                ASSERT_EQ(a.ratio, b.ratio) << k;
                if (a.is_bounded) {
                    ASSERT_TRUE(is_bound(a.error.x, b.error.x)) << k;
                    ASSERT_TRUE(is_bound(a.error.y, b.error.y)) << k;
                    ASSERT_EQ(a.ratio_error.size(), b.ratio_error.size()) << k;
                    for (size_t d = 0; d < a.ratio_error.size(); ++d) {
                        ASSERT_TRUE(is_bound(a.ratio_error[d], b.ratio_error[d])) << k;
                    }
                }
                cut += a.original < 0 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(cut, 3000);
    EXPECT_GT(bounds, 6000);
}

// Each of the roundings counts once, with the weight it has: a triangle ten thousand times larger
// than the view volume keeps its corners within 4 pixels, and nine tenths of its samples are
// certain.
TEST(Clip, AHugeTriangleKeepsMostOfItsSamples) {
    cases::Case c = blank(64, 64);
    cases::Draw d = whole(c);
    d.positions = {{-3e4F, -1e4F, 0.5F, 1}, {3e4F, -1e4F, 0.5F, 1}, {0, 4e4F, 0.5F, 1}};
    c.draws.push_back(d);
    const Triple t{d.positions[0], d.positions[1], d.positions[2]};
    for (const Profile profile : {Profile::practice, Profile::direct3d}) {
        for (const ClippedVertex& v : clip_triangle(t, kSquare, profile)) {
            EXPECT_LE(std::max(v.error.x, v.error.y), 4);
        }
        EXPECT_GE(expect(c, {8}, profile).must_samples, 3686U);
    }
}

}  // namespace
}  // namespace ref::test
