// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Conservative coverage: both implementations against each other, against triangles that are cut by
// the squares of pixels in a third way, and against what is known by hand.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ref/coverage/exact/exact.hpp"
#include "ref/coverage/fast/fast.hpp"
#include "ref/coverage/setup.hpp"
#include "tests/unit/ref/coverage_random.hpp"
#include "tests/unit/ref/same_expectations.hpp"

namespace ref::test {
namespace {

using cases::Conservative;
using cases::Profile;

// A triangle in units of 1/256 pixel.
using Corners = std::array<std::array<int64_t, 2>, 3>;

struct Piece {
    bool is_there = false;  // some point of the closed square
    bool has_area = false;
};

// The triangle cut by the four lines of a square, in rationals.
Piece cut_by_square(const Corners& triangle, int64_t x0, int64_t y0, int64_t x1, int64_t y1) {
    using Polygon = std::vector<std::array<mpq_class, 2>>;
    Polygon left;
    for (const auto& [x, y] : triangle) {
        left.push_back({mpq_class(x), mpq_class(y)});
    }
    for (const auto& [axis, bound, sign] :
         {std::tuple(0, x0, 1), {0, x1, -1}, {1, y0, 1}, {1, y1, -1}}) {
        const auto inside = [&, k = static_cast<size_t>(axis), s = sign,
                             b = bound](const std::array<mpq_class, 2>& p) {
            return mpq_class((p.at(k) - b) * s);
        };
        Polygon next;
        for (size_t i = 0; i < left.size(); ++i) {
            const auto& p = left[i];
            const auto& q = left[(i + 1) % left.size()];
            const mpq_class at_p = inside(p);
            const mpq_class at_q = inside(q);
            if (at_p >= 0) {
                next.push_back(p);
            }
            if (sgn(at_p) * sgn(at_q) < 0) {
                const mpq_class t = at_p / (at_p - at_q);
                next.push_back(
                    {mpq_class(p[0] + t * (q[0] - p[0])), mpq_class(p[1] + t * (q[1] - p[1]))});
            }
        }
        left = std::move(next);
    }
    mpq_class area;
    for (size_t i = 1; i + 1 < left.size(); ++i) {
        area += (left[i][0] - left[0][0]) * (left[i + 1][1] - left[0][1]) -
                (left[i][1] - left[0][1]) * (left[i + 1][0] - left[0][0]);
    }
    return {!left.empty(), area != 0};
}

int64_t twice_area(const Corners& t) {
    return (t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[1][1] - t[0][1]) * (t[2][0] - t[0][0]);
}

// Whether the square lies in the triangle, without its border or with it.
bool is_filled(const Corners& t, int64_t x0, int64_t y0, int64_t x1, int64_t y1, bool is_strict) {
    const int64_t sign = twice_area(t) > 0 ? 1 : -1;
    for (const int64_t x : {x0, x1}) {
        for (const int64_t y : {y0, y1}) {
            for (size_t k = 0; k < 3; ++k) {
                const auto& a = t.at(k);
                const auto& b = t.at((k + 1) % 3);
                const int64_t e = sign * ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]));
                if (is_strict ? e <= 0 : e < 0) {
                    return false;
                }
            }
        }
    }
    return true;
}

Corners corners(RandomCases& random) {
    const int64_t grid = random.flip() ? 1 : (random.flip() ? 64 : 128);
    Corners out{};
    for (auto& [x, y] : out) {
        x = random.integer(1, 8 * 256 / grid - 1) * grid;
        y = random.integer(1, 8 * 256 / grid - 1) * grid;
    }
    if (random.integer(0, 3) == 0) {  // smaller than a pixel
        for (size_t k : {1U, 2U}) {
            for (size_t axis : {0U, 1U}) {
                out.at(k).at(axis) =
                    std::clamp<int64_t>(out[0].at(axis) + random.integer(-40, 40), 1, 8 * 256 - 1);
            }
        }
    }
    return out;
}

cases::Case case_of(const Corners& t, Conservative mode, float extra = 0, uint32_t samples = 1) {
    std::vector<Point> points;
    for (const auto& [x, y] : t) {
        points.push_back({static_cast<double>(x) / 256, static_cast<double>(y) / 256});
    }
    cases::Case c = pixels(8, 8, points, samples);
    c.draws[0].conservative = mode;
    c.draws[0].conservative_extra = extra;
    return c;
}

Limits limits_of(float size, float step = 0, bool keeps = true) {
    Limits out;
    out.overestimation = size;
    out.overestimation_step = step;
    out.rasterizes_degenerates = keeps;
    return out;
}

// On the grid nothing is free but borders and what the device adds.
TEST(Conservative, TrianglesOnTheGrid) {
    uint64_t musts = 0;
    uint64_t opens = 0;
    uint64_t nots = 0;
    for (uint64_t seed = 1; seed <= 1500; ++seed) {
        RandomCases random(seed);
        const Corners t = corners(random);
        if (twice_area(t) == 0) {
            continue;
        }
        const bool is_over = seed % 2 == 0;
        const int64_t units[] = {0, 1, 128};
        const int64_t size = units[seed / 2 % 3];
        const cases::Case c =
            case_of(t, is_over ? Conservative::overestimate : Conservative::underestimate);
        const Expectation e =
            expect(c, limits_of(static_cast<float>(size) / 256), Profile::direct3d);
        const Expectation practice =
            expect(c, limits_of(static_cast<float>(size) / 256), Profile::practice);
        for (int64_t j = 0; j < 8; ++j) {
            for (int64_t i = 0; i < 8; ++i) {
                const HitBounds hits =
                    hits_at(e, static_cast<uint32_t>(i), static_cast<uint32_t>(j));
                const int64_t x = i * 256;
                const int64_t y = j * 256;
                bool must = false;
                bool may = false;
                if (is_over) {
                    const int64_t by = size + 1;
                    must = cut_by_square(t, x, y, x + 256, y + 256).has_area;
                    may = cut_by_square(t, x - by, y - by, x + 256 + by, y + 256 + by).is_there;
                } else {
                    must = is_filled(t, x - 1, y - 1, x + 257, y + 257, true);
                    may = is_filled(t, x, y, x + 256, y + 256, false);
                }
                ASSERT_EQ(hits.total_min, must ? 1U : 0U)
                    << "seed " << seed << " at " << i << ' ' << j;
                ASSERT_EQ(hits.total_max, may ? 1U : 0U)
                    << "seed " << seed << " at " << i << ' ' << j;
                // The corners are all that practice leaves free besides.
                const HitBounds loose =
                    hits_at(practice, static_cast<uint32_t>(i), static_cast<uint32_t>(j));
                ASSERT_EQ(loose.total_min, hits.total_min) << "seed " << seed;
                ASSERT_GE(loose.total_max, hits.total_max) << "seed " << seed;
                musts += must ? 1 : 0;
                opens += may && !must ? 1 : 0;
                nots += may ? 0 : 1;
            }
        }
    }
    EXPECT_GT(musts, 5000U);
    EXPECT_GT(opens, 2000U);
    EXPECT_GT(nots, 10000U);
}

cases::Case random_case(RandomCases& random) {
    cases::Case c = random.integer(0, 5) == 0 ? random.mesh() : random.triangles();
    for (cases::Draw& d : c.draws) {
        d.conservative = static_cast<Conservative>(std::max<int64_t>(0, random.integer(-1, 2)));
        if (d.conservative == Conservative::overestimate && random.flip()) {
            d.conservative_extra = static_cast<float>(random.integer(0, 300)) / 256;
        }
    }
    return c;
}
Setting random_setting(RandomCases& random) {
    Setting s = setting(random);
    const float sizes[] = {0, 1.0F / 512, 0.5F, 0.3F};
    s.limits.overestimation = sizes[random.integer(0, 3)];
    s.limits.overestimation_step = random.flip() ? 0 : 0.25F;
    s.limits.rasterizes_degenerates = random.flip();
    return s;
}

TEST(ExhaustiveConservative, FastAndExactAgree) {
    uint64_t samples = 0;
    uint64_t decided = 0;
    uint64_t open = 0;
    for (uint64_t seed = 1; samples < 60000; ++seed) {
        RandomCases random(seed);
        const Setting s = random_setting(random);
        const cases::Case c = random_case(random);
        const Expectation fast = expect(c, s.limits, s.profile);
        ASSERT_TRUE(same_expectations(fast, exact::expect(c, s.limits, s.profile)))
            << "seed " << seed << ", profile " << cases::to_string(s.profile) << ", bits "
            << s.limits.subpixel_bits;
        samples += fast.samples.size();
        decided += fast.must_samples;
        open += fast.either_samples;
    }
    EXPECT_GT(decided, samples / 20);
    EXPECT_GT(open, 1000U);
}

// What a profile allows each looser one does.
TEST(Conservative, ProfilesNest) {
    for (uint64_t seed = 1; seed <= 400; ++seed) {
        RandomCases random(seed);
        const Setting s = random_setting(random);
        const cases::Case c = random_case(random);
        // How the corners of a clipped polygon are joined differs from profile to profile, so that
        // one may prove a little more there than a stricter one.
        const bool is_inside = std::ranges::all_of(c.draws, [](const cases::Draw& d) {
            return std::ranges::all_of(d.positions, [](const glm::vec4& p) {
                return std::fabs(p.x) <= p.w && std::fabs(p.y) <= p.w && p.z >= 0 && p.z <= p.w;
            });
        });
        const Expectation loose = expect(c, s.limits, Profile::vulkan);
        const Expectation middle = expect(c, s.limits, Profile::practice);
        const Expectation strict = expect(c, s.limits, Profile::direct3d);
        for (size_t k = 0; k < loose.samples.size(); ++k) {
            const HitBounds& a = loose.samples[k].hits;
            const HitBounds& b = middle.samples[k].hits;
            const HitBounds& d = strict.samples[k].hits;
            if (is_inside) {
                ASSERT_LE(a.total_min, b.total_min) << "seed " << seed << " sample " << k;
                ASSERT_LE(b.total_min, d.total_min) << "seed " << seed << " sample " << k;
            }
            ASSERT_GE(a.total_max, b.total_max) << "seed " << seed << " sample " << k;
            ASSERT_GE(b.total_max, d.total_max) << "seed " << seed << " sample " << k;
        }
    }
}

// All samples of a pixel have one answer, wherever they lie.
TEST(Conservative, SamplesOfAPixelAgree) {
    for (uint64_t seed = 1; seed <= 100; ++seed) {
        RandomCases random(seed);
        const Corners t = corners(random);
        const auto mode = seed % 2 == 0 ? Conservative::overestimate : Conservative::underestimate;
        const Expectation one = expect(case_of(t, mode), limits_of(0), Profile::direct3d);
        const Expectation four = expect(case_of(t, mode, 0, 4), limits_of(0), Profile::direct3d);
        for (size_t k = 0; k < four.samples.size(); ++k) {
            ASSERT_EQ(four.samples[k].hits, one.samples[k / 4].hits) << "seed " << seed;
        }
    }
}

// Vertices 2^-14 pixels from a line of the grid: no area once they are snapped, some before.
cases::Case nearly_flat(Conservative mode) {
    cases::Case c = pixels(8, 8, {{1.25, 1.5}, {6.75, 4.25}, {4, 2.875 + std::ldexp(1.0, -14)}});
    c.draws[0].conservative = mode;
    return c;
}

TEST(Conservative, DegeneratesAreDrawnAsTheDeviceSays) {
    const cases::Case c = nearly_flat(Conservative::overestimate);
    const Expectation kept = expect(c, limits_of(0, 0, true), Profile::direct3d);
    const Expectation culled = expect(c, limits_of(0, 0, false), Profile::direct3d);
    EXPECT_GE(kept.must_samples, 8U);
    EXPECT_EQ(hits_at(kept, 4, 2).back_min, 1U);  // a back face
    EXPECT_EQ(culled.must_samples, 0U);
    EXPECT_EQ(culled.either_samples, 0U);
    // One that had no area before "may be culled regardless".
    cases::Case flat = c;
    flat.draws[0].positions[2] = at_pixel(flat.draws[0], 4, 2.875);
    const Expectation open = expect(flat, limits_of(0, 0, true), Profile::direct3d);
    EXPECT_EQ(open.must_samples, 0U);
    EXPECT_GE(open.either_samples, 8U);
    EXPECT_EQ(expect(flat, limits_of(0, 0, false), Profile::practice).either_samples, 0U);
    // Underestimated it fills nothing.
    const Expectation under =
        expect(nearly_flat(Conservative::underestimate), limits_of(0, 0, true), Profile::direct3d);
    EXPECT_EQ(under.must_samples + under.either_samples, 0U);
    cases::Case back = c;
    back.draws[0].cull = cases::CullMode::back;
    EXPECT_EQ(expect(back, limits_of(0, 0, true), Profile::direct3d).either_samples, 0U);
}

TEST(Conservative, ExtraSizeReachesHalfOfItAndNoMoreThanAll) {
    // Its right side is a quarter of a pixel before column 4.
    const Corners t{{{256, 256}, {960, 256}, {256, 960}}};
    const auto column = [&](float extra, float step, uint32_t x) {
        return hits_at(expect(case_of(t, Conservative::overestimate, extra), limits_of(0, step),
                              Profile::direct3d),
                       x, 1);
    };
    EXPECT_EQ(column(0, 0, 4).total_max, 0U);
    EXPECT_EQ(column(0.24F, 0, 4).total_max, 0U);
    EXPECT_EQ(column(0.25F, 0, 4).total_max, 1U);
    EXPECT_EQ(column(0.25F, 0, 4).total_min, 0U);
    EXPECT_EQ(column(0.5F, 0, 4).total_min, 0U);  // a unit is left for the grid
    EXPECT_EQ(column(0.52F, 0, 4).total_min, 1U);
    EXPECT_EQ(column(0.75F, 0, 4).total_min, 1U);
    EXPECT_EQ(column(0.52F, 0.5F, 4).total_min, 0U);  // may be taken for half a pixel,
    EXPECT_EQ(column(0.75F, 0.5F, 5).total_max, 0U);  // or for one
    EXPECT_EQ(column(1.2F, 0, 5).total_max, 0U);
    EXPECT_EQ(column(1.2F, 0.5F, 5).total_max, 1U);
    // Vulkan says how large the size is, and that results approximate it.
    EXPECT_EQ(
        hits_at(expect(case_of(t, Conservative::overestimate), limits_of(0), Profile::vulkan), 7, 7)
            .total_max,
        1U);
    EXPECT_EQ(
        hits_at(expect(case_of(t, Conservative::underestimate), limits_of(0), Profile::vulkan), 7,
                7)
            .total_max,
        0U);
}

// A triangle whose corner the near plane cuts off, from (1.25, 1.5) and (10.75, 2.25) to (5.125,
// 10.5) in depth -1/4: a quad is left, which a device may draw as two triangles.
cases::Case cut_by_near_plane(Conservative mode) {
    cases::Case c = pixels(16, 16, {{1.25, 1.5}, {10.75, 2.25}, {5.125, 10.5}});
    c.draws[0].positions[0].z = c.draws[0].positions[1].z = 0.75F;
    c.draws[0].positions[2].z = -0.25F;
    c.draws[0].conservative = mode;
    return c;
}

// The cut's ends are at three quarters of the edges: (4.15625, 8.25) and (6.53125, 8.4375).
TEST(Conservative, PiecesOfAClippedTriangleMeet) {
    const Expectation over =
        expect(cut_by_near_plane(Conservative::overestimate), limits_of(0), Profile::direct3d);
    const auto bounds = [](const Expectation& e, uint32_t x, uint32_t y) {
        const HitBounds hits = hits_at(e, x, y);
        return std::pair(hits.total_min, hits.total_max);
    };
    using Bounds = std::pair<uint32_t, uint32_t>;
    EXPECT_EQ(bounds(over, 9, 2), Bounds(1, 2));  // from the second corner to the cut
    EXPECT_EQ(bounds(over, 7, 5), Bounds(1, 2));
    EXPECT_EQ(bounds(over, 2, 3), Bounds(1, 2));  // from the first one
    EXPECT_EQ(bounds(over, 5, 2), Bounds(1, 1));
    EXPECT_EQ(bounds(over, 3, 2), Bounds(1, 1));
    EXPECT_EQ(bounds(over, 12, 2), Bounds(0, 0));
    const Expectation under =
        expect(cut_by_near_plane(Conservative::underestimate), limits_of(0), Profile::direct3d);
    EXPECT_EQ(bounds(under, 7, 4), Bounds(0, 1));
    EXPECT_EQ(bounds(under, 5, 3), Bounds(1, 1));
    EXPECT_EQ(bounds(under, 6, 3), Bounds(1, 1));
    EXPECT_EQ(bounds(under, 1, 1), Bounds(0, 0));
}

// The second corner lies on the far plane, which cuts off the third half way to the first: (2, 4).
// A device that finds a cut at the second corner, too, has a piece without area from there to (2,
// 4). An H100 has it.
TEST(Conservative, ACornerOnThePlaneMayBeAPieceWithoutArea) {
    cases::Case c = pixels(8, 8, {{1, 1}, {6, 2}, {3, 7}});
    c.draws[0].positions[1].z = 1;
    c.draws[0].positions[2].z = 1.5F;
    c.draws[0].conservative = Conservative::overestimate;
    const auto hits = [&](bool keeps, uint32_t x, uint32_t y) {
        return hits_at(expect(c, limits_of(0, 0, keeps), Profile::direct3d), x, y);
    };
    EXPECT_EQ(hits(true, 3, 3).total_max, 2U);
    EXPECT_EQ(hits(false, 3, 3).total_max, 1U);
    EXPECT_EQ(hits(true, 3, 5).total_max, 0U);
    // A piece without area is a back face, whichever way the triangle faces.
    EXPECT_TRUE(hits(true, 3, 3).allows(1, 1));
    EXPECT_FALSE(hits(true, 3, 3).allows(2, 1));
}

// Two pieces have planes of their own, so that their depths need not be equal; nor need those of a
// draw by samples and a conservative one, which are no two of the same state.
TEST(Conservative, DepthsOfPiecesAndOfOtherModesMayDiffer) {
    cases::Case pieces = cut_by_near_plane(Conservative::overestimate);
    pieces.draws[0].depth.write = false;
    pieces.target.has_stencil = true;  // its paths follow each piece
    pieces.draws[0].stencil.front.pass = cases::StencilOp::increment_and_clamp;
    const HitBounds hits = hits_at(expect(pieces, limits_of(0), Profile::direct3d), 9, 2);
    EXPECT_TRUE(hits.allows(0, 1));
    EXPECT_TRUE(hits.allows(0, 2));

    // Nor is a further piece there because the first one is, or the same triangle was.
    cases::Case again = pieces;
    again.draws.push_back(again.draws[0]);
    const HitBounds both = hits_at(expect(again, limits_of(0), Profile::direct3d), 9, 2);
    EXPECT_EQ(both.total_min, 2U);
    EXPECT_EQ(both.total_max, 4U);

    cases::Case twice = pixels(8, 8, {{1.25, 1.25}, {7, 1.5}, {1.5, 7}});
    twice.draws[0].positions[1].z = 0.25F;
    twice.draws[0].conservative = Conservative::overestimate;
    twice.draws[0].depth.compare = cases::CompareOp::greater;
    twice.draws.push_back(twice.draws[0]);
    EXPECT_EQ(hits_at(expect(twice, limits_of(0), Profile::direct3d), 3, 3).total_max, 1U);
    twice.draws[1].conservative = Conservative::none;
    EXPECT_EQ(hits_at(expect(twice, limits_of(0), Profile::direct3d), 3, 3).total_max, 2U);
}

// A clip distance and its negative share out the samples along the cut, x = 4.5 here, but of
// conservative draws both cover the pixels there.
TEST(Conservative, ComplementsShareOutNothing) {
    cases::Case c = pixels(8, 8, {{1, 1}, {7, 1}, {1, 7}});
    cases::Draw& draw = c.draws[0];
    draw.distances.clip_count = 1;
    draw.distances.clip = {{3.5F, 0, 0, 0}, {-2.5F, 0, 0, 0}, {3.5F, 0, 0, 0}};
    c.draws.push_back(draw);
    for (glm::vec4& d : c.draws[1].distances.clip) {
        d.x = -d.x;
    }
    EXPECT_EQ(hits_at(expect(c, limits_of(0), Profile::direct3d), 4, 2).total_max, 1U);
    for (cases::Draw& d : c.draws) {
        d.conservative = Conservative::overestimate;
    }
    EXPECT_EQ(hits_at(expect(c, limits_of(0), Profile::direct3d), 4, 2).total_max, 2U);
}

// Both triangles at an edge cover the pixels on it, and neither scissor nor viewport is enlarged.
TEST(Conservative, SharedEdgesScissorAndViewport) {
    cases::Case c = pixels(
        8, 8, {{1.25, 1.5}, {6.75, 1.5}, {6.75, 6.25}, {1.25, 1.5}, {6.75, 6.25}, {1.25, 6.25}});
    c.draws[0].conservative = Conservative::overestimate;
    for (const Profile profile : cases::kProfiles) {
        EXPECT_EQ(hits_at(expect(c, limits_of(0), profile), 2, 2).total_min, 2U);
    }
    c.draws[0].scissor = {2, 2, 3, 3};
    const Expectation cut = expect(c, limits_of(0.5F), Profile::direct3d);
    EXPECT_EQ(hits_at(cut, 4, 4).total_min, 2U);
    EXPECT_EQ(hits_at(cut, 5, 4).total_max, 0U);
    EXPECT_EQ(hits_at(cut, 1, 2).total_max, 0U);
    cases::Case view = pixels(8, 8, {{-20, -20}, {28, -20}, {-20, 60}});
    view.draws[0].viewport = {2, 2, 3, 3};
    for (glm::vec4& p : view.draws[0].positions) {
        p = {p.x < 0 ? -30.0F : 30.0F, p.y < 0 ? -30.0F : 30.0F, 0.5F, 1};
    }
    view.draws[0].conservative = Conservative::overestimate;
    const Expectation inside = expect(view, limits_of(0), Profile::direct3d);
    EXPECT_EQ(hits_at(inside, 2, 2).total_min, 1U);
    EXPECT_EQ(hits_at(inside, 5, 3).total_min, 0U);  // touched by the clipped polygon's border
    EXPECT_EQ(hits_at(inside, 6, 3).total_max, 0U);
}

}  // namespace
}  // namespace ref::test
