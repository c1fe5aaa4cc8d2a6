// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Cases written as files, and read again.
#include "cases/write/to_toml.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <optional>

#include "cases/load/loader.hpp"
#include "cases/toml/toml_text.hpp"
#include "cases/toml/toml_tree.hpp"
#include "cases/wire/case_bytes.hpp"
#include "folders.hpp"

namespace cases {

namespace {

const std::string kTomlHead = "format = 1\ndescription = \"d\"\nrules = [\"cover.inside\"]\n";

std::optional<Case> load_one(const std::string& toml, const std::string& id) {
    ExpectedAll<std::vector<Case>> loaded = load_text(toml, "f.toml", id);
    if (!loaded) {
        ADD_FAILURE() << id << ": " << to_string(loaded.error().front()) << "\n" << toml;
        return std::nullopt;
    }
    return loaded->size() == 1 ? std::optional(std::move(loaded->front())) : std::nullopt;
}

std::string written(const std::string& toml) {
    const std::optional<Case> c = load_one(toml, "family/name");
    const Expected<std::string> text = c ? to_toml(*c) : Expected<std::string>("");
    EXPECT_TRUE(text) << (text ? "" : to_string(text.error()));
    return text.value_or("");
}

// A value as text, on one line if it is short.
std::string text_of(const TomlValue& value) {
    TomlValue table;
    tree::set(table, "v", value);
    return to_text(table);
}

// The vertices that are written, of a draw with these in a target of 8 x 8 pixels.
std::string vertices_of(const std::string& draw) {
    const std::optional<Case> c =
        load_one(kTomlHead + "[target]\nsize = [8, 8]\n[[draw]]\n" + draw, "family/name");
    const Expected<TomlValue> document = c ? to_tree(*c) : TomlValue();
    const TomlValue* draws = document ? document->find("draw") : nullptr;
    return draws == nullptr ? "" : text_of(*draws->array.front().find("vertices"));
}

// The same of a value as a file has it.
std::string read(const std::string& value) {
    return text_of(*read_toml("v = " + value, "f").value().find("v"));
}

std::vector<std::string> rows_of(const Case& c) {
    return c.claim.expected_hits ? c.claim.expected_hits->rows : std::vector<std::string>();
}

}  // namespace

// Every leaf of the suite that is not too large for a file.
TEST(ToToml, GivesBackEveryLeafOfTheSuite) {
    const Suite suite = load_suite(test_support::source_dir() + "/cases/suite");
    ASSERT_TRUE(suite.errors.empty());
    size_t tried_leaves = 0;
    size_t written_leaves = 0;
    size_t leaves_in_clip = 0;
#ifdef __SANITIZE_ADDRESS__
    constexpr size_t kEvery = 8;  // under the sanitizers each leaf takes ten times as long
#else
    constexpr size_t kEvery = 1;
#endif
    for (size_t k = 0; k < suite.cases.size(); k += kEvery) {
        const Case& c = suite.cases[k];
        ++tried_leaves;
        const Expected<std::string> text = to_toml(c);
        if (!text) {
            const auto is_large = [](const Draw& d) {
                return d.positions.size() > kMaxWrittenVertices ||
                       (d.indices && d.indices->size() > kMaxWrittenIndices);
            };
            EXPECT_TRUE(std::any_of(c.draws.begin(), c.draws.end(), is_large))
                << to_string(text.error());
            continue;
        }
        const std::optional<Case> back = load_one(*text, c.id);
        ASSERT_TRUE(back);
        EXPECT_EQ(to_bytes(*back), to_bytes(c)) << c.id << "\n" << *text;
        EXPECT_EQ(back->claim.description, c.claim.description);
        EXPECT_EQ(back->claim.catches, c.claim.catches);
        EXPECT_EQ(back->claim.rules, c.claim.rules);
        EXPECT_EQ(back->claim.links, c.claim.links);
        EXPECT_EQ(rows_of(*back), rows_of(c)) << c.id;
        const Expected<std::string> again = to_toml(*back);
        ASSERT_TRUE(again);
        EXPECT_EQ(*again, *text);
        ++written_leaves;
        leaves_in_clip += text->find("= \"clip\"") != std::string::npos ? 1U : 0U;
    }
    EXPECT_GT(written_leaves * 100, tried_leaves * 99);
    EXPECT_GT(leaves_in_clip, 0U);
    EXPECT_LT(leaves_in_clip * 10, written_leaves);
}

// A plain case has the keys that it cannot do without; whoever reads it sees what is special.
TEST(ToToml, LeavesDefaultsOut) {
    const std::string plain = R"(format = 1
description = "One \"triangle\"."
rules = ["cover.inside"]

[target]
size = [8, 8]

[[draw]]
vertices = [
    [0, 0],
    [8, 0],
    [0, 7.5]
]
)";
    EXPECT_EQ(written(plain), plain);
    // The same with every default spelt out, but for the format of depth, which is kept where it is
    // named.
    EXPECT_EQ(written(R"(
format = 1
description = "One \"triangle\"."
rules = ["cover.inside"]
links = []
relations = []
[target]
size = [8, 8]
samples = 1
layers = 1
depth_clear = 0.375
resolve = "none"
depth_resolve = "none"
stencil = false
attachments = "all"
[[draw]]
topology = "triangle-list"
space = "pixels"
vertices = [[0,0,0.5,1], [8,0,0.5,1], [0,"15/2",0.5,1]]
viewport = { rect = [0, 0, 8, 8], depth = [0, 1] }
scissor = [0, 0, 8, 8]
depth = { compare = "always", write = true, clamp = false }
viewport_index = 0
layer = 0
cull = "none"
front_face = "counter-clockwise"
sample_mask = 0xffffffff
provoking = "first"
depth_volume = "zero-to-one"
rasterizer_discard = false
discard = "none"
early_tests = false
mirror = "none"
)"),
              plain);
}

// One case with nearly every key, as it is written; loading it gives the same text.
TEST(ToToml, IsWrittenAsPeopleWriteIt) {
    const std::string text = R"toml(format = 1
description = "All of it."
catches = "much"
rules = ["cover.inside", "blend.equation"]
links = ["https://example.org"]
relations = ["same-twice", { scissor-tiles = [4, 4] }]

[target]
size = [8, 4]
samples = 2
depth_clear = 0.25
sample_locations = [[0, 15], [8, 8]]
resolve = "average"
depth_resolve = "min"
stencil = true
stencil_clear = 7

[target.color]
format = "rgba16-float"
clear = [0, 0.1, "2^-20", 1]

[[draw]]
topology = "triangle-strip"
viewport = { rect = [0, 4, 8, -4], depth = [0.25, 1] }
scissor = [1, 0, 7, 4]
cull = "back"
front_face = "clockwise"
provoking = "last"
rasterizer_discard = true
query = "occlusion-precise"
depth = { compare = "less", write = false, bias = { slope = 1.5 }, clip = true, bounds = [0.25, 1] }
depth_volume = "negative-one-to-one"
stencil = { front = { compare = "equal", fail = "zero", depth_fail = "invert", pass = "replace", compare_mask = 127, write_mask = 240, reference = 9 }, back = { pass = "keep" } }
sample_mask = 3
shader_mask = 255
min_sample_shading = 0.5
color = { attribute = "c", blend = "alpha", constants = [0, 0, 0, 1], write_mask = "rb" }
vertices = [
    [0, 0, 0.5, 1],
    [8, 0, 0.25, 2],
    [0, 4, 0.5, 1],
    ["2+2/3", 4, 0.5, 1]
]
indices = [0, 1, 2, "restart", 1, 2, 3]

[[draw.attribute]]
name = "c"
values = [[1, 0], [0.1, 0], [0, 1], [0, "-2^-30"]]

[[draw.attribute]]
interpolation = "noperspective"
constant = 7
probe = "at-offset"
offset = [0.25, -0.5]

[[draw.attribute]]
source = "barycentric"
auxiliary = "centroid"

[[draw]]
space = "clip"
discard = "checker"
discard_by = "demote"
frag_depth = { value = 0.5, other = 0.25, where = "odd-rows" }
color = { value = [1, 1, 1, 1], blend = { destination = "one", alpha = { source = "zero" } } }
vertices = [
    ["nan", 0, 0, 1],
    ["-inf", -0.0, "bits(0x7fc00001)", 0],
    ["2^-149", "0.1f", 16777216, 1],
    [0, 1, 2, 3]
]

[[draw.clip_distance]]
values = [1, -1, 0.33333334, 2]

[[draw.clip_distance]]
constant = -0.0

[[draw.cull_distance]]
constant = 4

[expect]
hits = ["""
??......
........
........
........
""", """
........
........
........
.......?
"""]
)toml";
    EXPECT_EQ(written(text), text);
}

TEST(ToToml, WritesConservativeDraws) {
    const std::string text = R"toml(format      = 1
description = "family/name"
rules       = ["cover.inside"]

[target]
size = [8, 8]

[[draw]]
vertices           = [[0,0], [8,0], [0,8]]
conservative       = "overestimate"
conservative_extra = 0.25
)toml";
    const std::optional<Case> c = load_one(text, "family/name");
    ASSERT_TRUE(c);
    EXPECT_EQ(c->draws[0].conservative, Conservative::overestimate);
    const Expected<std::string> once = to_toml(*c);
    ASSERT_TRUE(once);
    EXPECT_NE(once->find("conservative = \"overestimate\"\nconservative_extra = 0.25\n"),
              std::string::npos);
    const std::optional<Case> back = load_one(*once, "family/name");
    ASSERT_TRUE(back);
    EXPECT_EQ(to_bytes(*back), to_bytes(*c));
}

TEST(ToToml, KeepsFragmentSizes) {
    const std::string text = R"toml(format      = 1
description = "A case."
rules       = ["fragment-size.rate"]

[target]
size = [8, 8]

[[draw]]
vertices      = [[0,0], [8,0], [0,8]]
fragment_size = [4, 2]

[[draw.attribute]]
source = "shading-rate"
)toml";
    const std::optional<Case> c = load_one(text, "family/name");
    ASSERT_TRUE(c);
    EXPECT_EQ(c->draws[0].fragment_size, (std::array<uint32_t, 2>{4, 2}));
    const Expected<std::string> once = to_toml(*c);
    ASSERT_TRUE(once);
    EXPECT_NE(once->find("fragment_size = [4, 2]\n"), std::string::npos) << *once;
    EXPECT_NE(once->find("source = \"shading-rate\"\n"), std::string::npos) << *once;
    const std::optional<Case> back = load_one(*once, "family/name");
    ASSERT_TRUE(back);
    EXPECT_EQ(to_bytes(*back), to_bytes(*c));
}

// One row a way to write a number: what is given, and the vertices that come of it.
TEST(ToToml, WritesNumbersShortest) {
    struct NumberRow {
        const char* given;
        const char* written;
    };
    const NumberRow rows[] = {
        // Pixels: a grid of a power of two, then decimals, then fractions.
        {R"([[0,0], [8,0], ["3+1/65536",5]])", R"([[0,0], [8,0], ["3+1/65536",5]])"},
        {R"([[0,0], [8,0], ["-1-1/256",5]])", R"([[0,0], [8,0], ["-1-1/256",5]])"},
        {R"([[0,0], [8,0], [0.1,"-8/3"]])", R"([[0,0], [8,0], [0.1,"-2-2/3"]])"},
        {R"([[0,0], [8,0], ["5/7","1/1000"]])", R"([[0,0], [8,0], ["5/7",0.001]])"},
        // z and w: as short as the longest vertex allows.
        {R"([[0,0], [8,0], [0,8,0.5,1]])", "[[0,0], [8,0], [0,8]]"},
        {R"([[0,0], [8,0], [0,8,-0.0]])", "[[0,0,0.5], [8,0,0.5], [0,8,-0.0]]"},
        {R"([[0,0], [8,0], [0,8,"1/3",-3]])", R"([[0,0,0.5,1], [8,0,0.5,1], [0,8,"1/3",-3]])"},
        {R"([[0,0], [8,0], [4,4,0,"1/3"]])", "[[0,0,0.5,1], [8,0,0.5,1], [4,4,0,0.33333334]]"},
    };
    for (const NumberRow& row : rows) {
        EXPECT_EQ(vertices_of(std::string("vertices = ") + row.given), read(row.written));
    }
    const std::string clip = "space = \"clip\"\nvertices = ";
    // Clip space where no pixel says it: -0 with a positive w; far away; a tiny offset from the
    // centre, which is pixel 4.
    for (const char* same :
         {"[[-0.0,0,0,1], [1,0,0,1], [0,1,0,1]]", "[[10000000000,0,0,1], [1,0,0,1], [0,1,0,1]]",
          R"([["2^-100",0,0,1], [1,0,0,1], [0,1,0,1]])", "[[0,0,0,0], [1,0,0,1], [0,1,0,1]]"}) {
        EXPECT_EQ(vertices_of(clip + same), read(same));
    }
    // And pixels where one does.
    EXPECT_EQ(vertices_of(clip + "[[-1,-1,0,1], [1,0,0,1], [\"0x1.555556p-2\",1,0,1]]"),
              read(R"([[0,0,0], [8,4,0], ["5+1/3",8,0]])"));
    EXPECT_EQ(vertices_of("viewport = [1, 2, 0.5, -3]\n" + clip +
                          "[[-1,-1,0.5,1], [1,0,0.5,1], [0,1,0.5,1]]"),
              read("[[1,2], [1.5,0.5], [1.25,-1]]"));
}

// No bits are lost, whatever they are: all exponents and the ends of each.
TEST(ToToml, KeepsEveryBit) {
    std::optional<Case> c = load_one(kTomlHead +
                                         "[target]\nsize = [8, 8]\n[[draw]]\nspace = \"clip\"\n"
                                         "vertices = [[0,0,0,1],[1,0,0,1],[0,1,0,1]]\n"
                                         "[[draw.attribute]]\nconstant = 1\n",
                                     "family/name");
    ASSERT_TRUE(c);
    std::vector<glm::vec4>& positions = c->draws[0].positions;
    std::vector<glm::vec4>& values = c->draws[0].attributes[0].values;
    for (uint32_t exponent = 0; exponent < 256; ++exponent) {
        for (const uint32_t mantissa : {0x0U, 0x1U, 0x2aaaabU, 0x555555U, 0x7fffffU}) {
            const uint32_t bits = exponent << 23U | mantissa;
            const auto value = std::bit_cast<float>(bits);
            positions.emplace_back(value, -value, std::bit_cast<float>(bits ^ 1U), value);
            // Attributes end at 2^126, or are not finite.
            const bool is_large = exponent >= 126 + 127 && exponent < 255;
            values.emplace_back(is_large ? 1.0F : -value, 0, 0, 0);
        }
    }
    const Expected<std::string> text = to_toml(*c);
    ASSERT_TRUE(text) << to_string(text.error());
    const std::optional<Case> back = load_one(*text, c->id);
    ASSERT_TRUE(back);
    EXPECT_EQ(to_bytes(*back), to_bytes(*c));
}

TEST(ToToml, SaysWhatCannotBeWritten) {
    const std::optional<Case> plain =
        load_one(kTomlHead + "[target]\nsize = [8, 8]\n[[draw]]\nvertices = [[0,0],[8,0],[0,8]]\n",
                 "family/name");
    ASSERT_TRUE(plain);
    const auto error_of = [](const Case& c) {
        const Expected<std::string> text = to_toml(c);
        return text ? *text : to_string(text.error());
    };
    Case c = *plain;
    c.draws[0].positions.resize(kMaxWrittenVertices + 1, {0, 0, 0, 1});
    EXPECT_EQ(error_of(c),
              "error: family/name has 4097 vertices and 0 indices; a case file is written of at "
              "most 4096 and 24576");
    c.draws[0].positions.pop_back();
    EXPECT_TRUE(to_toml(c));
    c = *plain;
    c.draws[0].indices = std::vector<uint32_t>(kMaxWrittenIndices + 1, 0);
    EXPECT_EQ(error_of(c),
              "error: family/name has 3 vertices and 24577 indices; a case file is written of at "
              "most 4096 and 24576");
    c = *plain;
    c.draws[0].color.write_mask = 1;  // of no colour target
    EXPECT_EQ(error_of(c),
              "error: family/name cannot be written as a case file: it holds what no key of a case "
              "file says");
    c = *plain;
    c.variation.other_clears = true;
    EXPECT_EQ(error_of(c),
              "error: family/name cannot be written as a case file: it holds what no key of a case "
              "file says");
    c = *plain;
    c.claim.rules.clear();
    EXPECT_EQ(error_of(c),
              "error: family/name cannot be written as a case file: rules is empty, so "
              "the case claims nothing; name at least one rule of docs/rules.md");
}

}  // namespace cases
