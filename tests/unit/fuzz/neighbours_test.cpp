// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/reduce/neighbours.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "cases/load/loader.hpp"
#include "fuzz/entry.hpp"

namespace fuzz {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

const std::string kText = R"(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [8, 8]
samples = 4
sample_locations = [[1, 1], [2, 2], [3, 3], [4, 4]]
[target.color]
format = "rgba8-unorm"
[[draw]]
color = { value = [1, 0.5, 0, 0.25], blend = "additive" }
vertices = [[0, 0], [8, 0], [0, 8]]
[[draw]]
cull = "back"
color = { value = [1, 0.5, 0, 0.25] }
depth = { compare = "less" }
vertices = [[0, 0], [8, 0], [0, 8]]
)";

std::vector<Neighbour> all() {
    return neighbours(*cases::read_toml(kText, "f"));
}

TEST(Neighbours, FormatsSamplesAndWordsOfKeys) {
    std::map<std::string, std::set<std::string>> values;
    for (const Neighbour& n : all()) {
        EXPECT_FALSE(n.data.draws.empty());
        values[n.place].insert(n.value);
    }
    EXPECT_EQ(values["the format {}"].size(), 13U);  // of 20 all but itself and those of integers
    EXPECT_TRUE(values["the format {}"].contains("rgba16-float"));
    EXPECT_FALSE(values["the format {}"].contains("r32-uint"));  // its values are no whole numbers
    EXPECT_THAT(values["depth {}"], UnorderedElementsAre("d24-unorm", "d16-unorm"));
    EXPECT_THAT(values["{}"],
                UnorderedElementsAre("1 sample", "2 samples", "8 samples", "16 samples"));
    EXPECT_EQ(values["blend = {} in draw 0"].size(), 7U);
    EXPECT_THAT(values["cull = {} in draw 1"],
                UnorderedElementsAre("none", "front", "front-and-back"));
    EXPECT_EQ(values["the comparison {} in draw 1"].size(), 7U);
    EXPECT_EQ(values.size(), 6U);
}

TEST(Neighbours, SentencesTellThosePassing) {
    const std::vector<Neighbour> list = all();
    const auto told = [&](const std::set<std::string>& good, const std::set<std::string>& skipped) {
        std::vector<bool> judged, passes;
        for (const Neighbour& n : list) {
            judged.push_back(!skipped.contains(n.value));
            passes.push_back(good.contains(n.value));
        }
        return sentences(list, judged, passes);
    };
    EXPECT_THAT(told({}, {}), IsEmpty());
    EXPECT_THAT(told({"2 samples", "1 sample", "16 samples", "rgba16-float", "front"}, {}),
                ElementsAre("with the format rgba16-float in place of rgba8-unorm",
                            "with 1 sample, 2 samples or 16 samples in place of 4",
                            "with cull = front in draw 1 in place of back"));
    // All of many are any other; what nobody judged does not stand against that.
    std::set<std::string> blends = {"none", "alpha", "premultiplied", "multiply", "min", "max"};
    EXPECT_THAT(told(blends, {"reverse-subtract"}),
                testing::Contains("with blend = any other in draw 0 in place of additive"));
    EXPECT_THAT(told(blends, {}),
                testing::Contains("with blend = none, alpha, premultiplied, multiply, min or max "
                                  "in draw 0 in place of additive"));
}

}  // namespace
}  // namespace fuzz
