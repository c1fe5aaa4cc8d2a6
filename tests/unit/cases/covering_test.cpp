// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/load/covering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <string>

namespace cases {

namespace {

std::vector<size_t> values(const std::vector<size_t>& sizes, size_t combination) {
    std::vector<size_t> result(sizes.size());
    for (size_t i = sizes.size(); i-- > 0;) {
        result[i] = combination % sizes[i];
        combination /= sizes[i];
    }
    return result;
}

std::string shown(const std::vector<size_t>& sizes) {
    std::string text = "of";
    for (const size_t size : sizes) {
        text += " " + std::to_string(size);
    }
    return text;
}

size_t product_of(const std::vector<size_t>& sizes) {
    size_t product = 1;
    for (const size_t size : sizes) {
        product *= size;
    }
    return product;
}

// All that covering.hpp promises, by the definition: axes, values and combinations one by one.
void expect_covers(const std::vector<size_t>& sizes) {
    const std::vector<size_t> chosen = cover_pairs(sizes);
    const size_t product = product_of(sizes);
    ASSERT_FALSE(chosen.empty()) << shown(sizes);
    EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end())) << shown(sizes);
    EXPECT_EQ(std::set<size_t>(chosen.begin(), chosen.end()).size(), chosen.size())
        << shown(sizes) << ": a combination stands twice";
    EXPECT_EQ(chosen.front(), 0U) << shown(sizes);
    EXPECT_EQ(chosen.back(), product - 1) << shown(sizes);
    for (size_t i = 0; i < sizes.size(); ++i) {
        for (size_t j = i + 1; j < sizes.size(); ++j) {
            std::set<std::pair<size_t, size_t>> pairs;
            for (const size_t combination : chosen) {
                const std::vector<size_t> v = values(sizes, combination);
                pairs.insert({v[i], v[j]});
            }
            EXPECT_EQ(pairs.size(), sizes[i] * sizes[j])
                << shown(sizes) << ": axes " << i << " and " << j;
        }
    }
    std::vector<size_t> ordered = sizes;
    std::sort(ordered.rbegin(), ordered.rend());
    const size_t two_largest = ordered[0] * ordered[1];
    EXPECT_GE(chosen.size(), two_largest) << shown(sizes);
    EXPECT_LE(chosen.size(), product) << shown(sizes);
    double harmonic = 0;
    for (size_t n = 1; n <= sizes.size() * (sizes.size() - 1) / 2; ++n) {
        harmonic += 1.0 / static_cast<double>(n);
    }
    EXPECT_LE(static_cast<double>(chosen.size()), static_cast<double>(two_largest) * harmonic)
        << shown(sizes);
    if (ordered.size() > 2 && ordered[2] > 1) {
        EXPECT_LT(chosen.size(), product) << shown(sizes) << ": nothing is left out";
    }
}

}  // namespace

TEST(CoverPairs, OfTwoAxesIsTheProduct) {
    EXPECT_EQ(cover_pairs(std::array<size_t, 2>{2, 3}), (std::vector<size_t>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(cover_pairs(std::array<size_t, 4>{1, 2, 1, 2}), (std::vector<size_t>{0, 1, 2, 3}));
    EXPECT_EQ(cover_pairs(std::array<size_t, 3>{1, 1, 1}), (std::vector<size_t>{0}));
}

// By hand. 2 x 2 x 2: after 000 and 111 each two axes miss 01 and 10; a combination has no more
// than two of these six beside one pair that was chosen once; the first ones are 001, 010 and 100.
// 3 x 2 x 2: after 000 and 211, 101 is the first with three missing pairs, then 110; what is left,
// 01 and 20 of the first axis with each of the others, takes 011 and 200.
TEST(CoverPairs, SmallOnesAreTheseOnEveryMachine) {
    EXPECT_EQ(cover_pairs(std::array<size_t, 3>{2, 2, 2}), (std::vector<size_t>{0, 1, 2, 4, 7}));
    EXPECT_EQ(cover_pairs(std::array<size_t, 3>{3, 2, 2}),
              (std::vector<size_t>{0, 3, 5, 6, 8, 11}));
    EXPECT_EQ(cover_pairs(std::array<size_t, 4>{2, 2, 2, 2}).size(), 6U);
    EXPECT_EQ(cover_pairs(std::array<size_t, 4>{3, 3, 3, 3}).size(), 10U);
    EXPECT_EQ(cover_pairs(std::array<size_t, 4>{3, 4, 2, 2}).size(), 13U);
}

// Of 8 x 4 x 2 each of the 32 pairs of the first two axes is chosen once; two pairs of the third
// axis with either other are then soon there. Were the rest filled with the first that comes, its
// first value would stand in 24 of them.
TEST(CoverPairs, ValuesThatAreFreeTakeTurns) {
    const std::vector<size_t> sizes = {8, 4, 2};
    const std::vector<size_t> chosen = cover_pairs(sizes);
    ASSERT_EQ(chosen.size(), 32U);
    const auto first = std::count_if(chosen.begin(), chosen.end(),
                                     [](size_t combination) { return combination % 2 == 0; });
    EXPECT_GE(first, 15);
    EXPECT_LE(first, 17);
}

TEST(CoverPairs, OfEverySmallSize) {
    for (size_t a = 1; a <= 4; ++a) {
        for (size_t b = 1; b <= 4; ++b) {
            for (size_t c = 1; c <= 4; ++c) {
                expect_covers({a, b, c});
                for (size_t d = 1; d <= 3; ++d) {
                    expect_covers({a, b, c, d});
                }
            }
        }
    }
}

TEST(CoverPairs, OfManySizes) {
    std::mt19937_64 random(1);
    size_t tried = 0;
    while (tried < 200) {
        std::vector<size_t> sizes(2 + random() % 9);
        for (size_t& size : sizes) {
            size = 1 + random() % 9;
        }
        if (product_of(sizes) <= 4096) {
            expect_covers(sizes);
            ++tried;
        }
    }
    expect_covers(std::vector<size_t>(12, 2));
    expect_covers({64, 64});
}

}  // namespace cases
