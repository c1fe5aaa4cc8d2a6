// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "cases/model/sample.hpp"

namespace cases {
namespace {

TEST(SampleLocations, AreReadAsTheyAreWritten) {
    const std::vector<SampleLocations> lists{{{4, 4}, {12, 12}},
                                             {{6, 2}, {14, 6}, {2, 10}, {10, 15}}};
    EXPECT_EQ(to_text(lists), "4,4;12,12 6,2;14,6;2,10;10,15");
    EXPECT_EQ(parse_sample_locations(to_text(lists)).value(), lists);
    EXPECT_EQ(to_text({}), "");
    EXPECT_TRUE(parse_sample_locations("")->empty());
}

TEST(SampleLocations, WrongTextsAreTold) {
    const auto wrong = [](const char* text) {
        const auto lists = parse_sample_locations(text);
        return lists ? std::string("none") : lists.error().message;
    };
    for (const std::string text : {"4", "4,", "16,0", "-1,0", "1.5,2", "a,b", "1,2,3"}) {
        EXPECT_EQ(wrong((text + ";0,0").c_str()),
                  "'" + text + "' is no sample location: write x,y in 1/16 pixel, 0 to 15");
    }
    EXPECT_EQ(wrong("1,2;3,4;5,6"),
              "'1,2;3,4;5,6' has 3 locations: write the locations of 2, 4, 8 or 16 samples");
    EXPECT_EQ(wrong("8,8"), "'8,8' has 1 location: write the locations of 2, 4, 8 or 16 samples");
}

}  // namespace
}  // namespace cases
