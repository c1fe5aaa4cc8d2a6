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
        EXPECT_EQ(exercise_of(rule.id).empty(), cases::is_of_device(rule.id)) << rule.id;
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
// stored, so where they overlap (pixels i >= j with i + j <= 6: 16) nothing is tested. 12 more are
// the first one's, where ALWAYS passes as no test would, and 20 the second one's, where 0.5 fails
// against what was cleared.
TEST(Exercise, CoplanarTrianglesUnderEqualAreFree) {
    const std::string text =
        "[target]\nsize = [8, 8]\ndepth = \"d32-float\"\n"
        "[[draw]]\nvertices = [[0,0,0.5], [8,0,0.5], [0,8,0.5]]\ndepth = { compare = \"always\" }\n"
        "[[draw]]\nvertices = [[0,0,0.5], [8,0,0.5], [8,8,0.5]]\ndepth = { compare = \"equal\" }\n";
    const Exercise found = exercise_of_text(text, {"depth.compare"});
    EXPECT_EQ(found.free_samples, 16U);
    EXPECT_EQ(found.rules[0].samples, 20U);
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

// What a device shows that is wrong about the rule is what a right one shows, until the case asks.
TEST(Exercise, AValueThatIsThereMayDecideNothing) {
    const auto of = [](const std::string& rule, const std::string& vertices,
                       const std::string& target, const std::string& draw) {
        return exercise_of_text("[target]\nsize = [8, 8]\n" + target +
                                    "[[draw]]\nvertices = " + vertices + "\n" + draw,
                                {rule})
            .rules[0]
            .samples;
    };
    const std::string plain = "[[0,0], [8,0], [0,8]]";
    EXPECT_EQ(of("fragcoord.w", plain, "", ""), 0U);
    EXPECT_EQ(of("fragcoord.w", "[[0,0,0.5,1], [8,0,0.5,2], [0,8,0.5,4]]", "", ""), 28U);
    const std::string id = "[[draw.attribute]]\nsource = \"sample-id\"\n";
    EXPECT_EQ(of("sample.id", plain, "", id), 0U);
    EXPECT_GT(of("sample.id", plain, "samples = 4\n", id), 0U);
    const std::string four = "samples = 4\n";
    const std::string centred = four + "sample_locations = [[8, 8], [8, 8], [8, 8], [8, 8]]\n";
    EXPECT_EQ(of("fragcoord.sample", plain, centred, "min_sample_shading = 1\n"), 0U);
    EXPECT_GT(of("fragcoord.sample", plain, four, "min_sample_shading = 1\n"), 0U);
    // Nothing has to be drawn of a bad triangle; beside a right one its harm would be seen.
    const std::string bad = "[nan,0,0,1], [8,0,0,1], [0,8,0,1]";
    const std::string clip = "space = \"clip\"\n";
    EXPECT_EQ(of("number.undefined", "[" + bad + "]", "", clip), 0U);
    EXPECT_EQ(
        of("number.undefined", "[" + bad + ", [-1,-1,0,1], [1,-1,0,1], [-1,1,0,1]]", "", clip),
        28U);
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

// The pixels of a triangle with legs of 8 pixels in a target of 8 x 8: i + j <= 6, 28 of them, and
// 6 of these in columns 4 and beyond.
constexpr const char* kTriangle = "vertices = [[0,0], [8,0], [0,8]]\n";

uint64_t samples_of(const std::string& rule, const std::string& target, const std::string& draw,
                    const std::string& more = "") {
    return exercise_of_text(
               "[target]\nsize = [8, 8]\n" + target + "[[draw]]\n" + kTriangle + draw + more,
               {rule})
        .rules[0]
        .samples;
}

TEST(Exercise, AScissorThatCutsNothingDecidesNothing) {
    EXPECT_EQ(samples_of("scissor.half-open", "", "scissor = [0, 0, 100, 100]\n"), 0U);
    EXPECT_EQ(samples_of("scissor.half-open", "", "scissor = [0, 0, 4, 8]\n"), 6U);
}

TEST(Exercise, AMaskOfAllSamplesDecidesNothing) {
    EXPECT_EQ(samples_of("sample.mask", "samples = 4\n", "sample_mask = 15\n"), 0U);
    EXPECT_EQ(samples_of("sample.mask", "samples = 4\n", "shader_mask = 15\n"), 0U);
    // Sample 3 of each pixel, at (10, 14) / 16, is covered where i + j + 24/16 < 8, 28 times; in
    // reverse sample 0 would be lost, at (6, 2) / 16, 36 times.
    EXPECT_EQ(samples_of("sample.mask", "samples = 4\n", "sample_mask = 7\n"), 64U);
    EXPECT_EQ(samples_of("sample.mask", "samples = 4\n", "shader_mask = 7\n"), 64U);
}

// Taken for an alpha, a fourth of 0 would draw nothing: that shows at the 6 samples of the
// triangle, unless another one is drawn over it.
TEST(Exercise, IntegersThatAlphaWouldTakeAwayShowWhereTheyAreSeen) {
    const auto found = [](const std::string& behind) {
        return exercise_of_text(
                   "[target]\nsize = [8, 8]\nattachments = \"color\"\n"
                   "[target.color]\nformat = \"rgba8-uint\"\n"
                   "[[draw]]\nvertices = [[0,0], [4,0], [0,4]]\n"
                   "color = { value = [1, 2, 3, 0], alpha_to_coverage = true }\n" +
                       behind,
                   {"sample.alpha-to-coverage"})
            .rules.at(0)
            .samples;
    };
    EXPECT_EQ(found(""), 6U);
    EXPECT_EQ(
        found("[[draw]]\nvertices = [[0,0], [16,0], [0,16]]\ncolor = { value = [9, 9, 9, 9] }\n"),
        0U);
}

TEST(Exercise, ADistanceThatCutsNothingDecidesNothing) {
    EXPECT_EQ(samples_of("clip.distance", "", "[[draw.clip_distance]]\nconstant = 1\n"), 0U);
    EXPECT_EQ(samples_of("clip.distance", "", "[[draw.clip_distance]]\nplane = \"4-x\"\n"), 6U);
    EXPECT_EQ(samples_of("cull.distance", "", "[[draw.cull_distance]]\nvalues = [-1, -1, 1]\n"),
              0U);
    const std::string culled =
        "[[draw]]\nvertices = [[0,0], [8,0], [0,8]]\n[[draw.cull_distance]]\n"
        "constant = -1\n";
    EXPECT_EQ(samples_of("cull.distance", "", "", culled), 28U);
}

TEST(Exercise, CullingAndDiscardingDecideWhatIsDrawn) {
    EXPECT_EQ(samples_of("face.cull", "", ""), 0U);
    EXPECT_EQ(samples_of("face.cull", "", "cull = \"front\"\n"), 28U);
    EXPECT_EQ(samples_of("face.cull", "", "cull = \"back\"\n"),
              28U);  // or, of front faces, nothing
    const std::string discarded =
        "[[draw]]\nvertices = [[0,0], [4,0], [0,4]]\nrasterizer_discard = ";
    EXPECT_EQ(samples_of("discard.rasterizer", "", "", discarded + "true\n"), 6U);
    EXPECT_EQ(samples_of("discard.rasterizer", "", "", discarded + "false\n"), 0U);
}

TEST(Exercise, ALayerIsWhereItIsDrawn) {
    EXPECT_EQ(samples_of("layer.select", "", ""), 0U);
    EXPECT_EQ(samples_of("layer.select", "layers = 2\n", ""), 56U);
    EXPECT_EQ(samples_of("layer.select", "layers = 2\n", "layer = 1\n"), 56U);
}

TEST(Exercise, ABiasThatRoundsToNothingDecidesNothing) {
    const auto biased = [](const std::string& format, const std::string& keys) {
        return samples_of("depth.bias", "depth = \"" + format + "\"\n",
                          "depth = { bias = { " + keys + " }\n");
    };
    EXPECT_EQ(biased("d16-unorm", "constant = \"2^-20\" }"), 0U);
    EXPECT_EQ(biased("d32-float", "constant = \"2^-20\" }"), 0U);
    EXPECT_EQ(biased("d32-float", "constant = 1000 }"), 28U);
    EXPECT_EQ(biased("d32-float", "constant = 1000 }, write = false"), 0U);
    // A step of fixed point may be as small as one likes, but no larger than 2 2^-16.
    EXPECT_EQ(biased("d16-unorm", "constant = 100 }"), 28U);
}

// A bias that takes a triangle behind its own equal: without it, or with more of it, the test fails
// as well, but with the other sign it passes, in all 28 samples.
TEST(Exercise, TheSignOfABiasCounts) {
    const std::string plane = "[[draw]]\nvertices = [[0,0,0.5], [8,0,0.5], [0,8,0.5]]\n";
    const Exercise found =
        exercise_of_text("[target]\nsize = [8, 8]\ndepth = \"d32-float\"\ndepth_clear = 1\n" +
                             plane + "depth = { compare = \"less\" }\n" + plane +
                             "depth = { compare = \"less\", bias = { constant = 1000 } }\n",
                         {"depth.bias"});
    EXPECT_EQ(found.rules[0].samples, 28U);
}

TEST(Exercise, AConstantShowsNoInterpolation) {
    const auto attribute = [](const std::string& keys) { return "[[draw.attribute]]\n" + keys; };
    const std::string constant = attribute("constant = 0.5\n");
    const std::string plane = attribute("plane = [\"x+2*y\"]\n");
    const std::string samples = "samples = 4\n";
    EXPECT_EQ(samples_of("interp.centroid", samples, constant + "auxiliary = \"centroid\"\n"), 0U);
    EXPECT_GT(samples_of("interp.centroid", samples, plane + "auxiliary = \"centroid\"\n"), 0U);
    EXPECT_EQ(samples_of("interp.sample", samples, constant + "auxiliary = \"sample\"\n"), 0U);
    EXPECT_EQ(samples_of("interp.sample", samples, plane + "auxiliary = \"sample\"\n"),
              samples_of("cover.inside", samples, ""));
    EXPECT_EQ(samples_of("interp.at-offset", "",
                         constant + "probe = \"at-offset\"\noffset = [0.25, 0]\n"),
              0U);
    EXPECT_EQ(
        samples_of("interp.at-offset", "", plane + "probe = \"at-offset\"\noffset = [0.25, 0]\n"),
        28U);
    for (const auto& [rule, probe] :
         {std::pair("derivative.fine", "dfdx-fine"), std::pair("derivative.coarse", "dfdy-coarse"),
          std::pair("derivative.plain", "dfdx")}) {
        const std::string of = "probe = \"" + std::string(probe) + "\"\n";
        EXPECT_EQ(samples_of(rule, "", constant + of), 0U);
        EXPECT_EQ(samples_of(rule, "", plane + of), 28U);
    }
    EXPECT_EQ(samples_of("interp.linear", "", constant + "interpolation = \"noperspective\"\n"),
              0U);
    EXPECT_EQ(samples_of("interp.linear", "", plane + "interpolation = \"noperspective\"\n"), 28U);
    EXPECT_EQ(samples_of("interp.flat", "", constant + "interpolation = \"flat\"\n"), 0U);
    EXPECT_EQ(samples_of("interp.flat", "", plane + "interpolation = \"flat\"\n"), 28U);
    EXPECT_EQ(samples_of("interp.perspective", "", constant), 0U);
    EXPECT_EQ(samples_of("interp.perspective", "", plane), 28U);  // another w would change it
    const auto perspective = [](const std::string& values) {
        return exercise_of_text(
                   "[target]\nsize = [8, 8]\n[[draw]]\nvertices = [[0,0,0.5,1], "
                   "[8,0,0.5,2], [0,8,0.5,4]]\n[[draw.attribute]]\nvalues = " +
                       values,
                   {"interp.perspective"})
            .rules[0]
            .samples;
    };
    EXPECT_EQ(perspective("[0, 0, 0]\n"), 0U);
    EXPECT_EQ(perspective("[1, 1, 1]\n"), 28U);  // which 1/w is not, unless it is divided by it
    EXPECT_EQ(perspective("[1, 2, 4]\n"), 28U);
    EXPECT_EQ(samples_of("depth.linear", "", ""), 0U);
    EXPECT_EQ(exercise_of_text("[target]\nsize = [8, 8]\n[[draw]]\n"
                               "vertices = [[0,0,0.25], [8,0,0.5], [0,8,0.75]]\n",
                               {"depth.linear"})
                  .rules[0]
                  .samples,
              28U);
}

std::string color_target(const std::string& clear) {
    return "[target.color]\nformat = \"rgba8-unorm\"\nclear = " + clear + "\n";
}

TEST(Exercise, ABlendOrMaskThatChangesNothingDecidesNothing) {
    const std::string grey = color_target("[0, 0.5, 0.5, 0.5]");
    const auto color = [](const std::string& keys) { return "color = { " + keys + " }\n"; };
    EXPECT_EQ(samples_of("blend.equation", grey,
                         color("value = [0, 0.5, 0.5, 0.5], blend = { source = \"zero\", "
                               "destination = \"one\" }")),
              0U);  // the same colour whatever is kept
    EXPECT_EQ(samples_of("blend.equation", grey,
                         color("value = [1, 1, 1, 1], blend = { source = \"zero\", "
                               "destination = \"one\" }")),
              28U);
    EXPECT_EQ(
        samples_of("blend.equation", grey, color("value = [1, 1, 0, 0.5], blend = \"alpha\"")),
        28U);
    EXPECT_EQ(samples_of("blend.write-mask", grey,
                         color("value = [1, 0.5, 0.5, 0.5], write_mask = \"r\"")),
              0U);
    EXPECT_EQ(
        samples_of("blend.write-mask", grey, color("value = [1, 1, 1, 1], write_mask = \"r\"")),
        28U);
}

// Without instruments the colours alone tell what was drawn.
TEST(Exercise, WhatCannotBeSeenIsNotExercised) {
    const std::string target = "attachments = \"color\"\n" + color_target("[0, 0, 0, 0]");
    const auto draw = [](const std::string& value, const std::string& more = "") {
        return "color = { value = " + value + more + " }\n";
    };
    const std::string red = draw("[1, 0, 0, 1]");
    const std::string small = "[[draw]]\nvertices = [[0,0], [4,0], [0,4]]\n";
    EXPECT_EQ(samples_of("cover.inside", target, draw("[0, 0, 0, 0]"), small + red), 6U);
    EXPECT_EQ(samples_of("cover.inside", target, red), 28U);
    EXPECT_EQ(samples_of("cover.outside", target, draw("[0, 0, 0, 0]")), 0U);
    EXPECT_EQ(samples_of("tie.top-left", target, draw("[0, 0, 0, 0]")), 0U);
    EXPECT_EQ(samples_of("tie.top-left", target, red), 8U);
    EXPECT_EQ(
        samples_of("scissor.half-open", target, draw("[0, 0, 0, 0]") + "scissor = [0, 0, 4, 8]\n"),
        0U);
    EXPECT_EQ(samples_of("scissor.half-open", target, red + "scissor = [0, 0, 4, 8]\n"), 6U);
    // The order of two fragments of one colour.
    EXPECT_EQ(samples_of("order.primitive", target, red, small + red), 0U);
    EXPECT_EQ(samples_of("order.primitive", target, red, small + draw("[0, 1, 0, 1]")), 6U);
}

std::vector<Sight> sights(const std::string& first, const std::string& second) {
    return exercise_of_text("[target]\nsize = [8, 8]\nattachments = \"color\"\n" +
                                color_target("[0, 0, 0, 0]") + "[[draw]]\n" + kTriangle +
                                "color = { value = " + first + " }\n[[draw]]\n" + kTriangle +
                                "color = { value = " + second + " }\n",
                            {"cover.inside"})
        .draws;
}

TEST(Exercise, DrawsOfWhichNothingCanBeSeen) {
    using Sights = std::vector<Sight>;
    const Sights both{Sight::something, Sight::something};
    EXPECT_EQ(sights("[0, 0, 0, 0]", "[1, 0, 0, 1]"), (Sights{Sight::nothing, Sight::something}));
    EXPECT_EQ(sights("[1, 0, 0, 1]", "[1, 0, 0, 1]"), (Sights{Sight::nothing, Sight::nothing}));
    // The second hides the first, but not if the first is drawn last.
    EXPECT_EQ(sights("[1, 0, 0, 1]", "[0, 1, 0, 1]"), both);
    EXPECT_EQ(
        sights("[0.5, 0, 0, 1], blend = \"additive\"", "[0.25, 0, 0, 1], blend = \"additive\""),
        both);
    // That it changes nothing is what its mask or its equation is for.
    EXPECT_EQ(sights("[1, 0, 0, 1]", "[1, 1, 0, 1], write_mask = \"r\""), both);
    EXPECT_EQ(sights("[1, 0, 0, 1]",
                     "[0, 1, 0, 1], blend = { source = \"zero\", destination = \"one\" }"),
              both);
}

// By hand: the mask leaves samples 0 and 1 of four, which reversed would be 3 and 2.
TEST(Exercise, AMaskInReverse) {
    const std::string text =
        "[target]\nsize = [1, 1]\nsamples = 4\n"
        "sample_locations = [[1, 1], [3, 1], [12, 12], [15, 15]]\n"
        "[[draw]]\nvertices = [[0,0], [1,0], [0,1]]\nsample_mask = ";
    const auto samples = [&](const std::string& mask) {
        return exercise_of_text(text + mask + "\n", {"sample.mask"}).rules[0].samples;
    };
    EXPECT_EQ(samples("3"), 2U);  // nothing is lost by it, and all in reverse
    EXPECT_EQ(samples("15"), 0U);
    EXPECT_EQ(samples("1"), 2U);  // sample 1 is lost by it, sample 0 in reverse
}

TEST(Exercise, AVertexOnAClipPlane) {
    // At -1 the left side cuts off what lies left of 8/9, the first 7 pixels; the corners of what
    // is left are snapped, so that 7 centres on the hypotenuse are free, which the case itself
    // decides.
    EXPECT_EQ(samples_of("clip.distance", "", "[[draw.clip_distance]]\nplane = \"x\"\n"), 14U);
    EXPECT_EQ(samples_of("clip.distance", "", "[[draw.clip_distance]]\nplane = \"x+1\"\n"), 0U);
}

TEST(Exercise, BlendingThatShowsOnlyIfItIsDoneTwice) {
    const std::string black = color_target("[0, 0, 0, 0]");
    EXPECT_EQ(samples_of("blend.equation", black,
                         "color = { value = [0.25, 0, 0, 0], blend = \"additive\" }\n"),
              28U);
}

// "Logical operations are not applied to floating-point or sRGB format color attachments": what is
// seen is that nothing changes, where the operation would. The triangle covers 28 samples of 64.
TEST(Exercise, ALogicalOperationThatAFormatDoesNotTake) {
    const auto samples = [](const std::string& format, const std::string& color) {
        return exercise_of_text(
                   "[target]\nsize = [8, 8]\nattachments = \"color\"\n"
                   "[target.color]\nformat = \"" +
                       format +
                       "\"\nclear = [1, 0.5, 0.25, 1]\n[[draw]]\n"
                       "vertices = [[0,0], [8,0], [0,8]]\n"
                       "color = { value = [0.5, 1, 0.125, 1], logic = " +
                       color + " }\n",
                   {"logic.operation"})
            .rules[0]
            .samples;
    };
    for (const char* format : {"rgba16-float", "r32-float", "rgba8-srgb"}) {
        EXPECT_EQ(samples(format, "\"xor\""), 28U) << format;
        EXPECT_EQ(samples(format, "\"invert\""), 28U) << format;
        EXPECT_EQ(samples(format, "\"copy\""), 0U) << format;
        EXPECT_EQ(samples(format, "\"xor\", write_mask = \"\""), 0U) << format;
    }
    EXPECT_EQ(samples("rgba8-unorm", "\"xor\""), 28U);
}

TEST(Exercise, OneSampleIsNotTheCorner) {
    const std::string plane = "[[draw.attribute]]\nplane = [\"x+2*y\"]\n";
    EXPECT_EQ(samples_of("interp.at-sample", "", plane + "probe = \"at-sample\"\nsample = 0\n"),
              28U);
    EXPECT_EQ(samples_of("interp.at-centroid", "", plane + "probe = \"at-centroid\"\n"), 28U);
}

// Of each rule with several wrong devices, what one of them alone tells.

uint64_t samples_of_text(const std::string& rule, const std::string& text) {
    return exercise_of_text(text, {rule}).rules[0].samples;
}

TEST(Exercise, FacesWithoutInstrumentsShowByCulling) {
    const std::string target = "attachments = \"color\"\n" + color_target("[0, 0, 0, 0]");
    const std::string red = "color = { value = [1, 0, 0, 1] }\n";
    EXPECT_EQ(samples_of("face.area-sign", target, red), 0U);
    EXPECT_EQ(samples_of("face.area-sign", target, red + "cull = \"front\"\n"), 28U);
    EXPECT_EQ(samples_of("face.cull", "", "",
                         "[[draw]]\nvertices = [[0,0], [4,0], [0,4]]\ncull = \"front-and-back\"\n"),
              6U);
}

// Half of the triangle lies beyond the far plane in either volume.
TEST(Exercise, ADepthPlaneThatIsSwitchedOff) {
    EXPECT_GT(samples_of_text("clip.depth",
                              "[target]\nsize = [8, 8]\n[[draw]]\nspace = \"clip\"\n"
                              "vertices = [[-1,-1,0.5,1], [1,-1,0.5,1], [-1,1,1.5,1]]\n"),
              0U);
}

// Sample 0 lies elsewhere than the centre, sample 1 in it and not in the place of sample 0.
TEST(Exercise, ASampleInputAtTheCentreOrAtSampleZero) {
    const std::string target = "samples = 2\nsample_locations = [[2, 2], [8, 8]]\n";
    const std::string plane = "[[draw.attribute]]\nplane = [\"x+2*y\"]\n";
    EXPECT_EQ(samples_of("interp.sample", target, plane + "auxiliary = \"sample\"\n"),
              samples_of("cover.inside", target, ""));
    // The centre is right for whole pixels: at their sample 0 it shows that a device takes samples.
    // Where sample 0 alone is covered, at i + j = 7, the centre is wrong.
    EXPECT_EQ(samples_of("interp.centroid", target, plane + "auxiliary = \"centroid\"\n"),
              28U + 8U);
    const std::string corners = "samples = 2\nsample_locations = [[0, 0], [8, 8]]\n";
    EXPECT_GT(
        samples_of("interp.at-sample", corners, plane + "probe = \"at-sample\"\nsample = 0\n"), 0U);
}

// b = 1/2, 1/4, 1/4 and w = 2, 1/2, 1 at the one centre: sum b/w = 1, so that the division changes
// nothing there; with perspective the value is 1/2, without it 1/4.
TEST(Exercise, AValueThatShowsPerspectiveAlone) {
    EXPECT_EQ(samples_of_text("interp.perspective",
                              "[target]\nsize = [1, 1]\n[[draw]]\nindices = [1, 2, 4]\n"
                              "vertices = [[9,9,0,1], [0,0,0,2], [2,0,0,0.5], [9,9,0,1], "
                              "[0,2,0,1]]\n[[draw.attribute]]\nvalues = [0, 0, 1, 0, 0]\n"),
              1U);
}

TEST(Exercise, FactorsThatShowExchangedAlone) {
    EXPECT_EQ(samples_of("blend.equation", color_target("[0, 0.5, 0.5, 0.5]"),
                         "color = { value = [1, 1, 1, 1], blend = { source = \"one\", "
                         "destination = \"zero\" } }\n"),
              28U);
}

TEST(Exercise, ALeastThatShowsIfItIsNotBlended) {
    EXPECT_EQ(samples_of("blend.equation", color_target("[0, 0.5, 0.5, 0.5]"),
                         "color = { value = [1, 1, 1, 1], blend = { source = \"one\", "
                         "destination = \"one\", op = \"min\" } }\n"),
              28U);
}

// A front and a back face over each sample: which is which does not show, a face alone does.
TEST(Exercise, AFoldShowsItsFaces) {
    EXPECT_EQ(samples_of_text("face.area-sign",
                              "[target]\nsize = [8, 8]\n[[draw]]\nvertices = [[0,0], [8,0], "
                              "[0,8], [0,0], [0,8], [8,0]]\n"),
              28U);
}

TEST(Exercise, ABiasAtItsClampShowsIfItIsLeftOut) {
    EXPECT_EQ(samples_of("depth.bias", "depth = \"d32-float\"\n",
                         "depth = { bias = { constant = 1000000, clamp = 0.001 } }\n"),
              28U);
}

TEST(Exercise, AFlatColourShowsItsVertex) {
    const std::string target = "attachments = \"color\"\n" + color_target("[0, 0, 0, 0]");
    const std::string values =
        "color = { attribute = \"c\" }\n[[draw.attribute]]\nname = \"c\"\n"
        "interpolation = \"flat\"\nvalues = [[1,0,0,1], ";
    for (const std::string convention : {"first", "last"}) {
        const std::string keys = "provoking = \"" + convention + "\"\n" + values;
        const std::string rule = "provoking." + convention;
        EXPECT_EQ(samples_of(rule, target, keys + "[0,1,0,1], [0,0,1,1]]\n"), 28U);
        EXPECT_EQ(samples_of(rule, target, keys + "[0,1,0,1], [1,0,0,1]]\n"), 0U);
    }
}

// The second draw leaves one pixel of each fragment of the first one, which then agrees with none.
TEST(Exercise, SharedFragmentsKeepTwoPixels) {
    const std::string target = "[target]\nsize = [2, 8]\n";
    const std::string square = "vertices = [[0,0], [2,0], [0,8],  [2,0], [2,8], [0,8]]\n";
    const std::string first = target + "[[draw]]\nfragment_size = [2, 1]\n" + square;
    const std::string next = "[[draw]]\nscissor = [0, 0, 1, 8]\n" + square;
    const std::vector<std::string> rules = {"fragment-size.shared"};
    EXPECT_GT(exercise_of_text(first, rules).rules[0].samples, 4U);
    EXPECT_EQ(exercise_of_text(first + next, rules).rules[0].samples, 0U);
}

}  // namespace
}  // namespace ref
