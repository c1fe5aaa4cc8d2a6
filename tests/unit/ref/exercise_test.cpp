// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/exercise/exercise.hpp"

#include <gtest/gtest.h>

#include "cases/load/loader.hpp"
#include "cases/model/rule.hpp"

namespace ref {
namespace {

constexpr const char* kHead = "format = 1\ndescription = \"A case.\"\nrules = [\"cover.inside\"]\n";

Exercise exercise_of_text(const std::string& text, const std::vector<std::string>& rules) {
    const auto loaded = cases::load_text(kHead + text, "case.toml", "case");
    EXPECT_TRUE(loaded) << (loaded ? "" : loaded.error().front().message);
    return loaded ? exercise(loaded->front(), Limits{}, rules, Count::all) : Exercise{};
}

TEST(Exercise, EveryRuleSaysWhatExercisesIt) {
    for (const cases::Rule& rule : cases::all_rules()) {
        EXPECT_FALSE(exercise_of(rule.id).empty()) << rule.id;
    }
    EXPECT_TRUE(exercise_of("no.rule").empty());
}

// By hand: a triangle with legs of 4 pixels covers the 6 centres x + y < 4 and its hypotenuse, a
// right edge, goes through those of x + y = 3, (i + 1/2) + (j + 1/2) = 4.
TEST(Exercise, SamplesAreCounted) {
    const std::string text =
        "[target]\nsize = [8, 8]\n[[draw]]\nvertices = [[0,0], [4,0], [0,4]]\n";
    const Exercise found =
        exercise_of_text(text, {"cover.inside", "cover.outside", "tie.top-left", "depth.compare"});
    ASSERT_EQ(found.rules.size(), 4U);
    EXPECT_EQ(found.samples, 64U);
    EXPECT_EQ(found.rules[0].samples, 6U);
    EXPECT_EQ(found.rules[1].samples, 54U);
    EXPECT_EQ(found.rules[2].samples, 4U);
    EXPECT_EQ(found.rules[3].samples, 0U);
    EXPECT_EQ(found.free_samples, 0U);
}

// Two triangles at the same depth under EQUAL: the second may fall on either side of what was
// stored, so where they overlap (pixels i >= j with i + j <= 6: 16)
// nothing is tested. 12 more are the first one's, where ALWAYS passes, and 20 the second one's,
// where 0.5 fails against a cleared 1.
TEST(Exercise, CoplanarTrianglesUnderEqualAreFree) {
    const std::string text =
        "[target]\nsize = [8, 8]\ndepth = \"d32-float\"\n"
        "[[draw]]\nvertices = [[0,0,0.5], [8,0,0.5], [0,8,0.5]]\ndepth = { compare = \"always\" }\n"
        "[[draw]]\nvertices = [[0,0,0.5], [8,0,0.5], [8,8,0.5]]\ndepth = { compare = \"equal\" }\n";
    const Exercise found = exercise_of_text(text, {"depth.compare"});
    EXPECT_EQ(found.free_samples, 16U);
    EXPECT_EQ(found.rules[0].samples, 32U);
}

// A depth of 3/4 is in the range; 2^23 units of r = 2^-24 are 1/2 and take it beyond. Clamped
// depths end at 1, so only the bias or the plane tells that one was.
TEST(Exercise, ADepthIsClampedByItsPlaneOrItsBias) {
    const auto clamped = [](const std::string& z, const std::string& bias) {
        const std::string text =
            "[target]\nsize = [8, 8]\ndepth = \"d16-unorm\"\n[[draw]]\n"
            "space = \"clip\"\nvertices = [[-1,-1," +
            z + ",1], [1,-1," + z + ",1], [-1,1," + z + ",1]]\ndepth = { clamp = true" + bias +
            " }\n";
        return exercise_of_text(text, {"depth.clamp"}).rules[0].samples;
    };
    EXPECT_EQ(clamped("0.75", ""), 0U);
    EXPECT_EQ(clamped("0.75", ", bias = { constant = 100 }"), 0U);
    EXPECT_EQ(clamped("\"1-2^-20\"", ""), 0U);  // stored as 1
    EXPECT_GT(clamped("0.75", ", bias = { constant = 8388608 }"), 0U);
    EXPECT_GT(clamped("1.5", ""), 0U);
}

TEST(Exercise, WhatIsDrawnBehindFailsTheTest) {
    const std::string text =
        "[target]\nsize = [8, 8]\ndepth = \"d32-float\"\n"
        "[[draw]]\nvertices = [[0,0,0.5], [8,0,0.5], [0,8,0.5]]\ndepth = { compare = \"less\" }\n"
        "[[draw]]\nvertices = [[0,0,0.75], [8,0,0.75], [0,8,0.75]]\ndepth = { compare = \"less\" "
        "}\n";
    const Exercise found = exercise_of_text(text, {"depth.compare"});
    EXPECT_EQ(found.free_samples, 0U);
    EXPECT_GE(found.rules[0].samples, 28U);
}

}  // namespace
}  // namespace ref
