// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/position/position.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ref/position/position_detail.hpp"
#include "ref/position/position_filter.hpp"
#include "tests/unit/ref/coverage_random.hpp"

namespace ref::test {
namespace {

using cases::Profile;

constexpr cases::Viewport kSquare{0, 0, 64, 64, 0, 1};

mpq_class exact(float f) {
    return mpq_class(static_cast<double>(f));
}

TEST(Position, IdealIsTheViewportTransform) {
    const IdealPosition center = ideal_position({0, 0, 0.5F, 1}, kSquare);
    EXPECT_EQ(center.x, 32);
    EXPECT_EQ(center.y, 32);
    EXPECT_EQ(center.z, mpq_class(1, 2));
    const IdealPosition third = ideal_position({1, -1, 1, 3}, {0, 0, 64, 64, 0.25F, 0.75F});
    EXPECT_EQ(third.x, mpq_class(128, 3));
    EXPECT_EQ(third.y, mpq_class(64, 3));
    EXPECT_EQ(third.z, mpq_class(5, 12));
    EXPECT_EQ(third.inv_w, mpq_class(1, 3));
    const IdealPosition flipped = ideal_position({0, 0.5F, 0, 1}, {8, 40, 16, -32, 0, 1});
    EXPECT_EQ(flipped.x, 16);
    EXPECT_EQ(flipped.y, 16);
}

TEST(Position, TransformErrorIsZeroOnlyWhereEveryStepIsExact) {
    EXPECT_EQ(transform_error({0.25F, -0.5F, 0, 1}, kSquare).x, 0);
    EXPECT_EQ(transform_error({0.5F, -1, 0, 2}, kSquare).y, 0);
    EXPECT_GT(transform_error({0.5F, 0.5F, 0, 3}, kSquare).x, 0);         // 1/3 is not a binary32
    EXPECT_GT(transform_error({0x1.000002p-1F, 0, 0, 1}, kSquare).x, 0);  // 32 + t needs 29 bits
    EXPECT_GT(transform_error({0.25F, 0, 0, 1}, {0.1F, 0, 64, 64, 0, 1}).x, 0);
}

// Evaluation orders that devices use, in binary32.
std::array<float, 6> computed(float c, float w, float p, float v) {
    const float half = p / 2;
    const float o = v + half;
    const float by_reciprocal = c * (1.0F / w);
    const float divided = c / w;
    const float folded = o - 0.5F;
    return {by_reciprocal * half + o,          divided * half + o,
            std::fma(by_reciprocal, half, o),  std::fma(divided, half, o),
            (by_reciprocal * half + o) - 0.5F, by_reciprocal * half + folded};
}

TEST(Position, TransformErrorBoundsBinary32) {
    RandomCases random(3);
    int nonzero = 0;
    double worst = 0;
    for (int k = 0; k < 20000; ++k) {
        const auto w = static_cast<float>(std::exp2(random.real(-10, 10)));
        const float c = static_cast<float>(random.real(-2, 2)) * w;
        const bool is_dyadic = random.flip();
        const cases::Viewport v{is_dyadic ? static_cast<float>(random.integer(-64, 64))
                                          : static_cast<float>(random.real(-100, 100)),
                                0,
                                is_dyadic ? static_cast<float>(random.integer(1, 1024))
                                          : static_cast<float>(random.real(1, 5000)),
                                64,
                                0,
                                1};
        const glm::vec4 clip(c, 0, 0, w);
        const mpq_class ideal = ideal_position(clip, v).x;
        const mpq_class bound = transform_error(clip, v).x;
        const auto values = computed(c, w, v.width, v.x);
        for (size_t i = 0; i < values.size(); ++i) {
            const mpq_class shift = i < 4 ? mpq_class(0) : mpq_class(1, 2);
            const mpq_class error = abs(exact(values[i]) + shift - ideal);
            ASSERT_LE(error, bound) << "order " << i << ", case " << k;
            if (bound > 0) {
                worst = std::max(worst, mpq_class(error / bound).get_d());
                ++nonzero;
            }
        }
    }
    EXPECT_GT(nonzero, 1000);
    EXPECT_GT(worst, 0.2);  // not a bound that anything would pass
}

TEST(Position, ExactTransformIsExactInBinary32) {
    RandomCases random(4);
    int exact_ones = 0;
    for (int k = 0; k < 20000; ++k) {
        const cases::Viewport v{0, 0, static_cast<float>(1 << random.integer(0, 12)), 64, 0, 1};
        const float w = std::exp2(static_cast<float>(random.integer(-4, 4)));
        const float c = static_cast<float>(random.integer(-4096, 4096)) / 4096 * w;
        if (transform_error({c, 0, 0, w}, v).x == 0) {
            const auto values = computed(c, w, v.width, v.x);
            for (size_t i = 0; i < values.size(); ++i) {
                const mpq_class shift = i < 4 ? mpq_class(0) : mpq_class(1, 2);
                ASSERT_EQ(exact(values[i]) + shift, ideal_position({c, 0, 0, w}, v).x);
            }
            ++exact_ones;
        }
    }
    EXPECT_GT(exact_ones, 10000);
}

Box box(double x, double y, Profile profile, int bits = 8) {
    cases::Draw d;
    d.viewport = kSquare;
    return *position_box(at_pixel(d, x, y), kSquare, {bits}, profile);
}

TEST(Position, BoxesOnTheGridArePoints) {
    for (const Profile profile : {Profile::practice, Profile::direct3d}) {
        EXPECT_EQ(box(10.5, 3.25, profile), (Box{688128, 212992, 688128, 212992}));
        EXPECT_TRUE(box(10 + 1.0 / 256, 3, profile).is_point());
        EXPECT_TRUE(box(1.0 / 16, 3, profile, 4).is_point());
    }
    EXPECT_FALSE(box(10.5, 3.25, Profile::vulkan).is_point());
}

TEST(Position, BoxesOffTheGrid) {
    constexpr int64_t kUnit = 256;  // S47.16 units of a subpixel of 8 bits
    const int64_t base = 10 * kFixedOne;
    const auto x_at = [](double units, Profile profile) {
        return box(10 + units / 256, 1, profile);
    };
    EXPECT_EQ(x_at(0.25, Profile::practice).x0, base);
    EXPECT_EQ(x_at(0.25, Profile::practice).x1, base + kUnit);
    EXPECT_EQ(x_at(0.25, Profile::direct3d).x1, base);
    EXPECT_EQ(x_at(0.5, Profile::direct3d).x0, base);
    EXPECT_EQ(x_at(0.5, Profile::direct3d).x1, base + kUnit);
    EXPECT_EQ(x_at(0.375, Profile::direct3d).x1, base);
    EXPECT_EQ(x_at(0.4375, Profile::direct3d).x1, base + kUnit);
    EXPECT_EQ(x_at(0.625, Profile::direct3d).x0, base + kUnit);
    // vulkan: 1e-5 (4 |10 - 32| + 32 + 2 * 10 + 1) = 141e-5 pixel, 0.36 units
    EXPECT_EQ(x_at(0, Profile::vulkan).x0, base - kUnit);
    EXPECT_EQ(x_at(0, Profile::vulkan).x1, base + kUnit);
    EXPECT_EQ(x_at(0.5, Profile::vulkan).x0, base);
    EXPECT_EQ(x_at(0.5, Profile::vulkan).x1, base + kUnit);
    EXPECT_EQ(x_at(0.25, Profile::vulkan).x0, base - kUnit);
}

// A device accurate to 1e-5 computes 3.4960972 for 3.49609375 and rounds it up to 3.5: a sample at
// 3.5 then lies on an edge that nobody shares.
TEST(Position, LiteralVulkanSnapsWhatIsComputed) {
    const cases::Case c = pixels(8, 8, {{3.49609375, 0}, {3.49609375, 8}, {8, 4}});
    const HitBounds open = hits_at(expect(c, {8}, Profile::vulkan), 3, 4);
    EXPECT_EQ(open.total_min, 0U);
    EXPECT_EQ(open.total_max, 1U);
    EXPECT_EQ(hits_at(expect(c, {8}, Profile::vulkan), 4, 4).total_min, 1U);
    EXPECT_EQ(hits_at(expect(c, {8}, Profile::practice), 3, 4).total_min, 1U);
}

TEST(Position, ProfilesAreNestedAndHoldTheNearestPoint) {
    RandomCases random(5);
    for (int k = 0; k < 5000; ++k) {
        cases::Draw d;
        d.viewport = kSquare;
        const glm::vec4 clip = at_pixel(d, random.real(-100, 100), random.real(-100, 100),
                                        static_cast<float>(random.real(0.1, 8)));
        const Limits limits{static_cast<int>(random.integer(4, 16))};
        const Box strict = *position_box(clip, kSquare, limits, Profile::direct3d);
        const Box usual = *position_box(clip, kSquare, limits, Profile::practice);
        const Box loose = *position_box(clip, kSquare, limits, Profile::vulkan);
        const auto holds = [](const Box& outer, const Box& inner) {
            return outer.x0 <= inner.x0 && outer.y0 <= inner.y0 && outer.x1 >= inner.x1 &&
                   outer.y1 >= inner.y1;
        };
        EXPECT_TRUE(holds(usual, strict)) << k;
        EXPECT_TRUE(holds(loose, usual)) << k;
        const FixedPoint p = *snap_nearest(clip, kSquare, limits);
        EXPECT_TRUE(holds(strict, {p.x, p.y, p.x, p.y})) << k;
        const int64_t step = int64_t{1} << (kFixedBits - limits.subpixel_bits);
        EXPECT_EQ(strict.x0 % step, 0);
        EXPECT_EQ(usual.y1 % step, 0);
    }
}

// The binary64 filter never says anything else than the rationals, and says something mostly.
TEST(ExhaustivePosition, FilterAgreesWithRationals) {
    RandomCases random(6);
    int told = 0;
    int snapped = 0;
    const int rounds = 30000;
    for (int k = 0; k < rounds; ++k) {
        cases::Viewport v{0, 0, 64, 64, 0, 1};
        const int64_t kind = random.integer(0, 4);
        if (kind == 0) {
            v = {static_cast<float>(random.real(-9, 9)),
                 static_cast<float>(random.integer(-9, 9)),
                 static_cast<float>(random.real(1, 5000)),
                 static_cast<float>(random.integer(-900, -1)),
                 0,
                 1};
        }
        cases::Draw d;
        d.viewport = v;
        const Limits limits{static_cast<int>(random.integer(4, 16))};
        const double unit = std::exp2(-limits.subpixel_bits);
        // Often on the grid, on midpoints, at the 0.6 of direct3d, or a little beside them.
        const auto coordinate = [&] {
            const double offsets[] = {0, 0.5, 0.4, 0.6, 0.25};
            const double near = random.flip() ? 0 : random.real(-1, 1) * std::exp2(-20);
            return static_cast<double>(random.integer(-2000, 20000)) * unit +
                   (offsets[random.integer(0, 4)] + near) * unit;
        };
        const float ws[] = {1, 2, 0.25F, 3, static_cast<float>(random.real(0.01, 100))};
        const glm::vec4 clip = at_pixel(d, coordinate(), coordinate(), ws[random.integer(0, 4)]);
        const FixedPoint nearest = *exact_snap_nearest(clip, v, limits);
        const auto near_x = filtered_nearest(clip.x, clip.w, v.x, v.width, limits);
        const auto near_y = filtered_nearest(clip.y, clip.w, v.y, v.height, limits);
        ASSERT_EQ(near_x.value_or(nearest.x), nearest.x) << k;
        ASSERT_EQ(near_y.value_or(nearest.y), nearest.y) << k;
        snapped += near_x ? 1 : 0;
        for (const Profile profile : cases::kProfiles) {
            const Box want = *exact_position_box(clip, v, limits, profile);
            const auto x = filtered_range(clip.x, clip.w, v.x, v.width, limits, profile);
            const auto y = filtered_range(clip.y, clip.w, v.y, v.height, limits, profile);
            if (x) {
                ASSERT_EQ(x->low, want.x0) << k;
                ASSERT_EQ(x->high, want.x1) << k;
                ++told;
            }
            if (y) {
                ASSERT_EQ(y->low, want.y0) << k;
                ASSERT_EQ(y->high, want.y1) << k;
            }
        }
    }
    EXPECT_GT(told, rounds * 2);
    EXPECT_GT(snapped, rounds * 2 / 3);
}

TEST(Position, NearestTiesGoToEven) {
    cases::Draw d;
    d.viewport = kSquare;
    const auto snapped = [&](double units) {
        return snap_nearest(at_pixel(d, 8 + units / 256, 8), kSquare, {8})->x / 256 - 8 * 256;
    };
    EXPECT_EQ(snapped(0.5), 0);
    EXPECT_EQ(snapped(1.5), 2);
    EXPECT_EQ(snapped(-0.5), 0);
    EXPECT_EQ(snapped(0.5 + 1.0 / 64), 1);
}

TEST(Position, NothingOutsideTheGuaranteedRange) {
    const Limits limits;
    for (const Profile profile : cases::kProfiles) {
        EXPECT_FALSE(position_box({0x1p40F, 0, 0, 1}, kSquare, limits, profile));
        EXPECT_FALSE(position_box({NAN, 0, 0, 1}, kSquare, limits, profile));
        EXPECT_FALSE(position_box({0, INFINITY, 0, 1}, kSquare, limits, profile));
        EXPECT_FALSE(position_box({0, 0, 0, 0}, kSquare, limits, profile));
        EXPECT_FALSE(position_box({0, 0, 0, -1}, kSquare, limits, profile));
        EXPECT_FALSE(position_box({0, 0, 0, 0x1p-140F}, kSquare, limits, profile));
        EXPECT_TRUE(position_box({0x1p26F, 0, 0, 1}, kSquare, limits, profile));
    }
}

// Vulkan guarantees magnitudes up to 2^32: 1/w, x/w, y/w and z/w have to stay within it.
TEST(Position, LiteralVulkanAsksNothingBeyondTwoToThe32) {
    const Limits limits;
    const auto has_box = [&](const glm::vec4& clip, Profile profile) {
        return position_box(clip, kSquare, limits, profile).has_value();
    };
    EXPECT_TRUE(has_box({0, 0, 0, 0x1p-32F}, Profile::vulkan));
    EXPECT_FALSE(has_box({0, 0, 0, 0x1.fffffep-33F}, Profile::vulkan));
    EXPECT_TRUE(has_box({0, 0, 0x1p32F, 1}, Profile::vulkan));
    EXPECT_FALSE(has_box({0, 0, -0x1.000002p32F, 1}, Profile::vulkan));
    for (const Profile profile : {Profile::practice, Profile::direct3d}) {
        EXPECT_TRUE(has_box({0, 0, 0, 0x1p-50F}, profile));
        EXPECT_TRUE(has_box({0, 0, -0x1.000002p32F, 1}, profile));
    }
}

TEST(Position, FractionalViewportMovesInLiteralVulkan) {
    const cases::Viewport v{0.5F, 0, 64, 64, 0, 1};
    const Box b = *position_box({0, 0, 0, 1}, v, {8}, Profile::vulkan);
    EXPECT_LE(b.x0, 32 * kFixedOne + kFixedOne / 2 - kFixedOne);
    EXPECT_GT(b.y0, 31 * kFixedOne + kFixedOne / 2);
}

}  // namespace
}  // namespace ref::test
