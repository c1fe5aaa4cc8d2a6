// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/model/triangle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "ref/number/fixed_point.hpp"
#include "tests/unit/ref/coverage_fixture.hpp"

namespace ref::test {
namespace {

using Numbers = std::array<uint32_t, 3>;

std::vector<Numbers> vertices(cases::Topology topology, size_t positions,
                              std::optional<std::vector<uint32_t>> indices = {},
                              bool has_restart = false) {
    cases::Case c = blank(1, 1);
    cases::Draw d = whole(c);
    d.topology = topology;
    d.positions.resize(positions);
    d.indices = std::move(indices);
    d.primitive_restart = has_restart;
    c.draws.push_back(d);
    std::vector<Numbers> out;
    uint32_t primitive = 0;
    for (const cases::Triangle& t : assemble(c)) {
        EXPECT_EQ(t.provoking, t.vertex[0]);
        EXPECT_EQ(t.primitive, primitive++);
        out.push_back(t.vertex);
    }
    return out;
}

TEST(Assemble, Topologies) {
    using enum cases::Topology;
    EXPECT_EQ(vertices(triangle_list, 7), (std::vector<Numbers>{{0, 1, 2}, {3, 4, 5}}));
    EXPECT_EQ(vertices(triangle_strip, 6),
              (std::vector<Numbers>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}}));
    EXPECT_EQ(vertices(triangle_fan, 5), (std::vector<Numbers>{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
    EXPECT_TRUE(vertices(triangle_strip, 2).empty());
    EXPECT_TRUE(vertices(triangle_list, 0).empty());
}

TEST(Assemble, IndicesAndRestart) {
    using enum cases::Topology;
    constexpr uint32_t kCut = cases::kRestartIndex;
    EXPECT_EQ(vertices(triangle_list, 4, {{3, 2, 1, 0}}), (std::vector<Numbers>{{3, 2, 1}}));
    EXPECT_EQ(vertices(triangle_strip, 7, {{0, 1, 2, 3, kCut, 4, 5, kCut, 4, 5, 6}}, true),
              (std::vector<Numbers>{{0, 1, 2}, {1, 3, 2}, {4, 5, 6}}));
    EXPECT_EQ(vertices(triangle_list, 5, {{3, 4, kCut, 0, 1, 2, 4, kCut, kCut, 2, 3, 4}}, true),
              (std::vector<Numbers>{{0, 1, 2}, {2, 3, 4}}));
    EXPECT_EQ(vertices(triangle_fan, 6, {{0, 1, 2, kCut, kCut, 3, 4, 5}}, true),
              (std::vector<Numbers>{{1, 2, 0}, {4, 5, 3}}));
}

TEST(Assemble, LastProvokingVertexChangesNothingElse) {
    const auto provoking = [](cases::Topology topology, cases::ProvokingVertex mode) {
        cases::Case c = blank(1, 1);
        cases::Draw d = whole(c);
        d.topology = topology;
        d.provoking = mode;
        d.positions.resize(6);
        c.draws.push_back(d);
        std::vector<uint32_t> out;
        for (const cases::Triangle& t : assemble(c)) {
            out.push_back(t.provoking);
            EXPECT_NE(std::find(t.vertex.begin(), t.vertex.end(), t.provoking), t.vertex.end());
        }
        c.draws[0].provoking = cases::ProvokingVertex::first;
        const std::vector<cases::Triangle> first = assemble(c);
        c.draws[0].provoking = mode;
        const std::vector<cases::Triangle> same = assemble(c);
        for (size_t k = 0; k < first.size(); ++k) {
            EXPECT_EQ(first[k].vertex, same[k].vertex);
            EXPECT_EQ(first[k].primitive, same[k].primitive);
        }
        return out;
    };
    using enum cases::Topology;
    using enum cases::ProvokingVertex;
    using List = std::vector<uint32_t>;
    EXPECT_EQ(provoking(triangle_list, first), (List{0, 3}));
    EXPECT_EQ(provoking(triangle_list, last), (List{2, 5}));
    EXPECT_EQ(provoking(triangle_strip, first), (List{0, 1, 2, 3}));
    EXPECT_EQ(provoking(triangle_strip, last), (List{2, 3, 4, 5}));
    EXPECT_EQ(provoking(triangle_fan, first), (List{1, 2, 3, 4}));
    EXPECT_EQ(provoking(triangle_fan, last), (List{2, 3, 4, 5}));
}

TEST(Samples, StandardLocationsAreDistinctAndOnTheFourBitGrid) {
    for (const uint32_t samples : {1U, 2U, 4U, 8U, 16U}) {
        ASSERT_EQ(cases::standard_sample_locations(samples).size(), samples);
        std::set<std::array<uint8_t, 2>> seen;
        int sum_x = 0;
        for (const auto& l : cases::standard_sample_locations(samples)) {
            seen.insert(l);
            sum_x += l[0];
            EXPECT_LT(l[0], 16);
            EXPECT_LT(l[1], 16);
        }
        EXPECT_EQ(seen.size(), samples);
        EXPECT_NEAR(sum_x / static_cast<double>(samples), 8, 0.51);
    }
    // Sample 1 of 4 lies at (0.875, 0.375).
    EXPECT_EQ(sample_position(2, 3, 1, {8, 8, 4}),
              (FixedPoint{2 * kFixedOne + 57344, 3 * kFixedOne + 24576}));
    EXPECT_EQ(sample_position(0, 0, 0, {8, 8, 1}), (FixedPoint{32768, 32768}));
}

TEST(Samples, TheTargetsOwnLocationsTakeTheStandardOnesPlace) {
    cases::Target target{8, 8, 2};
    target.sample_locations = {{1, 15}, {0, 7}};
    EXPECT_EQ(sample_position(1, 0, 0, target), (FixedPoint{kFixedOne + 4096, 61440}));
    EXPECT_EQ(sample_position(1, 2, 1, target), (FixedPoint{kFixedOne, 2 * kFixedOne + 28672}));
}

TEST(Samples, BothMasksLetASampleThrough) {
    EXPECT_TRUE(cases::is_in_mask({}, 15));
    EXPECT_FALSE(cases::is_in_mask({5U, {}, {}}, 1));
    EXPECT_TRUE(cases::is_in_mask({5U, {}, {}}, 2));
    EXPECT_FALSE(cases::is_in_mask({5U, 3U, {}}, 2));
    EXPECT_TRUE(cases::is_in_mask({5U, 3U, {}}, 0));
}

}  // namespace
}  // namespace ref::test
