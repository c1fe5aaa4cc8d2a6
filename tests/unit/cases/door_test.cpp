// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The table of doors: who can take which, what is read of it, and what comes of it.
#include "cases/model/door.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "cases/base/float_bits.hpp"
#include "cases/load/loader.hpp"
#include "cases/model/derive.hpp"
#include "cases/model/rule.hpp"
#include "cases/wire/case_bytes.hpp"
#include "cases/write/to_toml.hpp"

namespace cases {
namespace {

std::string door_file(const std::string& doors, const std::string& draw) {
    return "format = 1\ndescription = \"d\"\nrules = [\"door.index\"]\n" +
           (doors.empty() ? "" : "relations = [{ doors = " + doors + " }]\n") +
           "[target]\nsize = [8, 4]\n[[draw]]\n" + draw;
}
const std::string kDoorTriangle = "vertices = [[0,0],[8,0],[0,4]]\n";
const std::string kStrip =
    "topology = \"triangle-strip\"\nvertices = [[0,0],[8,0],[0,4],[8,4]]\n"
    "indices = [0, 1, 2, \"restart\", 1, 2, 3]\n";

std::string door_error(const std::string& text) {
    const ExpectedAll<std::vector<Case>> loaded = load_text(text, "f", "id");
    return loaded ? "no error" : to_string(loaded.error().front());
}

Case case_of(const std::string& text) {
    return load_text(text, "f", "id").value().front();
}

std::set<std::string_view> takes(const Case& c) {
    std::set<std::string_view> words;
    for (const DoorRow& row : all_doors()) {
        if (can_take(row.door, c)) {
            words.insert(row.word);
        }
    }
    return words;
}

}  // namespace

TEST(Door, EveryRowHasAWordASentenceAndARule) {
    std::set<std::string_view> words;
    for (const DoorRow& row : all_doors()) {
        EXPECT_TRUE(words.insert(row.word).second) << row.word;
        EXPECT_EQ(find_door(row.word), row.door);
        EXPECT_EQ(&row_of(row.door), &row);
        EXPECT_TRUE(row.does.ends_with('.')) << row.word;
        EXPECT_FALSE(row.takes.empty()) << row.word;
        ASSERT_NE(find_rule(row.rule), nullptr) << row.word;
        EXPECT_TRUE(row.rule.starts_with("door."));
        EXPECT_EQ(find_rule(row.rule)->profile, Profile::vulkan);
    }
    EXPECT_EQ(words.size() + 1, kDoors);
    EXPECT_EQ(find_door("none"), std::nullopt);
}

TEST(Door, ATriangleTakesAllButWhatNeedsMore) {
    const std::set<std::string_view> taken = takes(case_of(door_file("", kDoorTriangle)));
    for (const DoorRow& row : all_doors()) {
        const bool needs_more =
            row.door == Door::restart_extra || row.door == Door::instance_rate ||
            row.door == Door::instance_divisor || row.door == Door::instance_divisor_zero ||
            row.door == Door::secondary_each || row.door == Door::query_first;
        EXPECT_EQ(taken.contains(row.word), !needs_more) << row.word;
    }
}

// What a fragment shader writes is stored with the bits of a clear where neither is rounded.
TEST(Door, OnlyExactClearsAreDrawn) {
    Case c = case_of(door_file("", kDoorTriangle));
    const auto takes_clear = [&c](ColorFormat format, const glm::vec4& clear) {
        c.target.color.emplace();
        c.target.color->format = format;
        c.target.color->clear = clear;
        return can_take(Door::clear_draw, c);
    };
    EXPECT_TRUE(takes_clear(ColorFormat::rgba8_unorm, {0, 1, 1, 0}));
    EXPECT_FALSE(takes_clear(ColorFormat::rgba8_unorm, {0, 1, 0.5F, 0}));
    EXPECT_FALSE(takes_clear(ColorFormat::rgba8_srgb, {0.25F, 1, 0, 0}));
    EXPECT_TRUE(takes_clear(ColorFormat::r5g6b5_unorm, {0, 1, 0, 0.5F}));  // no alpha
    EXPECT_TRUE(takes_clear(ColorFormat::rgba16_float, {0.5F, -2, 1024, 0}));
    EXPECT_FALSE(takes_clear(ColorFormat::rgba16_float, {0.3F, 0, 0, 0}));
    EXPECT_TRUE(takes_clear(ColorFormat::rgba32_float, {0.3F, -0.0F, 0, 0}));
    EXPECT_FALSE(takes_clear(ColorFormat::rgba32_float, {0x1p-140F, 0, 0, 0}));
    EXPECT_FALSE(
        takes_clear(ColorFormat::rgba32_float, glm::vec4(std::numeric_limits<float>::quiet_NaN())));
    EXPECT_TRUE(takes_clear(ColorFormat::rgba8_uint, {7, 255, 0, 1}));
    c.target.depth_format = DepthFormat::d16_unorm;
    c.target.depth_clear = 0.5F;
    EXPECT_FALSE(can_take(Door::clear_draw, c));
    c.target.depth_clear = 1;
    EXPECT_TRUE(can_take(Door::clear_draw, c));
    c.target.layers = 2;
    EXPECT_FALSE(can_take(Door::clear_draw, c));
    EXPECT_FALSE(can_take(Door::image_linear, c));
}

TEST(Door, NoDynamicStateAsksForSamplesToBeShaded) {
    Case c = case_of(door_file("", kDoorTriangle));
    EXPECT_TRUE(can_take(Door::shader_objects, c));
    c.draws.front().multisample.min_sample_shading = 0.5F;
    EXPECT_FALSE(can_take(Door::shader_objects, c));
}

TEST(Door, WhatIsWrittenByFeedbackKeepsItsNumbers) {
    Case c = case_of(door_file("", kDoorTriangle));
    EXPECT_TRUE(can_take(Door::transform_feedback, c));
    c.draws.front().indices = {{0, 1, 2}};
    EXPECT_FALSE(can_take(Door::transform_feedback, c));
    EXPECT_FALSE(can_take(Door::transform_feedback, case_of(door_file("", kStrip))));
}

// A device may drop a triangle with two vertices in one place before they are written.
TEST(Door, WhatIsWrittenByFeedbackHasItsCornersApart) {
    const std::string second = "vertices = [[0,0],[8,0],[0,4],[1,1],";
    EXPECT_TRUE(
        can_take(Door::transform_feedback, case_of(door_file("", second + "[2,1],[1,2]]"))));
    EXPECT_FALSE(
        can_take(Door::transform_feedback, case_of(door_file("", second + "[2,1],[1,1]]"))));
    EXPECT_FALSE(
        can_take(Door::transform_feedback, case_of(door_file("", second + "[2,1],[2,1]]"))));
}

// The module that pulls vertices is built with distances of one kind.
TEST(Door, PulledVerticesHaveOneKindOfDistances) {
    Case c = case_of(door_file("", kDoorTriangle));
    c.draws.front().distances.clip_count = 1;
    EXPECT_TRUE(can_take(Door::vertices_pulled, c));
    c.draws.front().distances.cull_count = 1;
    EXPECT_FALSE(can_take(Door::vertices_pulled, c));
}

TEST(Door, OnlyNumbersOfBinary16GoThroughHalves) {
    using Positions = std::vector<glm::vec4>;
    EXPECT_TRUE(are_half_floats(Positions{{-0.0F, 0.5F, -65504.0F, 0x1p-14F}, {1, 2, 3, 4}}));
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    // Between two of them, too large, denormal there, no number.
    for (const float x : {2049.0F, 1 / 3.0F, 65520.0F, 0x1p-15F, kInfinity, -kInfinity,
                          std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_FALSE(are_half_floats(Positions{{1, 2, 3, 4}, {0, 0, 0, x}})) << x;
    }
    EXPECT_FALSE(are_half_floats(Positions{}));
    EXPECT_EQ(half_bits(-0.0F), 0x8000);
    EXPECT_EQ(half_bits(1.0F), 0x3c00);
}

// Half of 19 is 9.5, and 2 x / 19 - 1 no number of binary32: its window coordinate is rounded, and
// another number further to the right.
TEST(Door, OnlyWhatIsExactInTheWindowIsMoved) {
    Case c = case_of(door_file("", kDoorTriangle));
    EXPECT_TRUE(can_take(Door::target_last_tile, c));
    const auto takes_with = [&c](auto change) {
        Case other = c;
        change(other.draws.front());
        return can_take(Door::target_last_tile, other);
    };
    EXPECT_FALSE(takes_with([](Draw& d) { d.positions[0] = {1 / 3.0F, 0, 0, 1}; }));
    EXPECT_TRUE(takes_with([](Draw& d) { d.positions[0] = {1 / 16.0F, 0, 0, 1}; }));
    EXPECT_FALSE(takes_with([](Draw& d) { d.positions[0] = {0x1p-20F, 0, 0, 1}; }));
    EXPECT_FALSE(takes_with([](Draw& d) { d.positions[0] = {1.5F, 0, 0, 1}; }));
    EXPECT_FALSE(takes_with([](Draw& d) { d.positions[0] = {0, 0, 1.5F, 1}; }));
    EXPECT_FALSE(takes_with([](Draw& d) { d.positions[0] = {0, 0, 0, 2}; }));
    EXPECT_FALSE(takes_with([](Draw& d) { d.distances.clip_count = 1; }));
    // Within two pixels of the target's corner the budgets are too small for the other place.
    EXPECT_FALSE(takes_with([](Draw& d) {
        d.viewport.width = 1;
        d.viewport.height = 16;
    }));
    EXPECT_FALSE(takes_with([](Draw& d) {
        d.viewport.width = 16;
        d.viewport.height = 1;
    }));
    EXPECT_EQ(kMovedColumns % 2, 0U);
    EXPECT_EQ(kMovedRows % 2, 0U);
}

TEST(Door, WhatAShaderMayLoseIsNotReadAsInput) {
    Case c = case_of(door_file("", kDoorTriangle));
    EXPECT_TRUE(can_take(Door::input_attachment, c));
    Attribute a;
    a.values.assign(3, glm::vec4(1, -2, 0, 0.5F));
    c.draws.front().attributes = {a};
    EXPECT_TRUE(can_take(Door::input_attachment, c));
    for (const float lost : {0x1p-130F, 0x1p-31F, std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::quiet_NaN()}) {
        c.draws.front().attributes[0].values[1].w = lost;
        EXPECT_FALSE(can_take(Door::input_attachment, c)) << lost;
    }
    c.draws.front().attributes.clear();
    const auto takes_with = [&c](auto change) {
        Case other = c;
        change(other.draws.front());
        return can_take(Door::input_attachment, other);
    };
    EXPECT_FALSE(takes_with([](Draw& d) { d.positions[1].z = 0x1p-40F; }));
    EXPECT_FALSE(takes_with([](Draw& d) { d.positions[1].w = 0x1p40F; }));
    EXPECT_FALSE(takes_with([](Draw& d) { d.viewport.max_depth = 0x1p-40F; }));
    EXPECT_FALSE(takes_with([](Draw& d) { d.depth.bias.emplace(); }));
    EXPECT_FALSE(takes_with([](Draw& d) { d.frag_depth = FragDepth{false, 0x1p-40F}; }));
    c.target.layers = 2;
    EXPECT_FALSE(can_take(Door::input_attachment, c));
}

TEST(Door, OnlyACaseWithAQueryBeginsOneFirst) {
    Case c = case_of(door_file("", kDoorTriangle));
    EXPECT_FALSE(can_take(Door::query_first, c));
    c.draws.front().query = Query::occlusion;
    EXPECT_TRUE(can_take(Door::query_first, c));
}

TEST(Door, AMeshHasAGroupForEachTriangle) {
    Case c = case_of(door_file("", kDoorTriangle));
    c.draws.front().positions.resize(size_t{3} * 65535);
    EXPECT_TRUE(can_take(Door::mesh_shader, c));
    c.draws.front().positions.resize(size_t{3} * 65536);
    EXPECT_FALSE(can_take(Door::mesh_shader, c));
}

TEST(Door, WhatRestartsTakesNoLargestIndex) {
    const std::set<std::string_view> taken = takes(case_of(door_file("", kStrip)));
    EXPECT_TRUE(taken.contains("index-8"));
    EXPECT_TRUE(taken.contains("restart-extra"));
    EXPECT_FALSE(taken.contains("index-8-largest"));
    EXPECT_FALSE(taken.contains("index-16-largest"));
    EXPECT_FALSE(taken.contains("first-vertex"));
}

TEST(Door, IndicesHaveToFit) {
    Case c = case_of(door_file("", kDoorTriangle));
    const auto with_vertices = [&c](size_t count) {
        c.draws.front().positions.resize(count, c.draws.front().positions.front());
        return takes(c);
    };
    EXPECT_TRUE(with_vertices(256).contains("index-8"));
    EXPECT_TRUE(with_vertices(256).contains("index-8-largest"));
    EXPECT_FALSE(with_vertices(257).contains("index-8"));
    EXPECT_TRUE(with_vertices(65536).contains("index-16-largest"));
    EXPECT_FALSE(with_vertices(65537).contains("index-16"));
    EXPECT_TRUE(with_vertices(65537).contains("index-32"));
    // With restart the largest value is no index.
    Case strip = case_of(door_file("", kStrip));
    strip.draws.front().positions.resize(256, glm::vec4(0, 0, 0, 1));
    strip.draws.front().indices = {{0, 1, 255}};
    EXPECT_FALSE(takes(strip).contains("index-8"));
    strip.draws.front().indices = {{0, 1, 254}};
    EXPECT_TRUE(takes(strip).contains("index-8"));
    EXPECT_EQ(largest_index(strip.draws.front()), 254U);
}

TEST(Door, ABlitTakesNone) {
    Case c;
    c.blit.emplace();
    EXPECT_TRUE(takes(c).empty());
}

TEST(Door, ListsAreSplitInTheMiddle) {
    Case c = case_of(door_file("", kDoorTriangle));
    Draw& draw = c.draws.front();
    EXPECT_EQ(split_of(Door::multi_draw, draw), 0U);
    draw.positions.resize(15, draw.positions.front());
    EXPECT_EQ(split_of(Door::multi_draw, draw), 2U);
    EXPECT_EQ(split_of(Door::multi_indirect, draw), 2U);
    EXPECT_EQ(split_of(Door::multi_draw_empty, draw), 0U);
    EXPECT_EQ(split_of(Door::index_16, draw), 0U);
    draw.topology = Topology::triangle_fan;
    EXPECT_EQ(split_of(Door::multi_draw, draw), 0U);
}

TEST(Door, RelationsAreReadWrittenAndDerived) {
    const Case c = case_of(door_file(R"(["index-16", "vertex-offset"])", kDoorTriangle));
    ASSERT_EQ(c.relations.size(), 2U);
    EXPECT_EQ(c.relations[1], (Relation{RelationKind::door, {}, Door::vertex_offset}));
    const std::vector<Derivation> derived = derivations(c);
    ASSERT_EQ(derived.size(), 2U);
    EXPECT_EQ(derived[0].name, "door index-16");
    EXPECT_EQ(derived[0].rule, "door.index");
    EXPECT_EQ(derived[1].variation.door, Door::vertex_offset);
    EXPECT_EQ(derive(c, derived[1]).variation.door, Door::vertex_offset);
    EXPECT_TRUE(derive(c, derived[1]).relations.empty());
    const Case again = case_of(to_toml(c).value());
    EXPECT_EQ(again.relations, c.relations);
}

TEST(Door, ARunAddsDoorsOnce) {
    Case c = case_of(door_file(R"(["index-16"])", kDoorTriangle));
    c.doors = {Door::index_16, Door::index_32};
    ASSERT_EQ(derivations(c).size(), 2U);
    EXPECT_EQ(derivations(c)[1].name, "door index-32");
    EXPECT_EQ(from_bytes(to_bytes(c))->doors, c.doors);
    EXPECT_TRUE(derive(c, derivations(c)[0]).doors.empty());
    c.doors = {Door::none};
    EXPECT_FALSE(from_bytes(to_bytes(c)));
}

TEST(Door, EverySentence) {
    EXPECT_EQ(door_error(door_file(R"(["index-17"])", kDoorTriangle)),
              "f:4:25: error: a door is \"index-17\"; did you mean \"index-16\"?");
    EXPECT_EQ(door_error(door_file(R"(["index-16", "index-16"])", kDoorTriangle)),
              "f:4:14: error: the door index-16 stands twice");
    EXPECT_EQ(door_error(door_file(R"(["restart-extra"])", kDoorTriangle)),
              "f:4:14: error: the door restart-extra does not suit the case: it takes a strip or a "
              "fan; leave it out");
    EXPECT_EQ(door_error(door_file("[]", kDoorTriangle)),
              "f:4:24: error: doors is empty; write one at least, as \"index-16\"");
}

}  // namespace cases
