// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Brown's analytic derivatives against the exact quotient.
#include "ref/value/fragment/partials.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {

using ref::PartialVertex;

mpq_class random_number(std::mt19937_64& rng, int low, int high) {
    std::uniform_int_distribution<int> whole(low * 64, high * 64);
    mpq_class q(whole(rng), 64);
    q.canonicalize();
    return q;
}

std::array<PartialVertex, 3> random_triangle(std::mt19937_64& rng, bool equal_w) {
    std::array<PartialVertex, 3> v;
    for (PartialVertex& p : v) {
        const mpq_class w = equal_w ? mpq_class(3) : mpq_class(random_number(rng, 1, 40));
        p = {random_number(rng, -20, 20), random_number(rng, -20, 20), w,
             random_number(rng, -9, 9)};
    }
    return v;
}

// The value by its definition: areas over w, eq. 4 of the paper, without eq. 5.
struct Quotient {
    mpq_class n, d;
};
Quotient quotient(const std::array<PartialVertex, 3>& v, const mpq_class& x, const mpq_class& y) {
    Quotient q;
    for (size_t i = 0; i < 3; ++i) {
        const PartialVertex& a = v[(i + 1) % 3];
        const PartialVertex& b = v[(i + 2) % 3];
        const mpq_class area = (a.x - x) * (b.y - y) - (b.x - x) * (a.y - y);
        q.n += area * v[i].u / v[i].w;
        q.d += area / v[i].w;
    }
    return q;
}

// (u(x + h) - u(x)) / h = du/dx D(x) / D(x + h), for every h, so in the limit too.
TEST(Partials, ADifferenceIsThePartialTimesTheRatioOfDenominators) {
    std::mt19937_64 rng(5);
    int checked = 0;
    for (int n = 0; n < 2000; ++n) {
        const auto v = random_triangle(rng, false);
        const mpq_class x = random_number(rng, -20, 20);
        const mpq_class y = random_number(rng, -20, 20);
        const auto p = partials_at(v, x, y, 1);
        const Quotient here = quotient(v, x, y);
        ASSERT_EQ(p.has_value(), sgn(here.d) != 0);
        if (!p) {
            continue;
        }
        EXPECT_EQ(p->u, here.n / here.d);
        for (const mpq_class& h : {mpq_class(1), mpq_class(-1), mpq_class(1, 1 << 20)}) {
            const Quotient right = quotient(v, mpq_class(x + h), y);
            const Quotient below = quotient(v, x, mpq_class(y + h));
            if (sgn(right.d) != 0) {
                const mpq_class difference = (right.n / right.d - p->u) / h;
                EXPECT_EQ(difference, p->dx * here.d / right.d);
                ++checked;
            }
            if (sgn(below.d) != 0) {
                const mpq_class difference = (below.n / below.d - p->u) / h;
                EXPECT_EQ(difference, p->dy * here.d / below.d);
                ++checked;
            }
        }
    }
    EXPECT_GT(checked, 10000);
}

TEST(Partials, TheTotalDifferentialIsTheSumTimesTheSpacing) {
    std::mt19937_64 rng(6);
    for (int n = 0; n < 500; ++n) {
        const auto v = random_triangle(rng, false);
        const mpq_class spacing(3, 2);
        const auto p = partials_at(v, mpq_class(1, 2), mpq_class(5, 2), spacing);
        if (p) {
            EXPECT_EQ(p->total, spacing * (p->dx + p->dy));
        }
    }
}

// With equal w the value is linear: every difference is the partial.
TEST(Partials, EqualWHasConstantPartials) {
    std::mt19937_64 rng(7);
    for (int n = 0; n < 500; ++n) {
        const auto v = random_triangle(rng, true);
        const auto p = partials_at(v, 0, 0, 1);
        const auto q = partials_at(v, 7, -3, 1);
        if (p && q) {
            EXPECT_EQ(p->dx, q->dx);
            EXPECT_EQ(p->dy, q->dy);
            EXPECT_EQ(q->u - p->u, 7 * p->dx - 3 * p->dy);
        }
    }
}

// Vertices (0,0), (4,0), (0,4) with w 1, 1/2, 1 and u 0, 8, 0 have
// 1/w = 1 + x/4 and u/w = 4 x there, so u = 16 x / (4 + x), du/dx = 64 / (4 + x)^2 = 64/25 at x
// = 1.
TEST(Partials, ByHand) {
    const std::array<PartialVertex, 3> v = {PartialVertex{0, 0, 1, 0},
                                            PartialVertex{4, 0, mpq_class(1, 2), 8},
                                            PartialVertex{0, 4, 1, 0}};
    const auto p = partials_at(v, 1, 1, 2);
    ASSERT_TRUE(p);
    EXPECT_EQ(p->u, mpq_class(16, 5));
    EXPECT_EQ(p->dx, mpq_class(64, 25));
    EXPECT_EQ(p->dy, 0);
    EXPECT_EQ(p->total, mpq_class(128, 25));
}

TEST(Partials, NoneWithoutAreaOrOnTheHorizon) {
    std::array<PartialVertex, 3> v = {PartialVertex{0, 0, 1, 0}, PartialVertex{1, 1, 1, 8},
                                      PartialVertex{2, 2, 1, 0}};
    EXPECT_FALSE(partials_at(v, 1, 0, 1));
    // 1/w = 1 - x/2 vanishes at x = 2.
    v = {PartialVertex{0, 0, 1, 0}, PartialVertex{4, 0, -1, 8}, PartialVertex{0, 4, 1, 0}};
    EXPECT_FALSE(partials_at(v, 2, 1, 1));
}

}  // namespace
