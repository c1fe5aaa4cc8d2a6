// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Answers given in binary64 against the same questions asked in rationals.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ref/position/position.hpp"
#include "ref/value/fragment/quantities.hpp"

namespace ref {
namespace {

mpq_class q(float f) {
    return mpq_class(static_cast<double>(f));
}

bool is_normal_float(const mpq_class& v) {
    const auto f = static_cast<float>(v.get_d());
    return v == 0 || (std::isnormal(f) && q(f) == v);
}

// Coordinates on the subpixel grid, on ties, beside them, and anywhere.
float coordinate(std::mt19937& random) {
    const auto grid = static_cast<float>(static_cast<int>(random() % 8192) - 4096) / 1024.0F;
    switch (random() % 4) {
        case 0:
            return grid;
        case 1:
            return std::nextafter(grid, 2.0F);
        case 2:
            return std::ldexp(grid, static_cast<int>(random() % 60) - 40);
        default:
            return std::ldexp(static_cast<float>(random()), -31) - 1;
    }
}

struct Sampled {
    glm::vec4 clip;
    cases::Viewport viewport;
};

Sampled sampled(std::mt19937& random) {
    constexpr float kW[] = {1.0F, 1.0F, 0.5F, 4.0F, 3.0F, 0.1F, -1.0F};
    constexpr float kExtent[] = {16.0F, 64.0F, 100.0F, 33.5F, 0.25F, 1.0e-30F};
    constexpr float kOrigin[] = {0.0F, 0.0F, 3.0F, -7.5F, 0.1F, 1.0e10F};
    Sampled s;
    s.clip = {coordinate(random), coordinate(random), 0.5F, kW[random() % 7]};
    s.viewport.x = kOrigin[random() % 6];
    s.viewport.y = kOrigin[random() % 6];
    s.viewport.width = kExtent[random() % 6];
    s.viewport.height = kExtent[random() % 6];
    return s;
}

TEST(FastPaths, SnappedPositionsAreThoseOfTheRationals) {
    std::mt19937 random(20240611);
    size_t ties = 0;
    for (int n = 0; n < 20000; ++n) {
        const Sampled s = sampled(random);
        if (!(s.clip.w > 0)) {
            continue;
        }
        cases::Draw draw;
        draw.viewport = s.viewport;
        value::Primitive primitive;
        primitive.draw = &draw;
        primitive.clip = {s.clip, s.clip, s.clip};
        const Limits limits{n % 2 == 0 ? 8 : 4};
        const auto want = snap_nearest(s.clip, s.viewport, limits);
        const auto got = value::snapped_positions(primitive, limits);
        ASSERT_EQ(got.has_value(), want.has_value());
        if (want) {
            EXPECT_EQ((*got)[2].x, want->x);
            EXPECT_EQ((*got)[2].y, want->y);
        }
        mpq_class twice =
            ideal_position(s.clip, s.viewport).x * (int64_t{2} << limits.subpixel_bits);
        ties += twice.get_den() == 1 && mpz_odd_p(twice.get_num_mpz_t()) != 0 ? 1U : 0U;
    }
    EXPECT_GT(ties, 100U);
}

TEST(FastPaths, TransformErrorIsZeroExactlyWhereEveryStepIsExact) {
    std::mt19937 random(20240612);
    size_t exact = 0;
    size_t inexact = 0;
    for (int n = 0; n < 20000; ++n) {
        const Sampled s = sampled(random);
        const TransformError error = transform_error(s.clip, s.viewport);
        const mpq_class half = q(s.viewport.width) / 2;
        const mpq_class normalized = q(s.clip.x) / q(s.clip.w);
        const mpq_class t = normalized * half;
        const mpq_class offset = q(s.viewport.x) + half;
        int exponent = 0;
        const bool is_power = std::fabs(std::frexp(std::fabs(s.clip.w), &exponent) - 0.5F) <= 0;
        const mpq_class x_f = t + offset;
        const mpq_class pixel_half(1, 2);
        bool want = is_power;
        for (const mpq_class& step : {normalized, half, t, offset, mpq_class(offset - pixel_half),
                                      x_f, mpq_class(x_f - pixel_half)}) {
            want = want && is_normal_float(step);
        }
        EXPECT_EQ(error.x == 0, want)
            << s.clip.x << " " << s.clip.w << " " << s.viewport.x << " " << s.viewport.width;
        ++(want ? exact : inexact);
    }
    EXPECT_GT(exact, 1000U);
    EXPECT_GT(inexact, 1000U);
}

TEST(FastPaths, ErrorsOfVerticesAreThoseOfTheTransform) {
    std::mt19937 random(20240613);
    size_t zero = 0;
    for (int n = 0; n < 20000; ++n) {
        const Sampled s = sampled(random);
        cases::Draw draw;
        draw.viewport = s.viewport;
        value::Primitive primitive;
        primitive.draw = &draw;
        primitive.clip = {s.clip, s.clip, s.clip};
        const TransformError want = transform_error(s.clip, s.viewport);
        const auto exact = value::ideal_vertices<mpq_class>(primitive);
        EXPECT_EQ(exact.ex[1], want.x);
        EXPECT_EQ(exact.ey[1], want.y);
        const auto ball = value::ideal_vertices<value::Ball>(primitive);
        EXPECT_LE(abs(want.x - mpq_class(ball.ex[2].v)), mpq_class(ball.ex[2].e));
        EXPECT_LE(abs(want.y - mpq_class(ball.ey[2].v)), mpq_class(ball.ey[2].e));
        EXPECT_LE(ball.ex[2].e, 0x1p-40 * std::fabs(ball.ex[2].v) + 0x1p-500);
        zero += want.x == 0 ? 1U : 0U;
    }
    EXPECT_GT(zero, 1000U);
    EXPECT_LT(zero, 19000U);
}

}  // namespace
}  // namespace ref
