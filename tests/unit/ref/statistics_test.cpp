// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What queries of pipeline statistics may give, by hand.
#include "ref/expectation/statistics.hpp"

#include <gtest/gtest.h>

#include "tests/unit/ref/value_case.hpp"

namespace ref::test {
namespace {

using cases::Profile;
using cases::Query;
using cases::Topology;

cases::Case case_of(Topology topology, const std::vector<glm::vec4>& pixels) {
    cases::Case c;
    c.target = {8, 8, 1};
    cases::Draw d;
    d.viewport = {0, 0, 8, 8, 0, 1};
    d.scissor = {0, 0, 8, 8};
    d.topology = topology;
    for (const glm::vec4& p : pixels) {
        d.positions.push_back(value_test::clip_of(
            static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z), 1, 8));
    }
    c.draws.push_back(d);
    return c;
}

CountBounds bounds(cases::Case c, Query query, Profile profile, const ShownAt& shown = {}) {
    c.draws[0].query = query;
    return statistic_bounds(c, 0, expect(c, Limits{}, profile), shown);
}

const std::vector<glm::vec4> kSix = {{0, 0, 0.5F, 1}, {0, 8, 0.5F, 1}, {4, 0, 0.5F, 1},
                                     {4, 8, 0.5F, 1}, {8, 0, 0.5F, 1}, {8, 8, 0.5F, 1}};

// The examples of the Direct3D 11.3 functional specification, 20.4.7: strips and lists of four
// primitives, with an index buffer of one value and without.
TEST(Statistics, ExamplesOfDirect3D) {
    const auto d3d = [](const cases::Case& c, Query query) {
        return bounds(c, query, Profile::direct3d);
    };
    const cases::Case strip = case_of(Topology::triangle_strip, kSix);
    EXPECT_EQ(d3d(strip, Query::input_vertices), (CountBounds{6, 6}));
    EXPECT_EQ(d3d(strip, Query::input_primitives), (CountBounds{4, 4}));
    EXPECT_EQ(d3d(strip, Query::vertex_invocations), (CountBounds{6, 12}));
    std::vector<glm::vec4> twelve = kSix;
    twelve.insert(twelve.end(), kSix.begin(), kSix.end());
    const cases::Case list = case_of(Topology::triangle_list, twelve);
    EXPECT_EQ(d3d(list, Query::input_vertices), (CountBounds{12, 12}));
    EXPECT_EQ(d3d(list, Query::input_primitives), (CountBounds{4, 4}));
    EXPECT_EQ(d3d(list, Query::vertex_invocations), (CountBounds{12, 12}));
    cases::Case same = list;
    same.draws[0].indices = std::vector<uint32_t>(12, 3);
    EXPECT_EQ(d3d(same, Query::input_vertices), (CountBounds{12, 12}));
    EXPECT_EQ(d3d(same, Query::input_primitives), (CountBounds{4, 4}));
    EXPECT_EQ(d3d(same, Query::vertex_invocations), (CountBounds{1, 12}));
    same.draws[0].topology = Topology::triangle_strip;
    same.draws[0].indices = std::vector<uint32_t>(6, 3);
    EXPECT_EQ(d3d(same, Query::input_vertices), (CountBounds{6, 6}));
    EXPECT_EQ(d3d(same, Query::input_primitives), (CountBounds{4, 4}));
    EXPECT_EQ(d3d(same, Query::vertex_invocations), (CountBounds{1, 12}));
}

TEST(Statistics, NothingBoundsThemFromAboveBelowDirect3D) {
    const cases::Case strip = case_of(Topology::triangle_strip, kSix);
    for (const Profile profile : {Profile::vulkan, Profile::practice}) {
        EXPECT_EQ(bounds(strip, Query::input_vertices, profile), (CountBounds{6, kNoMost}));
        EXPECT_EQ(bounds(strip, Query::input_primitives, profile), (CountBounds{4, kNoMost}));
        EXPECT_EQ(bounds(strip, Query::vertex_invocations, profile), (CountBounds{6, kNoMost}));
        EXPECT_EQ(bounds(strip, Query::clipping_invocations, profile), (CountBounds{4, kNoMost}));
        cases::Case same = strip;
        same.draws[0].indices = std::vector<uint32_t>(6, 3);
        EXPECT_EQ(bounds(same, Query::input_vertices, profile), (CountBounds{1, kNoMost}));
    }
}

TEST(Statistics, WhatIsIncompleteMayCount) {
    std::vector<glm::vec4> five(kSix.begin(), kSix.begin() + 5);
    const cases::Case list = case_of(Topology::triangle_list, five);
    EXPECT_EQ(bounds(list, Query::input_vertices, Profile::direct3d), (CountBounds{3, 5}));
    EXPECT_EQ(bounds(list, Query::input_primitives, Profile::direct3d), (CountBounds{1, 2}));
    EXPECT_EQ(bounds(list, Query::vertex_invocations, Profile::direct3d), (CountBounds{3, 5}));
    EXPECT_EQ(bounds(list, Query::clipping_invocations, Profile::direct3d), (CountBounds{1, 2}));
    // A strip of four, one of two, one of three.
    cases::Case strip = case_of(Topology::triangle_strip, kSix);
    constexpr uint32_t kRestart = cases::kRestartIndex;
    strip.draws[0].primitive_restart = true;
    strip.draws[0].indices = {0, 1, 2, 3, kRestart, 4, 5, kRestart, 3, 4, 5};
    EXPECT_EQ(bounds(strip, Query::input_vertices, Profile::direct3d), (CountBounds{7, 11}));
    EXPECT_EQ(bounds(strip, Query::input_primitives, Profile::direct3d), (CountBounds{3, 4}));
    EXPECT_EQ(bounds(strip, Query::vertex_invocations, Profile::direct3d), (CountBounds{6, 11}));
    // Direct3D knows no fans: as many vertices as a strip has, or a list.
    const cases::Case fan = case_of(Topology::triangle_fan, kSix);
    EXPECT_EQ(bounds(fan, Query::input_vertices, Profile::direct3d), (CountBounds{6, 12}));
}

// One triangle of which clipping makes so many at least, and at most.
CountBounds clipped(const std::vector<glm::vec4>& pixels, Profile profile) {
    return bounds(case_of(Topology::triangle_list, pixels), Query::clipping_primitives, profile);
}

TEST(Statistics, ClippingLiesBetweenGuardBandAndViewport) {
    const std::vector<glm::vec4> inside = {{1, 1, 0.5F, 1}, {7, 1, 0.5F, 1}, {1, 7, 0.5F, 1}};
    EXPECT_EQ(clipped(inside, Profile::direct3d), (CountBounds{1, 1}));
    EXPECT_EQ(clipped(inside, Profile::vulkan), (CountBounds{1, kNoMost}));
    // Two corners lie beyond a border each: a quad or a pentagon, or not clipped.
    const std::vector<glm::vec4> beyond = {{1, 1, 0.5F, 1}, {20, 1, 0.5F, 1}, {1, 20, 0.5F, 1}};
    EXPECT_EQ(clipped(beyond, Profile::direct3d), (CountBounds{1, 3}));
    // Beyond a border alone it may be clipped away, beyond the near plane it must be.
    const std::vector<glm::vec4> beside = {{-9, 1, 0.5F, 1}, {-2, 1, 0.5F, 1}, {-2, 7, 0.5F, 1}};
    EXPECT_EQ(clipped(beside, Profile::direct3d), (CountBounds{0, 2}));
    const std::vector<glm::vec4> before = {{1, 1, -0.5F, 1}, {7, 1, -0.5F, 1}, {1, 7, -0.25F, 1}};
    EXPECT_EQ(clipped(before, Profile::direct3d), (CountBounds{0, 0}));
    EXPECT_EQ(clipped(before, Profile::vulkan), (CountBounds{0, kNoMost}));
    // Vulkan asks for a vertex inside and a sample: a triangle between all samples has none.
    const std::vector<glm::vec4> tiny = {{1, 1, 0.5F, 1}, {1.25F, 1, 0.5F, 1}, {1, 1.25F, 0.5F, 1}};
    EXPECT_EQ(clipped(tiny, Profile::vulkan).least, 0U);
    // All corners are outside, and the middle covers everything.
    const std::vector<glm::vec4> around = {
        {-20, -20, 0.5F, 1}, {60, -20, 0.5F, 1}, {-20, 60, 0.5F, 1}};
    EXPECT_EQ(clipped(around, Profile::vulkan).least, 0U);
}

// Below direct3d those that have no sample may be culled before.
TEST(Statistics, CulledTrianglesReachClipping) {
    cases::Case c =
        case_of(Topology::triangle_list, {{1, 1, 0.5F, 1}, {7, 1, 0.5F, 1}, {1, 7, 0.5F, 1}});
    EXPECT_EQ(bounds(c, Query::clipping_invocations, Profile::vulkan).least, 1U);
    c.draws[0].cull = cases::CullMode::front_and_back;
    EXPECT_EQ(bounds(c, Query::clipping_invocations, Profile::direct3d), (CountBounds{1, 1}));
    EXPECT_EQ(bounds(c, Query::clipping_invocations, Profile::practice).least, 0U);
    EXPECT_EQ(bounds(c, Query::clipping_primitives, Profile::vulkan).least, 0U);
    EXPECT_EQ(bounds(c, Query::clipping_primitives, Profile::direct3d), (CountBounds{1, 1}));
    c.draws[0].rasterizer_discard = true;
    EXPECT_EQ(bounds(c, Query::clipping_invocations, Profile::direct3d), (CountBounds{0, 1}));
    EXPECT_EQ(bounds(c, Query::clipping_primitives, Profile::direct3d), (CountBounds{0, 1}));
    EXPECT_EQ(bounds(c, Query::input_vertices, Profile::direct3d), (CountBounds{3, 3}));
}

// 28 pixels lie inside, 8 on the diagonal; the quads of a square of 8 pixels have 64.
TEST(Statistics, FragmentsAreThoseThatShow) {
    cases::Case c =
        case_of(Topology::triangle_list, {{0, 0, 0.5F, 1}, {8, 0, 0.5F, 1}, {0, 8, 0.5F, 1}});
    EXPECT_EQ(bounds(c, Query::fragment_invocations, Profile::direct3d), (CountBounds{28, 64}));
    EXPECT_EQ(bounds(c, Query::fragment_invocations, Profile::vulkan), (CountBounds{28, kNoMost}));
    const auto of_hits = [](uint32_t hits) {
        ShownSample out{true, {}, hits};
        out.paths.hits = {path::SeenHits::Detail::total, hits, 0};
        return out;
    };
    const auto shown = [&](size_t index) { return of_hits(index % 8 + index / 8 <= 7 ? 1 : 0); };
    EXPECT_EQ(bounds(c, Query::fragment_invocations, Profile::vulkan, shown).least, 36U);
    // A sample that is wrong, or not known, is no other finding.
    const auto lost = [&](size_t index) {
        return index == 0 || index == 9 ? ShownSample{false, {}, {}} : of_hits(1);
    };
    EXPECT_EQ(bounds(c, Query::fragment_invocations, Profile::practice, lost).least, 34U);
    // Those that are discarded once they are tested were shaded; what is not tested may be skipped.
    c.draws[0].discard = cases::Discard::checker;
    EXPECT_EQ(bounds(c, Query::fragment_invocations, Profile::vulkan).least, 16U);
    c.draws[0].early_tests = true;
    EXPECT_EQ(bounds(c, Query::fragment_invocations, Profile::practice).least, 28U);
    EXPECT_EQ(bounds(c, Query::fragment_invocations, Profile::vulkan).least, 16U);
}

// A sliver of 6 pixels whose area is more than a pixel, and which has no sample: a device may leave
// it out.
TEST(Statistics, ATriangleBetweenSamplesMayBeLeftOut) {
    const std::vector<glm::vec4> sliver = {
        {1, 1.5625F, 0.5F, 1}, {7, 1.5625F, 0.5F, 1}, {1, 2.4375F, 0.5F, 1}};
    EXPECT_EQ(clipped(sliver, Profile::direct3d), (CountBounds{0, 1}));
}

// However much lies over it: by its place, which on large targets vulkan does not promise.
TEST(Statistics, ATriangleWithASampleReachesClippingAndLeavesIt) {
    cases::Case c =
        case_of(Topology::triangle_list, {{1, 1, 0.5F, 1}, {7, 1, 0.5F, 1}, {1, 7, 0.5F, 1}});
    c.draws.push_back(c.draws[0]);
    c.draws.push_back(c.draws[0]);
    for (const Query query : {Query::clipping_invocations, Query::clipping_primitives}) {
        EXPECT_EQ(bounds(c, query, Profile::practice), (CountBounds{1, kNoMost}));
        EXPECT_EQ(bounds(c, query, Profile::vulkan).least, 0U);
        cases::Case masked = c;
        masked.draws[0].multisample.sample_mask = 2;
        EXPECT_EQ(bounds(masked, query, Profile::practice).least, 0U);
        cases::Case cut = c;
        cut.draws[0].scissor = {2, 0, 6, 8};
        EXPECT_EQ(bounds(cut, query, Profile::practice).least, 0U);
    }
}

// One corner lies before the near plane: two pieces, whose quads of helpers may count twice.
TEST(Statistics, PiecesOfAClippedTriangleShareQuads) {
    cases::Case c =
        case_of(Topology::triangle_list, {{0, 0, 0.5F, 1}, {8, 0, 0.5F, 1}, {0, 8, -0.25F, 1}});
    const CountBounds cut = bounds(c, Query::fragment_invocations, Profile::direct3d);
    EXPECT_EQ(cut.most, 128U);
    EXPECT_GT(cut.least, 0U);
}

TEST(Statistics, SamplesThatAreShadedOneByOneCountEach) {
    cases::Case c =
        case_of(Topology::triangle_list, {{0, 0, 0.5F, 1}, {16, 0, 0.5F, 1}, {0, 16, 0.5F, 1}});
    c.target.samples = 4;
    // Beyond two borders it may be cut into three pieces.
    EXPECT_EQ(bounds(c, Query::fragment_invocations, Profile::direct3d), (CountBounds{64, 192}));
    c.draws[0].multisample.min_sample_shading = 1;
    EXPECT_EQ(bounds(c, Query::fragment_invocations, Profile::direct3d), (CountBounds{256, 768}));
    c.draws[0].multisample.sample_mask = 5;
    EXPECT_EQ(bounds(c, Query::fragment_invocations, Profile::practice).least, 128U);
    EXPECT_EQ(bounds(c, Query::fragment_invocations, Profile::vulkan).least, 64U);
}

TEST(Statistics, NothingIsSaidOfNumbersThatAreNone) {
    cases::Case c =
        case_of(Topology::triangle_list, {{1, 1, 0.5F, 1}, {7, 1, 0.5F, 1}, {1, 7, 0.5F, 1}});
    c.draws[0].positions[1].x = std::nanf("");
    EXPECT_EQ(bounds(c, Query::clipping_primitives, Profile::direct3d), (CountBounds{0, kNoMost}));
    EXPECT_EQ(bounds(c, Query::clipping_invocations, Profile::direct3d), (CountBounds{1, 1}));
}

}  // namespace
}  // namespace ref::test
