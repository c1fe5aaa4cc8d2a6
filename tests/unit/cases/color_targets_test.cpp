// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Several colour targets: how they are read, written and sent, and what devices cannot have.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cases/load/loader.hpp"
#include "cases/model/derive.hpp"
#include "cases/wire/case_bytes.hpp"
#include "cases/write/to_toml.hpp"

namespace cases {
namespace {

const std::string kThreeTargets =
    "color = [{ format = \"rgba8-unorm\", clear = [1, 0, 0, 0] }, { format = \"r32-uint\", clear = "
    "[7, 0, 0, 0] }, { format = \"rgba16-float\" }]";
const std::string kThreeOutputs =
    "color = [{ value = [0.5, 0, 0, 1], write_mask = \"rg\" }, { value = [9, 0, 0, 0] }, { "
    "attribute = \"c\", blend = \"additive\" }]";

std::string targets_file(
    const std::string& target, const std::string& draw,
    const std::string& attribute = "values = [[1,2,3,4],[5,6,7,8],[1,0.5,2,3]]") {
    return "format = 1\ndescription = \"d\"\nrules = [\"color.location\"]\n[target]\nsize = [8, "
           "8]\n" +
           target + "\n[[draw]]\nvertices = [[0,0],[8,0],[0,8]]\n" + draw +
           "\n[[draw.attribute]]\nname = \"c\"\n" + attribute + "\n";
}

Case load_targets(const std::string& text) {
    const auto cases = load_text(text, "f", "id");
    EXPECT_TRUE(cases) << to_string(cases.error().front());
    return cases ? cases->front() : Case{};
}

void targets_fail(const std::string& text, const std::string& words) {
    const auto cases = load_text(text, "f", "id");
    ASSERT_FALSE(cases) << words;
    const std::string error = to_string(cases.error().front());
    EXPECT_NE(error.find(": error: " + words), std::string::npos) << error;
}

TEST(ColorTargets, TheJudgedOneIsTakenOutOfTheList) {
    const Case first = load_targets(targets_file(kThreeTargets, kThreeOutputs));
    EXPECT_EQ(first.target.color->format, ColorFormat::rgba8_unorm);
    EXPECT_EQ(first.target.judged_color, 0U);
    EXPECT_EQ(first.target.color_count(), 3U);
    EXPECT_EQ(first.draws[0].color.write_mask, 3);
    const Case middle = load_targets(targets_file(kThreeTargets + "\njudged = 1", kThreeOutputs));
    EXPECT_EQ(middle.target.color->format, ColorFormat::r32_uint);
    EXPECT_EQ(middle.draws[0].color.value.x, 9);
    ASSERT_EQ(middle.target.other_colors.size(), 2U);
    EXPECT_EQ(middle.target.other_colors[0].format, ColorFormat::rgba8_unorm);
    EXPECT_EQ(middle.target.other_colors[1].format, ColorFormat::rgba16_float);
    EXPECT_EQ(middle.draws[0].other_colors[1].attribute, 0);
    for (const Case& c : {first, middle}) {
        EXPECT_EQ(c.target.color_at(0).format, ColorFormat::rgba8_unorm);
        EXPECT_EQ(c.target.color_at(1).clear.x, 7);
        EXPECT_EQ(c.target.color_at(2).format, ColorFormat::rgba16_float);
        EXPECT_EQ(output_at(c.target, c.draws[0], 0).value.x, 0.5F);
        EXPECT_EQ(output_at(c.target, c.draws[0], 1).value.x, 9);
        EXPECT_TRUE(output_at(c.target, c.draws[0], 2).blend);
    }
}

TEST(ColorTargets, JudgedIsAMatrixAxis) {
    std::string text = targets_file(kThreeTargets + "\njudged = \"k\"", kThreeOutputs);
    text.insert(text.find("[target]"), "[matrix]\nk = [0, 1, 2]\n");
    const auto leaves = load_text(text, "f", "id");
    ASSERT_TRUE(leaves) << to_string(leaves.error().front());
    ASSERT_EQ(leaves->size(), 3U);
    for (uint32_t k = 0; k < 3; ++k) {
        EXPECT_EQ((*leaves)[k].target.judged_color, k);
    }
}

TEST(ColorTargets, AreWrittenAndSentAsTheyAre) {
    for (const char* judged : {"", "\njudged = 1", "\njudged = 2"}) {
        const Case c = load_targets(targets_file(kThreeTargets + judged, kThreeOutputs));
        const Case again = load_targets(to_toml(c).value());
        EXPECT_EQ(again.target, c.target);
        EXPECT_EQ(again.draws[0].color, c.draws[0].color);
        EXPECT_EQ(again.draws[0].other_colors, c.draws[0].other_colors);
        const Expected<Case> sent = from_bytes(to_bytes(c));
        ASSERT_TRUE(sent);
        EXPECT_EQ(sent->target, c.target);
        EXPECT_EQ(sent->draws[0].other_colors, c.draws[0].other_colors);
    }
}

TEST(ColorTargets, BytesOfTargetsThatDrawsDoNotWriteToAreDamaged) {
    const Case c = load_targets(targets_file(kThreeTargets, kThreeOutputs));
    Case less = c;
    less.draws[0].other_colors.pop_back();
    EXPECT_FALSE(from_bytes(to_bytes(less)));
    Case beyond = c;
    beyond.target.judged_color = 3;
    EXPECT_FALSE(from_bytes(to_bytes(beyond)));
    Case none = c;
    none.target.color.reset();
    EXPECT_FALSE(from_bytes(to_bytes(none)));
}

TEST(ColorTargets, WhatTargetsShareIsFoundInAnyOfThem) {
    Case c = load_targets(targets_file(kThreeTargets, kThreeOutputs));
    EXPECT_EQ(blend_constants(c.draws[0]), glm::vec4(0));
    c.draws[0].other_colors[1].blend->constants = {1, 2, 3, 4};
    EXPECT_EQ(blend_constants(c.draws[0]), glm::vec4(1, 2, 3, 4));
    EXPECT_EQ(drawn_attributes(c.target, c.draws[0]), std::vector<uint32_t>{0});
    c.draws[0].color.attribute = 2;
    EXPECT_EQ(drawn_attributes(c.target, c.draws[0]), (std::vector<uint32_t>{2, 0}));
    c.draws[0].color.attribute = 0;  // for both
    EXPECT_EQ(drawn_attributes(c.target, c.draws[0]), std::vector<uint32_t>{0});
}

TEST(ColorTargets, MistakesAreNamed) {
    targets_fail(targets_file("color = [{ format = \"r32-uint\" }]", kThreeOutputs),
                 "color lists 1 colour target; write 2 to 4, or a table for one");
    targets_fail(targets_file("color = [{ format = \"r32-uint\" }, { format = \"rgba8-unrom\" }]",
                              kThreeOutputs),
                 "the colour format is \"rgba8-unrom\"; did you mean \"rgba8-unorm\"?");
    targets_fail(targets_file(kThreeTargets + "\njudged = 3", kThreeOutputs),
                 "judged is not an integer from 0 to 2");
    targets_fail(
        targets_file("judged = 0\n[target.color]\nformat = \"rgba8-unorm\"",
                     "color = { value = [0,0,0,0] }"),
        "judged chooses from a list of colour targets; write color = [{ format = ...}, ...]");
    targets_fail(
        targets_file(kThreeTargets, "color = { value = [0, 0, 0, 0] }"),
        "the target has 3 colours; write a list of as many tables, in the order of [target]'s");
    targets_fail(
        targets_file(kThreeTargets, "color = [{ value = [0, 0, 0, 0] }, { value = [0, 0, 0, 0] }]"),
        "the target has 3 colours; write a list of as many tables, in the order of [target]'s");
    // Each by the format of its own target.
    targets_fail(
        targets_file(kThreeTargets,
                     "color = [{ value = [0, 0, 0, 0] }, { value = [0.5, 0, 0, 0] }, { value = [0, "
                     "0, 0, 0] }]"),
        "value is not a whole number from 0 to");
}

TEST(ColorTargets, WhatADeviceHasOnceIsTheSameForAll) {
    const std::string targets =
        "attachments = \"color\"\ncolor = [{ format = \"rgba8-unorm\" }, { format = "
        "\"rgba16-float\" }]";
    const auto outputs = [](const std::string& one, const std::string& other) {
        return "color = [{ value = [0,0,0,0]" + one + " }, { value = [0,0,0,0]" + other + " }]";
    };
    const std::string blend = ", blend = { source = \"constant-color\" }, constants = ";
    targets_fail(
        targets_file(targets, outputs(blend + "[1,0,0,0]", blend + "[0,1,0,0]")),
        "a draw has one set of blend constants for all its colours; write the same in each that "
        "blends");
    load_targets(targets_file(targets, outputs(blend + "[1,0,0,0]", blend + "[1,0,0,0]")));
    load_targets(targets_file(targets, outputs(blend + "[1,0,0,0]", "")));
    targets_fail(
        targets_file(targets, outputs(", logic = \"xor\"", "")),
        "a draw has one logical operation for all its colours; write the same in each of them");
    load_targets(targets_file(targets, outputs(", logic = \"xor\"", ", logic = \"xor\"")));
    targets_fail(targets_file(targets, outputs(", alpha_to_one = true", ", alpha_to_one = true")),
                 "alpha to one changes the colour at location 0 alone; write one colour target");
    targets_fail(targets_file(targets, outputs("", ", alpha_to_coverage = true")),
                 "alpha to coverage takes the alpha of the colour at location 0 alone; write one "
                 "colour target");
    targets_fail(
        targets_file(targets,
                     outputs("", ", blend = { source = \"src1-color\" }, second = [0,0,0,0]")),
        "a device may blend a second source into one attachment alone; write one colour target");
    targets_fail(
        targets_file(targets, outputs("", ""), "values = [[1,2],[3,4],[5,6]]\nprobe = \"dfdx\""),
        "attribute \"c\" is not a value from the vertices alone; several colour targets go with "
        "those only");
    targets_fail(
        "format = 1\ndescription = \"d\"\nrules = [\"blit.nearest\"]\n[target]\nsize = [8, 8]\n"
        "color = [{ format = \"rgba8-unorm\" }, { format = \"rgba16-float\" }]\nattachments = "
        "\"color\"\n[blit]\nsize = [8, 8]\n",
        "a blit writes to one colour target; write a table [target.color]");
}

}  // namespace
}  // namespace cases
