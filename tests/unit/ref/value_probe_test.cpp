// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// interpolateAt*, derivatives, levels of detail and barycentric order: what is accepted and what is
// not, by hand, and the filtered answer against the oracle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "ref/value/accept/probe.hpp"
#include "tests/share.hpp"
#include "value_case.hpp"

namespace {

using cases::Interpolation;
using cases::Probe;
using cases::Profile;

// (0,0), (8,0), (0,8) with w = 1, 1/2, 1 and f = 0, 16, 0 on 8 x 8 pixels: 1/w = 1 + x/8 and
// f/w = 4 x, so f = 32 x / (8 + x). At the centres x = 1/2, 3/2, 5/2: 32/17, 96/19, 160/21.
cases::Case hyperbola() {
    return value_test::make_case(
        8, {value_test::clip_of(0, 0, 0.5, 1, 8), value_test::clip_of(8, 0, 0.5, 0.5, 8),
            value_test::clip_of(0, 8, 0.5, 1, 8)});
}

void add_probe(cases::Case& c, Probe probe) {
    value_test::add_attribute(c, Interpolation::smooth, 1,
                              {glm::vec4(0), glm::vec4(16, 0, 0, 0), glm::vec4(0)});
    c.draws[0].attributes.back().probe = probe;
}

// f(x, y) = 16 x y / (...) needs a second direction: f = 0, 16, 8.
void add_slanted(cases::Case& c, Probe probe) {
    value_test::add_attribute(c, Interpolation::smooth, 1,
                              {glm::vec4(0), glm::vec4(16, 0, 0, 0), glm::vec4(8, 0, 0, 0)});
    c.draws[0].attributes.back().probe = probe;
}

bool accepts(const cases::Case& c, std::initializer_list<double> values, Profile profile,
             cases::SampleId id = {1, 1, 0}) {
    ref::ValueReference reference(c, ref::Limits{}, profile);
    ref::FragmentValues device = value_test::rounded(reference.expected(0, id));
    size_t a = 0;
    for (const double v : values) {
        device.attributes[a++].x = static_cast<float>(v);
    }
    const bool ok = reference.judge(0, id, device).ok;
    EXPECT_EQ(reference.judge_exact(0, id, device).ok, ok);
    return ok;
}

double f_at(double x) {
    return 32 * x / (8 + x);
}

TEST(ValueProbe, AFineDerivativeIsOneOfTwoDifferences) {
    for (const Profile profile : cases::kProfiles) {
        cases::Case c = hyperbola();
        add_probe(c, Probe::dx_fine);
        EXPECT_TRUE(accepts(c, {f_at(1.5) - f_at(0.5)}, profile));
        EXPECT_TRUE(accepts(c, {f_at(2.5) - f_at(1.5)}, profile));
        EXPECT_FALSE(accepts(c, {(f_at(2.5) - f_at(0.5)) / 2}, profile));  // central
        EXPECT_FALSE(accepts(c, {256 / (9.5 * 9.5)}, profile));            // the limit
        EXPECT_FALSE(accepts(c, {f_at(0.5) - f_at(1.5)}, profile));        // the sign
        EXPECT_FALSE(accepts(c, {0}, profile));
        EXPECT_FALSE(accepts(c, {std::numeric_limits<double>::quiet_NaN()}, profile));
    }
}

// g = (4 x + y) / (1 + x/8), from f = 0, 16, 8.
double g_at(double x, double y) {
    return (4 * x + y) / (1 + x / 8);
}

TEST(ValueProbe, CoarseMayTakeTheOtherRowFineMayNot) {
    const double own = g_at(1.5, 1.5) - g_at(0.5, 1.5);
    const double other = g_at(1.5, 0.5) - g_at(0.5, 0.5);
    const double below = g_at(1.5, 2.5) - g_at(0.5, 2.5);
    const double far = g_at(1.5, 3.5) - g_at(0.5, 3.5);
    for (const Profile profile : cases::kProfiles) {
        for (const Probe probe : {Probe::dx_fine, Probe::dx_coarse, Probe::dx}) {
            cases::Case c = hyperbola();
            add_slanted(c, probe);
            const bool is_coarse = probe != Probe::dx_fine;
            EXPECT_TRUE(accepts(c, {own}, profile));
            EXPECT_EQ(accepts(c, {other}, profile), is_coarse);
            EXPECT_EQ(accepts(c, {below}, profile), is_coarse);
            EXPECT_FALSE(accepts(c, {far}, profile));
        }
    }
}

TEST(ValueProbe, OneQuadExplainsTheFragment) {
    const double left = f_at(1.5) - f_at(0.5);
    const double right = f_at(2.5) - f_at(1.5);
    for (const Profile profile : cases::kProfiles) {
        cases::Case c = hyperbola();
        add_probe(c, Probe::dx_fine);
        add_probe(c, Probe::dx_coarse);
        EXPECT_TRUE(accepts(c, {left, left}, profile));
        EXPECT_TRUE(accepts(c, {right, right}, profile));
        EXPECT_FALSE(accepts(c, {left, right}, profile));
        EXPECT_FALSE(accepts(c, {right, left}, profile));
    }
}

TEST(ValueProbe, PlainDerivativesAreBothCoarseOrBothFine) {
    // The pixel (1,1) as the last of its quad. dy changes with x, dx with y.
    const double fine_x = g_at(1.5, 1.5) - g_at(0.5, 1.5);
    const double coarse_x = g_at(1.5, 0.5) - g_at(0.5, 0.5);
    cases::Case c = hyperbola();
    add_slanted(c, Probe::dx);
    add_slanted(c, Probe::dx_fine);
    EXPECT_TRUE(accepts(c, {fine_x, fine_x}, Profile::vulkan));
    EXPECT_TRUE(accepts(c, {coarse_x, fine_x}, Profile::vulkan));
    EXPECT_FALSE(accepts(c, {coarse_x, coarse_x}, Profile::vulkan));
}

TEST(ValueProbe, AWidthIsTheSumOfMagnitudes) {
    const double x = g_at(1.5, 1.5) - g_at(0.5, 1.5);
    const double y = g_at(1.5, 1.5) - g_at(1.5, 0.5);
    for (const Profile profile : cases::kProfiles) {
        cases::Case c = hyperbola();
        add_slanted(c, Probe::width_fine);
        EXPECT_TRUE(accepts(c, {x + y}, profile));
        EXPECT_FALSE(accepts(c, {x}, profile));
        EXPECT_FALSE(accepts(c, {std::hypot(x, y)}, profile));
        EXPECT_FALSE(accepts(c, {-x - y}, profile));
    }
}

// A helper pixel where the denominator vanishes: nothing is promised, not even a number.
TEST(ValueProbe, BeyondTheHorizonNothingIsAsked) {
    // 1/w = 1 - x/4 on (0,0), (3,0), (0,3): the centre 3.5 of pixel 3 is near, 4.5 beyond it.
    cases::Case c = value_test::make_case(
        8, {value_test::clip_of(0, 0, 0.5, 1, 8), value_test::clip_of(3.75, 0, 0.5, 16, 8),
            value_test::clip_of(0, 8, 0.5, 1, 8)});
    add_probe(c, Probe::dx_fine);
    const cases::SampleId id{3, 0, 0};
    for (const double v : {0.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_TRUE(accepts(c, {v}, Profile::direct3d, id));
    }
}

TEST(ValueProbe, OffsetsAreRoundedInEitherDirectionOrNotAtAll) {
    const auto with_offset = [](float offset) {
        cases::Case c = hyperbola();
        value_test::add_attribute(c, Interpolation::noperspective, 1,
                                  {glm::vec4(0), glm::vec4(8, 0, 0, 0), glm::vec4(0)});
        c.draws[0].attributes.back().probe = Probe::at_offset;
        c.draws[0].attributes.back().probe_offset = {offset, 0};
        return c;
    };
    for (const Profile profile : cases::kProfiles) {
        cases::Case c = with_offset(0.25F);  // f = x
        EXPECT_TRUE(accepts(c, {1.75}, profile));
        EXPECT_FALSE(accepts(c, {1.5}, profile));
        EXPECT_FALSE(accepts(c, {1.8125}, profile));
        c = with_offset(3.0F / 64);
        EXPECT_TRUE(accepts(c, {1.5}, profile));
        EXPECT_TRUE(accepts(c, {1.5625}, profile));
        EXPECT_TRUE(accepts(c, {1.546875}, profile));
        EXPECT_FALSE(accepts(c, {1.4375}, profile));
        EXPECT_FALSE(accepts(c, {1.625}, profile));
        EXPECT_EQ(accepts(c, {1.53125}, profile), profile != Profile::direct3d);
    }
}

// A report tells an error in budgets: of what is accepted never more than K (a hundredth more for
// the denominator's own error), and up to K of what is accepted last.
TEST(ValueProbe, WhatIsAcceptedIsWithinItsBudgets) {
    for (const Probe probe : {Probe::at_offset, Probe::dx, Probe::width}) {
        cases::Case c = value_test::make_case(
            12, {value_test::clip_of(1, 1, 0.5, 1, 12), value_test::clip_of(11, 2, 0.5, 4, 12),
                 value_test::clip_of(2, 11, 0.5, 2, 12)});
        value_test::add_attribute(
            c, Interpolation::smooth, 1,
            {glm::vec4(1, 0, 0, 0), glm::vec4(4, 0, 0, 0), glm::vec4(-2, 0, 0, 0)});
        c.draws[0].attributes[0].probe = probe;
        c.draws[0].attributes[0].probe_offset = {0, 0.1875F};
        for (const Profile profile : cases::kProfiles) {
            ref::ValueReference reference(c, ref::Limits{4}, profile);
            double most = 0;
            for (const cases::SampleId id : {cases::SampleId{9, 2, 0}, {5, 4, 0}, {3, 9, 0}}) {
                const ref::FragmentValues exact = value_test::rounded(reference.expected(0, id));
                for (const float sign : {1.0F, -1.0F}) {
                    const auto judged = [&](float moved) {
                        ref::FragmentValues device = exact;
                        device.attributes[0].x += sign * moved;
                        return reference.judge(0, id, device);
                    };
                    float right = 0;
                    float wrong = 2;
                    ASSERT_TRUE(judged(right).ok);
                    ASSERT_FALSE(judged(wrong).ok);
                    for (int k = 0; k < 30; ++k) {
                        const float middle = (right + wrong) / 2;
                        const ref::FragmentVerdict verdict = judged(middle);
                        if (verdict.worst_ratio > 1) {
                            EXPECT_EQ(verdict.worst_quantity, ref::QuantityId::of_attribute(0, 0));
                        }
                        if (verdict.ok) {
                            EXPECT_LE(verdict.worst_ratio, 1.01 * ref::budget_factor(profile));
                        }
                        (verdict.ok ? right : wrong) = middle;
                    }
                    most = std::max(most, judged(right).worst_ratio);
                }
            }
            EXPECT_GE(most, 0.6 * ref::budget_factor(profile)) << static_cast<int>(profile);
        }
    }
}

// 1 part in 10^5 is 167.77 units u = 2^-24.
TEST(ValueProbe, FindingsTellTheProfilesFactor) {
    EXPECT_EQ(ref::exact_budget_factor(Profile::vulkan), mpq_class("4194304/3125"));
    for (const Profile profile : cases::kProfiles) {
        for (const Probe probe : {Probe::value, Probe::at_offset}) {
            cases::Case c = hyperbola();
            add_probe(c, probe);
            ref::ValueReference reference(c, ref::Limits{}, profile);
            ref::FragmentValues device = value_test::rounded(reference.expected(0, {1, 1, 0}));
            device.attributes[0].x += 1;
            const ref::FragmentVerdict verdict = reference.judge(0, {1, 1, 0}, device);
            ASSERT_EQ(verdict.mismatches.size(), 1U);
            const std::string& text = verdict.mismatches[0].expected;
            EXPECT_NE(text.find(profile == Profile::vulkan ? " within 1342 x " : " within 2 x "),
                      std::string::npos)
                << text;
        }
    }
}

// What is accepted of a level is no number of budgets: neither explain nor a report tells one.
TEST(ValueProbe, LevelsOfDetailAreToldWithTheirFreedom) {
    for (const Profile profile : cases::kProfiles) {
        cases::Case c = hyperbola();
        value_test::add_attribute(c, Interpolation::smooth, 2,
                                  {glm::vec4(0), glm::vec4(1, 0, 0, 0), glm::vec4(0, 1, 0, 0)});
        c.draws[0].attributes.back().probe = Probe::lod;
        c.draws[0].attributes.back().texture_size = {32, 32};
        ref::ValueReference reference(c, ref::Limits{}, profile);
        size_t levels = 0;
        for (const ref::ExpectedValue& e : reference.expected(0, {1, 1, 0})) {
            if (e.quantity.is_attribute()) {
                ++levels;
                EXPECT_EQ(e.factor, 0) << to_text(e.quantity);
                EXPECT_EQ(e.also, "or up to half a level and the freedom of the quad away");
            } else if (!e.is_flat) {
                EXPECT_EQ(e.factor, ref::budget_factor(profile)) << to_text(e.quantity);
            }
        }
        EXPECT_EQ(levels, 2U);
    }
}

TEST(ValueProbe, LevelsOfDetailLieInTheSpecifiedRange) {
    // s = x / 8, t = y / 8 on a texture of 32 x 32: m = 4 each, log2 4 = 2 to 2 + 1/2.
    cases::Case c = hyperbola();
    c.draws[0].positions[1] = value_test::clip_of(8, 0, 0.5, 1, 8);
    value_test::add_attribute(c, Interpolation::smooth, 2,
                              {glm::vec4(0), glm::vec4(1, 0, 0, 0), glm::vec4(0, 1, 0, 0)});
    cases::Attribute& a = c.draws[0].attributes.back();
    a.probe = Probe::lod;
    a.texture_size = {32, 32};
    const auto accepts_lod = [&](double level, double lambda) {
        ref::ValueReference reference(c, ref::Limits{}, Profile::direct3d);
        const cases::SampleId id{1, 1, 0};
        ref::FragmentValues device = value_test::rounded(reference.expected(0, id));
        device.attributes[0] = {static_cast<float>(level), static_cast<float>(lambda), 0, 0};
        const bool ok = reference.judge(0, id, device).ok;
        EXPECT_EQ(reference.judge_exact(0, id, device).ok, ok);
        return ok;
    };
    EXPECT_TRUE(accepts_lod(2, 2));
    EXPECT_TRUE(accepts_lod(2.5, 2.5));
    EXPECT_TRUE(accepts_lod(2, 1.95));
    EXPECT_FALSE(accepts_lod(2, 1.9));
    EXPECT_FALSE(accepts_lod(2, 2.6));
    EXPECT_FALSE(accepts_lod(1.5, 2));
    EXPECT_FALSE(accepts_lod(3, 2));
    EXPECT_FALSE(accepts_lod(2, std::numeric_limits<double>::quiet_NaN()));
    a.texture_size = {2, 2};  // m = 1/4: magnified, level 0; one level above it
    EXPECT_TRUE(accepts_lod(0, -2));
    EXPECT_FALSE(accepts_lod(-2, -2));
    a.texture_size = {1, 32};  // log2 4 = 2 from v alone
    EXPECT_TRUE(accepts_lod(2, 2));
    EXPECT_FALSE(accepts_lod(0, -3));
}

TEST(ValueProbe, LevelsOfDetailMayEndWhereNoBiasSelectsALevel) {
    // s = x scale on a texture of 4 x 4: m = 4 scale, so lambda' is log2(scale) + 2, to 1/2 more.
    cases::Case c = hyperbola();
    c.draws[0].positions[1] = value_test::clip_of(8, 0, 0.5, 1, 8);
    Profile profile = Profile::direct3d;
    const auto accepts_lod = [&](float scale, double level, double lambda) {
        c.draws[0].attributes.clear();
        value_test::add_attribute(c, Interpolation::smooth, 2,
                                  {glm::vec4(0), glm::vec4(8 * scale, 0, 0, 0), glm::vec4(0)});
        cases::Attribute& a = c.draws[0].attributes.back();
        a.probe = Probe::lod;
        a.texture_size = {4, 4};
        ref::ValueReference reference(c, ref::Limits{}, profile);
        const cases::SampleId id{1, 1, 0};
        ref::FragmentValues device = value_test::rounded(reference.expected(0, id));
        device.attributes[0] = {static_cast<float>(level), static_cast<float>(lambda), 0, 0};
        const bool ok = reference.judge(0, id, device).ok;
        EXPECT_EQ(reference.judge_exact(0, id, device).ok, ok);
        return ok;
    };
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    // Nothing differs: log2 of 0.
    EXPECT_TRUE(accepts_lod(0, 0, -kInfinity));
    EXPECT_TRUE(accepts_lod(0, 0, -63.5));
    EXPECT_TRUE(accepts_lod(0, 0, -16));
    EXPECT_FALSE(accepts_lod(0, 0, -15.9));
    EXPECT_FALSE(accepts_lod(0, 0, 0));
    EXPECT_FALSE(accepts_lod(0, 0, kInfinity));
    // lambda' = -58: no end may be below it.
    EXPECT_TRUE(accepts_lod(0x1p-60F, 0, -58));
    EXPECT_TRUE(accepts_lod(0x1p-60F, 0, -31.75));
    EXPECT_FALSE(accepts_lod(0x1p-60F, 0, -63.5));
    EXPECT_FALSE(accepts_lod(0x1p-60F, 0, -15));
    EXPECT_FALSE(accepts_lod(0x1p-60F, 1, -58));
    // lambda' = 62, the texture's last level is 2.
    EXPECT_TRUE(accepts_lod(0x1p60F, 2, 62));
    EXPECT_TRUE(accepts_lod(0x1p60F, 2, 18));
    EXPECT_FALSE(accepts_lod(0x1p60F, 2, 17.9));
    EXPECT_FALSE(accepts_lod(0x1p60F, 2, 64));
    EXPECT_FALSE(accepts_lod(0x1p60F, 3, 62));
    // Vulkan's bias may be of 2 levels alone.
    profile = Profile::vulkan;
    EXPECT_TRUE(accepts_lod(0x1p60F, 2, 4));
    EXPECT_FALSE(accepts_lod(0x1p60F, 2, 3.9));
    EXPECT_FALSE(accepts_lod(0x1p60F, 2, 64));
    profile = Profile::practice;
    EXPECT_FALSE(accepts_lod(0x1p60F, 2, 17.9));
    profile = Profile::direct3d;
    // What is in range has no other end.
    EXPECT_FALSE(accepts_lod(0x1p-10F, 0, -16));
    EXPECT_FALSE(accepts_lod(0x1p10F, 2, 18));
}

TEST(ValueProbe, BarycentricOrderByTopologyAndProvokingVertex) {
    // The expected component of each vertex of the second triangle, whose own vertices are 1, 2, 3
    // (strip: primitive {1,3,2}; fan: {2,3,0}). Vulkan, tables of "Barycentric Interpolation".
    struct Row {
        cases::Topology topology;
        cases::ProvokingVertex provoking;
        std::array<uint32_t, 3> order;
    };
    const Row rows[] = {
        {cases::Topology::triangle_strip, cases::ProvokingVertex::first, {1, 3, 2}},
        {cases::Topology::triangle_strip, cases::ProvokingVertex::last, {2, 1, 3}},
        {cases::Topology::triangle_fan, cases::ProvokingVertex::first, {2, 3, 0}},
        {cases::Topology::triangle_fan, cases::ProvokingVertex::last, {0, 2, 3}},
    };
    for (const Row& row : rows) {
        cases::Case c = hyperbola();
        cases::Draw& draw = c.draws[0];
        draw.topology = row.topology;
        draw.provoking = row.provoking;
        draw.positions.push_back(value_test::clip_of(8, 8, 0.5, 1, 8));
        cases::Attribute a;
        a.source = cases::Source::barycentric;
        a.components = 3;
        draw.attributes = {a};
        const auto triangles = cases::assemble(c);
        const auto primitive = ref::value::make_primitive(c, triangles[1]);
        for (uint32_t k = 0; k < 3; ++k) {
            const auto values = ref::value::attribute_values(primitive, 0, k);
            for (size_t i = 0; i < 3; ++i) {
                EXPECT_EQ(values[i] > 0, triangles[1].vertex[i] == row.order[k]);
            }
        }
    }
}

// Random triangles, probes and deviations up to a few budgets: both ways agree on every fragment.
TEST(ExhaustiveValueProbe, FilterAgreesWithTheOracle) {
    std::mt19937_64 rng(21);
    constexpr Probe kProbes[] = {Probe::at_sample,  Probe::at_offset,   Probe::dx,
                                 Probe::dy,         Probe::dx_fine,     Probe::dy_fine,
                                 Probe::dx_coarse,  Probe::dy_coarse,   Probe::width,
                                 Probe::width_fine, Probe::width_coarse};
    uint64_t accepted = 0, rejected = 0;
    const int triangles = test_support::rounds(36);
    for (int n = 0; n < triangles; ++n) {
        auto s = value_test::random_case(rng, 64, static_cast<value_test::Shape>(n % 3),
                                         n % 4 < 2 ? 0 : 8);
        for (cases::Attribute& a : s.c.draws[0].attributes) {
            if (a.interpolation != Interpolation::flat) {
                a.probe = kProbes[rng() % std::size(kProbes)];
                a.probe_offset = {static_cast<float>(rng() % 15) / 16.0F - 0.5F, 3.0F / 64};
            }
        }
        const Profile profile = cases::kProfiles[static_cast<size_t>(n) % 3];
        ref::ValueReference reference(s.c, ref::Limits{}, profile);
        const cases::SampleId id = s.inside.front();
        const auto expected = reference.expected(0, id);
        for (int k = 0; k < 8; ++k) {
            ref::FragmentValues device = value_test::rounded(expected);
            for (const ref::ExpectedValue& e : expected) {
                if (e.quantity.is_attribute() && e.part.empty() && !e.is_flat && k > 0) {
                    const double off =
                        e.budget * 0.5 * k * (static_cast<double>(rng() % 2001) / 1000 - 1);
                    number_of(device, e.quantity) = static_cast<float>(e.nearest + off);
                }
            }
            const auto fast = reference.judge(0, id, device);
            const auto exact = reference.judge_exact(0, id, device);
            EXPECT_EQ(fast.ok, exact.ok) << "triangle " << n << ", device " << k;
            accepted += exact.ok ? 1U : 0U;
            rejected += exact.ok ? 0U : 1U;
        }
    }
    EXPECT_GT(accepted, static_cast<uint64_t>(triangles) * 5 / 3);
    EXPECT_GT(rejected, static_cast<uint64_t>(triangles) * 5 / 6);
}

}  // namespace
