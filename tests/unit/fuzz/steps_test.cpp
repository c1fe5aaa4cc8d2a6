// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What single steps of the reducer make of a case.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "cases/model/triangle.hpp"
#include "fuzz/reduce/measure.hpp"
#include "fuzz/reduce/reduce.hpp"
#include "reduce_documents.hpp"
#include "simpler.hpp"

namespace fuzz {
namespace {

using cases::Case;

// The one simpler document that a step leads to.
Document after(const Document& document, const std::string& step) {
    std::vector<std::string> others;
    for (Simpler& one : simpler(document)) {
        if (one.step == step) {
            return std::move(one.document);
        }
        others.push_back(one.step);
    }
    ADD_FAILURE() << "no step is called " << step << " but " << testing::PrintToString(others);
    return {};
}

// Where the vertices of a case are in pixels of its target.
std::vector<glm::dvec2> pixels_of(const Case& c) {
    std::vector<glm::dvec2> out;
    for (const cases::Draw& draw : c.draws) {
        const glm::dvec4 port(draw.viewport.x, draw.viewport.y, draw.viewport.width,
                              draw.viewport.height);
        for (const glm::vec4& p : draw.positions) {
            const glm::dvec4 v = p;
            out.emplace_back(port.x + port.z / 2 * (v.x / v.w + 1),
                             port.y + port.w / 2 * (v.y / v.w + 1));
        }
    }
    return out;
}

TEST(ReduceStep, CutsTheTargetWithoutMovingThePicture) {
    const Document document = read(R"(
format = 1
description = "Three spaces."
rules = ["cover.inside"]
[target]
size = [32, 16]
[[draw]]
vertices = [[16.5, 8.25], [20, 9], [17, 12]]
scissor = [10, 2, 20, 12]
[[draw]]
space = "clip"
vertices = [[0.25, 0.25, 0.5, 1], [0.5, 0.25, 0.5, 1], [0.5, 0.75, 1, 2]]
[[draw]]
space = "ndc"
viewport = [16, 4, 8, 8]
vertices = [[0.25, 0.25], [0.5, 0.25], [0.5, 0.5]]
)");
    const Document cut = after(document, "cut to what is drawn");
    const Case before = load(to_text(document));
    const Case c = load(to_text(cut));
    // From (16.5, 8.25) to (24, 12).
    EXPECT_EQ(c.target.width, 8U);
    EXPECT_EQ(c.target.height, 4U);
    std::vector<glm::dvec2> moved = pixels_of(before);
    for (glm::dvec2& p : moved) {
        p -= glm::dvec2(16, 8);
    }
    EXPECT_EQ(pixels_of(c), moved);
    EXPECT_EQ(c.draws[0].scissor, (cases::Rect{0, 0, 8, 4}));
    EXPECT_EQ(pixels_of(load(to_text(after(document, "draw 1 in pixels")))), pixels_of(before));
    const std::vector<glm::dvec2> narrower =
        pixels_of(load(to_text(after(document, "without 4 columns at the right"))));
    for (size_t k = 0; k < narrower.size(); ++k) {
        // Rounded to binary32 as 28ths: to 2^-24 of at most 1, times half the width.
        EXPECT_NEAR(glm::distance(narrower[k], pixels_of(before)[k]), 0, 14 * 0x1p-24);
    }
}

// The triangles of a case, by the positions of their corners.
std::vector<std::array<glm::vec4, 3>> triangles_of(const Case& c) {
    std::vector<std::array<glm::vec4, 3>> out;
    for (const cases::Triangle& t : cases::assemble(c)) {
        const std::vector<glm::vec4>& p = c.draws[t.draw].positions;
        // The provoking one first, the others in their order.
        const size_t first =
            static_cast<size_t>(std::ranges::find(t.vertex, t.provoking) - t.vertex.begin());
        out.push_back({p[t.vertex.at(first)], p[t.vertex.at((first + 1) % 3)],
                       p[t.vertex.at((first + 2) % 3)]});
    }
    return out;
}

TEST(ReduceStep, WritesStripsAndFansAsTheSameTriangles) {
    for (const char* topology : {"triangle-strip", "triangle-fan"}) {
        for (const char* provoking : {"first", "last"}) {
            const Document document = read(fmt::format(R"(
format = 1
description = "A run or two."
rules = ["cover.inside"]
[target]
size = [8, 8]
[[draw]]
topology = "{}"
provoking = "{}"
vertices = [[0, 0], [1, 5], [2, 1], [3, 6], [4, 2], [5, 7], [7, 7]]
indices = [0, 1, 2, 3, 4, "restart", 5, 4, 3, 2, "restart", 0, 1]
)",
                                                       topology, provoking));
            const Document list = after(document, "as a list without indices");
            const Case c = load(to_text(list));
            EXPECT_EQ(c.draws[0].topology, cases::Topology::triangle_list);
            EXPECT_FALSE(c.draws[0].indices);
            EXPECT_EQ(triangles_of(c), triangles_of(load(to_text(document)))) << topology;
            const Case fewer = load(to_text(after(document, "without unused vertices")));
            EXPECT_EQ(fewer.draws[0].positions.size(), 6U);
            EXPECT_EQ(triangles_of(fewer), triangles_of(load(to_text(document))));
            for (const char* run : {"without run 0", "without run 1", "without run 2"}) {
                EXPECT_EQ(load(to_text(after(document, run))).draws[0].indices->size(),
                          run[12] == '0'   ? 7U
                          : run[12] == '1' ? 8U
                                           : 10U);
            }
        }
    }
}

TEST(ReduceStep, KeepsTheAttributeThatAColourNames) {
    const Document document = read(kCrowded);
    EXPECT_THAT(to_text(after(document, "draw 0 without attribute 0")),
                testing::HasSubstr("color = { attribute = \"attribute0\", "));
    EXPECT_THAT(to_text(after(document, "draw 0 without attribute 1")),
                testing::HasSubstr("value = [1, 1, 1, 1]"));
}

// Without its indices this draw would have three triangles in place of one.
TEST(ReduceStep, IsNothingThatMakesTheCaseHarder) {
    const Document document = read(R"(
format = 1
description = "One of three."
rules = ["cover.inside"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0, 0], [4, 0], [0, 4], [1, 1], [5, 1], [1, 5], [2, 2], [6, 2], [2, 6]]
indices = [0, 4, 8]
)");
    const Document crowded = read(kCrowded);
    for (const Document* from : {&document, &crowded}) {
        for (const Simpler& one : simpler(*from)) {
            EXPECT_LT(measure(one.document), measure(*from)) << one.step;
            EXPECT_TRUE(from != &document || one.step != "without indices");
        }
    }
}

// Keys go with the one that gives them their meaning.
TEST(ReduceStep, TakesWhatMeansNothingAloneAlong) {
    const Document document = read(kCrowded);
    EXPECT_THAT(to_text(after(document, "draw 0 without blending")),
                testing::HasSubstr("color = { attribute = \"attribute1\" }"));
    EXPECT_THAT(to_text(after(document, "draw 0 without attribute 2 probe")),
                testing::HasSubstr("[[draw.attribute]]\nconstant = [0.5, 0.25]\n"));
    const cases::Case one = load(to_text(after(document, "with 1 sample")));
    EXPECT_EQ(one.target.samples, 1U);
    EXPECT_TRUE(one.target.sample_locations.empty());
    EXPECT_EQ(one.draws[0].attributes[2].probe_sample, 0U);
    const cases::Case two = load(to_text(after(document, "with 2 samples")));
    EXPECT_EQ(two.target.sample_locations.size(), 2U);
    const cases::Case plain = load(to_text(after(document, "without a colour target")));
    EXPECT_FALSE(plain.target.color);
    EXPECT_EQ(plain.target.color_resolve, cases::Resolve::none);
}

TEST(ReduceStep, TakesAwayWhatDrawsSayOfTheStencilWithIt) {
    const Document document = read(R"(
format = 1
description = "A stencil that is tested."
rules = ["cover.inside"]
[target]
size = [8, 8]
stencil = true
stencil_clear = 3
[[draw]]
stencil = { front = { pass = "replace", reference = 5 }, back = { pass = "zero" } }
discard = "checker"
early_tests = true
vertices = [[0, 0], [8, 0], [0, 8]]
[[draw]]
stencil = { compare = "equal", reference = 5, pass = "increment-clamp", compare_mask = 7 }
vertices = [[0, 0], [8, 0], [0, 8]]
)");
    const cases::Case none = load(to_text(after(document, "without a stencil")));
    EXPECT_FALSE(none.target.has_stencil);
    EXPECT_EQ(none.draws[1].stencil, cases::StencilState{});
    const cases::Case counts = load(to_text(after(document, "draw 1 without stencil")));
    EXPECT_EQ(counts.draws[1].stencil, cases::StencilState{});
    EXPECT_EQ(counts.draws[0].stencil.front.reference, 5U);
    const cases::Case open = load(to_text(after(document, "draw 1 without stencil test")));
    EXPECT_EQ(open.draws[1].stencil.front.compare, cases::CompareOp::always);
    const cases::Case whole = load(to_text(after(document, "draw 1 without stencil compare mask")));
    EXPECT_EQ(whole.draws[1].stencil.back.compare_mask, 0xffU);
    const cases::Case one = load(to_text(after(document, "draw 0 without stencil back")));
    EXPECT_EQ(one.draws[0].stencil.back, cases::StencilFace{});
    const cases::Case drawn = load(to_text(after(document, "draw 0 without discard")));
    EXPECT_EQ(drawn.draws[0].discard, cases::Discard::none);
    EXPECT_TRUE(drawn.draws[0].early_tests);
    EXPECT_FALSE(load(to_text(after(document, "draw 0 without early tests"))).draws[0].early_tests);
}

TEST(ReduceStep, TakesAwayColourTargetsThatAreNotJudged) {
    const Document document = read(R"(
format = 1
description = "Three targets."
rules = ["cover.inside"]
[target]
size = [8, 8]
color = [{ format = "rgba8-unorm" }, { format = "r32-uint" }, { format = "rgba16-float" }]
judged = 2
[[draw]]
vertices = [[0, 0], [8, 0], [0, 8]]
color = [{ value = [0, 0, 0, 1], write_mask = "g" }, { value = [7, 0, 0, 0] }, { value = [1, 2, 3, 4], blend = "additive" }]
)");
    const cases::Case one = load(to_text(after(document, "with one colour target")));
    EXPECT_EQ(one.target.color_count(), 1U);
    EXPECT_EQ(one.target.color->format, cases::ColorFormat::rgba16_float);
    EXPECT_EQ(one.draws[0].color.value.w, 4);
    const Document less = after(document, "without colour target 0");
    const cases::Case two = load(to_text(less));
    EXPECT_EQ(two.target.judged_color, 1U);
    EXPECT_EQ(two.target.color->format, cases::ColorFormat::rgba16_float);
    EXPECT_EQ(two.draws[0].other_colors[0].value.x, 7);
    EXPECT_EQ(load(to_text(after(document, "without colour target 1"))).target.color_count(), 2U);
    EXPECT_EQ(load(to_text(after(document, "without a colour target"))).target.color_count(), 0U);
    // The judged one stays, and of two either is left with "with one colour target".
    for (const Simpler& simple : simpler(document)) {
        EXPECT_NE(simple.step, "without colour target 2");
    }
    for (const Simpler& simple : simpler(less)) {
        EXPECT_NE(simple.step, "without colour target 0");
    }
}

TEST(ReduceStep, TakesAwayWhatBecomesOfFragments) {
    const Document document = read(R"(
format = 1
description = "Depths that are written and tested, and colours that are combined."
rules = ["cover.inside"]
[target]
size = [8, 8]
attachments = "color+depth"
[target.color]
format = "rgba8-uint"
[[draw]]
frag_depth = { value = 0.25, other = 0.75, where = "checker" }
color = { value = [1, 2, 3, 4], logic = "xor" }
vertices = [[0, 0], [8, 0], [0, 8]]
[[draw]]
depth = { bounds = [0.25, 0.5] }
color = { value = [1, 2, 3, 4], logic = "or" }
vertices = [[0, 0], [8, 0], [0, 8]]
)");
    // A number for some pixels is nothing without the pattern that says which.
    const cases::Case one = load(to_text(after(document, "draw 0 without frag depth where")));
    ASSERT_TRUE(one.draws[0].frag_depth);
    EXPECT_EQ(*one.draws[0].frag_depth, (cases::FragDepth{.value = 0.25F}));
    EXPECT_FALSE(load(to_text(after(document, "draw 0 without frag depth"))).draws[0].frag_depth);
    EXPECT_FALSE(
        load(to_text(after(document, "draw 1 without depth bounds"))).draws[1].depth.bounds);
    const cases::Case written = load(to_text(after(document, "draw 0 without color logic")));
    EXPECT_FALSE(written.draws[0].color.logic);
    EXPECT_TRUE(written.draws[1].color.logic);
}

// Vertices take their values along, so that each triangle keeps what it had.
TEST(ReduceStep, LeavesOutVerticesWithTheirValues) {
    const Case c = load(to_text(after(read(kCrowded), "draw 0 without triangle 0")));
    const cases::Draw& draw = c.draws[0];
    ASSERT_EQ(draw.positions.size(), 3U);
    for (size_t v = 0; v < 3; ++v) {
        EXPECT_EQ(draw.attributes[0].values[v].x, static_cast<float>(v + 4));
        EXPECT_EQ(draw.attributes[1].values[v].x, v == 2 ? 3.0F : v == 1 ? 0.2F : 0.1F);
        EXPECT_EQ(draw.distances.cull[v].x, v == 1 ? -1.0F / 3 : -1.0F);
    }
}

}  // namespace
}  // namespace fuzz
