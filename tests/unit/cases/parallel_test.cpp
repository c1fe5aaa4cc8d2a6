// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/base/parallel.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace cases {
namespace {

TEST(ForEachIndex, TakesEachIndexOnce) {
    for (const size_t count : {size_t{0}, size_t{1}, size_t{3}, size_t{1000}}) {
        std::vector<std::atomic<int>> taken(count);
        for_each_index(count, [&](size_t k) { ++taken.at(k); });
        for (size_t k = 0; k < count; ++k) {
            EXPECT_EQ(taken[k], 1) << k << " of " << count;
        }
    }
}

TEST(ForEachIndex, ThrowsOnWhatABodyThrows) {
    EXPECT_THROW(for_each_index(100,
                                [](size_t k) {
                                    if (k == 57) {
                                        throw std::runtime_error("57");
                                    }
                                }),
                 std::runtime_error);
}

}  // namespace
}  // namespace cases
