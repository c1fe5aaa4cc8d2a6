// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What ways make of the cases of the suite: cases that a file can say, without instruments.
#include "cases/model/way.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <string>

#include "cases/load/loader.hpp"
#include "cases/model/derive.hpp"
#include "cases/model/matrix.hpp"
#include "cases/model/texels.hpp"
#include "cases/select/selector.hpp"
#include "cases/wire/case_bytes.hpp"
#include "cases/write/to_toml.hpp"
#include "folders.hpp"

namespace cases {
namespace {

// The first leaf of each file.
const std::vector<Case>& the_files() {
    static const std::vector<Case> kFirst = [] {
        std::vector<Case> out;
        std::set<std::string> files;
        constexpr size_t kMostVertices = 1000;  // larger cases only take longer
        for (Case& c : load_suite(test_support::source_dir() + "/cases/suite").cases) {
            const bool is_large = std::ranges::any_of(
                c.draws, [](const Draw& draw) { return draw.positions.size() > kMostVertices; });
            if (!is_large && files.insert(c.claim.where.file).second) {
                out.push_back(std::move(c));
            }
        }
        return out;
    }();
    return kFirst;
}

// Written and read again.
// All ways of all files: too long for the sanitizers.
TEST(ExhaustiveWay, MakesCasesThatAFileCanSay) {
    for (const WayRow& way : all_ways()) {
        size_t count = 0;
        for (const Case& c : the_files()) {
            const std::optional<Case> made = by_way(way, c);
            if (!made) {
                continue;
            }
            ++count;
            EXPECT_EQ(made->id, c.id + "@" + std::string(way.word));
            const Expected<std::string> text = to_toml(*made);
            if (!text) {
                continue;  // too large for a file, ToToml holds that
            }
            const auto back = load_text(*text, "f.toml", made->id);
            ASSERT_TRUE(back) << made->id << ": " << to_string(back.error().front()) << *text;
            ASSERT_EQ(back->size(), 1U);
            EXPECT_EQ(to_bytes(back->front()), to_bytes(*made)) << made->id << "\n" << *text;
        }
        EXPECT_GT(count, way.word == "bare-beside" ? 50U : 300U) << way.word;
    }
}

TEST(Way, AttachesNothingThatTellsOfFragments) {
    const std::map<std::string_view, Attachments> alone = {
        {"bare-depth", Attachments::depth},
        {"bare-depth-sampled", Attachments::depth},
        {"bare-stencil", Attachments::stencil},
        {"prepass", Attachments::color_depth},
        {"bare-color-texture", Attachments::color}};
    for (const WayRow& way : all_ways()) {
        for (const Case& c : the_files()) {
            const std::optional<Case> made = by_way(way, c);
            if (!made) {
                continue;
            }
            ASSERT_NE(made->target.attachments(), Attachments::all) << made->id;
            if (const auto only = alone.find(way.word); only != alone.end()) {
                ASSERT_EQ(made->target.attachments(), only->second) << made->id;
            }
            ASSERT_TRUE(made->relations.empty() && made->doors.empty()) << made->id;
            ASSERT_FALSE(by_way(way, *made)) << "a way of a way";
            // The triangles are those of the case.
            const size_t passes = way.word == "prepass" ? 2 : 1;
            ASSERT_EQ(made->draws.size(), passes * c.draws.size()) << made->id;
            for (size_t k = 0; k < made->draws.size(); ++k) {
                const Draw& before = c.draws[k % c.draws.size()];
                ASSERT_EQ(made->draws[k].positions.size(), before.positions.size()) << made->id;
                ASSERT_EQ(std::memcmp(made->draws[k].positions.data(), before.positions.data(),
                                      before.positions.size() * sizeof(glm::vec4)),
                          0)
                    << made->id;
                ASSERT_EQ(made->draws[k].indices, before.indices) << made->id;
                ASSERT_EQ(made->draws[k].viewport, before.viewport) << made->id;
            }
        }
    }
}

// Each draw and vertex has a colour of its own, and the clear colour is none of them.
TEST(Way, TellsDrawsApart) {
    const std::span<const WayRow> plain = all_ways().first(7);  // those of one colour a draw
    const auto found = std::ranges::find_if(the_files(), [&](const Case& c) {
        return c.draws.size() > 2 && std::ranges::all_of(plain, [&](const WayRow& way) {
                   return by_way(way, c).has_value();
               });
    });
    ASSERT_NE(found, the_files().end());
    for (const WayRow& way : plain) {
        const std::optional<Case> made = by_way(way, *found);
        ASSERT_TRUE(made) << way.word;
        for (size_t k = 0; k < made->draws.size(); ++k) {
            EXPECT_NE(made->draws[k].color.value, made->target.color->clear);
            for (size_t n = 0; n < k; ++n) {
                EXPECT_NE(made->draws[k].color.value, made->draws[n].color.value);
            }
        }
    }
}

TEST(Way, BlendsWhereItSaysSo) {
    for (const WayRow& way : all_ways()) {
        const std::optional<Case> made = by_way(way, the_files().front());
        for (size_t k = 0; made && k < made->draws.size(); ++k) {
            EXPECT_EQ(made->draws[k].color.blend.has_value(), way.word == "bare-color-blended")
                << way.word;
        }
    }
    const auto blends = [](const WayRow& way, const Case& c) {
        const std::optional<Case> made = by_way(way, c);
        return made && made->draws.front().color.blend;
    };
    const auto blended = std::ranges::find(all_ways(), "bare-color-blended", &WayRow::word);
    EXPECT_TRUE(
        std::ranges::any_of(the_files(), [&](const Case& c) { return blends(*blended, c); }));
}

std::vector<Case> made_by(std::string_view word) {
    const auto way = std::ranges::find(all_ways(), word, &WayRow::word);
    std::vector<Case> out;
    for (const Case& c : the_files()) {
        if (std::optional<Case> made = by_way(*way, c)) {
            out.push_back(std::move(*made));
        }
    }
    return out;
}

// As a vertex shader multiplies: by columns, each product and each sum rounded.
glm::vec4 by_matrix(const glm::vec4& v) {
    glm::vec4 out{};
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const float product = kMatrix.at(static_cast<size_t>(4 * j + i)) * v[j];
            out[i] += product;
        }
    }
    return out;
}

TEST(Way, AMatrixMakesThePositions) {
    size_t count = 0;
    for (const Case& c : made_by("bare-color-matrix")) {
        for (const Draw& draw : c.draws) {
            ASSERT_TRUE(draw.matrix) << c.id;
            for (const glm::vec4& p : draw.positions) {
                const glm::vec4 before = before_matrix(p);
                ASSERT_EQ(by_matrix(before), p) << c.id;
                count += before == p ? 0U : 1U;
            }
        }
    }
    EXPECT_GT(count, 1000U);
    EXPECT_TRUE(takes_matrix(std::vector{glm::vec4(0, -0x1p-100F, 0x1p100F, 3)}));
    for (const float bad : {0x1p-101F, -0x1p101F, std::nanf(""), HUGE_VALF}) {
        EXPECT_FALSE(takes_matrix(std::vector{glm::vec4(0, 0, 0, bad)})) << bad;
    }
}

TEST(Way, AMaskCutsACornerOffEachTriangle) {
    for (const Case& c : made_by("bare-color-mask")) {
        for (const Draw& draw : c.draws) {
            const std::vector<glm::vec4>& at = draw.attributes.at(0).values;
            for (size_t v = 0; v + 2 < draw.vertex_count(); ++v) {
                const auto left = std::count_if(at.begin() + static_cast<std::ptrdiff_t>(v),
                                                at.begin() + static_cast<std::ptrdiff_t>(v) + 3,
                                                [](const glm::vec4& p) { return p.x < 0; });
                ASSERT_EQ(left, 1) << c.id;
            }
            ASSERT_GE(draw.color.value.w, 0.75F);
        }
    }
}

// Three vertices in a row choose texels far from each other, and none is between two texels.
TEST(Way, TexelsTellVerticesApart) {
    std::set<std::pair<float, float>> places;
    for (const Case& c : made_by("bare-color-texels")) {
        for (const Draw& draw : c.draws) {
            const std::vector<glm::vec4>& at = draw.attributes.at(0).values;
            for (size_t v = 0; v < at.size(); ++v) {
                for (const float s : {at[v].x, at[v].y}) {
                    const float inside = s * kTexels - std::floor(s * kTexels);
                    ASSERT_TRUE(inside >= 1 / 16.0F && inside <= 15 / 16.0F && s > 0 && s < 1);
                }
                if (v % draw.vertex_count() > 0) {  // not of the instance before
                    const glm::vec4 step = texel_at(at[v]) - texel_at(at[v - 1]);
                    ASSERT_GT(std::fabs(step.x) + std::fabs(step.y), 0.5F);
                }
                places.insert({at[v].x, at[v].y});
            }
        }
    }
    EXPECT_GE(places.size(), 16U);
}

TEST(Way, TakesNoCaseWithAColourOrABlit) {
    for (const Case& c : the_files()) {
        if (c.blit) {
            for (const WayRow& way : all_ways()) {
                ASSERT_FALSE(by_way(way, c)) << c.id;
            }
        }
        if (c.target.color) {
            ASSERT_FALSE(by_way(all_ways().front(), c)) << c.id;
        }
    }
}

TEST(WayId, IsBehindTheLastPart) {
    EXPECT_EQ(split_way("a/b").base, "a/b");
    EXPECT_EQ(split_way("a/b").way, "");
    EXPECT_EQ(split_way("a/b:x=1@bare-color-push").base, "a/b:x=1");
    EXPECT_EQ(split_way("a/b:x=1@bare-color-push").way, "bare-color-push");
    EXPECT_EQ(split_way("@rule:cover.inside").way, "");  // a selector
}

TEST(WayId, GlobsSpeakOfCasesOrOfWays) {
    EXPECT_TRUE(glob_matches("a/*", "a/b"));
    EXPECT_FALSE(glob_matches("a/*", "a/b@bare-color-push"));
    EXPECT_FALSE(glob_matches("a/**", "a/b:x=1@bare-color-push"));
    EXPECT_FALSE(glob_matches("a/*@*", "a/b"));
    EXPECT_TRUE(glob_matches("a/*@*", "a/b@bare-color-push"));
    EXPECT_TRUE(glob_matches("a/b@bare-*", "a/b:x=1@bare-color-push"));
    EXPECT_FALSE(glob_matches("a/b@bare-color-s*", "a/b:x=1@bare-color-push"));
    EXPECT_TRUE(glob_matches("**@prepass", "a/b:x=1@prepass"));
}

}  // namespace
}  // namespace cases
