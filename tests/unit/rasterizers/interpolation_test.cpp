// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The ways to interpolate against rationals, within the bounds that interpolation.hpp derives.
#include <gtest/gtest.h>

#include <cmath>

#include "rasterizers/algorithms/brown_gradient.hpp"
#include "tests/unit/rasterizers/exact_numbers.hpp"
#include "tests/unit/rasterizers/random_triangles.hpp"

namespace rasterizers {
namespace {

using test::RandomTriangles;

mpq_class exact(float v) {
    return mpq_class(static_cast<double>(v));
}

// g(k) = k u / (1 - k u), u = 2^-24
mpq_class g(int k) {
    const mpq_class ku = mpq_class(k) * test::power_of_two(-24);
    return ku / (1 - ku);
}

struct Case {
    Corners triangle;
    SubpixelPoint point;
    Areas areas;
    Values z{}, w{};
};

class RandomInterpolations {
  public:
    explicit RandomInterpolations(uint64_t seed) : random_(seed) {}

    // A triangle with area, a point in it (or, `far`, anywhere), values and w.
    Case next(bool is_inside) {
        for (;;) {
            Case c;
            c.triangle = random_.triangle(random_.integer(0, 5), random_.integer(1, 60));
            const auto& [v0, v1, v2] = c.triangle;
            if (edge_function(v0, v1, v2) == 0) {
                continue;
            }
            const int64_t s = random_.integer(0, 1000);
            const int64_t t = random_.integer(0, 1000 - s);
            const SubpixelPoint p{(v0.x * (1000 - s - t) + v1.x * s + v2.x * t) / 1000,
                                  (v0.y * (1000 - s - t) + v1.y * s + v2.y * t) / 1000};
            c.point = p;
            c.areas = areas_at(c.triangle, p);
            const bool inside = std::min({c.areas.part[0], c.areas.part[1], c.areas.part[2]}) >= 0;
            if (inside != is_inside) {
                continue;
            }
            for (size_t k = 0; k < 3; ++k) {
                c.z[k] = value();
                c.w[k] = std::fabs(value()) + 0x1p-30F;
            }
            return c;
        }
    }
    float value() {
        return std::ldexp(static_cast<float>(random_.integer(-0xffffff, 0xffffff)),
                          static_cast<int>(random_.integer(-40, -10)));
    }

  private:
    RandomTriangles random_;
};

// |computed - exact| / bound must stay below 1, and must come near enough to it that the bound
// says something.
struct Ratio {
    double worst = 0;
    void add(float computed, const mpq_class& value, const mpq_class& bound, const char* name) {
        const mpq_class error = abs(exact(computed) - value);
        ASSERT_TRUE(error <= bound) << name << " " << error.get_d() << " " << bound.get_d();
        if (sgn(bound) > 0) {
            worst = std::max(worst, mpq_class(error / bound).get_d());
        }
    }
};

TEST(Interpolation, StaysWithinItsBound) {
    RandomInterpolations random(5);
    Ratio three;
    Ratio two;
    Ratio nested;
    Ratio perspective;
    for (int n = 0; n < 40000; ++n) {
        const Case c = random.next(n % 4 != 0);
        const auto l = test::exact_barycentrics(c.areas);
        const std::array z{exact(c.z[0]), exact(c.z[1]), exact(c.z[2])};
        const mpq_class value = l[0] * z[0] + l[1] * z[1] + l[2] * z[2];
        const mpq_class sum = abs(l[0] * z[0]) + abs(l[1] * z[1]) + abs(l[2] * z[2]);
        three.add(three_multiplies(c.areas, c.z), value, g(6) * sum, "three");
        two.add(two_multiplies(c.areas, c.z), value,
                g(7) * (abs(l[1] * (z[1] - z[0])) + abs(l[2] * (z[2] - z[0]))) + g(2) * abs(z[0]),
                "two");
        nested.add(nested_lines(c.areas, c.z), value, g(10) * sum, "nested");
        if (n % 4 != 0) {
            const auto b = test::exact_perspective(c.areas, c.w);
            mpq_class u = 0;
            mpq_class magnitude = 0;
            for (size_t k = 0; k < 3; ++k) {
                u += b[k] * z[k];
                magnitude += abs(b[k] * z[k]);
            }
            perspective.add(brown(c.areas, w_products(c.w), c.z), u, g(12) * magnitude, "brown");
        }
    }
    for (const Ratio& ratio : {three, two, nested, perspective}) {
        EXPECT_GT(ratio.worst, 0.1);
        EXPECT_LE(ratio.worst, 1.0);
    }
}

// A constant comes back unchanged from two multiplies, and not from three.
TEST(Interpolation, Constants) {
    RandomInterpolations random(6);
    int changed = 0;
    for (int n = 0; n < 2000; ++n) {
        const Case c = random.next(true);
        const Values z{0.1F, 0.1F, 0.1F};
        EXPECT_EQ(two_multiplies(c.areas, z), 0.1F);
        changed += three_multiplies(c.areas, z) < 0.1F || three_multiplies(c.areas, z) > 0.1F;
    }
    EXPECT_GT(changed, 100);
}

// By hand: at vertex 1, z_0 + 1 (z_1 - z_0) with z_0 = 2^25 and z_1 = 1. The difference 1 - 2^25
// needs 25 bits and lies half way between 2^25 - 2 and 2^25; to even it is -2^25, and 0 comes back.
TEST(Interpolation, TwoMultipliesLoseASmallVertexValueByHand) {
    const Corners t{{{0, 0}, {2560, 0}, {0, 2560}}};
    const Areas at_vertex_1 = areas_at(t, t[1]);
    EXPECT_EQ(at_vertex_1.part, (std::array<int64_t, 3>{0, 2560 * 2560, 0}));
    const Values z{0x1p25F, 1, 0};
    EXPECT_EQ(two_multiplies(at_vertex_1, z), 0.0F);
    EXPECT_EQ(three_multiplies(at_vertex_1, z), 1.0F);
    EXPECT_EQ(nested_lines(at_vertex_1, z), 1.0F);
    EXPECT_EQ(brown(at_vertex_1, w_products({1, 2, 4}), z), 1.0F);
}

// By hand: half way between w = 1 and w = 3 on screen, b' = (3/4, 1/4): eye space is nearer to the
// vertex that is nearer to the eye.
TEST(Interpolation, PerspectiveByHand) {
    const Corners t{{{0, 0}, {2560, 0}, {0, 2560}}};
    const Areas middle = areas_at(t, {1280, 0});
    EXPECT_EQ(brown(middle, w_products({1, 3, 7}), {0, 8, 100}), 2.0F);
    EXPECT_EQ(three_multiplies(middle, {0, 8, 100}), 4.0F);
}

// alpha = (1-t) s, beta = s t, gamma = 1 - s are the barycentric coordinates, and U, the point on
// AB, and P are where they should be: exactly, from integer areas.
TEST(Interpolation, NestedLinesAreBarycentric) {
    RandomInterpolations random(8);
    int checked = 0;
    for (int n = 0; n < 3000; ++n) {
        const Case c = random.next(n % 2 == 0);
        const auto l = test::exact_barycentrics(c.areas);
        const mpq_class s = 1 - l[2];
        EXPECT_EQ(mpq_class(l[0] + l[1] + l[2]), 1);
        if (sgn(s) == 0) {
            continue;
        }
        ++checked;
        const mpq_class t = l[1] / s;
        EXPECT_EQ(mpq_class((1 - t) * s), l[0]);
        EXPECT_EQ(mpq_class(t * s), l[1]);
        // U = (1-t) A + t B lies on the line AB, and C, U and the point with the coordinates l too.
        const auto coordinate = [&](size_t v, bool is_x) {
            return mpq_class(mpz_class(is_x ? c.triangle[v].x : c.triangle[v].y));
        };
        for (const bool is_x : {true, false}) {
            const mpq_class u = (1 - t) * coordinate(0, is_x) + t * coordinate(1, is_x);
            EXPECT_EQ(mpq_class((1 - s) * coordinate(2, is_x) + s * u),
                      mpq_class(l[0] * coordinate(0, is_x) + l[1] * coordinate(1, is_x) +
                                l[2] * coordinate(2, is_x)));
        }
    }
    EXPECT_GT(checked, 2000);
}

// Equations 1 to 6 in rationals: u by both forms of equation 4, and by the transformed coordinates
// of equation 5 in equation 6, with the areas of equation 2; and equation 3 is equation 6 with one
// w.
TEST(Interpolation, EquationsOneToSixAgree) {
    RandomInterpolations random(10);
    for (int n = 0; n < 2000; ++n) {
        const Case c = random.next(true);
        const auto b = test::exact_barycentrics(c.areas);
        const auto b_eye = test::exact_perspective(c.areas, c.w);
        mpq_class first_numerator = 0;
        mpq_class first_denominator = 0;
        mpq_class second_numerator = 0;
        mpq_class second_denominator = 0;
        mpq_class six = 0;
        mpq_class three = 0;
        for (size_t i = 0; i < 3; ++i) {
            const mpq_class u = exact(c.z[i]);
            const mpq_class w = exact(c.w[i]);
            const mpq_class product = exact(c.w[(i + 1) % 3]) * exact(c.w[(i + 2) % 3]);
            first_numerator += b[i] * (u / w);
            first_denominator += b[i] / w;
            second_numerator += b[i] * product * u;
            second_denominator += b[i] * product;
            six += b_eye[i] * u;
            three += b[i] * u;
        }
        EXPECT_EQ(mpq_class(first_numerator / first_denominator), six);
        EXPECT_EQ(mpq_class(second_numerator / second_denominator), six);
        EXPECT_EQ(mpq_class(b_eye[0] + b_eye[1] + b_eye[2]), 1);
        const auto same = test::exact_perspective(c.areas, {0.75F, 0.75F, 0.75F});
        EXPECT_EQ(
            mpq_class(same[0] * exact(c.z[0]) + same[1] * exact(c.z[1]) + same[2] * exact(c.z[2])),
            three);
    }
}

// Equation 9 against the quotient rule for u = N/D with N = sum q_i A_i u_i and D = sum q_i A_i,
// both affine, so that their derivatives are differences over one pixel: exactly, in rationals.
TEST(Interpolation, EquationNineIsTheQuotientRule) {
    RandomInterpolations random(9);
    for (int n = 0; n < 2000; ++n) {
        const Case c = random.next(true);
        const auto w = [&](size_t k) { return exact(c.w[k]); };
        const std::array<mpq_class, 3> q{w(1) * w(2), w(2) * w(0), w(0) * w(1)};
        const std::array<mpq_class, 3> z{exact(c.z[0]), exact(c.z[1]), exact(c.z[2])};
        const SubpixelPoint p = c.point;
        const auto numerator_and_sum = [&](const SubpixelPoint& at) {
            std::pair<mpq_class, mpq_class> out;
            for (size_t k = 0; k < 3; ++k) {
                const mpq_class a =
                    mpz_class(edge_function(c.triangle[(k + 1) % 3], c.triangle[(k + 2) % 3], at));
                out.first += q[k] * a * z[k];
                out.second += q[k] * a;
            }
            return out;
        };
        const auto [num, sum] = numerator_and_sum(p);
        if (sgn(sum) == 0) {
            continue;
        }
        const auto derivative = [&, &num_ = num, &sum_ = sum](const SubpixelPoint& beside) {
            const auto [num_1, sum_1] = numerator_and_sum(beside);
            return mpq_class(((num_1 - num_) * sum_ - num_ * (sum_1 - sum_)) / (sum_ * sum_));
        };
        const Gradient<mpq_class> g =
            brown_gradient<mpq_class>(c.triangle, q, z, mpq_class(num / sum), sum);
        EXPECT_EQ(g.dx, derivative({p.x + kPixel, p.y}));
        EXPECT_EQ(g.dy, derivative({p.x, p.y + kPixel}));
        EXPECT_EQ(g.total(mpq_class(2)), mpq_class(2 * (g.dx + g.dy)));
    }
}

// By hand: w = 1 everywhere, u = x in pixels: du/dx = 1 and du/dy = 0 wherever.
TEST(Interpolation, GradientByHand) {
    const Corners t{{{0, 0}, {2560, 0}, {0, 2560}}};
    const Gradient<float> g =
        brown_gradient<float>(t, {1, 1, 1}, {0, 10, 0}, 3.0F, 2560.0F * 2560.0F);
    EXPECT_EQ(g.dx, 1.0F);
    EXPECT_EQ(g.dy, 0.0F);
}

}  // namespace
}  // namespace rasterizers
