// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/change/changed_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "cases/base/checksum.hpp"
#include "fuzz/cause.hpp"
#include "fuzz/entry.hpp"

namespace fuzz {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// Cases of three families, which stay as they are: what a seed means rests on them.
Starts starts() {
    static const std::string kTriangle = R"(format = 1
description = "d"
catches = "c"
links = ["https://example.org"]
rules = ["cover.inside"]
[matrix]
rotation = [0, 90]
[target]
size = [8, 8]
[[draw]]
rotate = "rotation"
vertices = [[0, 0], [8, 0], [0, 8]]
[expect."rotation=0"]
hits = """
????????
????????
????????
????????
????????
????????
????????
????????
"""
)";
    static const std::string kColor = R"(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [16, 8]
samples = 4
[target.color]
format = "rgba8-unorm"
[[draw]]
color = { attribute = "c", blend = "additive" }
depth = { compare = "less", bias = { constant = 2 } }
indices = [0, 1, 2, 2, 1, 3]
vertices = [[0, 0, 0.25], [16, 0, 0.5], [0, 8, 0.5], [16, 8, 0.75]]
[[draw.attribute]]
name = "c"
values = [[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [1, 1, 1, 1]]
[[draw]]
topology = "triangle-strip"
scissor = [1, 1, 9, 5]
color = { value = [1, 0.5, 0, 0.25] }
vertices = [[2, 2], [9, 2], [2, 7], [9, 7]]
)";
    static const std::string kClip = R"(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [8, 8]
[[draw]]
space = "clip"
vertices = [[-1, -1, 0.5, 1], [2, -2, 1, 2], [-0.5, 0.5, 0.25, 0.5]]
[[draw.clip_distance]]
values = [1, -1, 1]
[[draw.attribute]]
values = [1, 0.5, 0]
)";
    std::vector<Start> all;
    for (const auto& [name, toml] :
         {std::pair("a", kTriangle), std::pair("b", kColor), std::pair("c", kClip)}) {
        auto loaded = cases::load_text(toml, name, name);
        EXPECT_TRUE(loaded) << cases::to_string(loaded.error().front());
        for (cases::Case& c : *loaded) {
            all.push_back({std::move(c), {}});
        }
    }
    return std::make_shared<const std::vector<Start>>(std::move(all));
}

std::vector<Source::Made> all_of(Source& source, uint64_t groups) {
    std::vector<Source::Made> all;
    for (uint64_t number = 0; number < groups * source.group_size(); ++number) {
        if (number % source.group_size() == 0) {
            source.enter(number / source.group_size());
        }
        all.push_back(source.make(number));
    }
    return all;
}

std::shared_ptr<const std::vector<Start>> start_of(const std::string& toml) {
    auto loaded = cases::load_text(toml, "f", "f");
    EXPECT_TRUE(loaded) << cases::to_string(loaded.error().front());
    return std::make_shared<const std::vector<Start>>(std::vector<Start>{{loaded->front(), {}}});
}

TEST(ChangedSource, MakesTheSameCasesOnEveryMachine) {
    // A change of this number changes what every seed means: say so in the changelog.
    ChangedSource source(1, starts());
    uint64_t hash = 0;
    for (const Source::Made& made : all_of(source, 64)) {
        hash = cases::stable_hash(made.text, hash);
    }
    EXPECT_EQ(cases::hex(hash), "d67a7c9a5091f857");
    ChangedSource other(2, starts());
    uint64_t hash_of_other = 0;
    for (const Source::Made& made : all_of(other, 64)) {
        hash_of_other = cases::stable_hash(made.text, hash_of_other);
    }
    EXPECT_NE(hash, hash_of_other);
}

// A case does not depend on which numbers were made before: shards and --print.
TEST(ChangedSource, ANumberAloneMakesTheCase) {
    ChangedSource all(1, starts()), one(1, starts());
    const std::vector<Source::Made> made = all_of(all, 24);
    for (const uint64_t number : {3U, 40U, 41U, 250U, 383U}) {
        one.enter(number / one.group_size());
        EXPECT_EQ(one.make(number).text, made[number].text) << number;
    }
}

TEST(ChangedSource, CasesAreCasesThatSayWhatWasChanged) {
    ChangedSource source(1, starts());
    std::map<std::string, size_t> from;
    std::set<std::string> texts;
    size_t made = 0, refused = 0, missing = 0;
    for (const Source::Made& one : all_of(source, 100)) {
        refused += one.refused;
        if (one.text.empty()) {
            ++missing;
            EXPECT_FALSE(one.data);
            continue;
        }
        ++made;
        ASSERT_TRUE(one.data);
        EXPECT_TRUE(load_one(one.text, "again")) << one.text;
        const std::string& description = one.data->claim.description;
        EXPECT_THAT(description, StartsWith("Made by edgecase fuzz of "));
        EXPECT_THAT(description, HasSubstr(": ")) << description;
        EXPECT_FALSE(one.data->claim.expected_hits) << one.text;
        EXPECT_TRUE(one.data->claim.links.empty());
        ++from[description.substr(25, description.find(": ") - 25)];
        texts.insert(one.text);
    }
    // All starts take turns; hardly any number finds no case, and hardly a case is made twice.
    EXPECT_EQ(from.size(), 4U);
    for (const auto& [id, count] : from) {
        EXPECT_GT(count, 300U) << id;
    }
    EXPECT_LT(missing, 16U);
    EXPECT_GT(refused, 0U);
    EXPECT_LT(refused, made);
    EXPECT_GT(texts.size(), made * 9 / 10);
}

// What a hunt of these three starts reaches: most of what the format can say of a case.
TEST(ChangedSource, ChangesReachStatesAndGeometries) {
    ChangedSource source(3, starts());
    std::set<std::string> words;
    constexpr uint64_t kGroups = 8000;
    for (uint64_t group = 0; group < kGroups; ++group) {
        source.enter(group);
        // The first of a group has its state alone, and a few others have geometries.
        for (uint64_t k = 0; k < (group % 32 == 0 ? 8U : 1U); ++k) {
            const std::set<std::string> more =
                to_texts(facts_of(source.make(group * source.group_size() + k).text).essentials);
            words.insert(more.begin(), more.end());
        }
    }
    for (const char* word : {"several samples",
                             "layers",
                             "stencil=true",
                             "attachments=color",
                             "resolve=average",
                             "depth_clear",
                             "color",
                             "several draws",
                             "unequal w",
                             "sloping depth",
                             "draw.cull=back",
                             "draw.front_face=clockwise",
                             "draw.topology=triangle-fan",
                             "draw.provoking=last",
                             "draw.depth_volume=negative-one-to-one",
                             "draw.depth.compare",
                             "draw.depth.write=false",
                             "draw.depth.clamp=true",
                             "draw.depth.clip=false",
                             "draw.depth.bias.slope",
                             "draw.depth.bias.clamp",
                             "draw.depth.bounds",
                             "draw.frag_depth.value",
                             "draw.frag_depth.where=checker",
                             "draw.frag_depth.from=frag-coord",
                             "draw.query=occlusion",
                             "draw.query=occlusion-precise",
                             "draw.color.logic=xor",
                             "draw.discard=checker",
                             "draw.early_tests=true",
                             "draw.sample_mask",
                             "draw.shader_mask",
                             "draw.layer",
                             "draw.viewport_index",
                             "draw.min_sample_shading",
                             "draw.viewport",
                             "draw.scissor",
                             "draw.indices",
                             "draw.attribute",
                             "draw.attribute.interpolation=flat",
                             "draw.attribute.auxiliary=centroid",
                             "draw.attribute.source",
                             "draw.clip_distance",
                             "draw.cull_distance",
                             "draw.color.blend",
                             "draw.color.write_mask",
                             "relation same-twice",
                             "relation scissor-tiles"}) {
        EXPECT_TRUE(words.contains(word)) << word;
    }
    // Of fourteen probes some.
    const auto probe = words.lower_bound("draw.attribute.probe=");
    EXPECT_TRUE(probe != words.end() && probe->starts_with("draw.attribute.probe="));
}

// What says what becomes of fragments is added, changed and left out.
TEST(ChangedSource, ChangesWhatBecomesOfFragments) {
    const std::string toml = R"(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [8, 8]
attachments = "color+depth"
depth_clear = 0.625
[target.color]
format = "rgba8-unorm"
[[draw]]
depth = { bounds = [0.25, 0.625] }
frag_depth = { value = 0.25 }
color = { value = [1, 1, 1, 1], logic = "xor" }
vertices = [[0, 0, 0.125], [8, 0, 0.125], [0, 8, 0.125]]
)";
    ChangedSource source(1, start_of(toml));
    std::set<std::string> seen;
    const auto see = [&](bool what, const char* words) {
        if (what) {
            seen.insert(words);
        }
    };
    for (uint64_t group = 0; group < 4000; ++group) {
        source.enter(group);
        const Source::Made made = source.make(group * source.group_size());
        if (!made.data || made.data->draws.size() != 1) {
            continue;
        }
        const cases::Draw& draw = made.data->draws[0];
        const auto& bounds = draw.depth.bounds;
        see(!bounds, "no bounds");
        see(bounds && bounds->max < 0.625F && bounds->max > 0.6249F,
            "just without the clear value");
        see(bounds && bounds->min <= bounds->max && bounds->max <= bounds->min, "one depth");
        see(!draw.frag_depth, "no depth written");
        see(draw.frag_depth && draw.frag_depth->is_coord, "its own depth written");
        see(draw.frag_depth && draw.frag_depth->where == cases::Discard::odd_rows, "two depths");
        see(draw.frag_depth && draw.frag_depth->value > 0.62F && draw.frag_depth->value < 0.63F,
            "near the clear value");
        see(draw.frag_depth && draw.frag_depth->layout != cases::DepthLayout::any, "a promise");
        see(!draw.color.logic, "no logical operation");
        see(draw.color.logic == cases::LogicOp::nand, "another operation");
        see(draw.query != cases::Query::none, "a query");
        see(draw.query != cases::Query::none && !made.data->target.has_instruments, "not counted");
    }
    EXPECT_THAT(seen,
                testing::UnorderedElementsAre(
                    "no bounds", "just without the clear value", "one depth", "no depth written",
                    "its own depth written", "two depths", "near the clear value", "a promise",
                    "no logical operation", "another operation", "a query"));
}

TEST(ChangedSource, ChangesWhatAlphaDoesAndTheSizeOfFragments) {
    const std::string toml = R"(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [8, 8]
[target.color]
format = "rgba8-unorm"
[[draw]]
query = "occlusion"
color = { value = [1, 1, 1, 0.5] }
vertices = [[0, 0], [8, 0], [0, 8]]
)";
    ChangedSource source(1, start_of(toml));
    std::set<std::string> seen;
    for (const Source::Made& made : all_of(source, 400)) {
        for (const cases::Draw& draw : made.data ? made.data->draws : std::vector<cases::Draw>()) {
            for (const auto& [what, words] :
                 {std::pair(draw.color.alpha_to_one, "to one"),
                  std::pair(draw.color.alpha_to_coverage, "to coverage"),
                  std::pair(draw.fragment_size[0] > draw.fragment_size[1], "wide fragments")}) {
                if (what) {
                    seen.insert(words);
                }
            }
        }
    }
    EXPECT_THAT(seen, testing::UnorderedElementsAre("to one", "to coverage", "wide fragments"));
}

TEST(ChangedSource, ChangesWhatAStencilDoes) {
    const std::string toml = R"(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [8, 8]
stencil = true
[[draw]]
vertices = [[0, 0], [8, 0], [0, 8]]
[[draw]]
stencil = { compare = "equal", pass = "replace", reference = 3 }
vertices = [[0, 0], [8, 0], [0, 8]]
)";
    ChangedSource source(1, start_of(toml));
    std::set<std::string> seen;
    const auto see = [&](bool what, const char* words) {
        if (what) {
            seen.insert(words);
        }
    };
    for (uint64_t group = 0; group < 8000; ++group) {
        source.enter(group);
        const Source::Made made = source.make(group * source.group_size());
        if (!made.data || made.data->draws.size() != 2) {
            continue;
        }
        const cases::StencilState& state = made.data->draws[1].stencil;
        const cases::StencilState usual;
        see(made.data->draws[0].stencil != usual, "one more");
        see(state == usual, "none");
        see(state != usual && state.front != state.back, "faces differ");
        see(state.front.compare == cases::CompareOp::greater, "another comparison");
        see(state.front.fail == cases::StencilOp::zero, "another operation");
        see(state.back.write_mask == 254, "a mask");
        see(state.back.reference == 255, "another reference");
        see(made.data->target.stencil_clear == 255, "another clear value");
    }
    EXPECT_THAT(seen,
                testing::UnorderedElementsAre("one more", "none", "faces differ",
                                              "another comparison", "another operation", "a mask",
                                              "another reference", "another clear value"));
}

TEST(ChangedSource, ChangesABlit) {
    const std::string toml = R"(format = 1
description = "d"
rules = ["blit.nearest"]
[target]
size = [8, 8]
color = { format = "rgba8-unorm" }
[blit]
size = [4, 4]
from = [0, 0, 3, 4]
to = [1, 1, 7, 5]
)";
    ChangedSource source(1, start_of(toml));
    std::set<std::string> seen;
    const auto see = [&](bool what, const char* words) {
        if (what) {
            seen.insert(words);
        }
    };
    for (uint64_t group = 0; group < 400; ++group) {
        source.enter(group);
        const Source::Made made = source.make(group * source.group_size());
        if (!made.data) {
            continue;
        }
        ASSERT_TRUE(made.data->blit);
        const cases::Blit& blit = *made.data->blit;
        see(blit.filter == cases::BlitFilter::linear, "filtered");
        see(blit.pattern == cases::BlitPattern::ramp, "another pattern");
        see(blit.source_format != made.data->target.color->format, "converted");
        see(blit.source.x1 < blit.source.x0, "mirrored");
        see(blit.destination.y1 < blit.destination.y0, "upside down");
    }
    EXPECT_THAT(seen, testing::UnorderedElementsAre("filtered", "another pattern", "converted",
                                                    "mirrored", "upside down"));
}

// A file that says what is open: that is varied, and nothing else.
TEST(ChangedSource, AFileWithFuzzVariesWhatItLeavesOpen) {
    const std::string toml = R"(format = 1
description = "d"
rules = ["cover.inside"]
[matrix]
size = [8, 16]
[fuzz]
x = { from = "-1/2", to = "1/2", step = "1/4" }
face = ["none", "back", "front"]
[target]
size = ["size", 8]
[[draw]]
cull = "face"
vertices = [["x", 0], [8, 0], [0, 8]]
)";
    auto loaded = cases::load_text(toml, "f", "f");
    ASSERT_TRUE(loaded) << cases::to_string(loaded.error().front());
    const auto open = std::make_shared<const Document>(*cases::read_toml(toml, "f"));
    std::vector<Start> all;
    for (cases::Case& c : *loaded) {
        all.push_back({std::move(c), open});
    }
    ChangedSource source(1, std::make_shared<const std::vector<Start>>(std::move(all)));
    std::set<std::tuple<uint32_t, double, cases::CullMode>> seen;
    for (const Source::Made& one : all_of(source, 64)) {
        ASSERT_TRUE(one.data) << one.text;
        EXPECT_EQ(one.refused, 0U);
        const cases::Case& c = *one.data;
        ASSERT_EQ(c.draws.size(), 1U);
        const double x = (static_cast<double>(c.draws[0].positions[0].x) + 1) * c.target.width / 2;
        seen.insert({c.target.width, x, c.draws[0].cull});
        EXPECT_EQ(std::fmod(x * 4, 1), 0) << x;
        EXPECT_EQ(c.draws[0].positions[1].y, -1);
    }
    EXPECT_EQ(seen.size(), 2U * 5 * 3);
}

// A case that is too large to be written has no changes; a hunt of others goes on.
TEST(ChangedSource, ATooLargeCaseIsLeftOut) {
    const auto loaded = cases::load_text(
        "format = 1\ndescription = \"d\"\nrules = [\"cover.inside\"]\n[target]\nsize = [64, 64]\n"
        "[[draw]]\ngenerate = { kind = \"surface\", columns = 128, rows = 128 }\n",
        "f", "f");
    ASSERT_TRUE(loaded) << cases::to_string(loaded.error().front());
    ChangedSource source(
        1, std::make_shared<const std::vector<Start>>(std::vector<Start>{{loaded->front(), {}}}));
    for (const Source::Made& one : all_of(source, 2)) {
        EXPECT_TRUE(one.text.empty());
        EXPECT_FALSE(one.data);
    }
}

}  // namespace
}  // namespace fuzz
