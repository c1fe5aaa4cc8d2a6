// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Clears among the draws, and contents that nobody cares for: random cases against the oracle, and
// pictures that are known by hand.
#include <gtest/gtest.h>

#include "cases/load/loader.hpp"
#include "cases/model/derive.hpp"
#include "ref/color/color.hpp"
#include "tests/unit/ref/same_expectations.hpp"
#include "tests/unit/ref/value_case.hpp"

namespace ref::test {
namespace {

using value_test::Random;

cases::Case random_case(uint64_t seed) {
    Random random(seed);
    cases::Case c;
    c.id = "random clears";
    c.target = {8, 8, random.one_in(3) ? 4U : 1U, random.one_in(3) ? 3U : 1U};
    c.target.has_stencil = random.one_in(2);
    c.target.color.emplace();
    const auto load = [&] {
        return random.one_in(3) ? cases::LoadOp::dont_care : cases::LoadOp::load;
    };
    c.target.depth_load = load();
    c.target.stencil_load = c.target.has_stencil ? load() : cases::LoadOp::clear;
    const uint32_t draws = 2 + random.below(3);
    for (uint32_t k = 0; k < draws; ++k) {
        const uint32_t layer = random.below(c.target.layers);
        if (random.one_in(2)) {
            cases::Clear clear;
            clear.layers = 1 + random.below(c.target.layers - layer);
            for (uint32_t n = 1 + random.below(3); n > 0; --n) {
                const uint32_t x = random.below(8), y = random.below(8);
                clear.rects.push_back({static_cast<int32_t>(x), static_cast<int32_t>(y),
                                       1 + random.below(8 - x), 1 + random.below(8 - y)});
            }
            clear.depth = random.one_in(2) ? std::optional(random.eighth()) : std::nullopt;
            if (c.target.has_stencil && random.one_in(2)) {
                clear.stencil = random.below(4);
            }
            clear.color = glm::vec4(1);
            c.draws.push_back(cases::clear_draw(c.target, clear, layer));
            continue;
        }
        cases::Draw& d = c.draws.emplace_back();
        d.viewport = {0, 0, 8, 8, 0, 1};
        d.scissor = {0, 0, 8, 8};
        d.layer = layer;
        d.depth.compare = static_cast<cases::CompareOp>(random.below(8));
        d.depth.write = !random.one_in(4);
        d.stencil.front.compare = static_cast<cases::CompareOp>(random.below(8));
        d.stencil.front.reference = random.below(4);
        value_test::add_random_triangles(d, random, 8, 64);
    }
    return c;
}

TEST(Clear, ExpectationsAgreeWithTheOracle) {
    for (uint64_t seed = 1; seed <= 60; ++seed) {
        const cases::Case c = random_case(seed);
        for (const cases::Profile profile : cases::kProfiles) {
            ASSERT_TRUE(same_expectations(expect(c, Limits{}, profile),
                                          exact::expect(c, Limits{}, profile)))
                << "seed " << seed;
        }
    }
}

cases::Case loaded(const std::string& target, const std::string& draws) {
    const auto cases = cases::load_text(
        "format = 1\ndescription = \"d\"\nrules = [\"clear.attachments\"]\n[target]\nsize = [4, "
        "1]\n" +
            target + draws,
        "f", "id");
    EXPECT_TRUE(cases) << (cases ? "" : to_string(cases.error().front()));
    return cases ? cases->front() : cases::Case();
}

const std::string kWhole =
    "[[draw]]\nvertices = [[-1,-1,\"1/2\"], [9,-1,\"1/2\"], [-1,9,\"1/2\"]]\n";

// One pixel before the rectangle, two in it, one behind: drawn, cleared, drawn to the left of 3.
TEST(Clear, AreKnownByHand) {
    const cases::Case c = loaded(
        "stencil = true\nstencil_clear = 9\ndepth_clear = 1\ncolor = { format = \"rgba8-uint\" }\n",
        kWhole +
            "stencil = { pass = \"replace\", reference = 5 }\ncolor = { value = [1,2,3,4] }\n" +
            "[[draw]]\nclear = { rects = [[1,0,2,1]], color = [7,8,9,10], depth = 0.25, stencil = "
            "6 }\n" +
            kWhole +
            "scissor = [0,0,2,1]\ndepth = { compare = \"greater\" }\nstencil = { pass = "
            "\"increment-clamp\" }\ncolor = { value = [0,16,0,0], write_mask = \"g\" }\n");
    for (const cases::Profile profile : cases::kProfiles) {
        const Expectation e = expect(c, Limits{}, profile);
        ColorReference colors(c, e);
        const auto codes = [&](uint32_t x) { return colors.codes(x, {x, 0, 0, 0}); };
        using Codes = std::array<uint32_t, 4>;
        EXPECT_EQ(codes(1), (Codes{7, 16, 9, 10}));
        EXPECT_EQ(codes(2), (Codes{7, 8, 9, 10}));
        EXPECT_EQ(codes(3), (Codes{1, 2, 3, 4}));
        const auto stencil = [&](size_t x) { return stencils_at(e, e.samples[x], std::nullopt); };
        EXPECT_TRUE(stencil(1).test(7) && stencil(1).count() == 1);
        EXPECT_TRUE(stencil(2).test(6) && stencil(2).count() == 1);
        EXPECT_TRUE(stencil(3).test(5) && stencil(3).count() == 1);
        // A clear is no hit, and its depth is there until a fragment has another.
        EXPECT_EQ(e.samples[1].hits.total_max, 2U);
        EXPECT_EQ(e.samples[2].hits.total_max, 1U);
        ASSERT_EQ(e.depth_writers_of(e.samples[2]).size(), 1U);
        EXPECT_EQ(e.triangles[e.depth_writers_of(e.samples[2])[0]].draw, 1U);
        EXPECT_EQ(e.triangles[e.depth_writers_of(e.samples[1])[0]].draw, 2U);
        EXPECT_EQ(e.triangles[e.depth_writers_of(e.samples[3])[0]].draw, 0U);
    }
}

// What is not cared for is any, until something replaces it.
TEST(Clear, UnknownContentsAreFree) {
    const cases::Case c = loaded(
        "stencil = true\nstencil_load = \"dont-care\"\ndepth_load = \"dont-care\"\ncolor = { "
        "format = "
        "\"rgba8-uint\", load = \"dont-care\" }\n",
        "[[draw]]\nclear = { rects = [[1,0,1,1]], color = [7,8,9,10], depth = 0.25, stencil = 6 "
        "}\n" +
            kWhole +
            "scissor = [0,0,2,1]\ndepth = { compare = \"greater\" }\nstencil = { compare = "
            "\"equal\", "
            "reference = 6 }\ncolor = { value = [0,16,0,0], write_mask = \"g\" }\n");
    const Expectation e = expect(c, Limits{}, cases::Profile::direct3d);
    ColorReference colors(c, e);
    const auto explains = [&](uint32_t x, const std::array<uint32_t, 4>& codes) {
        return colors.explains(x, {x, 0, 0, 0}, codes);
    };
    EXPECT_EQ(e.samples[0].hits.total_min, 0U);
    EXPECT_EQ(e.samples[0].hits.total_max, 1U);
    EXPECT_EQ(e.samples[1].hits.total_min, 1U);
    EXPECT_TRUE(explains(1, {7, 16, 9, 10}));
    EXPECT_FALSE(explains(1, {7, 8, 9, 10}));
    EXPECT_TRUE(explains(2, {1, 2, 3, 4}) && explains(2, {200, 0, 0, 0}));
    EXPECT_EQ(stencils_at(e, e.samples[2], std::nullopt).count(), 256U);
    EXPECT_EQ(stencils_at(e, e.samples[1], std::nullopt).count(), 1U);
    EXPECT_TRUE(e.samples[0].depth_may_be_clear);
    EXPECT_FALSE(e.samples[1].depth_may_be_clear);
}

}  // namespace
}  // namespace ref::test
