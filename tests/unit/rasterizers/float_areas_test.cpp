// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/algorithms/float_areas.hpp"

#include <gtest/gtest.h>

#include "ref/coverage/exact/exact.hpp"
#include "tests/unit/rasterizers/float_loss.hpp"
#include "tests/unit/rasterizers/random_triangles.hpp"

namespace rasterizers {
namespace {

using test::RandomTriangles;

bool covers_exactly(const Corners& t, const SubpixelPoint& p) {
    constexpr int64_t kScale = ref::kFixedOne / kPixel;
    const auto fixed = [](const SubpixelPoint& q) {
        return ref::FixedPoint{q.x * kScale, q.y * kScale};
    };
    return ref::exact::covers(fixed(t[0]), fixed(t[1]), fixed(t[2]), fixed(p));
}

// Of 20000 samples beside an edge, how many binary32 puts on the wrong side.
int wrong_samples(int64_t size) {
    RandomTriangles random(static_cast<uint64_t>(size));
    int wrong = 0;
    for (int n = 0; n < 20000; ++n) {
        const auto [t, p] = random.beside_edge(size);
        wrong += covers_in_float(t, p) != covers_exactly(t, p) ? 1 : 0;
    }
    return wrong;
}

// Differences of 12 bits have products of 24: nothing is rounded up to 16 pixels.
TEST(FloatAreas, CoverageIsExactUpToSixteenPixels) {
    for (const int64_t size : {3, 8, 15}) {
        EXPECT_EQ(wrong_samples(size), 0) << size;
    }
}
TEST(FloatAreas, CoverageIsWrongOnLargerTriangles) {
    EXPECT_GT(wrong_samples(1024), 3);
    EXPECT_GT(wrong_samples(16384), 50);
}

// By hand: the edge from (0,0) to (4097,4096) units passes 1 unit of area beside (4098,4097):
// 4097 * 4097 - 4096 * 4098 = 1. 4097^2 = 16785409 needs 25 bits and becomes 16785408, which is
// also 4096 * 4098: the computed area is 0.
TEST(FloatAreas, WrongSignByHand) {
    const Corners t{{{0, 0}, {4097, 4096}, {4098, 4097}}};
    EXPECT_EQ(edge_function(t[0], t[1], t[2]), 1);
    EXPECT_EQ(float_areas_at(t, {0, 0}).whole, 0.0F);
}

TEST(FloatAreas, LossIsWithinItsBound) {
    RandomTriangles random(31);
    int bounded = 0;
    double worst_three = 0;
    double worst_two = 0;
    for (int n = 0; n < 20000; ++n) {
        const std::optional<Corners> t =
            clockwise(random.triangle(random.integer(0, 5), random.integer(4, 2000)));
        if (!t) {
            continue;
        }
        const int64_t s = random.integer(0, 1000);
        const int64_t r = random.integer(0, 1000 - s);
        const SubpixelPoint p{((*t)[0].x * (1000 - s - r) + (*t)[1].x * s + (*t)[2].x * r) / 1000,
                              ((*t)[0].y * (1000 - s - r) + (*t)[1].y * s + (*t)[2].y * r) / 1000};
        const Values z{static_cast<float>(random.integer(-1000000, 1000000)),
                       static_cast<float>(random.integer(-1000000, 1000000)),
                       static_cast<float>(random.integer(-1000, 1000))};
        const test::FloatLoss loss = test::float_loss(*t, p, z);
        if (!loss.is_bounded) {
            continue;
        }
        ++bounded;
        ASSERT_LE(loss.three.measured, loss.three.bound) << n;
        ASSERT_LE(loss.two.measured, loss.two.bound) << n;
        worst_three =
            std::max(worst_three, mpq_class(loss.three.measured / loss.three.bound).get_d());
        worst_two = std::max(worst_two, mpq_class(loss.two.measured / loss.two.bound).get_d());
    }
    EXPECT_GT(bounded, 10000);
    EXPECT_GT(worst_three, 0.1);
    EXPECT_GT(worst_two, 0.1);
}

}  // namespace
}  // namespace rasterizers
