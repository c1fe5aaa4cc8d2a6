// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/base/regex.hpp"

#include <gtest/gtest.h>

#include <string>

namespace cases {

namespace {

std::string times(size_t count, const std::string& text) {
    std::string out;
    for (size_t k = 0; k < count; ++k) {
        out += text;
    }
    return out;
}

TEST(Regex, FindsTheLeftmostMatch) {
    const auto match = find_regex("l+vm[a-z]*", "an llvmpipe device");
    ASSERT_TRUE(match);
    EXPECT_EQ(*match, std::pair(size_t{3}, size_t{11}));
    EXPECT_FALSE(find_regex("^llvmpipe", "an llvmpipe device"));
    EXPECT_EQ(find_regex("", "abc"), std::pair(size_t{0}, size_t{0}));
}

TEST(Regex, SaysWhatIsWrong) {
    EXPECT_TRUE(check_regex("a|b"));
    EXPECT_EQ(check_regex("(").error().message, "'(' is not a regular expression (missing ): ()");
    EXPECT_FALSE(find_regex("(", "("));
}

// Expressions that overflow the stack of a recursive engine, or never end in it.
TEST(Regex, IsBoundedByItsLength) {
    EXPECT_TRUE(find_regex(times(60000, "(") + times(60000, ")"), "any"));
    const std::string nested = times(12, "(") + "a*" + times(12, ")*") + "!$";
    ASSERT_TRUE(check_regex(nested));
    EXPECT_FALSE(find_regex(nested, std::string(4000, 'a')));
    EXPECT_LT(check_regex(times(60000, "(")).error().message.size(), 400U);
}

}  // namespace

}  // namespace cases
