// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a profile asks for less than a plane's value: extrapolated depth, denominators that may be
// zero, positions and quotients of which nothing is promised; and the level of what is wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "value_case.hpp"

namespace {

using cases::Interpolation;
using cases::Profile;
using value_test::add_attribute;
using value_test::clip_of;
using value_test::make_case;
using value_test::rounded;

constexpr float kUnbounded = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// The verdict of both ways, which have to agree.
bool is_ok(const cases::Case& c, Profile profile, cases::SampleId id,
           const ref::FragmentValues& device) {
    ref::ValueReference reference(c, ref::Limits{}, profile);
    const ref::FragmentVerdict verdict = reference.judge(0, id, device);
    EXPECT_EQ(verdict.ok, reference.judge_exact(0, id, device).ok);
    return verdict.ok;
}

ref::FragmentValues exact_values(const cases::Case& c, cases::SampleId id) {
    return rounded(ref::ValueReference(c, ref::Limits{}, Profile::direct3d).expected(0, id));
}

// Only the snapped triangle covers the sample (10.5,10.5); its plane is at 1.115 there.
cases::Case beyond_the_far_plane() {
    return make_case(
        64, {clip_of(10.5270349, 10.4446434, 0, 1, 64), clip_of(10.4182075, 10.6308283, 1, 1, 64),
             clip_of(10.5141262, 10.4759869, 1, 1, 64)});
}

TEST(ExhaustiveValueFreedom, DepthMayBeClampedToTheViewport) {
    const cases::SampleId id{10, 10, 0};
    cases::Case c = beyond_the_far_plane();
    ref::FragmentValues v = exact_values(c, id);
    ASSERT_GT(v.depth, 1.05F);
    for (const Profile profile : {Profile::practice, Profile::direct3d}) {
        ref::FragmentValues device = v;
        EXPECT_TRUE(is_ok(c, profile, id, device));
        device.depth = 1;
        EXPECT_TRUE(is_ok(c, profile, id, device));
        device.frag_coord.z = 1;
        // Not what is written, so never clamped; at practice this sliver's planes may be any.
        EXPECT_EQ(is_ok(c, profile, id, device), profile == Profile::practice);
    }
    v.depth = 0.9375F;
    EXPECT_FALSE(is_ok(c, Profile::direct3d, id, v));
    v.depth = 0;
    EXPECT_FALSE(is_ok(c, Profile::direct3d, id, v));
    // The other end, and a range that runs backwards.
    for (auto& position : c.draws[0].positions) {
        position.z = 1 - position.z;
    }
    v = exact_values(c, id);
    ASSERT_LT(v.depth, -0.05F);
    v.depth = 0;
    EXPECT_TRUE(is_ok(c, Profile::direct3d, id, v));
    c.draws[0].viewport.min_depth = 0.75F;
    c.draws[0].viewport.max_depth = 0.25F;
    v = exact_values(c, id);
    ASSERT_GT(v.depth, 0.775F);
    v.depth = 0.75F;
    EXPECT_TRUE(is_ok(c, Profile::direct3d, id, v));
    v.depth = 0.25F;
    EXPECT_FALSE(is_ok(c, Profile::direct3d, id, v));
    v.depth = 1;
    EXPECT_FALSE(is_ok(c, Profile::direct3d, id, v));
}

TEST(ExhaustiveValueFreedom, DepthBeyondTheViewportIsUndefinedAtVulkan) {
    const cases::SampleId id{10, 10, 0};
    const cases::Case c = beyond_the_far_plane();
    ref::FragmentValues v = exact_values(c, id);
    for (const float depth : {0.0F, 0.5F, 1.0F, kUnbounded, kNan}) {
        v.depth = depth;
        EXPECT_TRUE(is_ok(c, Profile::vulkan, id, v)) << depth;
        EXPECT_EQ(is_ok(c, Profile::direct3d, id, v), depth >= 1 && depth <= 1) << depth;
    }
    // Inside of the range it is asked for, on its border too.
    for (const double z : {0.0, 0.5, 1.0}) {
        const cases::Case flat = make_case(
            64, {clip_of(4, 4, z, 1, 64), clip_of(60, 4, z, 1, 64), clip_of(4, 60, z, 1, 64)});
        v = exact_values(flat, id);
        EXPECT_TRUE(is_ok(flat, Profile::vulkan, id, v));
        v.depth = kNan;
        EXPECT_FALSE(is_ok(flat, Profile::vulkan, id, v));
        v.depth = 0.75F;
        EXPECT_FALSE(is_ok(flat, Profile::vulkan, id, v));
    }
}

// z_f is 1/4 + 0.6/2 = 0.55, so e = -1 and r = 2^-24: the bias of 2^24 r is 1 in either direction.
TEST(ExhaustiveValueFreedom, BiasedDepthMayBeClampedToZeroAndOne) {
    const cases::SampleId id{10, 10, 0};
    cases::Case c = make_case(
        64, {clip_of(4, 4, 0.6, 1, 64), clip_of(60, 4, 0.6, 1, 64), clip_of(4, 60, 0.6, 1, 64)});
    c.draws[0].viewport.min_depth = 0.25F;
    c.draws[0].viewport.max_depth = 0.75F;
    for (const bool is_down : {true, false}) {
        c.draws[0].depth.clamp = false;
        c.draws[0].depth.bias = cases::DepthBias{is_down ? -0x1p24F : 0x1p24F, 0, 0};
        ref::FragmentValues v = exact_values(c, id);
        const float unclamped = is_down ? -0.45F : 1.55F;
        const float end = is_down ? 0.25F : 0.75F;  // of the viewport's range
        const float unit = is_down ? 0.0F : 1.0F;
        for (const Profile profile : {Profile::practice, Profile::direct3d}) {
            for (const float depth : {unclamped, end, unit}) {
                ref::FragmentValues device = v;
                device.depth = depth;
                EXPECT_TRUE(is_ok(c, profile, id, device)) << depth;
            }
            // Between them, at the other ends, and without the bias.
            for (const float depth :
                 {(unclamped + unit) / 2, (end + unit) / 2, 1 - end, 1 - unit, 0.55F}) {
                ref::FragmentValues device = v;
                device.depth = depth;
                EXPECT_FALSE(is_ok(c, profile, id, device)) << depth;
            }
        }
        // With depth clamp the viewport's range is the only one.
        c.draws[0].depth.clamp = true;
        v = exact_values(c, id);
        v.depth = end;
        EXPECT_TRUE(is_ok(c, Profile::practice, id, v));
        v.depth = unit;
        EXPECT_FALSE(is_ok(c, Profile::practice, id, v));
    }
}

// 8 operations of 1e-5 on coordinates of 2000 are more than 1/w itself.
TEST(ExhaustiveValueFreedom, DenominatorsThatMayBeZeroLeaveTheHull) {
    cases::Case small =
        make_case(2048, {clip_of(2000, 2000, 0.5, 1, 2048), clip_of(2001, 2000, 0.5, 1, 2048),
                         clip_of(2000, 2001, 0.5, 1, 2048)});
    add_attribute(small, Interpolation::smooth, 1,
                  {glm::vec4(1.0F), glm::vec4(2.0F), glm::vec4(3.0F)});
    // Corners of the boxes of this sliver have planes of 1/w that are negative at the sample.
    cases::Case sliver =
        make_case(64, {clip_of(10.001, 10.4995, 0.5, 1, 64), clip_of(50.003, 10.5005, 0.5, 100, 64),
                       clip_of(30.002, 10.5003, 0.5, 1, 64)});
    add_attribute(sliver, Interpolation::smooth, 1,
                  {glm::vec4(1.0F), glm::vec4(2.0F), glm::vec4(3.0F)});
    struct Asked {
        const cases::Case* c;
        Profile profile;
        cases::SampleId id;
    };
    for (const Asked& asked : {Asked{&small, Profile::vulkan, {2000, 2000, 0}},
                               Asked{&sliver, Profile::practice, {30, 10, 0}}}) {
        ref::FragmentValues v = exact_values(*asked.c, asked.id);
        EXPECT_TRUE(is_ok(*asked.c, asked.profile, asked.id, v));
        for (const float inside : {1.0F, 2.0F, 3.0F}) {
            v.attributes[0].x = inside;
            EXPECT_TRUE(is_ok(*asked.c, asked.profile, asked.id, v)) << inside;
        }
        for (const float wrong : {1e30F, -1e30F, 1e6F, kUnbounded, kNan}) {
            v.attributes[0].x = wrong;
            EXPECT_FALSE(is_ok(*asked.c, asked.profile, asked.id, v)) << wrong;
        }
    }
}

// 1/w is 8 (x - zero), and the triangle begins an eighth to the right of that: the centre of the
// pixel whose sample at 8.875 is covered lies outside.
TEST(ExhaustiveValueFreedom, CentresOutsideMayDivideByZero) {
    const cases::SampleId id{8, 8, 1};
    for (const double zero : {8.5, 8.625}) {
        cases::Case c = make_case(
            16, {clip_of(zero + 0.125, 4, 0.5, 1, 16), clip_of(zero + 0.125, 13, 0.5, 1, 16),
                 clip_of(zero + 4, 8.5, 0.5, 1.0 / 32, 16)});
        c.target.samples = 4;
        add_attribute(c, Interpolation::smooth, 1,
                      {glm::vec4(1.0F), glm::vec4(2.0F), glm::vec4(3.0F)});
        ref::FragmentValues v = exact_values(c, id);
        for (const float any : {1.5F, 1e30F, -1e30F, kUnbounded, -kUnbounded, kNan}) {
            v.attributes[0].x = any;
            // Only the centre is asked for at direct3d, and there 1/w is 0, or -1.
            const bool is_number = std::isfinite(any);
            EXPECT_EQ(is_ok(c, Profile::direct3d, id, v), is_number || zero < 8.6) << any;
            EXPECT_TRUE(is_ok(c, Profile::practice, id, v)) << any;
            EXPECT_TRUE(is_ok(c, Profile::vulkan, id, v)) << any;
        }
    }
}

// Where primitives are enlarged the one sample is the centre, covered and outside of the triangle.
// 1/w is 0 there, or it is by the snapped vertices alone, or -1. At direct3d all values are of one
// basis: FragCoord.w says which.
TEST(ExhaustiveValueFreedom, EnlargedPrimitivesMayDivideByZero) {
    const cases::SampleId id{8, 8, 0};
    constexpr double kBySnappedAlone = 8.5 + 1.0 / 1024;
    for (const double zero : {8.5, kBySnappedAlone, 8.625}) {
        const bool is_by_all = zero < kBySnappedAlone;
        cases::Case c = make_case(
            16, {clip_of(zero + 0.125, 4, 0.5, 1, 16), clip_of(zero + 0.125, 13, 0.5, 1, 16),
                 clip_of(zero + 4, 8.5, 0.5, 1.0 / 32, 16)});
        c.draws[0].conservative = cases::Conservative::overestimate;
        add_attribute(c, Interpolation::smooth, 1,
                      {glm::vec4(1.0F), glm::vec4(2.0F), glm::vec4(3.0F)});
        ref::FragmentValues v = exact_values(c, id);
        ref::FragmentValues snapped = v;
        snapped.frag_coord.w = zero < 8.6 ? 0 : v.frag_coord.w;
        for (const float any : {1.5F, 1e30F, kUnbounded, -kUnbounded, kNan}) {
            v.attributes[0].x = any;
            snapped.attributes[0].x = any;
            const bool is_number = std::isfinite(any);
            for (const Profile profile : cases::kProfiles) {
                EXPECT_EQ(is_ok(c, profile, id, snapped), is_number || zero < 8.6) << any;
            }
            EXPECT_EQ(is_ok(c, Profile::practice, id, v), is_number || zero < 8.6) << any;
            EXPECT_EQ(is_ok(c, Profile::direct3d, id, v), is_number || is_by_all) << any;
        }
    }
}

// Every numeric value spoilt.
ref::FragmentValues spoilt(float x, float y, float with) {
    ref::FragmentValues v;
    v.frag_coord = {x, y, with, with};
    v.depth = with;
    v.attributes[0] = glm::vec4(with);
    return v;
}

TEST(ExhaustiveValueFreedom, NothingIsPromisedOfZeroOrDenormalW) {
    const glm::vec4 left(-1, -1, 0.5F, 1), right(1, -1, 0.5F, 1);
    for (const float w : {0.0F, 0x1p-130F, -0x1p-130F, -0.0F}) {
        cases::Case c = make_case(64, {glm::vec4(0, 0, 0, w), left, right});
        add_attribute(c, Interpolation::smooth, 1,
                      {glm::vec4(1.0F), glm::vec4(2.0F), glm::vec4(3.0F)});
        for (const Profile profile : cases::kProfiles) {
            for (const float value : {kNan, kUnbounded, 1e30F, 0.0F}) {
                EXPECT_TRUE(is_ok(c, profile, {32, 10, 0}, spoilt(32.5F, 10.5F, value)))
                    << w << " " << value;
            }
            EXPECT_FALSE(is_ok(c, profile, {32, 10, 0}, spoilt(32, 10.5F, 0)));
        }
    }
}

TEST(ExhaustiveValueFreedom, NothingIsPromisedOfQuotientsBeyondBinary32) {
    const auto judged = [](float f, float got, Profile profile) {
        cases::Case c =
            make_case(64, {clip_of(4, 4, 0.5, 0x1p-20, 64), clip_of(60, 4, 0.5, 0x1p-20, 64),
                           clip_of(4, 60, 0.5, 0x1p-20, 64)});
        for (const Interpolation i : {Interpolation::smooth, Interpolation::noperspective}) {
            add_attribute(c, i, 1, {glm::vec4(f), glm::vec4(f), glm::vec4(f)});
        }
        const cases::SampleId id{10, 10, 0};
        ref::FragmentValues v = exact_values(c, id);
        EXPECT_TRUE(is_ok(c, profile, id, v));
        v.attributes[0].x = got;
        const bool ok = is_ok(c, profile, id, v);
        v.attributes[1].x = got;  // f itself is a number like any other
        EXPECT_EQ(is_ok(c, profile, id, v), profile == Profile::vulkan);
        return ok;
    };
    for (const float got : {kNan, kUnbounded, 0.0F}) {
        EXPECT_TRUE(judged(0x1p120F, got, Profile::practice));
        EXPECT_TRUE(judged(-0x1p120F, got, Profile::direct3d));
        EXPECT_TRUE(judged(0x1p120F, got, Profile::vulkan));
        EXPECT_FALSE(judged(0x1p106F, got, Profile::practice));
    }
}

// The level of a finding is the loosest profile at which the fragment as a whole is wrong. Devices
// that take every value from another basis, with an error or without.
TEST(ExhaustiveValueFreedom, LevelIsThatOfTheWholeFragment) {
    std::mt19937_64 rng(31);
    std::array<int, 3> count{};
    for (int n = 0; n < 3000; ++n) {
        const auto s = value_test::random_case(rng, 64, value_test::Shape::sliver, 4);
        const cases::SampleId id = s.inside.front();
        const auto all = {
            value_test::Simulated(s.c, value_test::Device::origin_plane, value_test::Fault::none)
                .at(id.x, id.y),
            value_test::Simulated(s.c, value_test::Device::relative_snapped,
                                  value_test::Fault::none)
                .at(id.x, id.y)};
        ref::FragmentValues v = *all.begin();
        const auto pick = [&](float got) {
            return got * (rng() % 4 == 0 ? 1 + std::ldexp(1.0F, -static_cast<int>(rng() % 20)) : 1);
        };
        v.attributes[0].x = pick((all.begin() + rng() % 2)->attributes[0].x);
        v.attributes[0].w = pick((all.begin() + rng() % 2)->attributes[0].w);
        v.attributes[1].x = pick((all.begin() + rng() % 2)->attributes[1].x);
        v.frag_coord.w = pick((all.begin() + rng() % 2)->frag_coord.w);
        const auto verdict =
            ref::ValueReference(s.c, ref::Limits{}, Profile::direct3d).judge(0, id, v);
        if (verdict.ok) {
            continue;
        }
        Profile loosest = Profile::direct3d;
        for (const Profile p : {Profile::practice, Profile::vulkan}) {
            loosest = ref::ValueReference(s.c, ref::Limits{}, p).judge(0, id, v).ok ? loosest : p;
        }
        Profile told = Profile::direct3d;
        for (const auto& m : verdict.mismatches) {
            told = std::min(told, m.level);
        }
        ASSERT_EQ(told, loosest) << n;
        ++count[static_cast<size_t>(told)];
    }
    std::printf("levels: %d %d %d\n", count[0], count[1], count[2]);
    for (const int k : count) {
        EXPECT_GT(k, 0);
    }
}

// The vertices lie on the line from (2, -3) to (11, 20), whose slope is 23/9: it leaves the target
// at x = 2 + 27/23 and x = 2 + 171/23, which no binary32 number is. What a device makes of these
// cut points is a triangle with the area of their roundings, and of their snapping, 812.5 and
// 2415.3 of 1/256, one of another area that has the middle vertex on its border.
TEST(ExhaustiveValueFreedom, CutTriangleWithoutAreaClaimsAFiniteValueOnly) {
    cases::Case c = make_case(16, {clip_of(2, -3, 0.5, 1, 16), clip_of(6.5, 8.5, 0.5, 1, 16),
                                   clip_of(11, 20, 0.5, 1, 16)});
    add_attribute(c, Interpolation::smooth, 1,
                  {glm::vec4(0.1875F), glm::vec4(0.6875F), glm::vec4(0.5F)});
    for (const Profile profile : cases::kProfiles) {
        ref::ValueReference reference(c, {}, profile);
        ref::FragmentValues v;
        v.frag_coord = {6.5F, 8.5F, 0.5F, 1.0F};
        v.depth = 0.5F;
        for (const float value : {0.6875F, 0.75F, -104857.0F}) {
            v.attributes[0].x = value;
            EXPECT_TRUE(reference.judge(0, {6, 8, 0}, v).ok) << value;
            EXPECT_TRUE(reference.judge_exact(0, {6, 8, 0}, v).ok) << value;
        }
        v.attributes[0].x = std::numeric_limits<float>::quiet_NaN();
        const ref::FragmentVerdict verdict = reference.judge(0, {6, 8, 0}, v);
        ASSERT_EQ(verdict.mismatches.size(), 1U);
        EXPECT_EQ(verdict.mismatches[0].rule, "interp.hull");
    }
}

// The diagonal again, between the points of the grid: rounded up in x and down in y, as profile
// practice lets a device do, a vertex leaves it.
TEST(ExhaustiveValueFreedom, SnappingThatMakesAnAreaClaimsAFiniteValueOnly) {
    cases::Case c =
        make_case(8, {clip_of(2.001, 2.001, 0.5, 1, 8), clip_of(4.001, 4.001, 0.5, 1, 8),
                      clip_of(7.003, 7.003, 0.5, 1, 8)});
    add_attribute(c, Interpolation::smooth, 1, {glm::vec4(1.0F), glm::vec4(2.0F), glm::vec4(3.0F)});
    ref::FragmentValues v;
    v.frag_coord = {4.5F, 4.5F, 0.5F, 1.0F};
    v.depth = 0.5F;
    v.attributes[0].x = 3.5F;
    EXPECT_TRUE(ref::ValueReference(c, {}, Profile::practice).judge(0, {4, 4, 0}, v).ok);
}

}  // namespace
