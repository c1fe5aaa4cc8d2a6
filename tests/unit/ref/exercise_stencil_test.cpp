// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which samples exercise rules of stencils, and of discards where the number of hits is open.
#include <gtest/gtest.h>

#include "cases/load/loader.hpp"
#include "ref/exercise/exercise.hpp"

namespace ref {
namespace {

size_t samples_of(const std::string& text, const std::string& rule) {
    const auto loaded = cases::load_text(
        "format = 1\ndescription = \"A case.\"\nrules = [\"cover.inside\"]\n" + text, "case.toml",
        "case");
    EXPECT_TRUE(loaded) << (loaded ? "" : loaded.error().front().message);
    return loaded ? exercise(loaded->front(), Limits{}, std::vector<std::string>{rule}, Count::all)
                        .rules.at(0)
                        .samples
                  : 0;
}

// The six centres inside and the four on the hypotenuse, a right edge, may be hit. What is cleared
// to another number or has operations of its own is judged by the rules of those.
TEST(Exercise, OnlyAStencilThatCountsHitsIsACount) {
    const std::string target = "[target]\nsize = [4, 4]\nstencil = true\n";
    const std::string draw = "[[draw]]\nvertices = [[0,0], [4,0], [0,4]]\n";
    EXPECT_EQ(samples_of(target + draw, "stencil.count"), 6U);
    EXPECT_EQ(samples_of(target + "stencil_clear = 3\n" + draw, "stencil.count"), 0U);
    EXPECT_EQ(samples_of(target + draw + "stencil = { pass = \"invert\" }\n", "stencil.count"), 0U);
}

// The first draw leaves a stencil of 4 everywhere and hits where x + y is even; whether the second
// one, at the same depth, passes LESS is open. At the eight discarded pixels it leaves no hit and
// 4, or one hit and 251; without discards one hit and 4, or two hits and 251: none of these is
// right, though the numbers of hits overlap.
TEST(Exercise, ADiscardIsToldByTheStencilThatGoesWithTheHits) {
    const std::string text =
        "[target]\nsize = [4, 4]\nstencil = true\nstencil_clear = 3\n"
        "[[draw]]\ntopology = \"triangle-strip\"\ndiscard = \"checker\"\nearly_tests = true\n"
        "stencil = { pass = \"increment-clamp\" }\n"
        "vertices = [[0,0,0.25], [4,0,0.25], [0,4,0.25], [4,4,0.25]]\n"
        "[[draw]]\ntopology = \"triangle-strip\"\ndepth = { compare = \"less\" }\n"
        "stencil = { compare = \"equal\", reference = 4, pass = \"invert\" }\n"
        "vertices = [[0,0,0.25], [4,0,0.25], [0,4,0.25], [4,4,0.25]]\n";
    EXPECT_EQ(samples_of(text, "discard.fragment"), 8U);
    // Without its operation the stencil says nothing of the second draw, and no sample is sure.
    std::string silent = text;
    silent.replace(silent.find("pass = \"invert\""), 15, "pass = \"keep\"");
    EXPECT_EQ(samples_of(silent, "discard.fragment"), 0U);
}

// The six centres inside may not be counted, by a test, a mask, a discard or culling, and four on a
// right edge have nothing to count.
TEST(Exercise, AQueryOfWhatIsHiddenCountsNothingThere) {
    const std::string target = "[target]\nsize = [4, 4]\n";
    const std::string plain = "[[draw]]\nvertices = [[0,0], [4,0], [0,4]]\n";
    const std::string asked = plain + "query = \"occlusion-precise\"\n";
    EXPECT_EQ(samples_of(target + asked, "query.occlusion"), 6U);
    for (const char* hidden : {"depth = { compare = \"never\" }\n", "sample_mask = 0\n",
                               "cull = \"front-and-back\"\n", "rasterizer_discard = true\n"}) {
        EXPECT_EQ(samples_of(target + asked + hidden + plain, "query.occlusion"), 6U) << hidden;
        EXPECT_EQ(samples_of(target + plain + hidden + plain, "query.occlusion"), 0U) << hidden;
    }
}

}  // namespace
}  // namespace ref
