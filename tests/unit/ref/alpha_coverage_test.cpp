// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Alpha to coverage: what is left of a draw's coverage, by profile.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "cases/model/rule_ids.hpp"
#include "coverage_fixture.hpp"
#include "ref/expectation/explain.hpp"
#include "ref/stencil/values.hpp"
#include "tests/unit/ref/same_expectations.hpp"

namespace ref::test {
namespace {

using cases::Profile;

// A triangle with its right angle at the first pixel's corner, whose fragments have that alpha.
cases::Case with_alpha(float alpha, uint32_t samples = 4) {
    cases::Case c = blank(8, 8, samples);
    c.target.has_instruments = false;
    c.target.color = cases::ColorTarget{};
    cases::Draw draw = whole(c);
    for (const Point& p : {Point{0, 0}, Point{8, 0}, Point{0, 8}}) {
        draw.positions.push_back(at_pixel(draw, p[0], p[1]));
    }
    draw.color.value = {1, 0, 0, alpha};
    draw.color.alpha_to_coverage = true;
    c.draws.push_back(draw);
    return c;
}

// The hits that a sample inside the triangle may have, as "least to most"; of others there are none
// at any profile, and a device that lists samples one by one expects the same.
std::string hits_inside(const cases::Case& c, Profile profile) {
    const Expectation e = expect(c, Limits{}, profile);
    EXPECT_TRUE(same_expectations(e, exact::expect(c, Limits{}, profile)));
    cases::Case plain = c;
    plain.draws[0].color.alpha_to_coverage = false;
    const Expectation covered = expect(plain, Limits{}, profile);
    std::string seen;
    for (size_t k = 0; k < e.samples.size(); ++k) {
        const HitBounds& hits = e.samples[k].hits;
        if (covered.samples[k].hits.total_max == 0) {
            EXPECT_EQ(hits.total_max, 0U) << k;
        } else if (covered.samples[k].hits.total_min == 1) {
            const std::string here =
                std::to_string(hits.total_min) + " to " + std::to_string(hits.total_max);
            EXPECT_TRUE(seen.empty() || seen == here) << k << ": " << here;
            seen = here;
        }
    }
    return seen;
}

TEST(AlphaCoverage, TakesAnySampleWhereNoTextSaysWhich) {
    for (const float alpha : {-1.0F, 0.0F, 0.25F, 1.0F, 2.0F}) {
        EXPECT_EQ(hits_inside(with_alpha(alpha), Profile::vulkan), "0 to 1") << alpha;
        EXPECT_EQ(hits_inside(with_alpha(alpha), Profile::practice), "0 to 1") << alpha;
    }
    EXPECT_EQ(hits_inside(with_alpha(0.25F), Profile::direct3d), "0 to 1");
    // A mask of the shader's switches it off there, and of one sample nothing is said.
    cases::Case c = with_alpha(0);
    c.draws[0].multisample.shader_mask = 0xf;
    EXPECT_EQ(hits_inside(c, Profile::direct3d), "0 to 1");
    EXPECT_EQ(hits_inside(with_alpha(0, 1), Profile::direct3d), "0 to 1");
}

TEST(AlphaCoverage, HasEndsInDirect3d) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float alpha : {-3.0F, 0.0F, nan}) {
        EXPECT_EQ(hits_inside(with_alpha(alpha), Profile::direct3d), "0 to 0") << alpha;
    }
    for (const float alpha : {1.0F, 3.0F}) {
        EXPECT_EQ(hits_inside(with_alpha(alpha), Profile::direct3d), "1 to 1") << alpha;
    }
    // An alpha that is interpolated has an error.
    cases::Case c = with_alpha(1);
    cases::Attribute attribute;
    attribute.components = 4;
    attribute.values.assign(3, glm::vec4(1));
    c.draws[0].attributes.push_back(attribute);
    c.draws[0].color.attribute = 0;
    EXPECT_EQ(hits_inside(c, Profile::direct3d), "0 to 1");
}

TEST(AlphaCoverage, LeavesIntegersAsTheyAre) {
    for (const Profile profile : {Profile::vulkan, Profile::practice, Profile::direct3d}) {
        for (const float number : {0.0F, 1.0F, 200.0F}) {
            cases::Case c = with_alpha(number);
            c.target.color->format = cases::ColorFormat::rgba8_uint;
            EXPECT_EQ(hits_inside(c, profile), "1 to 1") << number;
        }
    }
}

TEST(AlphaCoverage, IsToldWithItsRule) {
    const auto told = [](const cases::Case& c, Profile profile) {
        const SampleExplanation e = explain_sample(c, Limits{}, profile, {1, 1, 0, 0});
        EXPECT_EQ(rule_of(e.triangles.at(0).why(), profile), cases::rule::sample_alpha_to_coverage);
        return e.triangles.at(0).sentence;
    };
    EXPECT_EQ(told(with_alpha(0), Profile::direct3d),
              "alpha to coverage leaves no sample of a fragment whose alpha is 0");
    EXPECT_EQ(told(with_alpha(1), Profile::direct3d),
              "inside the triangle, and alpha to coverage keeps all samples of a fragment whose "
              "output is of an alpha of 1");
    EXPECT_EQ(told(with_alpha(1), Profile::vulkan),
              "alpha to coverage may leave the sample out, by an algorithm of the device's own");
    cases::Case c = with_alpha(7);
    c.target.color->format = cases::ColorFormat::rgba8_uint;
    EXPECT_EQ(told(c, Profile::vulkan),
              "inside the triangle, and alpha to coverage keeps all samples of a fragment whose "
              "output is of integers");
}

// Along a shared edge of two such draws the sum of the hits is no longer one.
TEST(AlphaCoverage, OpensSharedEdges) {
    cases::Case c = with_alpha(0.5F);
    cases::Draw other = c.draws[0];
    other.positions.clear();
    for (const Point& p : {Point{8, 0}, Point{8, 8}, Point{0, 8}}) {
        other.positions.push_back(at_pixel(other, p[0], p[1]));
    }
    c.draws[0].positions.insert(c.draws[0].positions.end(), other.positions.begin(),
                                other.positions.end());
    for (const Profile profile : {Profile::vulkan, Profile::practice, Profile::direct3d}) {
        const Expectation e = expect(c, Limits{}, profile);
        EXPECT_TRUE(same_expectations(e, exact::expect(c, Limits{}, profile)));
        for (size_t k = 0; k < e.samples.size(); ++k) {
            ASSERT_EQ(e.samples[k].hits.total_min, 0U) << k;
        }
    }
}

// The same triangle again is there, whether alpha took the first away or not; and the first may be
// there where alpha takes the second away.
TEST(AlphaCoverage, SaysNothingOfTheSameTriangleAgain) {
    for (const size_t variant : {0U, 1U, 2U, 3U}) {
        const size_t open = variant % 2;
        cases::Case c = with_alpha(0.5F);
        c.target.has_depth = true;
        c.target.has_stencil = variant > 1;
        c.draws.push_back(c.draws[0]);
        c.draws[1 - open].color.alpha_to_coverage = false;
        for (cases::Draw& draw : c.draws) {
            draw.depth.compare = cases::CompareOp::not_equal;
            for (cases::StencilFace* face : {&draw.stencil.front, &draw.stencil.back}) {
                face->pass = cases::StencilOp::increment_and_clamp;
                face->depth_fail = cases::StencilOp::invert;
            }
        }
        const Expectation e = expect(c, Limits{}, Profile::direct3d);
        EXPECT_TRUE(same_expectations(e, exact::expect(c, Limits{}, Profile::direct3d)));
        const SampleExpectation& s = e.samples[0];
        // Depths are equal, so that the second fails where the first is there.
        const auto writers = e.writers_of(s);
        EXPECT_EQ(std::vector<uint32_t>(writers.begin(), writers.end()),
                  open == 0 ? (std::vector<uint32_t>{0, 1}) : (std::vector<uint32_t>{0}))
            << variant;
        EXPECT_TRUE(s.hits.total_max == 1 || !c.target.has_stencil) << variant;
        if (c.target.has_stencil) {
            // One is counted; a second one that is there fails by its depth and inverts that.
            EXPECT_EQ(path::values_of(e.stencils_of(s), s.is_free, 0, std::nullopt),
                      stencil::Values().set(1).set(0xfe))
                << variant;
        }
    }
}

}  // namespace
}  // namespace ref::test
