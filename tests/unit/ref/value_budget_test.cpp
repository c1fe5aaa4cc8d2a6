// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Budgets worked by hand: coordinates of either sign, points outside of the triangle, and the hull
// of a clipped polygon at profile vulkan.
#include <gtest/gtest.h>

#include <algorithm>

#include "ref/value/accept/judge_candidates.hpp"
#include "value_case.hpp"

namespace {

using cases::Interpolation;
using cases::Profile;
using value_test::add_attribute;
using value_test::clip_of;
using value_test::make_case;

// Of attribute 0, noperspective, in units of 2^-24.
double budget_at(const cases::Case& c, cases::SampleId id) {
    const auto all = ref::ValueReference(c, ref::Limits{}, Profile::direct3d).expected(0, id);
    const auto it = std::find_if(all.begin(), all.end(), [](const ref::ExpectedValue& e) {
        return to_text(e.quantity) == "attribute 0.x";
    });
    return it == all.end() ? 0 : it->budget * 0x1p24;
}

const std::array<glm::vec4, 3> kZeroOneTwo = {glm::vec4(0.0F), glm::vec4(1.0F), glm::vec4(2.0F)};

TEST(ValueBudget, NegativeCoordinatesCountFromEndToEnd) {
    // (60,60), (-60,60), (60,-60): differences of 120 though no coordinate is larger than 60.
    // D = 2, 1, 1; S_2 = 2*2 + 1 = 5; budget 2*5 + 2.
    cases::Case c =
        make_case(64, {glm::vec4(0.9375F, 0.9375F, 0, 1), glm::vec4(-0.9375F, 0.9375F, 0, 1),
                       glm::vec4(0.9375F, -0.9375F, 0, 1)});
    c.draws[0].viewport = {-64, -64, 128, 128, 0, 1};
    add_attribute(c, Interpolation::noperspective, 1, kZeroOneTwo);
    EXPECT_NEAR(budget_at(c, {0, 0, 0}), 12, 1e-9);
    // The same shifted so that it starts at the origin has the same budget.
    c.draws[0].viewport = {-4, -4, 128, 128, 0, 1};
    EXPECT_NEAR(budget_at(c, {63, 63, 0}), 12, 1e-9);
}

TEST(ValueBudget, GrowsWithTheExtrapolation) {
    // At (40.5,40.5): b = -9.125, 5.0625, 5.0625; sum |b| = 19.25. D = 10.125, 5.0625, 5.0625;
    // S_2 = 2*10.125 + 5.0625; budget (2 S_2 + 2) * 19.25.
    cases::Case c =
        make_case(64, {clip_of(0, 0, 0, 1, 64), clip_of(8, 0, 0, 1, 64), clip_of(0, 8, 0, 1, 64)});
    c.target.samples = 4;
    add_attribute(c, Interpolation::noperspective, 1, kZeroOneTwo);
    EXPECT_NEAR(budget_at(c, {40, 40, 0}), 52.625 * 19.25, 1e-9);
}

TEST(ValueBudget, HullOfAClippedPolygonHasTheErrorsOfTheProfile) {
    // Cut at x = w, half way between w = 1 and w = 3: a vertex with w = 2.
    cases::Case c = make_case(
        64, {glm::vec4(-1, 0, 0.5F, 1), glm::vec4(5, 0, 0.5F, 3), glm::vec4(-1, 1, 0.5F, 1)});
    add_attribute(c, Interpolation::smooth, 1, kZeroOneTwo);
    const auto triangles = cases::assemble(c);
    const auto primitive = ref::value::make_primitive(c, triangles[0]);
    ASSERT_TRUE(primitive.needs_clipping);
    const auto quantities = ref::value::quantities(c.draws[0], c.target);
    const auto slack = [&](Profile profile) {
        const auto set = ref::value::make_candidates<mpq_class>(
            primitive, std::span<const ref::value::Quantity>(quantities), ref::Limits{}, profile);
        std::array<double, 2> out{};  // of 1/w, which is within [1/2, 1], and of the attribute
        for (size_t i = 0; i < quantities.size(); ++i) {
            if (quantities[i].id == ref::QuantityId::of_frag_coord(3)) {
                out[0] = mpq_class(mpq_class(1, 2) - set.hulls[i].low).get_d();
            } else if (quantities[i].id == ref::QuantityId::of_attribute(0, 0)) {
                out[1] = mpq_class(set.hulls[i].high - 2).get_d();
            }
        }
        return out;
    };
    // 1/w of the new vertex: w is off by 8 roundings of the larger w, 3, relative to 2.
    const auto wide = slack(Profile::vulkan);
    EXPECT_GE(wide[0], 8e-5 * 3 / 2 / 2);
    EXPECT_LE(wide[0], 1e-3);
    EXPECT_GE(wide[1], 1e-5);
    EXPECT_LE(wide[1], 1e-3);
    const auto narrow = slack(Profile::practice);
    EXPECT_GE(narrow[0], 8 * 0x1p-24 * 3 / 2 / 2);
    EXPECT_LE(narrow[0], 1e-5);
    EXPECT_LE(narrow[1], 1e-5);
}

}  // namespace
