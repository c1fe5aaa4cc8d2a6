// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "ref/stencil/values.hpp"

namespace ref::stencil {
namespace {

TEST(StencilValuesText, TellsTheFirstOnesAndHowManyOthers) {
    Values values;
    EXPECT_EQ(to_text(values, " or ", 2), "");
    values.set(255);
    EXPECT_EQ(to_text(values, " or ", 2), "255");
    values.set(0);
    EXPECT_EQ(to_text(values, " or ", 2), "0 or 255");
    values.set(7);
    EXPECT_EQ(to_text(values, ", ", 2), "0, 7 and 1 others");
}

}  // namespace
}  // namespace ref::stencil
