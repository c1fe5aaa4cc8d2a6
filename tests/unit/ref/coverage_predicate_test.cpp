// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The predicates behind coverage: edge functions, boxes, facing, windows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ref/coverage/exact/exact.hpp"
#include "ref/coverage/facing.hpp"
#include "ref/coverage/fast/fast.hpp"
#include "ref/coverage/setup.hpp"
#include "ref/number/edge_function.hpp"
#include "tests/unit/ref/coverage_random.hpp"
#include "tests/unit/ref/same_expectations.hpp"

namespace ref::test {
namespace {

using cases::Profile;

FixedPoint random_point(RandomCases& random, int64_t reach) {
    return {random.integer(-reach, reach), random.integer(-reach, reach)};
}

TEST(EdgeFunction, SignsByHand) {
    const FixedPoint a{0, 0};
    const FixedPoint b{10, 0};
    EXPECT_TRUE(edge_function(a, b, {5, 1}) == 10);  // below a->b: y points down
    EXPECT_TRUE(edge_function(a, b, {5, -1}) == -10);
    EXPECT_TRUE(edge_function(a, b, {25, 0}) == 0);
    constexpr int64_t kFar = int64_t{1} << kPositionBits;
    EXPECT_TRUE(edge_function({-kFar, -kFar}, {kFar, -kFar}, {kFar, kFar}) == Int128{1} << 102);
    EXPECT_TRUE(is_top_left({0, 0}, {1, 0}));   // top
    EXPECT_FALSE(is_top_left({1, 0}, {0, 0}));  // bottom
    EXPECT_TRUE(is_top_left({0, 1}, {0, 0}));   // left
    EXPECT_FALSE(is_top_left({0, 0}, {0, 1}));  // right
    EXPECT_TRUE(is_top_left({5, 1}, {0, 0}));
}

TEST(EdgeFunction, SumIsTwiceTheAreaAnywhere) {
    RandomCases random(1);
    for (int k = 0; k < 20000; ++k) {
        const int64_t reach = int64_t{1} << random.integer(1, kPositionBits);
        const FixedPoint a = random_point(random, reach);
        const FixedPoint b = random_point(random, reach);
        const FixedPoint c = random_point(random, reach);
        const FixedPoint p = random_point(random, reach);
        const Int128 sum = edge_function(a, b, p) + edge_function(b, c, p) + edge_function(c, a, p);
        ASSERT_TRUE(sum == edge_function(a, b, c));
        ASSERT_TRUE(edge_function(a, b, p) == -edge_function(b, a, p));
    }
}

// A triangle of boxes as a device with grid steps of `step` sees it.
TriangleSetup boxes_setup(const std::array<Box, 3>& boxes, int64_t step, OutlineMode mode) {
    TriangleSetup t;
    t.kind = TriangleSetup::Kind::outlines;
    t.has_outline = true;
    t.grid_step = step;
    t.unclipped.mode = mode;
    t.unclipped.count = 3;
    t.unclipped.must_count = 3;
    for (size_t i = 0; i < 3; ++i) {
        t.unclipped.boxes[i] = t.unclipped.must_boxes[i] = boxes[i];
        t.unclipped.edge[i] = static_cast<EdgeLabel>(i);
    }
    constexpr int64_t kFar = int64_t{1} << 40;
    t.window.pixel_x0 = t.window.pixel_y0 = -kFar;
    t.window.pixel_x1 = t.window.pixel_y1 = kFar;
    t.window.zone_x = t.window.zone_y = t.window.core_x = t.window.core_y = {-kFar, kFar};
    return t;
}

// The 64 triangles of box corners, one by one: must if all have p strictly inside, with one
// orientation; a triangle that has p inside or on its border forbids must_not.
TEST(Boxes, AgreeWithAllCornerTriangles) {
    RandomCases random(2);
    int counts[3] = {};
    for (int k = 0; k < 30000; ++k) {
        std::array<Box, 3> boxes;
        for (Box& b : boxes) {
            const FixedPoint p = random_point(random, 12);
            b = {p.x, p.y, p.x + random.integer(0, 2), p.y + random.integer(0, 2)};
        }
        const FixedPoint p = random_point(random, 10);
        bool is_in_all_positive = true;
        bool is_in_all_negative = true;
        bool is_in_some = false;
        for (const FixedPoint& a : grid_points(boxes[0], 1)) {
            for (const FixedPoint& b : grid_points(boxes[1], 1)) {
                for (const FixedPoint& c : grid_points(boxes[2], 1)) {
                    const Int128 e[] = {edge_function(a, b, p), edge_function(b, c, p),
                                        edge_function(c, a, p)};
                    const auto all = [&](auto is) { return is(e[0]) && is(e[1]) && is(e[2]); };
                    is_in_all_positive = is_in_all_positive && all([](Int128 v) { return v > 0; });
                    is_in_all_negative = is_in_all_negative && all([](Int128 v) { return v < 0; });
                    is_in_some = is_in_some || ((all([](Int128 v) { return v >= 0; }) ||
                                                 all([](Int128 v) { return v <= 0; })) &&
                                                edge_function(a, b, c) != 0);
                }
            }
        }
        const TriangleSetup setup = boxes_setup(boxes, 1, OutlineMode::boxes);
        const Coverage fast = fast::classify(setup, p);
        ASSERT_EQ(fast, exact::classify(setup, p)) << k;
        ASSERT_EQ(fast == Coverage::must, is_in_all_positive || is_in_all_negative) << k;
        if (is_in_some) {
            ASSERT_NE(fast, Coverage::must_not) << k;
        }
        ++counts[static_cast<int>(fast)];
    }
    EXPECT_GT(*std::min_element(counts, counts + 3), 500);
}

// Outside the hull of the boxes is exact: just inside it, some choice of positions (between the
// grid points too) covers the sample. By hand, where single edges would be wrong.
TEST(Boxes, SliverThatMayFlipReachesItsWholeHull) {
    const std::array<Box, 3> boxes{Box{0, 0, 0, 0}, {100, -1, 100, 1}, {50, -1, 50, 1}};
    const TriangleSetup setup = boxes_setup(boxes, 1, OutlineMode::boxes);
    EXPECT_EQ(fast::classify(setup, {75, 0}), Coverage::either);
    EXPECT_EQ(fast::classify(setup, {75, 1}), Coverage::either);
    EXPECT_EQ(fast::classify(setup, {75, 2}), Coverage::must_not);
    EXPECT_EQ(fast::classify(setup, {25, 1}), Coverage::must_not);
}

TEST(Boxes, SnappedModeIsAllAndSome) {
    RandomCases random(3);
    int counts[3] = {};
    for (int k = 0; k < 10000; ++k) {
        std::array<Box, 3> boxes;
        for (Box& b : boxes) {
            const FixedPoint p = random_point(random, 8);
            b = {p.x, p.y, p.x + random.integer(0, 1), p.y + random.integer(0, 1)};
        }
        const FixedPoint p = random_point(random, 8);
        int covered = 0;
        int all = 0;
        for (const FixedPoint& a : grid_points(boxes[0], 1)) {
            for (const FixedPoint& b : grid_points(boxes[1], 1)) {
                for (const FixedPoint& c : grid_points(boxes[2], 1)) {
                    ++all;
                    covered += exact::covers(a, b, c, p) ? 1 : 0;
                }
            }
        }
        const Coverage want =
            covered == all ? Coverage::must : (covered > 0 ? Coverage::either : Coverage::must_not);
        ASSERT_EQ(fast::classify(boxes_setup(boxes, 1, OutlineMode::snapped), p), want);
        ++counts[static_cast<int>(want)];
    }
    EXPECT_GT(*std::min_element(counts, counts + 3), 300);
}

TEST(Coverage, VertexOrderDoesNotMatter) {
    const int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (uint64_t seed = 1; seed <= 60; ++seed) {
        RandomCases random(seed);
        const Setting s = setting(random);
        cases::Case c = random.triangles();
        c.draws.resize(1);
        c.draws[0].cull = cases::CullMode::none;
        const std::vector<glm::vec4> v = c.draws[0].positions;
        const Count first = count_hits(expect(c, s.limits, s.profile));
        for (const auto& o : order) {
            for (size_t k = 0; k < 3; ++k) {
                c.draws[0].positions[k] = v[static_cast<size_t>(o[k])];
            }
            EXPECT_EQ(count_hits(expect(c, s.limits, s.profile)), first) << "seed " << seed;
        }
    }
}

// Positions one binary32 step apart around a sample on an edge: the ideal triangle, judged by
// rationals, never contradicts what practice and vulkan demand.
TEST(Coverage, UlpGridAroundAnEdge) {
    int open = 0;
    int closed = 0;
    for (int dx = -8; dx <= 8; ++dx) {
        for (int dy = -8; dy <= 8; ++dy) {
            cases::Case c = pixels(32, 32, {{4.5, 4.5}, {28.5, 20.5}, {4.5, 20.5}});
            glm::vec4& v = c.draws[0].positions[1];
            const auto nudge = [](float f, int steps) {
                for (int k = 0; k < std::abs(steps); ++k) {
                    f = std::nextafter(f, steps > 0 ? 2.0F : -2.0F);
                }
                return f;
            };
            v.x = nudge(v.x, dx);
            v.y = nudge(v.y, dy);
            const IdealPosition q = ideal_position(v, c.draws[0].viewport);
            for (const Profile profile : {Profile::vulkan, Profile::practice}) {
                const Expectation e = expect(c, {8}, profile);
                if (std::abs(dx) < 2 && std::abs(dy) < 2) {
                    EXPECT_TRUE(same_expectations(e, exact::expect(c, {8}, profile)));
                }
                for (const uint32_t k :
                     {0U, 1U, 3U, 6U}) {  // samples (4.5 + 3k, 4.5 + 2k) on the edge
                    const mpq_class px = mpq_class(9, 2) + 3 * k;
                    const mpq_class py = mpq_class(9, 2) + 2 * k;
                    const mpq_class side = (q.x - mpq_class(9, 2)) * (py - mpq_class(9, 2)) -
                                           (q.y - mpq_class(9, 2)) * (px - mpq_class(9, 2));
                    const HitBounds& b = hits_at(e, 4 + 3 * k, 4 + 2 * k);
                    if (side > 0) {
                        EXPECT_GE(b.total_max, 1U);
                    } else if (side < 0) {
                        EXPECT_EQ(b.total_min, 0U);
                    }
                    (b.is_decided() ? closed : open) += 1;
                }
            }
            const HitBounds inner = hits_at(expect(c, {8}, Profile::practice), 6, 18);
            EXPECT_EQ(inner.total_min, 1U);
        }
    }
    EXPECT_GT(open, 100);
}

TEST(Facing, SignsByHand) {
    const Box a{0, 0, 0, 0};
    const Box b{10, 0, 10, 0};
    const Box c{0, 10, 0, 10};
    const AreaSigns clockwise = area_signs(std::array{a, b, c});
    EXPECT_EQ(clockwise.only(), 1);
    EXPECT_FALSE(can_face_front(clockwise, cases::FrontFace::counter_clockwise));
    EXPECT_TRUE(can_face_front(clockwise, cases::FrontFace::clockwise));
    const AreaSigns counter = area_signs(std::array{a, c, b});
    EXPECT_EQ(counter.only(), -1);
    EXPECT_TRUE(can_face_front(counter, cases::FrontFace::counter_clockwise));
    EXPECT_FALSE(can_face_back(counter, cases::FrontFace::counter_clockwise));
    const AreaSigns flat = area_signs(std::array{a, b, b});
    EXPECT_EQ(flat.only(), 0);
    for (const auto f : {cases::FrontFace::counter_clockwise, cases::FrontFace::clockwise}) {
        EXPECT_FALSE(can_face_front(flat, f));  // zero area is back facing, whatever is front
        EXPECT_TRUE(can_face_back(flat, f));
    }
}

TEST(Facing, SignsOfBoxesAreThoseOfTheirPoints) {
    RandomCases random(4);
    int mixed = 0;
    for (int k = 0; k < 5000; ++k) {
        std::array<Box, 3> boxes;
        for (Box& b : boxes) {
            const FixedPoint p = random_point(random, 6);
            b = {p.x, p.y, p.x + random.integer(0, 2), p.y + random.integer(0, 2)};
        }
        const AreaSigns corners = area_signs(boxes);
        const AreaSigns points = snapped_area_signs(boxes, 1);
        EXPECT_EQ(corners.negative, points.negative);
        EXPECT_EQ(corners.positive, points.positive);
        EXPECT_TRUE(corners.zero || !points.zero);
        mixed += corners.only() == 0 ? 1 : 0;
    }
    EXPECT_GT(mixed, 100);
}

Count faces(cases::CullMode cull, cases::FrontFace front_face, Profile profile) {
    cases::Case c = pixels(16, 16, {{1, 1}, {14, 1}, {1, 14}});
    c.draws[0].cull = cull;
    c.draws[0].front_face = front_face;
    Count out;
    const Expectation e = expect(c, {8}, profile);
    for (size_t k = 0; k < e.samples.size(); ++k) {
        const SampleExpectation& s = e.samples[k];
        out.once += s.hits.front_min;
        out.twice += s.hits.back_min;
        out.open += s.hits.is_decided() ? 0U : 1U;
    }
    return out;
}

TEST(Facing, CullModes) {
    using enum cases::CullMode;
    constexpr auto kCcw = cases::FrontFace::counter_clockwise;  // the triangle is clockwise: back
    constexpr auto kCw = cases::FrontFace::clockwise;
    EXPECT_EQ(faces(none, kCcw, Profile::direct3d).once, 0U);
    EXPECT_EQ(faces(none, kCcw, Profile::direct3d).twice, 78U);
    EXPECT_EQ(faces(none, kCw, Profile::direct3d).once, 78U);
    EXPECT_EQ(faces(back, kCcw, Profile::direct3d).twice, 0U);
    EXPECT_EQ(faces(front, kCcw, Profile::direct3d).twice, 78U);
    EXPECT_EQ(faces(front, kCw, Profile::direct3d).once, 0U);
    EXPECT_EQ(faces(front_and_back, kCcw, Profile::vulkan).open, 0U);
    EXPECT_EQ(faces(front_and_back, kCcw, Profile::vulkan).twice, 0U);
}

TEST(Facing, BehindTheEyeShowsItsVisibleSide) {
    cases::Case c = blank(32, 32);
    cases::Draw d = whole(c);
    d.positions = {{-.5F, -.5F, .5F, 1}, {.5F, -.5F, .5F, 1}, {0, .9F, -.5F, -1}};
    c.draws = {d};
    for (const Profile profile : {Profile::practice, Profile::direct3d}) {
        const HitBounds b = hits_at(expect(c, {8}, profile), 16, 20);
        EXPECT_EQ(b.front_max, 0U);
        EXPECT_EQ(b.back_min, 1U);
    }
    const HitBounds b = hits_at(expect(c, {8}, Profile::vulkan), 16, 20);
    EXPECT_EQ(b.front_max, 1U);
    EXPECT_EQ(b.back_max, 1U);
    EXPECT_EQ(b.total_min, 1U);
}

TEST(Window, ScissorIsHalfOpenAndViewportCuts) {
    cases::Case c = pixels(16, 16, {{-40, -40}, {80, -40}, {-40, 80}});
    c.draws[0].scissor = {3, 4, 5, 6};
    for (const Profile profile : cases::kProfiles) {
        const Expectation e = expect(c, {8}, profile);
        EXPECT_EQ(e.must_samples, 30U);
        EXPECT_EQ(e.either_samples, 0U);
        EXPECT_EQ(hits_at(e, 3, 4).total_min, 1U);
        EXPECT_EQ(hits_at(e, 8, 4).total_max, 0U);
    }
    c.draws[0].scissor = {0, 0, 0, 0};
    EXPECT_EQ(expect(c, {8}, Profile::direct3d).must_samples, 0U);
    c.draws[0].scissor = {0, 0, 16, 16};
    c.draws[0].viewport = {2, 3, 4, 5};
    c.draws[0].positions = {{-3, -3, .5F, 1}, {9, -3, .5F, 1}, {-3, 9, .5F, 1}};
    const Expectation e = expect(c, {8}, Profile::direct3d);
    EXPECT_EQ(e.must_samples, 20U);
    EXPECT_EQ(hits_at(e, 1, 3).total_max, 0U);
    EXPECT_EQ(hits_at(e, 2, 3).total_min, 1U);
    EXPECT_EQ(hits_at(e, 5, 7).total_min, 1U);
    EXPECT_EQ(hits_at(e, 6, 7).total_max, 0U);
}

TEST(Window, FractionalViewportLeavesLessThanAPixel) {
    cases::Case c = blank(16, 16);
    cases::Draw d = whole(c);
    d.viewport = {4.25F, 0, 8, 16};
    d.positions = {{-3, -3, .5F, 1}, {9, -3, .5F, 1}, {-3, 9, .5F, 1}};
    c.draws = {d};
    for (const Profile profile : cases::kProfiles) {
        const Expectation e = expect(c, {8}, profile);
        EXPECT_EQ(hits_at(e, 2, 8).total_max, 0U);
        EXPECT_FALSE(hits_at(e, 3, 8).is_decided());
        EXPECT_FALSE(hits_at(e, 4, 8).is_decided());
        EXPECT_EQ(hits_at(e, 8, 8).total_min, 1U);
        EXPECT_EQ(hits_at(e, 13, 8).total_max, 0U);
    }
}

TEST(Undefined, NotANumberFreesItsOwnTriangleOnly) {
    cases::Case c = pixels(32, 32, {{1, 1}, {2, 2}, {1, 3}, {20, 20}, {30, 20}, {30, 30}});
    for (const float bad : {NAN, INFINITY, -INFINITY}) {
        c.draws[0].positions[1].y = bad;
        for (const Profile profile : cases::kProfiles) {
            const Expectation e = expect(c, {8}, profile);
            EXPECT_EQ(hits_at(e, 3, 28).total_max, 1U);
            EXPECT_EQ(hits_at(e, 3, 28).total_min, 0U);
            EXPECT_EQ(hits_at(e, 28, 22).total_min, 1U);
            EXPECT_EQ(hits_at(e, 28, 22).total_max, 2U);
        }
        EXPECT_EQ(expect(c, {8}, Profile::direct3d).must_samples, 55U);
    }
}

TEST(HitBounds, DecidedAndAllowed) {
    HitBounds b;
    EXPECT_TRUE(b.is_decided());
    EXPECT_TRUE(b.allows(0, 0));
    b = {0, 1, 0, 1, -1, 1, 1, 1};  // one hit, of either face
    EXPECT_FALSE(b.is_decided());
    EXPECT_TRUE(b.allows(1, 0) && b.allows(0, 1));
    EXPECT_FALSE(b.allows(0, 0) || b.allows(1, 1) || b.allows(2, 0));
    b.signed_min = 1;
    EXPECT_TRUE(b.is_decided());
    EXPECT_FALSE(b.allows(0, 1));
}

}  // namespace
}  // namespace ref::test
