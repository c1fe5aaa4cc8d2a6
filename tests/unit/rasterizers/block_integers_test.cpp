// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/algorithms/block_integers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/rasterizers/exact_numbers.hpp"
#include "tests/unit/rasterizers/random_triangles.hpp"

namespace rasterizers {
namespace {

using test::RandomTriangles;
using Three = std::array<int64_t, 3>;

// Brown's example: "if the w-coordinates were defined as 15-bit integers, then the products would
// be 30-bit integers that could be block normalized to 15-bit integers".
TEST(BlockIntegers, FifteenBitsByHand) {
    const Block w = normalise_w({1, 2, 3}, 15);
    EXPECT_EQ(w.q, (Three{8192, 16384, 24576}));  // 3 * 2^13 has 15 bits
    EXPECT_EQ(w.exponent, -13);
    // w1 w2 = 6 2^26, w2 w0 = 3 2^26, w0 w1 = 2 2^26: 29 bits, so 14 are dropped
    const Block products = normalise_products(w, 15);
    EXPECT_EQ(products.exponent, 14);
    EXPECT_EQ(products.q, (Three{6 << 12, 3 << 12, 2 << 12}));
}

TEST(BlockIntegers, RoundingUpMovesTheExponent) {
    // 255.75 needs 8 bits, rounds to 256, which needs 9: so 127.875 -> 128
    const Block w = normalise_w({255.75F, 1, 0.5F}, 8);
    EXPECT_EQ(w.q, (Three{128, 0, 0}));  // 1/2 and 1/4 of a unit: to even, and down
    EXPECT_EQ(w.exponent, 1);
    // 15 * 15 = 225, 15 * 15, ...: 8 bits to 4, 14.06 -> 14
    EXPECT_EQ(normalise_products({{15, 15, 15}, 0}, 4).q, (Three{14, 14, 14}));
    // 249 / 16 = 15.56 -> 16 needs five bits: 249 / 32 = 7.8 -> 8
    EXPECT_EQ(normalise_products({{3, 83, 3}, 0}, 4).q, (Three{8, 0, 8}));
}

// Each step is one addition; nothing is lost beyond what the terms have lost.
TEST(BlockIntegers, StepsAreAdditions) {
    const Corners t{{{100, 50}, {4000, 300}, {700, 3900}}};
    const NineTerms terms = nine_terms(t, {128, 128}, {{30000, 20001, 17}, 3}, 15);
    std::array<ref::Int128, 3> row = terms.first;
    for (int64_t l = 0; l < 12; ++l) {
        std::array<ref::Int128, 3> n = row;
        for (int64_t k = 0; k < 12; ++k) {
            EXPECT_TRUE(n == at_pixel(terms, k, l));
            for (size_t i = 0; i < 3; ++i) {
                n[i] += terms.step_x[i];
            }
        }
        for (size_t i = 0; i < 3; ++i) {
            row[i] += terms.step_y[i];
        }
    }
}

// Without normalisation equation 11 is equation 5 in integers.
TEST(BlockIntegers, ExactTermsAreEquationElevenExactly) {
    const Corners t{{{100, 50}, {4000, 300}, {700, 3900}}};
    const Block products{{7, 11, 13}, 0};
    const NineTerms terms = nine_terms(t, {128, 128}, products, 0);
    for (int64_t k = 0; k < 9; ++k) {
        const Areas areas = areas_at(t, {128 + k * kPixel, 128 + 3 * kPixel});
        const auto n = at_pixel(terms, k, 3);
        for (size_t i = 0; i < 3; ++i) {
            EXPECT_TRUE(n[i] == ref::Int128{products.q[i]} * areas.part[i]);
        }
    }
}

// The loss stays within the derived bound for every number of bits and every kind of triangle.
TEST(BlockIntegers, LossIsWithinItsBound) {
    RandomTriangles random(99);
    int bounded = 0;
    double worst = 0;
    for (int n = 0; n < 30000; ++n) {
        const std::optional<Corners> t =
            clockwise(random.triangle(random.integer(0, 5), random.integer(1, 60)));
        if (!t) {
            continue;
        }
        const PixelRect box = bounding_box(*t, {0, 0, 64, 64}, {128, 128});
        if (box.x0 >= box.x1 || box.y0 >= box.y1) {
            continue;
        }
        const int64_t x = random.integer(box.x0, box.x1 - 1);
        const int64_t y = random.integer(box.y0, box.y1 - 1);
        const Areas areas = areas_at(*t, sample_of(x, y, {128, 128}));
        if (std::min({areas.part[0], areas.part[1], areas.part[2]}) < 0) {
            continue;
        }
        std::array<float, 3> w{};
        for (float& v : w) {
            v = std::ldexp(static_cast<float>(random.integer(1, 0xffff)),
                           static_cast<int>(random.integer(-4, 0)));
        }
        const int bits = static_cast<int>(random.integer(3, kMaxBlockBits));
        const int terms = n % 2 == 0 ? 0 : static_cast<int>(random.integer(3, 40));
        const test::BlockLoss loss = test::block_loss(*t, sample_of(box.x0, box.y0, {128, 128}),
                                                      x - box.x0, y - box.y0, w, bits, terms);
        if (loss.bound) {
            ++bounded;
            ASSERT_LE(loss.measured, *loss.bound * (1 + 0x1p-40)) << bits << " " << terms;
            worst = std::max(worst, *loss.bound > 0 ? loss.measured / *loss.bound : 0);
        }
    }
    EXPECT_GT(bounded, 3000);
    EXPECT_GT(worst, 0.3);  // the bound says something
}

// The products alone: about 2 R 2^-n with R the ratio of the largest to the smallest w. The exact
// form is 3 rho / (1 - rho) * 2/3 with rho = 3 R 2^-n plus what a quarter of a unit adds.
TEST(BlockIntegers, LossOfProductsIsTwiceTheRatio) {
    RandomTriangles random(17);
    const Corners t{{{0, 0}, {16000, 0}, {0, 16000}}};
    double worst = 0;
    for (int n = 0; n < 6000; ++n) {
        const int bits = static_cast<int>(random.integer(8, 24));
        std::array<float, 3> w{};
        for (float& v : w) {
            v = static_cast<float>(random.integer(256, 1024)) / 256;
        }
        const float ratio = std::max({w[0], w[1], w[2]}) / std::min({w[0], w[1], w[2]});
        const int64_t k = random.integer(0, 30);
        const test::BlockLoss loss =
            test::block_loss(t, {128, 128}, k, random.integer(0, 30), w, bits, 0);
        const double unit = std::ldexp(static_cast<double>(ratio), -bits);
        ASSERT_LE(loss.measured, 2 * unit * (1 + 8 * unit));
        worst = std::max(worst, loss.measured / (2 * unit));
    }
    EXPECT_GT(worst, 0.2);
}

TEST(BlockIntegers, QuantisedBarycentricsAreNearest) {
    EXPECT_EQ(quantised_barycentrics({1, 1, 1}, 8), (Three{85, 85, 85}));  // 256/3 = 85.33
    EXPECT_EQ(quantised_barycentrics({1, 0, 3}, 2), (Three{1, 0, 3}));
    EXPECT_EQ(quantised_barycentrics({-1, 2, 7}, 3), (Three{-1, 2, 7}));
    EXPECT_EQ(quantised_barycentrics({-1, 3, 14}, 3), (Three{0, 2, 7}));  // -1/2 + ties upwards
}

}  // namespace
}  // namespace rasterizers
