// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The filtered answer against the oracle in rationals, and against the budget's formula written
// down a second time.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "ref/number/ball.hpp"
#include "tests/share.hpp"
#include "value_case.hpp"

namespace {

using cases::Profile;
using value_test::uniform;

// Float at `steps` floats from x.
float step(float x, int steps) {
    for (int k = 0; k < std::abs(steps); ++k) {
        x = std::nextafter(x, steps > 0 ? std::numeric_limits<float>::infinity()
                                        : -std::numeric_limits<float>::infinity());
    }
    return x;
}

bool same(const ref::FragmentVerdict& a, const ref::FragmentVerdict& b) {
    return a.ok == b.ok &&
           std::equal(a.mismatches.begin(), a.mismatches.end(), b.mismatches.begin(),
                      b.mismatches.end(), [](const auto& m, const auto& n) {
                          return m.quantity == n.quantity && m.rule == n.rule && m.level == n.level;
                      });
}

// Values at and around the threshold of each quantity in turn: both ways agree on every fragment.
TEST(ExhaustiveValueOracle, FilterAgreesAroundTheThreshold) {
    std::mt19937_64 rng(11);
    uint64_t values = 0, fragments = 0, accepted = 0, rejected = 0;
    for (int n = 0; n < test_support::rounds(120); ++n) {
        const auto shape = static_cast<value_test::Shape>(n % 3);
        const auto s =
            value_test::random_case(rng, n % 2 == 0 ? 64 : 2048, shape, n % 4 < 2 ? 0 : 8);
        const Profile profile = n % 5 == 4 ? Profile::practice : Profile::direct3d;
        ref::ValueReference reference(s.c, ref::Limits{}, profile);
        const cases::SampleId id = s.inside.front();
        const auto all = reference.expected(0, id);
        ref::FragmentValues base;
        for (const auto& e : all) {
            number_of(base, e.quantity) = static_cast<float>(e.nearest);
        }
        for (const auto& e : all) {
            if (e.is_flat) {
                continue;
            }
            for (const int sign : {-1, 1}) {
                for (const double scale : {0.5, 1.0 - 0x1p-20, 1.0, 1.0 + 0x1p-20}) {
                    for (const int ulps : {-1, 0, 1}) {
                        if (ulps != 0 && (scale < 1 || scale > 1)) {
                            continue;
                        }
                        ref::FragmentValues device = base;
                        number_of(device, e.quantity) =
                            step(static_cast<float>(e.nearest +
                                                    sign * scale * ref::kBudgetFactor * e.budget),
                                 ulps);
                        const auto fast = reference.judge(0, id, device);
                        const auto slow = reference.judge_exact(0, id, device);
                        ASSERT_TRUE(same(fast, slow))
                            << n << " " << to_text(e.quantity) << " " << scale;
                        // Each part by itself, too: the filter judges it without the other.
                        const auto part = fragments % 2 == 0 ? ref::FragmentPart::depth
                                                             : ref::FragmentPart::all_but_depth;
                        ASSERT_TRUE(same(reference.judge(0, id, device, part),
                                         reference.judge_exact(0, id, device, part)))
                            << n << " " << to_text(e.quantity) << " " << scale;
                        values += all.size() - 3;  // two centres and a flat value are not filtered
                        ++fragments;
                        ++(fast.ok ? accepted : rejected);
                    }
                }
            }
        }
    }
    EXPECT_GE(values, 800U * static_cast<uint64_t>(test_support::rounds(120)));
    EXPECT_GT(accepted, fragments / 20);
    EXPECT_GT(rejected, fragments / 20);
}

// A vertex as the second formulation has it: everything exact.
struct Vertex {
    mpq_class x, y, w;
};

mpq_class two_to(int e) {
    mpq_class q = 1;
    if (e >= 0) {
        mpq_mul_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(e));
    } else {
        mpq_div_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(-e));
    }
    return q;
}

mpq_class exact(float f) {
    return mpq_class(static_cast<double>(f));
}

// Barycentrics by Brown's eq. 1 and 2; the budget as in docs/precision.md, for positions on the
// grid and w a power of two, where no position is rounded.
struct Formula {
    std::array<Vertex, 3> v;
    std::array<mpq_class, 3> b, dx, dy;
    mpq_class X, Y;

    Formula(const std::array<Vertex, 3>& vertices, const mpq_class& px, const mpq_class& py)
        : v(vertices), X(px), Y(py) {
        mpq_class total;
        for (size_t i = 0; i < 3; ++i) {
            const Vertex &q = v[(i + 1) % 3], &r = v[(i + 2) % 3];
            b[i] = (q.x - px) * (r.y - py) - (r.x - px) * (q.y - py);
            dx[i] = q.y - r.y;
            dy[i] = r.x - q.x;
            total += b[i];
            X = std::max(X, v[i].x);
            Y = std::max(Y, v[i].y);
        }
        for (size_t i = 0; i < 3; ++i) {
            b[i] /= total;
            dx[i] = abs(mpq_class(dx[i] / total));
            dy[i] = abs(mpq_class(dy[i] / total));
        }
    }
    mpq_class linear(const std::array<mpq_class, 3>& g) const {
        return b[0] * g[0] + b[1] * g[1] + b[2] * g[2];
    }
    mpq_class budget(const std::array<mpq_class, 3>& g) const {
        std::array<mpq_class, 3> d;
        mpq_class worst, largest;
        for (size_t i = 0; i < 3; ++i) {
            d[i] = dx[i] * X + dy[i] * Y;
            worst += abs(g[i]) * d[i];
            largest = std::max(largest, mpq_class(abs(g[i])));
        }
        for (size_t j = 0; j < 3; ++j) {
            mpq_class sum;
            for (size_t i = 0; i < 3; ++i) {
                sum += abs(mpq_class(g[i] - g[j])) * d[i];
            }
            worst = std::max(worst, sum);
        }
        const mpq_class underflow = two_to(-123);
        return two_to(-24) * (2 * worst + largest) + underflow * (1 + X + Y);
    }
};

TEST(ExhaustiveValueOracle, DecisionMatchesTheFormulaWrittenTwice) {
    std::mt19937_64 rng(12);
    uint64_t decided = 0, accepted = 0;
    const uint32_t size = 256;
    for (int n = 0; n < 6000; ++n) {
        // On the 1/256 grid, w a power of two: one basis, no rounding of positions.
        std::array<Vertex, 3> v;
        std::array<glm::vec4, 3> clip{};
        std::array<float, 3> f{};
        std::array<glm::vec4, 3> values{};
        for (size_t i = 0; i < 3; ++i) {
            const auto x = static_cast<int64_t>(rng() % (size * 256 + 1));
            const auto y = static_cast<int64_t>(rng() % (size * 256 + 1));
            const int e = static_cast<int>(rng() % 9) - 4;
            const double w = std::ldexp(1.0, e);
            v[i] = {mpq_class(x, 256), mpq_class(y, 256), mpq_class(w)};
            v[i].x.canonicalize();
            v[i].y.canonicalize();
            clip[i] = value_test::clip_of(static_cast<double>(x) / 256,
                                          static_cast<double>(y) / 256, 0.5, w, size);
            f[i] = static_cast<float>(uniform(rng, -4, 4));
        }
        const uint32_t i = static_cast<uint32_t>(rng() % size),
                       j = static_cast<uint32_t>(rng() % size);
        const mpq_class px(2 * static_cast<int64_t>(i) + 1, 2),
            py(2 * static_cast<int64_t>(j) + 1, 2);
        const mpq_class area =
            (v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[2].x - v[0].x) * (v[1].y - v[0].y);
        if (area == 0) {
            continue;
        }
        const Formula formula(v, px, py);
        if (formula.b[0] < 0 || formula.b[1] < 0 || formula.b[2] < 0) {
            continue;
        }
        // A value near zero: floats are dense there, and the threshold is met to one part in 2^20.
        const mpq_class last = formula.b[2] / v[2].w;
        if (n % 2 == 0 && last > mpq_class(1, 64)) {
            const mpq_class others =
                formula.b[0] * exact(f[0]) / v[0].w + formula.b[1] * exact(f[1]) / v[1].w;
            f[2] = static_cast<float>(mpq_class(-others / last).get_d());
        }
        for (size_t k = 0; k < 3; ++k) {
            values[k] = glm::vec4(f[k]);
        }
        cases::Case c = value_test::make_case(size, clip);
        value_test::add_attribute(c, cases::Interpolation::smooth, 1, values);
        const std::array<mpq_class, 3> one = {1 / v[0].w, 1 / v[1].w, 1 / v[2].w};
        const std::array<mpq_class, 3> over = {exact(f[0]) / v[0].w, exact(f[1]) / v[1].w,
                                               exact(f[2]) / v[2].w};
        const mpq_class d = formula.linear(one);
        const mpq_class value = formula.linear(over) / d;
        const mpq_class bd = formula.budget(one);
        const mpq_class own = 2 * two_to(-24) * abs(value);
        const mpq_class reach =
            ref::kBudgetFactor *
            ((formula.budget(over) + abs(value) * bd) / (d - ref::kBudgetFactor * bd) + own);
        ref::ValueReference reference(c, ref::Limits{}, Profile::direct3d);
        const cases::SampleId id{i, j, 0};
        ref::FragmentValues device;
        for (const auto& e : reference.expected(0, id)) {
            number_of(device, e.quantity) = static_cast<float>(e.nearest);
            if (to_text(e.quantity) == "attribute 0.x") {
                EXPECT_EQ(mpq_class(e.exact), value);
                // The budget that is told is of Balls, within a few roundings of the exact one.
                const mpq_class budget = (formula.budget(over) + abs(value) * bd) / d + own;
                EXPECT_LE(abs(mpq_class(e.budget) - budget), budget * two_to(-40));
            }
        }
        for (const int sign : {-1, 1}) {
            for (const double scale : {1 - 0x1p-10, 1 - 0x1p-20, 1.0, 1 + 0x1p-20, 1 + 0x1p-10}) {
                const auto edge =
                    static_cast<float>(mpq_class(value + sign * mpq_class(scale) * reach).get_d());
                for (const int ulps : {-1, 0, 1}) {
                    device.attributes[0].x = step(edge, ulps);
                    const bool expect =
                        abs(mpq_class(exact(device.attributes[0].x) - value)) <= reach;
                    ASSERT_EQ(reference.judge(0, id, device).ok, expect) << n << " " << ulps;
                    ++decided;
                    accepted += expect ? 1 : 0;
                }
            }
        }
    }
    EXPECT_GT(decided, 5000U);
    EXPECT_GT(accepted, decided / 10);
    EXPECT_LT(accepted, decided - decided / 10);
}

// A Ball always holds the exact result.
TEST(ExhaustiveValueOracle, BallHoldsTheExactResult) {
    using ref::value::Ball;
    std::mt19937_64 rng(13);
    const auto holds = [](const Ball& b, const mpq_class& q) {
        return abs(mpq_class(q - mpq_class(b.v))) <= mpq_class(b.e);
    };
    for (int n = 0; n < 20000; ++n) {
        mpq_class q = mpq_class(uniform(rng, -2, 2));
        Ball b(q.get_d());
        for (int k = 0; k < 12; ++k) {
            const double x = uniform(rng, -2, 2) * std::exp2(std::floor(uniform(rng, -30, 30)));
            switch (rng() % 5) {
                case 0:
                    q += mpq_class(x);
                    b = b + Ball(x);
                    break;
                case 1:
                    q -= mpq_class(x);
                    b = b - Ball(x);
                    break;
                case 2:
                    q *= mpq_class(x);
                    b = b * Ball(x);
                    break;
                case 3:
                    q /= mpq_class(x);
                    b = b / Ball(x);
                    break;
                default:
                    q = mpq_class(1) / (q * q + 1);
                    b = Ball(1.0) / (b * b + Ball(1.0));
                    break;
            }
            ASSERT_TRUE(holds(b, q)) << n << " " << k;
            ASSERT_TRUE(holds(ref::value::from_exact<Ball>(q), q));
        }
    }
}

}  // namespace
