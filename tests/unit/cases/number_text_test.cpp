// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/base/number_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cases {

namespace {

TEST(number_text, has_one_name_for_what_is_no_finite_number) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(number_text(kNan), "NaN");
    EXPECT_EQ(number_text(-kNan), "NaN");
    EXPECT_EQ(number_text(kInfinity), "infinity");
    EXPECT_EQ(number_text(-kInfinity, 3), "-infinity");
}

TEST(number_text, has_as_many_digits_as_asked_for) {
    EXPECT_EQ(number_text(1.0 / 3), "0.333333333");
    EXPECT_EQ(number_text(1.0 / 3, 3), "0.333");
    EXPECT_EQ(number_text(-0.0), "-0");
    EXPECT_EQ(number_text(12345678, 3), "1.23e+07");
}

}  // namespace

}  // namespace cases
