// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Clip and cull distances: the fast reference against the oracle, both against the sign of the
// interpolated distance in rationals, and against a device that tests distances at each sample in
// binary32.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "ref/expectation/complement.hpp"
#include "tests/unit/ref/coverage_fixture.hpp"
#include "tests/unit/ref/coverage_random.hpp"
#include "tests/unit/ref/same_expectations.hpp"

namespace ref::test {
namespace {

void add_distances(RandomCases& random, cases::Draw& d, uint32_t count) {
    d.distances.clip_count = count;
    const int64_t kind = random.integer(0, 3);
    const double size = std::ldexp(1.0, static_cast<int>(random.integer(-12, 12)));
    for (size_t v = 0; v < d.positions.size(); ++v) {
        glm::vec4 out(0.0F);
        for (uint32_t k = 0; k < count; ++k) {
            const double value = kind == 0 ? static_cast<double>(random.integer(-2, 2))
                                           : random.real(-1, kind == 1 ? 3 : 1) * size;
            out[static_cast<glm::vec4::length_type>(k)] = static_cast<float>(value);
        }
        d.distances.clip.push_back(out);
    }
}

cases::Draw negated(cases::Draw d) {
    for (glm::vec4& v : d.distances.clip) {
        v = -v;
    }
    return d;
}

TEST(ExhaustiveClipDistance, FastIsTheOracle) {
    uint64_t open = 0;
    uint64_t decided = 0;
    uint64_t pairs = 0;
    for (uint64_t seed = 1; seed <= 400; ++seed) {
        RandomCases random(seed);
        const Setting s = setting(random);
        cases::Case c = random.integer(0, 9) == 0 ? random.mesh() : random.triangles();
        for (cases::Draw& d : c.draws) {
            add_distances(random, d, static_cast<uint32_t>(random.integer(1, 4)));
        }
        if (random.flip()) {
            c.draws.push_back(negated(c.draws[0]));
            pairs += complements_of(c, assemble(c)).empty() ? 0U : 1U;
        }
        const Expectation fast = expect(c, s.limits, s.profile);
        const Expectation slow = exact::expect(c, s.limits, s.profile);
        ASSERT_TRUE(same_expectations(fast, slow)) << "seed " << seed;
        open += fast.either_samples;
        decided += fast.must_samples;
    }
    EXPECT_GT(open, 300U);
    EXPECT_GT(decided, 5000U);
    EXPECT_GT(pairs, 80U);
}

// c at a sample: N = sum b_i d_i/w_i over the whole triangle, and whether the sample is strictly
// inside or outside.
struct Truth {
    int side = 0;  // 1 inside, -1 outside
    mpq_class numerator;
};
mpq_class exact_number(float f) {
    return mpq_class(static_cast<double>(f));
}
Truth truth_of(const cases::Draw& d, uint32_t i, uint32_t j) {
    std::array<mpq_class, 3> x, y;
    for (size_t v = 0; v < 3; ++v) {
        const IdealPosition at = ideal_position(d.positions[v], d.viewport);
        x[v] = at.x;
        y[v] = at.y;
    }
    const mpq_class px = mpq_class(2 * i + 1, 2);
    const mpq_class py = mpq_class(2 * j + 1, 2);
    const auto cross = [&](const mpq_class& ax, const mpq_class& ay, const mpq_class& bx,
                           const mpq_class& by) { return mpq_class(ax * by - ay * bx); };
    const mpq_class area = cross(x[1] - x[0], y[1] - y[0], x[2] - x[0], y[2] - y[0]);
    Truth out;
    out.side = 1;
    for (size_t v = 0; v < 3; ++v) {
        const size_t a = (v + 1) % 3;
        const size_t b = (v + 2) % 3;
        const mpq_class bary = cross(x[b] - x[a], y[b] - y[a], px - x[a], py - y[a]) / area;
        out.side = bary < 0 ? -1 : (bary == 0 && out.side > 0 ? 0 : out.side);
        out.numerator +=
            bary * exact_number(d.distances.clip[v].x) / exact_number(d.positions[v].w);
    }
    return out;
}

cases::Case one_triangle(RandomCases& random) {
    cases::Case c = blank(16, 16);
    cases::Draw d = whole(c);
    for (int v = 0; v < 3; ++v) {
        d.positions.push_back(at_pixel(d, static_cast<double>(random.integer(-1024, 5120)) / 256,
                                       static_cast<double>(random.integer(-1024, 5120)) / 256,
                                       std::ldexp(1.0F, static_cast<int>(random.integer(-2, 2)))));
    }
    add_distances(random, d, 1);
    c.draws.push_back(d);
    return c;
}

bool has_area(const cases::Draw& d) {
    std::array<IdealPosition, 3> p;
    for (size_t v = 0; v < 3; ++v) {
        p[v] = ideal_position(d.positions[v], d.viewport);
    }
    return (p[1].x - p[0].x) * (p[2].y - p[0].y) != (p[1].y - p[0].y) * (p[2].x - p[0].x);
}

TEST(ExhaustiveClipDistance, DecidesAsTheExactSignDoes) {
    uint64_t decided = 0;
    uint64_t all = 0;
    for (uint64_t seed = 1; seed <= 600; ++seed) {
        RandomCases random(seed);
        const cases::Case c = one_triangle(random);
        if (!has_area(c.draws[0])) {
            continue;
        }
        for (const cases::Profile profile : cases::kProfiles) {
            const Expectation e = expect(c, {8}, profile);
            for (uint32_t j = 0; j < 16; ++j) {
                for (uint32_t i = 0; i < 16; ++i) {
                    const Truth t = truth_of(c.draws[0], i, j);
                    const HitBounds& hits = hits_at(e, i, j);
                    const bool is_must = hits.total_min > 0;
                    const bool is_must_not = hits.total_max == 0;
                    ASSERT_FALSE(is_must && (t.side < 0 || t.numerator < 0)) << seed;
                    ASSERT_FALSE(is_must_not && t.side > 0 && t.numerator >= 0) << seed;
                    if (t.side > 0) {
                        ++all;
                        decided += is_must || is_must_not ? 1U : 0U;
                    }
                }
            }
        }
    }
    EXPECT_GT(all, 20000U);
    EXPECT_GT(decided, all * 95 / 100);  // the band is narrow
}

// A device that interpolates the distance in binary32 and draws where it is not negative.
struct Tested {
    std::array<double, 3> x{}, y{};
    bool is_drawn(const cases::Draw& d, uint32_t i, uint32_t j) const {
        const auto px = static_cast<float>(i) + 0.5F;
        const auto py = static_cast<float>(j) + 0.5F;
        std::array<float, 3> g{}, fx{}, fy{};
        for (size_t v = 0; v < 3; ++v) {
            g[v] = d.distances.clip[v].x * (1.0F / d.positions[v].w);
            fx[v] = static_cast<float>(x[v]);
            fy[v] = static_cast<float>(y[v]);
        }
        const float det = (fx[1] - fx[0]) * (fy[2] - fy[0]) - (fx[2] - fx[0]) * (fy[1] - fy[0]);
        const float inverse = 1.0F / det;
        const float dx =
            ((g[1] - g[0]) * (fy[2] - fy[0]) - (g[2] - g[0]) * (fy[1] - fy[0])) * inverse;
        const float dy =
            ((g[2] - g[0]) * (fx[1] - fx[0]) - (g[1] - g[0]) * (fx[2] - fx[0])) * inverse;
        const float origin = g[0] - (fx[0] * dx + fy[0] * dy);
        return origin + px * dx + py * dy >= 0;
    }
};

TEST(ExhaustiveClipDistance, AllowsADeviceThatTestsEachSample) {
    uint64_t open_and_drawn = 0;
    for (uint64_t seed = 1; seed <= 600; ++seed) {
        RandomCases random(seed);
        cases::Case c = one_triangle(random);
        if (random.flip()) {  // off the grid
            for (glm::vec4& p : c.draws[0].positions) {
                p.x += static_cast<float>(random.real(-0.001, 0.001));
                p.y += static_cast<float>(random.real(-0.001, 0.001));
            }
        }
        const cases::Draw& d = c.draws[0];
        Tested unsnapped;
        Tested snapped;
        for (size_t v = 0; v < 3; ++v) {
            const IdealPosition at = ideal_position(d.positions[v], d.viewport);
            unsnapped.x[v] = at.x.get_d();
            unsnapped.y[v] = at.y.get_d();
            snapped.x[v] = std::nearbyint(unsnapped.x[v] * 256) / 256;
            snapped.y[v] = std::nearbyint(unsnapped.y[v] * 256) / 256;
        }
        for (const cases::Profile profile : cases::kProfiles) {
            const Expectation e = expect(c, {8}, profile);
            for (uint32_t j = 0; j < 16; ++j) {
                for (uint32_t i = 0; i < 16; ++i) {
                    const HitBounds& hits = hits_at(e, i, j);
                    if (hits.total_max == 0 && truth_of(d, i, j).side <= 0) {
                        continue;
                    }
                    for (const Tested& device : {unsnapped, snapped}) {
                        const bool is_drawn = device.is_drawn(d, i, j);
                        ASSERT_FALSE(hits.total_min > 0 && !is_drawn)
                            << seed << " " << i << "," << j;
                        ASSERT_FALSE(hits.total_max == 0 && is_drawn)
                            << seed << " " << i << "," << j;
                        open_and_drawn += hits.total_min != hits.total_max && is_drawn ? 1U : 0U;
                    }
                }
            }
        }
    }
    EXPECT_GT(open_and_drawn, 10U);
}

TEST(ExhaustiveClipDistance, OnThePlaneIsOpenForOneDrawAndClosedForTwo) {
    cases::Case c = pixels(8, 8, {{-1, -1}, {20, -1}, {-1, 20}});
    cases::Draw& d = c.draws[0];
    d.distances = {1, 0, {{-4.5F, 0, 0, 0}, {16.5F, 0, 0, 0}, {-4.5F, 0, 0, 0}}, {}};  // x - 3.5
    for (const cases::Profile profile : cases::kProfiles) {
        const Expectation one = expect(c, {8}, profile);
        EXPECT_EQ(hits_at(one, 3, 2).total_min, 0U);
        EXPECT_EQ(hits_at(one, 3, 2).total_max, 1U);
        EXPECT_EQ(hits_at(one, 2, 2).total_max, 0U);
        EXPECT_EQ(hits_at(one, 4, 2).total_min, 1U);
        cases::Case both = c;
        both.draws.push_back(negated(c.draws[0]));
        const Expectation two = expect(both, {8}, profile);
        EXPECT_EQ(count_hits(two).once, 64U);
        // The same plane, but not the negated distances: no complement.
        for (glm::vec4& v : both.draws[1].distances.clip) {
            v *= 2.0F;
        }
        EXPECT_EQ(hits_at(expect(both, {8}, profile), 3, 2).total_max, 2U);
    }
}

TEST(ExhaustiveClipDistance, SeveralNegatedDistancesShareNoSample) {
    cases::Case c = pixels(8, 8, {{-1, -1}, {20, -1}, {-1, 20}});
    c.draws[0].distances = {2,
                            0,
                            {{-4.5F, -4.5F, 0, 0}, {16.5F, -4.5F, 0, 0}, {-4.5F, 16.5F, 0, 0}},
                            {}};  // x - 3.5, y - 3.5
    c.draws.push_back(negated(c.draws[0]));
    const Expectation e = expect(c, {8}, cases::Profile::vulkan);
    EXPECT_EQ(hits_at(e, 3, 3).total_min, 0U);
    EXPECT_EQ(hits_at(e, 3, 3).total_max, 1U);
    EXPECT_EQ(hits_at(e, 5, 5).total_min, 1U);
    EXPECT_EQ(hits_at(e, 1, 1).total_min, 1U);
    EXPECT_EQ(hits_at(e, 5, 1).total_max, 0U);
}

TEST(ExhaustiveClipDistance, ZeroEverywhereClipsNothing) {
    cases::Case c = pixels(8, 8, {{-1, -1}, {20, -1}, {-1, 20}});
    c.draws[0].distances = {1, 0, std::vector<glm::vec4>(3, glm::vec4(0.0F)), {}};
    EXPECT_EQ(count_hits(expect(c, {8}, cases::Profile::vulkan)).once, 64U);
    c.draws.push_back(negated(c.draws[0]));
    EXPECT_EQ(count_hits(expect(c, {8}, cases::Profile::vulkan)).twice, 64U);
    EXPECT_TRUE(complements_of(c, assemble(c)).empty() ||
                complements_of(c, assemble(c))[0].partner == kNoPartner);
}

TEST(CullDistance, NegativeAtAllVertices) {
    cases::Case c = pixels(8, 8, {{-1, -1}, {20, -1}, {-1, 20}});
    const auto once = [&](float a, float b, float e) {
        c.draws[0].distances = {0, 1, {}, {{a, 0, 0, 0}, {b, 0, 0, 0}, {e, 0, 0, 0}}};
        return count_hits(expect(c, {8}, cases::Profile::vulkan)).once;
    };
    EXPECT_EQ(once(-1, -1, -1), 0U);
    EXPECT_EQ(once(-1, -1, 0), 64U);
    EXPECT_EQ(once(-1, 1, -1), 64U);
    EXPECT_EQ(once(-0.0F, -1, -1), 64U);
    // Each vertex is outside of some distance, none of them outside of the same one.
    c.draws[0].distances = {0, 2, {}, {{-1, 1, 0, 0}, {-1, -1, 0, 0}, {1, -1, 0, 0}}};
    EXPECT_EQ(count_hits(expect(c, {8}, cases::Profile::vulkan)).once, 64U);
}

// Near plane at z = 0, at z = -w, and none.
// z of the whole triangle is within 3u of 1: cut at x = 64/3, while z rounded to nearest is 1 or
// less up to x = 128/3.
TEST(DepthClip, AllowsADeviceThatDiscardsSamplesByTheirDepth) {
    for (const cases::Profile profile : cases::kProfiles) {
        cases::Case c = blank(64, 8);
        cases::Draw draw = whole(c);
        const float near_one = 1 - 0x1p-24F;
        draw.positions = {{-1, -1, near_one, 1}, {1, -1, 1 + 0x1p-23F, 1}, {-1, 1, near_one, 1}};
        c.draws = {draw};
        const Expectation e = expect(c, {8}, profile);
        EXPECT_EQ(hits_at(e, 30, 1).total_max, 1U);
        EXPECT_EQ(hits_at(e, 30, 1).total_min, 0U);
        EXPECT_EQ(hits_at(e, 63, 7).total_max, 0U);  // beside the triangle
        // Steeper by 2^23 it is cut as it was.
        c.draws[0].positions = {{-1, -1, 0, 1}, {1, -1, 2, 1}, {-1, 1, 0, 1}};
        const Expectation steep = expect(c, {8}, profile);
        EXPECT_EQ(hits_at(steep, 30, 1).total_min, 1U);
        EXPECT_EQ(hits_at(steep, 33, 1).total_max, 0U);
    }
}

TEST(DepthClip, ADenormalBeforeTheNearPlaneMayBeOnIt) {
    for (const cases::Profile profile : cases::kProfiles) {
        cases::Case c = blank(4, 4);
        cases::Draw draw = whole(c);
        for (const float z : {-0x1p-149F, -0x1p-126F}) {
            draw.positions = {{-1, -1, z, 1}, {3, -1, z, 1}, {-1, 3, z, 1}};
            c.draws = {draw};
            const HitBounds hits = hits_at(expect(c, {8}, profile), 1, 1);
            EXPECT_EQ(hits.total_min, 0U);
            EXPECT_EQ(hits.total_max, z > -0x1p-126F ? 1U : 0U) << z;
            const Expectation oracle = exact::expect(c, {8}, profile);
            EXPECT_EQ(hits_at(oracle, 1, 1), hits);
        }
    }
}

TEST(DepthClip, Volumes) {
    cases::Case c = blank(8, 8);
    cases::Draw d = whole(c);
    d.positions = {{-4, -4, -2, 1}, {4, -4, -2, 1}, {0, 4, 1, 1}};  // z = -2 + 3 (y + 4)/8
    c.draws.push_back(d);
    const auto rows = [&](bool is_symmetric, std::optional<bool> clip) {
        c.draws[0].depth.negative_one_to_one = is_symmetric;
        c.draws[0].depth.clip = clip;
        const Expectation e = expect(c, {8}, cases::Profile::vulkan);
        int count = 0;
        for (uint32_t j = 0; j < 8; ++j) {
            count += hits_at(e, 4, j).total_min > 0 ? 1 : 0;
        }
        return count;
    };
    // z >= 0 from y = 4/3 in NDC on, beyond the target; z >= -1 from y = -4/3 on.
    EXPECT_EQ(rows(false, {}), 0);
    EXPECT_EQ(rows(true, {}), 8);
    EXPECT_EQ(rows(false, false), 8);
    EXPECT_EQ(rows(false, true), 0);
}

}  // namespace
}  // namespace ref::test
