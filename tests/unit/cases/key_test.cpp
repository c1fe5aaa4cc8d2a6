// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The rows of keys beside the structures that they fill: no member without a row, no row without a
// reader and a writer.
#include "cases/key/key.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cases/load/loader.hpp"
#include "cases/model/words.hpp"
#include "cases/write/to_toml.hpp"

namespace cases {
namespace {

// Members that other keys fill.
const std::set<std::string> kNoRow = {
    "Draw.primitive_restart",  // a word of indices
    "FragDepth.coord",         // the key `from`
    "DepthState.volume",       // the key `depth_volume` of the draw
    "Target.width",            // the key `size`, as the next
    "Target.height",
    "Target.depth",  // the key `attachments`, as instruments
    "Target.names_depth",     "Target.instruments",       "Blit.source_width",
    "Blit.source_height",     "ClipDistances.clip_count", "ClipDistances.cull_count",
};

// Checks each word, number, true or false of a structure, and those of structures in it that are no
// table of their own.
template <class T>
void expect_rows(const std::string& name, const KeyTable& keys, const T& value) {
    T::fields(
        [&](const Field& field, const auto& member) {
            using Member = std::remove_cvref_t<decltype(member)>;
            const Key* key = keys.find_field(field.name);
            if constexpr (std::is_same_v<Member, ClipDistances>) {
                expect_rows("ClipDistances", keys, member);
            } else if constexpr (HasFields<Member>) {
                if (key == nullptr && !std::is_same_v<Member, SourceLocation> &&
                    !std::is_same_v<Member, Corners>) {
                    expect_rows(field.name, keys, member);
                }
            } else if constexpr (is_simple_member<Member>) {
                const std::string path = fmt::format("{}.{}", name, field.name);
                EXPECT_EQ(key == nullptr, kNoRow.contains(path))
                    << path << " has no key: write a row in cases/key/key.cpp";
                if constexpr (std::is_enum_v<Member>) {
                    const Words words = kWords<Member>;
                    ASSERT_NE(key, nullptr) << path;
                    EXPECT_TRUE(std::ranges::equal(
                        key->words, words.first(std::min(words.size(), key->words.size()))))
                        << path;
                    EXPECT_LT(static_cast<size_t>(member), key->words.size()) << path;
                }
            }
        },
        value);
}

TEST(Keys, EveryMemberHasARow) {
    expect_rows("Target", kTargetKeys, Target{});
    expect_rows("ColorTarget", kTargetColorKeys, ColorTarget{});
    expect_rows("Draw", kDrawKeys, Draw{});
    expect_rows("DepthState", kDepthKeys, DepthState{});
    EXPECT_NE(kDrawKeys.find_field("volume"), nullptr);
    expect_rows("DepthBias", kBiasKeys, DepthBias{});
    expect_rows("StencilFace", kStencilFaceKeys, StencilFace{});
    expect_rows("FragDepth", kFragDepthKeys, FragDepth{});
    expect_rows("ColorOutput", kColorKeys, ColorOutput{});
    expect_rows("BlendEquation", kBlendKeys, BlendEquation{});
    expect_rows("BlendEquation", kBlendAlphaKeys, BlendEquation{});
    expect_rows("Attribute", kAttributeKeys, Attribute{});
    expect_rows("Blit", kBlitKeys, Blit{});
}

TEST(Keys, HaveOneRowEach) {
    for (const KeyTable* table :
         {&kFileKeys, &kTargetKeys, &kDrawKeys, &kDepthKeys, &kColorKeys, &kAttributeKeys}) {
        std::set<std::string_view> names;
        for (const Key& key : table->keys) {
            EXPECT_TRUE(names.insert(key.name).second) << key.name;
            EXPECT_EQ(table->find(key.name), &key);
            EXPECT_EQ(key.kind == KeyKind::table, key.keys != nullptr) << key.name;
        }
    }
}

// Values to write for a key that a row alone reads, as a case file has them.
std::vector<std::string> values_of(const Key& key) {
    std::vector<std::string> out;
    for (const std::string_view word : key.words) {
        out.push_back(fmt::format("\"{}\"", word));
    }
    switch (key.kind) {
        case KeyKind::flag:
            return {"true", "false"};
        case KeyKind::whole:
        case KeyKind::bits:
            return {std::to_string(key.least), std::to_string(std::min(key.most, key.least + 1))};
        case KeyKind::number:
        case KeyKind::share:
            return {"0.75", "0.5"};
        default:
            return out;
    }
}

// Each is read, and written again where it is not what absence means.
TEST(Keys, AreReadAndWrittenByTheirRow) {
    const std::map<std::string_view, std::string_view> needs = {
        {"conservative_extra", "conservative = \"overestimate\"\n"},
        {"discard_by", "discard = \"checker\"\n"},
        {"matrix", "color = { value = [1, 1, 1, 1], from = \"constant\" }\n"},
    };
    const std::map<const KeyTable*, std::string> places = {
        {&kDrawKeys, "{}"},
        {&kDepthKeys, "depth = {{ {} }}\n"},
        {&kBiasKeys, "depth = {{ bias = {{ {} }} }}\n"},
        {&kStencilFaceKeys, "stencil = {{ back = {{ {} }} }}\n"},
        {&kBlendAlphaKeys, "color = {{ value = [1, 1, 1, 1], blend = {{ {} }} }}\n"},
    };
    for (const auto& [table, place] : places) {
        for (const Key& key : table->keys) {
            size_t written = 0;
            for (const std::string& value :
                 key.is_simple() ? values_of(key) : std::vector<std::string>()) {
                const auto need = needs.find(key.name);
                const bool is_matrix = key.name == "matrix";
                const bool is_colored = is_matrix || table == &kBlendAlphaKeys;
                const std::string text =
                    "format = 1\ndescription = \"d\"\nrules = [\"cover.inside\"]\n[target]\n"
                    "size = [8, 8]\nstencil = true\n" +
                    std::string(key.name == "layer" ? "layers = 2\n" : "") +
                    std::string(is_matrix ? "attachments = \"color\"\n" : "") +
                    std::string(is_colored ? "[target.color]\nformat = \"rgba8-unorm\"\n" : "") +
                    "[[draw]]\nvertices = [[0,0], [8,0], [0,8]]\n" +
                    std::string(need == needs.end() ? "" : need->second) +
                    fmt::format(fmt::runtime(place), fmt::format("{} = {}", key.name, value)) +
                    "\n";
                const auto loaded = load_text(text, "f", "f");
                if (!loaded) {  // what it does not go with
                    EXPECT_EQ(loaded.error().front().message.find("has no key"), std::string::npos)
                        << text;
                    continue;
                }
                const Expected<std::string> again = to_toml(loaded->front());
                ASSERT_TRUE(again) << text;
                written += again->find(std::string(key.name) + " ") != std::string::npos ? 1U : 0U;
            }
            // Where triangles begin, and what vertices are, is written as positions.
            const bool is_moved = key.has(Key::kShape) || key.name == "space";
            EXPECT_EQ(written > 0, key.is_simple() && !is_moved) << key.name;
        }
    }
}

}  // namespace
}  // namespace cases
