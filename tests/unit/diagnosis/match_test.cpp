// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/match.hpp"

#include <gtest/gtest.h>

namespace {

using diagnosis::is_same_value;
using diagnosis::Match;

TEST(SameValue, LeavesASixteenthOfTheError) {
    const char* expected = "0.5 = 1/2 within 2 x 1e-07";
    EXPECT_TRUE(is_same_value(expected, "0.75 (0x3f400000)", "0.75 (0x3f400000)"));
    EXPECT_TRUE(is_same_value(expected, "0.75 (0x3f400000)", "0.765 (0x0)"));  // 0.25 / 16
    EXPECT_FALSE(is_same_value(expected, "0.75 (0x3f400000)", "0.766 (0x0)"));
    EXPECT_FALSE(is_same_value(expected, "0.75 (0x3f400000)", "0.5 (0x3f000000)"));
}

TEST(SameValue, KnowsWhatIsNoNumber) {
    EXPECT_TRUE(is_same_value("1", "NaN (0xffc00000)", "NaN (0x7fc00000)"));
    EXPECT_FALSE(is_same_value("1", "NaN (0xffc00000)", "1 (0x3f800000)"));
    EXPECT_TRUE(is_same_value("1", "inf (0x7f800000)", "inf (0x7f800000)"));
    EXPECT_FALSE(is_same_value("1", "inf (0x7f800000)", "-inf (0xff800000)"));
}

TEST(SameValue, TakesCodesOneApart) {
    const char* expected = "r 158 to 161, g 47 to 49";
    EXPECT_TRUE(is_same_value(expected, "r 223, g 16", "r 224, g 16"));
    EXPECT_FALSE(is_same_value(expected, "r 223, g 16", "r 225, g 16"));
    EXPECT_FALSE(is_same_value(expected, "r 223, g 16", "g 223, r 16"));
    EXPECT_FALSE(is_same_value(expected, "r 223, g 16", "r 223"));
}

TEST(MatchExplains, ASixteenthOfTheSamplesMayDifferAndHalfOfWhatIsTold) {
    Match m{32, 32, 0, 16, 16};
    EXPECT_TRUE(m.explains());
    m.same = 30;
    EXPECT_TRUE(m.explains());
    m.same = 29;
    EXPECT_FALSE(m.explains());
    m = {32, 32, 3, 16, 16};
    EXPECT_FALSE(m.explains());
    m = {32, 32, 0, 16, 8};
    EXPECT_TRUE(m.explains());
    m = {32, 32, 0, 16, 7};
    EXPECT_FALSE(m.explains());
    EXPECT_FALSE(Match{}.explains());
}

}  // namespace
