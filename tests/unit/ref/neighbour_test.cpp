// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a device would draw that takes something of another colour target, and the rule that it then
// breaks.
#include "cases/fault/neighbour.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <optional>
#include <string>

#include "cases/load/loader.hpp"
#include "ref/color/color.hpp"

namespace ref {
namespace {

cases::Case three_targets(uint32_t judged) {
    const auto loaded = cases::load_text(
        "format = 1\ndescription = \"d\"\nrules = [\"color.location\"]\n[target]\nsize = [8, 8]\n"
        "color = [{ format = \"rgba32-float\", clear = [1, 1, 1, 1] }, { format = \"rgba32-float\","
        " clear = [8, 8, 8, 8] }, { format = \"r32-uint\" }]\njudged = " +
            std::to_string(judged) +
            "\n[[draw]]\nvertices = [[0,0],[20,0],[0,20]]\n"
            "color = [{ value = [2, 3, 4, 5], blend = \"additive\" }, { value = [5, 6, 7, 8], "
            "write_mask = \"g\" }, { value = [3, 0, 0, 0] }]\n",
        "f", "id");
    EXPECT_TRUE(loaded) << to_string(loaded.error().front());
    return loaded->front();
}

// The codes of four whole numbers in binary32.
std::array<uint32_t, 4> binary32_codes(float r, float g, float b, float a) {
    return {std::bit_cast<uint32_t>(r), std::bit_cast<uint32_t>(g), std::bit_cast<uint32_t>(b),
            std::bit_cast<uint32_t>(a)};
}

struct JudgedNeighbour {
    cases::Case c;
    Expectation expectation = expect(c, Limits{8}, cases::Profile::vulkan);
    ColorReference reference{c, expectation};

    explicit JudgedNeighbour(uint32_t judged) : c(three_targets(judged)) {}
    std::string rule_of(const std::array<uint32_t, 4>& codes) {
        ColorWitness witness;
        witness.knows_fragments = true;
        const ColorVerdict verdict = reference.judge(0, {0, 0, 0}, codes, witness);
        return verdict.kind == ColorVerdict::Kind::ok ? "ok" : verdict.rule;
    }
};

TEST(Neighbour, OnlyWhatDiffersIsAChange) {
    cases::Case c = three_targets(0);
    EXPECT_TRUE(cases::take_from(c, 1, cases::Taken::state));
    EXPECT_FALSE(c.draws[0].color.blend);
    EXPECT_EQ(c.draws[0].color.write_mask, 2);
    EXPECT_FALSE(cases::take_from(c, 1, cases::Taken::state));
    EXPECT_TRUE(cases::take_from(c, 1, cases::Taken::color));
    EXPECT_EQ(c.draws[0].color.value.x, 5);
    EXPECT_TRUE(cases::take_from(c, 1, cases::Taken::clear));
    EXPECT_EQ(c.target.color->clear.x, 8);
    EXPECT_FALSE(cases::take_from(c, 1, cases::Taken::all));
}

TEST(Neighbour, ClassesAreKeptApart) {
    cases::Case c = three_targets(2);
    EXPECT_FALSE(cases::take_from(c, 0, cases::Taken::color));
    EXPECT_FALSE(cases::take_from(c, 0, cases::Taken::clear));
    EXPECT_FALSE(cases::take_from(c, 0, cases::Taken::all));
    EXPECT_FALSE(cases::take_from(c, 0, cases::Taken::state));  // which blends, as integers do not
    EXPECT_TRUE(cases::take_from(c, 1, cases::Taken::state));   // which masks
    EXPECT_FALSE(c.draws[0].color.blend);
}

TEST(Neighbour, OthersChangeNothing) {
    JudgedNeighbour first(0);
    EXPECT_EQ(first.rule_of(binary32_codes(3, 4, 5, 6)), "ok");
    JudgedNeighbour second(1);
    EXPECT_EQ(second.rule_of(binary32_codes(8, 6, 8, 8)), "ok");
}

TEST(Neighbour, WhatIsTakenFromAnotherTargetBreaksTheRuleOfLocations) {
    JudgedNeighbour first(0);
    EXPECT_EQ(first.rule_of(binary32_codes(1, 3, 1, 1)), "color.location");      // its mask
    EXPECT_EQ(first.rule_of(binary32_codes(6, 7, 8, 9)), "color.location");      // its colour
    EXPECT_EQ(first.rule_of(binary32_codes(10, 11, 12, 13)), "color.location");  // its clear colour
    EXPECT_EQ(first.rule_of(binary32_codes(8, 6, 8, 8)), "color.location");      // all of it
    EXPECT_EQ(first.rule_of(binary32_codes(3, 4, 5, 7)), "blend.equation");  // nothing of the kind
    JudgedNeighbour second(1);
    EXPECT_EQ(second.rule_of(binary32_codes(13, 14, 15, 16)),
              "color.location");  // blending and mask
    EXPECT_EQ(second.rule_of(binary32_codes(8, 3, 8, 8)), "color.location");
    EXPECT_EQ(second.rule_of(binary32_codes(8, 7, 8, 8)), "blend.write-mask");
}

// Found by fuzzing on a driver that rounds to 10 bits wrongly: beside the value that was written
// 1015 is no code, and nothing of the other target makes it one.
TEST(Neighbour, ACodeBesideTheWrittenValueIsNoMixUp) {
    const auto loaded = cases::load_text(
        "format = 1\ndescription = \"d\"\nrules = [\"color.location\"]\n[target]\nsize = [1, 1]\n"
        "color = [{ format = \"rgba16-unorm\" }, { format = \"rgb10a2-unorm\", clear = [0, 0, 0, "
        "1] }]\n"
        "judged = 1\n[[draw]]\nvertices = [[0.5, 0], [0, 4], [8, -2]]\n[[draw.color]]\n"
        "value = [0, 0, 0, 0]\n[[draw.color]]\nattribute = \"c\"\n[[draw.attribute]]\n"
        "name = \"c\"\nvalues = [1, 1, 0]\n",
        "f", "id");
    ASSERT_TRUE(loaded) << to_string(loaded.error().front());
    const cases::Case& c = loaded->front();
    const Expectation expectation = expect(c, Limits{8}, cases::Profile::direct3d);
    ColorReference reference(c, expectation);
    const glm::vec4 written(115.0F / 116, 0, 0, 0);
    const auto rule_of = [&](uint32_t red) {
        ColorWitness witness;
        witness.knows_fragments = true;
        witness.written[0] = &written;
        return reference.judge(0, {0, 0, 0}, {red, 0, 0, 0}, witness).rule;
    };
    EXPECT_EQ(rule_of(1014), "");
    EXPECT_NE(rule_of(1015), "");
    EXPECT_NE(rule_of(1015), "color.location");
    EXPECT_EQ(rule_of(0), "color.location");  // the colour of the other target
}

}  // namespace
}  // namespace ref
