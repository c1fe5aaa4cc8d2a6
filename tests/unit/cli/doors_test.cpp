// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/doors.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cases/load/loader.hpp"
#include "cases/model/door.hpp"

namespace cli {
namespace {

std::vector<cases::Case> load(const std::string& text, const std::string& id) {
    auto loaded = cases::load_text(text, id + ".toml", id);
    EXPECT_TRUE(loaded);
    return loaded ? loaded.value() : std::vector<cases::Case>();
}

// A family whose smallest picture has thousands of triangles, beside a larger one of one triangle.
std::vector<cases::Case> crowded_family(const std::string& family) {
    std::vector<cases::Case> all = load(
        "format = 1\ndescription = \"d\"\ncatches = \"c\"\nrules = "
        "[\"cover.inside\"]\n[target]\nsize = [8, 8]\n[[draw]]\n"
        "generate = { kind = \"surface\", shape = \"plane\", columns = 64, rows = 64, "
        "radius = \"1/2\" }\n",
        family + "/crowded");
    for (cases::Case& c : load("format = 1\ndescription = \"d\"\ncatches = \"c\"\nrules = "
                               "[\"cover.inside\"]\n[target]\nsize = [32, 32]\n[[draw]]\n"
                               "vertices = [[1, 1], [7, 2], [2, 4]]\n",
                               family + "/plain")) {
        all.push_back(std::move(c));
    }
    return all;
}

TEST(DefaultDoors, TakeTheCaseThatIsCheapestToDraw) {
    std::vector<cases::Case> all = crowded_family("a");
    for (cases::Case& c : crowded_family("b")) {
        all.push_back(std::move(c));
    }
    ASSERT_EQ(all.size(), 4U);
    std::vector<cases::Case*> selected;
    for (cases::Case& c : all) {
        selected.push_back(&c);
    }
    choose_doors("default", selected);
    for (const cases::DoorRow& row : cases::all_doors()) {
        for (const size_t family : {0U, 2U}) {
            const cases::Case& crowded = all[family];
            const cases::Case& plain = all[family + 1];
            const auto has = [&](const cases::Case& c) {
                return std::find(c.doors.begin(), c.doors.end(), row.door) != c.doors.end();
            };
            const bool is_for_plain = cases::can_take(row.door, plain);
            EXPECT_EQ(has(plain), is_for_plain) << row.word;
            EXPECT_EQ(has(crowded), !is_for_plain && cases::can_take(row.door, crowded))
                << row.word;
        }
    }
}

}  // namespace
}  // namespace cli
