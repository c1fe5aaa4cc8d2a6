// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Cases worked by hand, and an independent implementation of Brown's equations in rationals.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "value_case.hpp"

namespace {

using cases::Interpolation;
using cases::Profile;
using ref::ExpectedValue;
using value_test::add_attribute;
using value_test::clip_of;
using value_test::make_case;
using value_test::rounded;

ref::ValueReference reference_of(const cases::Case& c, Profile profile = Profile::direct3d) {
    return {c, ref::Limits{}, profile};
}

const ExpectedValue& find(const std::vector<ExpectedValue>& all, const std::string& name) {
    const auto it = std::find_if(all.begin(), all.end(),
                                 [&](const ExpectedValue& e) { return to_text(e) == name; });
    if (it == all.end()) {
        throw std::runtime_error("no quantity " + name);
    }
    return *it;
}

// Vertices (0,0) w=1, (8,0) w=2, (0,8) w=1; attribute 0 at the first, 1 at the second, 2 at the
// third.
cases::Case brown_case() {
    cases::Case c =
        make_case(8, {clip_of(0, 0, 0.25, 1, 8), clip_of(8, 0, 0.5, 2, 8), clip_of(0, 8, 1, 1, 8)});
    add_attribute(c, Interpolation::smooth, 1, {glm::vec4(0.0F), glm::vec4(1.0F), glm::vec4(2.0F)});
    add_attribute(c, Interpolation::noperspective, 1,
                  {glm::vec4(0.0F), glm::vec4(1.0F), glm::vec4(2.0F)});
    add_attribute(c, Interpolation::flat, 1, {glm::vec4(1.5F), glm::vec4(-2.5F), glm::vec4(3.5F)});
    return c;
}

TEST(ValueHand, BrownEquationFour) {
    const cases::Case c = brown_case();
    ref::ValueReference reference = reference_of(c);
    // Pixel (3,0), p = (7/2, 1/2): b1 = 7/16, b2 = 1/16, b0 = 1/2.
    // D = 1/2 + 7/32 + 1/16 = 25/32; N = 7/32 + 1/8 = 11/32.
    const auto all = reference.expected(0, {3, 0, 0});
    EXPECT_EQ(find(all, "frag_coord.w").exact, "25/32");
    EXPECT_EQ(find(all, "attribute 0.x").exact, "11/25");
    EXPECT_EQ(find(all, "attribute 1.x").exact, "9/16");  // 7/16 + 2/16
    // z: 1/2 * 1/4 + 7/16 * 1/2 + 1/16 = 13/32.
    EXPECT_EQ(find(all, "depth").exact, "13/32");
    EXPECT_EQ(find(all, "frag_coord.z").exact, "13/32");
    EXPECT_EQ(find(all, "frag_coord.x").exact, "7/2");
    EXPECT_EQ(find(all, "frag_coord.y").exact, "1/2");
    EXPECT_EQ(find(all, "attribute 2.x").exact, "3/2");
    EXPECT_TRUE(find(all, "attribute 2.x").is_flat);
}

TEST(ValueHand, MidpointOfWOneToTwoIsAThird) {
    // Half way on screen between w = 1 (value 0) and w = 2 (value 1): (1/2 * 1/2) / (3/4) = 1/3.
    cases::Case c = make_case(16, {clip_of(0.5, 0.5, 0, 1, 16), clip_of(8.5, 0.5, 0, 2, 16),
                                   clip_of(0.5, 8.5, 0, 1, 16)});
    add_attribute(c, Interpolation::smooth, 1, {glm::vec4(0.0F), glm::vec4(1.0F), glm::vec4(0.0F)});
    ref::ValueReference reference = reference_of(c);
    EXPECT_EQ(find(reference.expected(0, {4, 0, 0}), "attribute 0.x").exact, "1/3");
}

TEST(ValueHand, EqualWIsLinear) {
    for (const float w : {0.25F, 1.0F, 3.0F}) {
        cases::Case c =
            make_case(8, {clip_of(0, 0, 0, w, 8), clip_of(8, 0, 0, w, 8), clip_of(0, 8, 0, w, 8)});
        const std::array<glm::vec4, 3> g = {glm::vec4(0.3F), glm::vec4(-7.0F), glm::vec4(11.0F)};
        add_attribute(c, Interpolation::smooth, 1, g);
        add_attribute(c, Interpolation::noperspective, 1, g);
        ref::ValueReference reference = reference_of(c);
        const auto all = reference.expected(0, {2, 3, 0});
        EXPECT_EQ(find(all, "attribute 0.x").exact, find(all, "attribute 1.x").exact) << w;
    }
}

TEST(ValueHand, BarycentricsSumToOne) {
    std::mt19937_64 rng(7);
    for (int n = 0; n < 300; ++n) {
        auto s = value_test::random_case(rng, 64, value_test::Shape::large, 6);
        s.c.draws[0].attributes.clear();
        const std::array<glm::vec4, 3> unit = {glm::vec4(1, 0, 0, 0), glm::vec4(0, 1, 0, 0),
                                               glm::vec4(0, 0, 1, 0)};
        add_attribute(s.c, Interpolation::smooth, 3, unit);
        add_attribute(s.c, Interpolation::noperspective, 3, unit);
        ref::ValueReference reference = reference_of(s.c);
        const auto all = reference.expected(0, s.inside[0]);
        for (const std::string a : {"attribute 0.", "attribute 1."}) {
            mpq_class sum;
            for (const char axis : {'x', 'y', 'z'}) {
                const mpq_class b(find(all, a + axis).exact);
                EXPECT_GT(b, 0);
                sum += b;
            }
            EXPECT_EQ(sum, 1);
        }
    }
}

TEST(ValueHand, VertexBehindTheEyeKeepsThePlane) {
    // The triangle of a plane: attribute = x_c in clip space, so f = x_c exactly wherever it shows;
    // x_d = x_c / w and w follow from the pixel. Vertex 2 has w = -1.
    cases::Case c = make_case(8, {glm::vec4(-0.5F, 0.5F, 0.5F, 1), glm::vec4(0.5F, 0.5F, 0.5F, 1),
                                  glm::vec4(0, 0, 0.5F, -1)});
    add_attribute(c, Interpolation::smooth, 2,
                  {glm::vec4(-0.5F, 1, 0, 0), glm::vec4(0.5F, 1, 0, 0), glm::vec4(0, -1, 0, 0)});
    ref::ValueReference reference = reference_of(c);
    const cases::SampleId id{4, 7, 0};
    const auto all = reference.expected(0, id);
    const mpq_class x_c(find(all, "attribute 0.x").exact);
    const mpq_class w(find(all, "attribute 0.y").exact);
    EXPECT_GT(w, 0);
    EXPECT_EQ(x_c / w, mpq_class(1, 8));  // x_d of pixel centre 4.5 of 8
    EXPECT_EQ(mpq_class(find(all, "frag_coord.w").exact), 1 / w);
    EXPECT_TRUE(reference.judge(0, id, rounded(all)).ok);
}

TEST(ValueHand, ExactValuesRoundedOncePass) {
    const cases::Case c = brown_case();
    for (const Profile profile : cases::kProfiles) {
        ref::ValueReference reference = reference_of(c, profile);
        const cases::SampleId id{3, 0, 0};
        const ref::FragmentVerdict verdict =
            reference.judge(0, id, rounded(reference.expected(0, id)));
        EXPECT_TRUE(verdict.ok);
        EXPECT_LT(verdict.worst_ratio, 0.5);
    }
}

// Values are moved one by one, within a budget, by half a
// budget more and far beyond what is accepted.
TEST(ValueHand, TheLargestErrorIsThatOfTheValueThatWasMoved) {
    const cases::Case c = brown_case();
    const cases::SampleId id{3, 0, 0};
    ref::ValueReference reference = reference_of(c, Profile::direct3d);
    const std::vector<ref::ExpectedValue> all = reference.expected(0, id);
    EXPECT_LT(reference.judge(0, id, rounded(all)).worst_ratio, 0.5);
    size_t moved = 0;
    for (size_t k = 0; k < all.size(); ++k) {
        if (all[k].is_flat || all[k].factor <= 0) {
            continue;
        }
        ++moved;
        for (const double budgets : {0.9, 1.5, 40.0}) {
            std::vector<ref::ExpectedValue> other = all;
            other[k].nearest += budgets * all[k].budget;
            const ref::FragmentValues device = rounded(other);
            for (const ref::FragmentVerdict& verdict :
                 {reference.judge(0, id, device), reference.judge_exact(0, id, device)}) {
                EXPECT_EQ(verdict.ok, budgets < 2) << to_text(all[k].quantity);
                EXPECT_NEAR(verdict.worst_ratio, budgets, 0.6) << to_text(all[k].quantity);
                EXPECT_EQ(verdict.worst_quantity, all[k].quantity);
            }
        }
    }
    EXPECT_EQ(moved, 5U);  // z, w, depth, two inputs
    ref::FragmentValues device = rounded(all);
    device.attributes[2].x += 1;
    EXPECT_EQ(reference.judge(0, id, device).worst_quantity, ref::QuantityId::of_attribute(2, 0));
}

// A bad number of one vertex leaves its own component free and no other, in both implementations.
TEST(ValueHand, BadNumbersOfAVertexFreeTheirComponentAlone) {
    for (const float bad :
         {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        cases::Case c = make_case(
            8, {clip_of(0, 0, 0.25, 1, 8), clip_of(8, 0, 0.5, 2, 8), clip_of(0, 8, 1, 1, 8)});
        add_attribute(c, Interpolation::smooth, 2,
                      {glm::vec4(0, 0, 0, 0), glm::vec4(bad, 1, 0, 0), glm::vec4(1, 2, 0, 0)});
        const cases::SampleId id{3, 0, 0};
        for (const Profile profile : cases::kProfiles) {
            ref::ValueReference reference = reference_of(c, profile);
            ref::FragmentValues device = rounded(reference.expected(0, id));
            for (const float any : {0.0F, bad, -7.0F}) {
                device.attributes[0].x = any;
                EXPECT_TRUE(reference.judge(0, id, device).ok);
                EXPECT_TRUE(reference.judge_exact(0, id, device).ok);
            }
            device.attributes[0].y += 0.25F;
            for (const ref::FragmentVerdict& verdict :
                 {reference.judge(0, id, device), reference.judge_exact(0, id, device)}) {
                ASSERT_EQ(verdict.mismatches.size(), 1U);
                EXPECT_EQ(to_text(verdict.mismatches[0].quantity), "attribute 0.y");
            }
        }
    }
}

// Judges the brown case with one value replaced; returns the single mismatch.
ref::ValueMismatch mismatch_of(const cases::Case& c, Profile profile, cases::SampleId id,
                               const std::function<void(ref::FragmentValues&)>& change) {
    ref::ValueReference reference = reference_of(c, profile);
    ref::FragmentValues values = rounded(reference.expected(0, id));
    change(values);
    const ref::FragmentVerdict verdict = reference.judge(0, id, values);
    const ref::FragmentVerdict exact = reference.judge_exact(0, id, values);
    EXPECT_EQ(verdict.ok, exact.ok);
    EXPECT_EQ(verdict.mismatches.size(), exact.mismatches.size());
    if (verdict.mismatches.size() != 1) {
        ADD_FAILURE() << verdict.mismatches.size() << " mismatches instead of one";
        return {};
    }
    return verdict.mismatches.front();
}

TEST(ValueHand, RulesAndLevels) {
    const cases::Case c = brown_case();
    const cases::SampleId id{3, 0, 0};
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();

    auto m = mismatch_of(c, Profile::direct3d, id, [&](auto& v) { v.attributes[0].x = nan; });
    EXPECT_EQ(m.rule, "interp.hull");
    EXPECT_EQ(m.level, Profile::vulkan);
    EXPECT_EQ(to_text(m.quantity), "attribute 0.x");
    m = mismatch_of(c, Profile::vulkan, id, [&](auto& v) { v.depth = inf; });
    EXPECT_EQ(m.rule, "interp.hull");
    EXPECT_EQ(m.level, Profile::vulkan);
    m = mismatch_of(c, Profile::vulkan, id, [&](auto& v) { v.attributes[0].x = 2.5F; });
    EXPECT_EQ(m.rule, "interp.hull");
    EXPECT_EQ(m.level, Profile::vulkan);
    // 1e-4 off: more than binary32 can be, less than 8 operations of 1e-5 each.
    m = mismatch_of(c, Profile::direct3d, id, [&](auto& v) { v.attributes[0].x += 1e-4F; });
    EXPECT_EQ(m.rule, "interp.perspective");
    EXPECT_EQ(m.level, Profile::practice);
    m = mismatch_of(c, Profile::direct3d, id, [&](auto& v) { v.attributes[1].x += 1e-4F; });
    EXPECT_EQ(m.rule, "interp.linear");
    EXPECT_EQ(m.level, Profile::practice);
    m = mismatch_of(c, Profile::direct3d, id, [&](auto& v) { v.depth += 1e-4F; });
    EXPECT_EQ(m.rule, "depth.linear");
    m = mismatch_of(c, Profile::direct3d, id, [&](auto& v) { v.frag_coord.w += 1e-4F; });
    EXPECT_EQ(m.rule, "fragcoord.w");
    EXPECT_EQ(m.level, Profile::practice);
    // The affine value 9/16 instead of 11/25 is wrong at every level.
    m = mismatch_of(c, Profile::direct3d, id, [&](auto& v) { v.attributes[0].x = 0.5625F; });
    EXPECT_EQ(m.rule, "interp.perspective");
    EXPECT_EQ(m.level, Profile::vulkan);
    m = mismatch_of(c, Profile::vulkan, id, [&](auto& v) { v.frag_coord.x = 3.0F; });
    EXPECT_EQ(m.rule, "fragcoord.xy");
    EXPECT_EQ(m.level, Profile::vulkan);
    m = mismatch_of(c, Profile::vulkan, id, [&](auto& v) { v.attributes[2].x = 3.5F; });
    EXPECT_EQ(m.rule, "provoking.first");
    m = mismatch_of(c, Profile::vulkan, id,
                    [&](auto& v) { v.attributes[2].x = std::nextafter(1.5F, 2.0F); });
    EXPECT_EQ(m.rule, "interp.flat");
    // At vulkan the 1e-4 is allowed.
    ref::ValueReference loose = reference_of(c, Profile::vulkan);
    ref::FragmentValues v = rounded(loose.expected(0, id));
    v.attributes[0].x += 1e-4F;
    EXPECT_TRUE(loose.judge(0, id, v).ok);
}

TEST(ValueHand, FlatSpecialValues) {
    cases::Case c = brown_case();
    const float denormal = 0x1p-140F;
    c.draws[0].attributes[2].values = {glm::vec4(denormal), glm::vec4(1.0F), glm::vec4(2.0F)};
    const cases::SampleId id{3, 0, 0};
    ref::ValueReference reference = reference_of(c);
    ref::FragmentValues v = rounded(reference.expected(0, id));
    v.attributes[2].x = 0.0F;
    EXPECT_TRUE(reference.judge(0, id, v).ok);
    v.attributes[2].x = denormal;
    EXPECT_TRUE(reference.judge(0, id, v).ok);
    v.attributes[2].x = 1.0F;
    EXPECT_FALSE(reference.judge(0, id, v).ok);
}

TEST(ValueHand, NonFiniteTriangleIsNotJudged) {
    cases::Case c = brown_case();
    c.draws[0].positions[1].x = std::numeric_limits<float>::quiet_NaN();
    ref::ValueReference reference = reference_of(c);
    EXPECT_TRUE(reference.judge(0, {3, 0, 0}, {}).ok);
    EXPECT_TRUE(reference.expected(0, {3, 0, 0}).empty());
}

// 1/w = 2^50, or f/w = 2^40, is more than Vulkan guarantees: wrong at practice, not at vulkan. What
// stays within 2^32 is asked as ever.
TEST(ValueHand, BeyondTwoToThe32IsLeftToPractice) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const auto judged = [](float w, float f, Profile profile, const auto& spoil) {
        cases::Case c = make_case(64, {clip_of(4, 4, 0.5, static_cast<double>(w), 64),
                                       clip_of(60, 4, 0.5, static_cast<double>(w), 64),
                                       clip_of(4, 60, 0.5, static_cast<double>(w), 64)});
        add_attribute(c, Interpolation::smooth, 1, {glm::vec4(f), glm::vec4(f), glm::vec4(f)});
        auto reference = reference_of(c, profile);
        ref::FragmentValues values = rounded(reference.expected(0, {10, 10, 0}));
        EXPECT_TRUE(reference.judge(0, {10, 10, 0}, values).ok);
        spoil(values);
        ref::FragmentVerdict verdict = reference.judge(0, {10, 10, 0}, values);
        EXPECT_EQ(verdict.ok, reference.judge_exact(0, {10, 10, 0}, values).ok);
        return verdict;
    };
    const auto no_w = [&](ref::FragmentValues& v) { v.frag_coord.w = -kInfinity; };
    const auto no_attribute = [&](ref::FragmentValues& v) { v.attributes[0].x = kInfinity; };
    const auto level = [](const ref::FragmentVerdict& v) {
        return v.mismatches.size() == 1 ? v.mismatches[0].level : Profile::direct3d;
    };
    EXPECT_TRUE(judged(0x1p-50F, 1, Profile::vulkan, no_w).ok);
    EXPECT_EQ(level(judged(0x1p-50F, 1, Profile::practice, no_w)), Profile::practice);
    EXPECT_EQ(level(judged(0x1p-50F, 1, Profile::direct3d, no_w)), Profile::practice);
    EXPECT_EQ(level(judged(0x1p-30F, 1, Profile::direct3d, no_w)), Profile::vulkan);
    EXPECT_TRUE(judged(0x1p-30F, 1024, Profile::vulkan, no_attribute).ok);
    EXPECT_FALSE(judged(0x1p-30F, 1024, Profile::vulkan, no_w).ok);
    EXPECT_EQ(level(judged(0x1p-30F, 1024, Profile::direct3d, no_attribute)), Profile::practice);
}

TEST(ValueHand, TriangleWithoutAreaClaimsTheHullOnly) {
    cases::Case c = make_case(
        8, {clip_of(1, 1, 0.5, 1, 8), clip_of(2, 2, 0.5, 1, 8), clip_of(4, 4, 0.5, 1, 8)});
    add_attribute(c, Interpolation::smooth, 1, {glm::vec4(1.0F), glm::vec4(2.0F), glm::vec4(3.0F)});
    ref::ValueReference reference = reference_of(c);
    ref::FragmentValues v;
    v.frag_coord = {2.5F, 2.5F, 0.5F, 1.0F};
    v.depth = 0.5F;
    v.attributes[0].x = 2.25F;
    EXPECT_TRUE(reference.judge(0, {2, 2, 0}, v).ok);
    v.attributes[0].x = 3.5F;
    const ref::FragmentVerdict verdict = reference.judge(0, {2, 2, 0}, v);
    ASSERT_EQ(verdict.mismatches.size(), 1U);
    EXPECT_EQ(verdict.mismatches[0].rule, "interp.hull");
    // At vulkan the positions may be off by 1e-5: slivers, on which binary32 promises nothing.
    EXPECT_EQ(verdict.mismatches[0].level, Profile::practice);
}

// Attribute and depth grow with x, so a value tells where it was evaluated.
TEST(ValueHand, MultisampledPositions) {
    cases::Case c =
        make_case(8, {clip_of(0, 0, 0, 1, 8), clip_of(8, 0, 1, 1, 8), clip_of(0, 8, 0, 1, 8)});
    c.target.samples = 4;
    const std::array<glm::vec4, 3> x = {glm::vec4(0.0F), glm::vec4(8.0F), glm::vec4(0.0F)};
    add_attribute(c, Interpolation::noperspective, 1, x);
    add_attribute(c, Interpolation::smooth, 1, x);
    // Sample 0 of pixel (3,2) is at (3.375, 2.125).
    const cases::SampleId id{3, 2, 0};
    const auto ok = [&](Profile profile, float a, float b, float coord_z, float depth) {
        ref::ValueReference reference = reference_of(c, profile);
        ref::FragmentValues v;
        v.frag_coord = {3.5F, 2.5F, coord_z / 8, 1.0F};
        v.depth = depth / 8;
        v.attributes[0].x = a;
        v.attributes[1].x = b;
        EXPECT_EQ(reference.judge(0, id, v).ok, reference.judge_exact(0, id, v).ok);
        return reference.judge(0, id, v).ok;
    };
    EXPECT_TRUE(ok(Profile::direct3d, 3.5F, 3.5F, 3.5F, 3.375F));
    EXPECT_TRUE(ok(Profile::direct3d, 3.5F, 3.5F, 3.375F, 3.375F));
    // At the sample: only with sample shading, which this draw has not turned on.
    EXPECT_FALSE(ok(Profile::direct3d, 3.375F, 3.375F, 3.375F, 3.375F));
    EXPECT_FALSE(ok(Profile::direct3d, 3.5F, 3.375F, 3.5F, 3.375F));  // two positions
    EXPECT_FALSE(ok(Profile::direct3d, 3.5F, 3.5F, 3.5F, 3.5F));      // depth at the centre
    EXPECT_FALSE(ok(Profile::direct3d, 3.25F, 3.25F, 3.5F, 3.375F));  // elsewhere in the pixel
    EXPECT_TRUE(ok(Profile::practice, 3.25F, 3.25F, 3.5F, 3.375F));
    EXPECT_FALSE(ok(Profile::practice, 4.25F, 4.25F, 3.5F, 3.375F));  // the next pixel
    EXPECT_FALSE(ok(Profile::vulkan, 4.25F, 4.25F, 3.5F, 3.375F));
}

}  // namespace
