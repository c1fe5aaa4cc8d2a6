// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How many cases that passed may speak against an error before it is named no longer.
#include "diagnosis/tally.hpp"

#include <gtest/gtest.h>

namespace diagnosis {
namespace {

// Of `answers` failed cases that were tried all are explained.
Tally explaining(size_t answers, uint64_t against, uint64_t tried) {
    Tally tally;
    tally.answers.assign(answers, Answer{Says::explains, {}});
    tally.passed_against = against;
    tally.passed_tried = tried;
    return tally;
}

TEST(Tally, AnEighthOfWhatWouldBeExplainedMaySpeakAgainst) {
    EXPECT_TRUE(explaining(8, 1, 3).stands(8));
    EXPECT_FALSE(explaining(8, 2, 3).stands(8));
    // If 64 of 640 were tried, 8 against are an eightieth.
    EXPECT_TRUE(explaining(64, 8, 64).stands(640));
}

// 25 of 59: of 955 failed cases that is less than an eighth, and yet the error is not the device's.
TEST(Tally, AQuarterOfManyPassedCasesMaySpeakAgainst) {
    EXPECT_FALSE(explaining(64, 25, 59).stands(955));
    EXPECT_TRUE(explaining(64, 14, 59).stands(955));
    EXPECT_FALSE(explaining(64, 5, 16).stands(955));
    EXPECT_TRUE(explaining(64, 5, 15).stands(955));
}

}  // namespace
}  // namespace diagnosis
