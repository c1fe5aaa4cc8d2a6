// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Bounds against devices: a simulated device snaps every vertex to some position of its box, the
// same for equal vertices, and draws with the top-left rule. Whatever it chooses, every sample must
// be allowed; and one hit too few or too many inside a mesh must not be.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "ref/coverage/fast/fast.hpp"
#include "ref/position/position.hpp"
#include "tests/unit/ref/clip_float.hpp"
#include "tests/unit/ref/coverage_random.hpp"

namespace ref::test {
namespace {

struct Hits {
    uint32_t front = 0, back = 0;
    std::vector<uint32_t> triangles;
};

// What a device draws that snaps vertex v of draw d to where[d][v].
std::vector<Hits> draw(const cases::Case& c, const std::vector<cases::Triangle>& triangles,
                       const std::vector<std::vector<FixedPoint>>& where) {
    std::vector<Hits> out;
    for (uint32_t j = 0; j < c.target.height; ++j) {
        for (uint32_t i = 0; i < c.target.width; ++i) {
            for (uint32_t s = 0; s < c.target.samples; ++s) {
                Hits h;
                const FixedPoint p = sample_position(i, j, s, c.target);
                for (uint32_t t = 0; t < triangles.size(); ++t) {
                    const cases::Draw& d = c.draws[triangles[t].draw];
                    const auto& v = where[triangles[t].draw];
                    const FixedPoint a = v[triangles[t].vertex[0]];
                    const FixedPoint b = v[triangles[t].vertex[1]];
                    const FixedPoint e = v[triangles[t].vertex[2]];
                    const int64_t x = int64_t{i} - d.scissor.x;
                    const int64_t y = int64_t{j} - d.scissor.y;
                    if (x < 0 || y < 0 || x >= d.scissor.width || y >= d.scissor.height ||
                        fast::winding(std::array{a, b, e}, p) == 0) {
                        continue;
                    }
                    const bool is_clockwise =
                        static_cast<double>(b.x - a.x) * static_cast<double>(e.y - a.y) >
                        static_cast<double>(b.y - a.y) * static_cast<double>(e.x - a.x);
                    const bool is_front =
                        is_clockwise == (d.front_face == cases::FrontFace::clockwise);
                    (is_front ? h.front : h.back) += 1;
                    h.triangles.push_back(t);
                }
                out.push_back(h);
            }
        }
    }
    return out;
}

class SnappingDevice {
  public:
    SnappingDevice(const cases::Case& c, const Setting& s) : case_(c) {
        for (const cases::Draw& d : c.draws) {
            for (const glm::vec4& p : d.positions) {
                boxes_[key(p)] = *position_box(p, d.viewport, s.limits, s.profile);
            }
        }
        const int64_t step = int64_t{1} << (kFixedBits - s.limits.subpixel_bits);
        step_ = s.profile == cases::Profile::vulkan ? 1 : step;
    }
    // Some position of each box: its corners mostly.
    std::vector<std::vector<FixedPoint>> snap(RandomCases& random) {
        std::map<Key, FixedPoint> chosen;
        for (const auto& [k, b] : boxes_) {
            const auto pick = [&](int64_t low, int64_t high) {
                if (random.integer(0, 3) == 0) {
                    return low + step_ * random.integer(0, (high - low) / step_);
                }
                return random.flip() ? low : high;
            };
            chosen[k] = {pick(b.x0, b.x1), pick(b.y0, b.y1)};
        }
        std::vector<std::vector<FixedPoint>> out;
        for (const cases::Draw& d : case_.draws) {
            out.emplace_back();
            for (const glm::vec4& p : d.positions) {
                out.back().push_back(chosen[key(p)]);
            }
        }
        return out;
    }

  private:
    using Key = std::array<float, 4>;
    static Key key(const glm::vec4& p) { return {p.x, p.y, p.z, p.w}; }
    const cases::Case& case_;
    std::map<Key, Box> boxes_;
    int64_t step_ = 1;
};

// A mesh that stays inside the view volume, so that the simulated device needs no clipping.
cases::Case inner_mesh(RandomCases& random, const Setting& s) {
    cases::Case c = blank(16, 16, random.flip() ? 1 : 4);
    cases::Draw d = whole(c);
    const int64_t n = random.integer(2, 4);
    const int64_t kind = random.integer(0, 3);
    for (int64_t y = 0; y <= n; ++y) {
        for (int64_t x = 0; x <= n; ++x) {
            double px = 2.0 + 12.0 * static_cast<double>(x) / static_cast<double>(n);
            double py = 2.0 + 12.0 * static_cast<double>(y) / static_cast<double>(n);
            const double grid = kind == 0 ? 2 : 512;
            px = std::nearbyint(px * grid) / grid;
            py = std::nearbyint(py * grid) / grid;
            if (kind == 2) {  // close to pixel centres, so that edges and vertices meet samples
                px = std::floor(px) + 0.5 + random.real(-1, 1) / (1 << s.limits.subpixel_bits);
                py = std::floor(py) + 0.5 + random.real(-1, 1) / (1 << s.limits.subpixel_bits);
            }
            d.positions.push_back(
                at_pixel(d, px, py, kind == 3 ? static_cast<float>(random.real(0.5, 4)) : 1));
        }
    }
    std::vector<uint32_t> indices;
    for (int64_t y = 0; y < n; ++y) {
        for (int64_t x = 0; x < n; ++x) {
            const auto a = static_cast<uint32_t>(y * (n + 1) + x);
            const auto e = static_cast<uint32_t>(a + n + 1);
            const uint32_t quad[6] = {a, a + 1, e, a + 1, e + 1, e};
            for (int t = 0; t < 2; ++t) {
                const bool is_turned = random.integer(0, 4) == 0;
                indices.insert(indices.end(), {quad[3 * t + (is_turned ? 1 : 0)],
                                               quad[3 * t + (is_turned ? 0 : 1)], quad[3 * t + 2]});
            }
        }
    }
    d.indices = indices;
    c.draws.push_back(d);
    if (random.integer(0, 3) == 0) {
        c.draws.push_back(d);  // a second layer: every edge is shared by four
    }
    return c;
}

TEST(ExhaustiveCoverageMesh, EverySnappingIsAllowed) {
    uint64_t fixed = 0;  // samples on shared edges that only the exactly-one rule decides
    for (uint64_t seed = 1; seed <= 250; ++seed) {
        RandomCases random(seed);
        const Setting s = setting(random);
        const cases::Case c = inner_mesh(random, s);
        const Expectation e = expect(c, s.limits, s.profile);
        SnappingDevice device(c, s);
        std::vector<std::pair<uint32_t, uint32_t>> range(e.samples.size(), {1000, 0});
        for (int round = 0; round < 6; ++round) {
            const std::vector<Hits> drawn = draw(c, e.triangles, device.snap(random));
            for (size_t k = 0; k < drawn.size(); ++k) {
                const SampleExpectation& sample = e.samples[k];
                ASSERT_TRUE(sample.hits.allows(drawn[k].front, drawn[k].back))
                    << "seed " << seed << ", sample " << k << ", front " << drawn[k].front
                    << ", back " << drawn[k].back << ", total " << sample.hits.total_min << ".."
                    << sample.hits.total_max;
                if (!drawn[k].triangles.empty()) {
                    const auto begin = e.writers.begin() + sample.writers_begin;
                    ASSERT_NE(
                        std::find(begin, begin + sample.writers_count, drawn[k].triangles.back()),
                        begin + sample.writers_count)
                        << "seed " << seed << ", sample " << k;
                }
            }
        }
        for (size_t k = 0; k < e.samples.size(); ++k) {
            const SampleExpectation& sample = e.samples[k];
            fixed += sample.writers_count > 1 && sample.hits.total_min == sample.hits.total_max &&
                     sample.hits.total_min > 0;
        }
    }
    EXPECT_GT(fixed, 500U);
}

// Every sample well inside a mesh of triangles that cannot flip: one hit, whatever the snapping.
TEST(CoverageMesh, InteriorIsHitOnce) {
    for (const cases::Profile profile : cases::kProfiles) {
        for (const int bits : {4, 8}) {
            cases::Case c = blank(32, 32);
            cases::Draw d = whole(c);
            RandomCases random(static_cast<uint64_t>(bits));
            for (int y = 0; y <= 4; ++y) {
                for (int x = 0; x <= 4; ++x) {
                    d.positions.push_back(at_pixel(d, 2 + 7 * x + random.real(-1, 1),
                                                   2 + 7 * y + random.real(-1, 1), 3));
                }
            }
            // Edges through many samples: the middle row of vertices on a line of centres.
            for (size_t x = 0; x <= 4; ++x) {
                d.positions[10 + x] = at_pixel(d, 2 + 7 * static_cast<double>(x), 16.5, 3);
            }
            std::vector<uint32_t> indices;
            for (uint32_t y = 0; y < 4; ++y) {
                for (uint32_t x = 0; x < 4; ++x) {
                    const uint32_t a = y * 5 + x;
                    indices.insert(indices.end(), {a, a + 1, a + 5, a + 1, a + 6, a + 5});
                }
            }
            d.indices = indices;
            c.draws.push_back(d);
            const Expectation e = expect(c, {bits}, profile);
            for (uint32_t j = 5; j < 27; ++j) {
                for (uint32_t i = 5; i < 27; ++i) {
                    const HitBounds& b = hits_at(e, i, j);
                    EXPECT_TRUE(b.allows(0, 1) || b.allows(1, 0)) << i << " " << j;
                    EXPECT_FALSE(b.allows(0, 0)) << i << " " << j;
                    EXPECT_FALSE(b.allows(2, 0) || b.allows(0, 2) || b.allows(1, 1));
                }
            }
        }
    }
}

// One rule at a time, on two triangles whose common edge runs through the centre of pixel (4,4).
struct Pair {
    cases::Case c = blank(8, 8);
    explicit Pair(std::array<glm::vec4, 6> v) {
        cases::Draw d = whole(c);
        d.positions.assign(v.begin(), v.end());
        c.draws.push_back(d);
    }
    static Pair sharing() {
        const cases::Case c = blank(8, 8);
        const cases::Draw d = whole(c);
        const auto at = [&](double x, double y) { return at_pixel(d, x, y); };
        return Pair({at(4.5, 1), at(4.5, 7), at(1, 4), at(4.5, 1), at(4.5, 7), at(7.25, 4)});
    }
    HitBounds middle(cases::Profile profile) const {
        return hits_at(expect(c, {8}, profile), 4, 4);
    }
};

TEST(CoverageMesh, PairIsHitOnceEvenInLiteralVulkan) {
    for (const cases::Profile profile : cases::kProfiles) {
        const HitBounds b = Pair::sharing().middle(profile);
        EXPECT_EQ(b.total_min, 1U);
        EXPECT_EQ(b.total_max, 1U);
    }
}

TEST(CoverageMesh, SameSideIsNotFixed) {
    Pair p = Pair::sharing();
    p.c.draws[0].positions[5] = at_pixel(p.c.draws[0], 2, 5);
    const HitBounds b = p.middle(cases::Profile::practice);
    EXPECT_EQ(b.total_min, 0U);
    EXPECT_EQ(b.total_max, 2U);
}

TEST(CoverageMesh, CulledPartnerIsNotCounted) {
    Pair p = Pair::sharing();
    std::swap(p.c.draws[0].positions[0], p.c.draws[0].positions[1]);
    p.c.draws[0].cull = cases::CullMode::none;
    EXPECT_EQ(p.middle(cases::Profile::practice).total_min, 1U);
    p = Pair::sharing();
    p.c.draws[0].cull = cases::CullMode::back;  // the two wind in opposite directions
    const HitBounds b = p.middle(cases::Profile::practice);
    EXPECT_EQ(b.total_min, 0U);
    EXPECT_EQ(b.total_max, 1U);
}

TEST(CoverageMesh, EndPointsMustBeBitwiseEqual) {
    Pair p = Pair::sharing();
    glm::vec4& v = p.c.draws[0].positions[3];
    v *= 2.0F;  // the same point, but not the same bits
    const HitBounds b = p.middle(cases::Profile::practice);
    EXPECT_EQ(b.total_min, 0U);
    EXPECT_EQ(b.total_max, 2U);
    EXPECT_EQ(p.middle(cases::Profile::direct3d).total_min, 1U);  // decided by top-left
}

TEST(CoverageMesh, AcrossDrawsOnlyInOneViewport) {
    Pair p = Pair::sharing();
    cases::Draw second = p.c.draws[0];
    second.positions.erase(second.positions.begin(), second.positions.begin() + 3);
    p.c.draws[0].positions.resize(3);
    p.c.draws.push_back(second);
    EXPECT_EQ(p.middle(cases::Profile::practice).total_min, 1U);
    p.c.draws[1].viewport.width = 16;
    p.c.draws[1].viewport.x = -4;
    for (glm::vec4& v : p.c.draws[1].positions) {
        v.x /= 2;
    }
    p.c.draws[1].positions[2].x = 0.5F;
    EXPECT_EQ(p.middle(cases::Profile::practice).total_min, 0U);
}

TEST(CoverageMesh, ThirdTriangleOnTheEdgeFreesIt) {
    Pair p = Pair::sharing();
    auto& v = p.c.draws[0].positions;
    v.insert(v.end(), {v[0], v[1], at_pixel(p.c.draws[0], 6, 4)});
    const HitBounds b = p.middle(cases::Profile::practice);
    EXPECT_EQ(b.total_min, 0U);
    EXPECT_EQ(b.total_max, 3U);
    // A fourth, on the other side, pairs up again: two layers.
    v.insert(v.end(), {v[0], v[1], at_pixel(p.c.draws[0], 2, 4)});
    EXPECT_EQ(p.middle(cases::Profile::practice).total_min, 2U);
    EXPECT_EQ(p.middle(cases::Profile::practice).total_max, 2U);
}

TEST(CoverageMesh, VertexSampleIsFreeInLiteralVulkanOnly) {
    cases::Case c = blank(8, 8);
    cases::Draw d = whole(c);
    const Point ring[] = {{7, 1}, {7, 7}, {1, 6}};
    for (int i = 0; i < 3; ++i) {
        for (const Point& q : {Point{4.5, 4.5}, ring[i], ring[(i + 1) % 3]}) {
            d.positions.push_back(at_pixel(d, q[0], q[1]));
        }
    }
    c.draws.push_back(d);
    const HitBounds literal = hits_at(expect(c, {8}, cases::Profile::vulkan), 4, 4);
    EXPECT_EQ(literal.total_min, 0U);
    EXPECT_EQ(literal.total_max, 3U);
    for (const cases::Profile profile : {cases::Profile::practice, cases::Profile::direct3d}) {
        const HitBounds b = hits_at(expect(c, {8}, profile), 4, 4);
        EXPECT_EQ(b.total_min, 1U);
        EXPECT_EQ(b.total_max, 1U);
    }
}

TEST(CoverageMesh, WritersEndWithTheLastThatMustHit) {
    const cases::Case c =
        pixels(8, 8, {{0, 0}, {8, 0}, {0, 8}, {-1, -1}, {8, 0}, {0, 8}, {4, 0}, {8, 0}, {0, 8}});
    const Expectation e = expect(c, {8}, cases::Profile::practice);
    const auto writers = [&](uint32_t i, uint32_t j) {
        const SampleExpectation& s = e.samples[j * 8 + i];
        return std::vector<uint32_t>(e.writers.begin() + s.writers_begin,
                                     e.writers.begin() + s.writers_begin + s.writers_count);
    };
    EXPECT_EQ(writers(1, 1), std::vector<uint32_t>({1}));
    EXPECT_EQ(writers(4, 2), std::vector<uint32_t>({2}));
    EXPECT_EQ(writers(7, 7), std::vector<uint32_t>());
    EXPECT_EQ(writers(3, 4), std::vector<uint32_t>({0, 1, 2}));  // on the common hypotenuse
}

// The near plane cuts two triangles along x = 8.5; where it meets their common edge nothing is
// fixed.
TEST(CoverageMesh, EdgesThatClippingMakesAreFree) {
    cases::Case c = blank(16, 16);
    cases::Draw d = whole(c);
    for (const Point& p : {Point{2, 8.5}, {14, 8.5}, {14, 2}, {2, 8.5}, {14, 8.5}, {14, 14}}) {
        d.positions.push_back(at_pixel(d, p[0], p[1]));
        d.positions.back().z = static_cast<float>((p[0] - 8.5) / 16);
    }
    c.draws.push_back(d);
    for (const cases::Profile profile : {cases::Profile::practice, cases::Profile::direct3d}) {
        const Expectation e = expect(c, {8}, profile);
        EXPECT_EQ(hits_at(e, 5, 8).total_max, 0U);
        EXPECT_EQ(hits_at(e, 12, 8).total_min, 1U);
        EXPECT_EQ(hits_at(e, 12, 8).total_max, 1U);
    }
    const Expectation e = expect(c, {8}, cases::Profile::practice);
    EXPECT_EQ(hits_at(e, 8, 8).total_min, 0U);
    EXPECT_EQ(hits_at(e, 8, 8).total_max, 2U);
    EXPECT_EQ(hits_at(expect(c, {8}, cases::Profile::vulkan), 12, 8).total_min, 0U);
}

// A device that clips in binary32, from the inner end of each edge, snaps to nearest and draws the
// polygon with the top-left rule: all it shows is allowed at every profile.
TEST(ExhaustiveCoverageMesh, ClippingDeviceIsAllowed) {
    uint64_t decided = 0;
    uint64_t clipped = 0;
    for (uint64_t seed = 1; seed <= 200; ++seed) {
        RandomCases random(seed);
        cases::Case c = blank(16, 16);
        cases::Draw d = whole(c);
        const double scale = std::pow(10.0, random.real(0.05, 3));
        const uint32_t n = 4;
        const bool is_behind = random.integer(0, 2) == 0;  // a plane through the eye
        for (uint32_t y = 0; y <= n; ++y) {
            for (uint32_t x = 0; x <= n; ++x) {
                const double px = scale * (2.0 * x / n - 1 + random.real(-.1, .1));
                const double py = scale * (2.0 * y / n - 1 + random.real(-.1, .1));
                const double w = is_behind ? 1 + py : random.real(0.5, 4);
                d.positions.emplace_back(px * (is_behind ? 1 : w), py * (is_behind ? 1 : w),
                                         w * random.real(0.2, 0.8), w);
            }
        }
        std::vector<uint32_t> indices;
        for (uint32_t y = 0; y < n; ++y) {
            for (uint32_t x = 0; x < n; ++x) {
                const uint32_t a = y * (n + 1) + x;
                indices.insert(indices.end(), {a, a + 1, a + n + 1, a + 1, a + n + 2, a + n + 1});
            }
        }
        d.indices = indices;
        c.draws.push_back(d);
        const std::vector<cases::Triangle> triangles = assemble(c);
        std::vector<std::vector<FixedPoint>> polygons;
        const bool is_depth_first = random.flip();
        for (const cases::Triangle& t : triangles) {
            const Triple v{d.positions[t.vertex[0]], d.positions[t.vertex[1]],
                           d.positions[t.vertex[2]]};
            polygons.emplace_back();
            clipped += !(is_inside(v[0]) && is_inside(v[1]) && is_inside(v[2]));
            for (const FloatVertex& p : float_clip(v, is_depth_first, 0)) {
                const float x = p.p.x * (1.0F / p.p.w) * 8 + 8;
                const float y = p.p.y * (1.0F / p.p.w) * 8 + 8;
                polygons.back().push_back({std::llrint(static_cast<double>(x) * 256) * 256,
                                           std::llrint(static_cast<double>(y) * 256) * 256});
            }
        }
        for (const cases::Profile profile : cases::kProfiles) {
            const Expectation e = expect(c, {8}, profile);
            for (uint32_t j = 0; j < 16; ++j) {
                for (uint32_t i = 0; i < 16; ++i) {
                    uint32_t front = 0;
                    uint32_t back = 0;
                    for (const auto& polygon : polygons) {
                        const int turns =
                            fast::winding(polygon, sample_position(i, j, 0, c.target));
                        front += turns < 0 ? 1U : 0U;
                        back += turns > 0 ? 1U : 0U;
                    }
                    const HitBounds& b = hits_at(e, i, j);
                    ASSERT_TRUE(b.allows(front, back))
                        << "seed " << seed << " profile " << cases::to_string(profile) << " pixel "
                        << i << " " << j << " front " << front << " back " << back << " allowed "
                        << b.total_min << ".." << b.total_max;
                    decided += b.is_decided() && b.total_min == 1 ? 1U : 0U;
                }
            }
        }
    }
    EXPECT_GT(clipped, 1000U);
    EXPECT_GT(decided, 40000U);
}

}  // namespace
}  // namespace ref::test
