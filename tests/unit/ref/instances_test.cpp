// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws of instances: their triangles by hand, the fast reference against the oracle, and both
// against the same triangles as draws of their own.
#include <gtest/gtest.h>

#include "cases/model/triangle.hpp"
#include "ref/coverage/exact/exact.hpp"
#include "ref/expectation/statistics.hpp"
#include "tests/unit/ref/coverage_random.hpp"
#include "tests/unit/ref/same_expectations.hpp"

namespace ref::test {
namespace {

// Gives a draw so many instances, moved by sixteenths of the target.
void spread(RandomCases& random, cases::Draw& d) {
    const std::vector<glm::vec4> base = std::move(d.positions);
    d.positions.clear();
    d.instances = static_cast<uint32_t>(random.integer(2, 4));
    d.first_instance = static_cast<uint32_t>(random.integer(0, 3));
    for (uint32_t i = 0; i < d.instances; ++i) {
        const auto sixteenths = [&] { return static_cast<float>(random.integer(-6, 6)) / 16; };
        const glm::vec4 by(sixteenths(), sixteenths(), random.flip() ? 0.0F : 0.125F, 0);
        for (const glm::vec4& p : base) {
            d.positions.push_back(p + by * p.w);
        }
    }
}

TEST(InstanceTriangles, CountAnewInEachInstance) {
    cases::Case c = blank(1, 1);
    cases::Draw d = whole(c);
    d.topology = cases::Topology::triangle_strip;
    d.positions.resize(10);  // five of each instance
    d.instances = 2;
    d.indices = {{0, 1, 2, 3, cases::kRestartIndex, 2, 3, 4}};
    d.primitive_restart = true;
    c.draws.push_back(d);
    const std::vector<cases::Triangle> all = assemble(c);
    std::vector<std::array<uint32_t, 3>> vertices;
    std::vector<uint32_t> primitives, provoking;
    for (const cases::Triangle& t : all) {
        vertices.push_back(t.vertex);
        primitives.push_back(t.primitive);
        provoking.push_back(t.provoking);
    }
    EXPECT_EQ(vertices, (std::vector<std::array<uint32_t, 3>>{
                            {0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {5, 6, 7}, {6, 8, 7}, {7, 8, 9}}));
    EXPECT_EQ(primitives, (std::vector<uint32_t>{0, 1, 2, 0, 1, 2}));
    EXPECT_EQ(provoking, (std::vector<uint32_t>{0, 1, 2, 5, 6, 7}));
}

// One draw for each instance of each draw.
cases::Case taken_apart(const cases::Case& c) {
    cases::Case out = c;
    out.draws.clear();
    for (const cases::Draw& draw : c.draws) {
        for (uint32_t i = 0; i < draw.instances; ++i) {
            cases::Draw& one = out.draws.emplace_back(draw);
            const auto count = static_cast<std::ptrdiff_t>(draw.vertex_count());
            one.instances = 1;
            one.first_instance = 0;
            one.positions.assign(draw.positions.begin() + i * count,
                                 draw.positions.begin() + (i + 1) * count);
        }
    }
    return out;
}

TEST(ExhaustiveInstanceOracle, DrawsWhatItsInstancesDrawOneByOne) {
    uint64_t decided = 0, several = 0;
    for (uint64_t seed = 1; seed <= 200; ++seed) {
        RandomCases random(seed);
        const Setting s = setting(random);
        cases::Case c = random.triangles();
        for (cases::Draw& draw : c.draws) {
            spread(random, draw);
        }
        const Expectation fast = expect(c, s.limits, s.profile);
        ASSERT_TRUE(same_expectations(fast, exact::expect(c, s.limits, s.profile)))
            << "seed " << seed;
        ASSERT_TRUE(same_expectations(fast, expect(taken_apart(c), s.limits, s.profile)))
            << "seed " << seed << ", taken apart";
        decided += fast.must_samples;
        for (size_t k = 0; k < fast.samples.size(); ++k) {
            several += fast.samples[k].hits.total_min > 1 ? 1U : 0U;
        }
    }
    EXPECT_GT(decided, 5000U);
    EXPECT_GT(several, 500U);  // where their order is seen
}

TEST(InstanceStatistics, CountAllInstances) {
    cases::Case c = blank(8, 8);
    cases::Draw d = whole(c);
    d.topology = cases::Topology::triangle_strip;
    for (uint32_t i = 0; i < 3; ++i) {
        for (const double x : {0.0, 4.0}) {
            for (const double y : {0.0, 4.0}) {
                d.positions.push_back(at_pixel(d, x + i, y, 1));
            }
        }
    }
    d.instances = 3;
    c.draws.push_back(d);
    const auto bounds = [&](cases::Query query) {
        c.draws[0].query = query;
        return statistic_bounds(c, 0, expect(c, Limits{}, cases::Profile::direct3d), ShownAt{});
    };
    EXPECT_EQ(bounds(cases::Query::input_vertices), (CountBounds{12, 12}));
    EXPECT_EQ(bounds(cases::Query::input_primitives), (CountBounds{6, 6}));
    EXPECT_EQ(bounds(cases::Query::vertex_invocations), (CountBounds{12, 18}));
    EXPECT_EQ(bounds(cases::Query::clipping_invocations), (CountBounds{6, 6}));
    EXPECT_EQ(bounds(cases::Query::clipping_primitives), (CountBounds{6, 6}));
}

}  // namespace
}  // namespace ref::test
