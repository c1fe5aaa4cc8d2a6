// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What makes big meshes cheap, against the same asked the long way.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <limits>
#include <map>

#include "ref/coverage/fast/snapped.hpp"
#include "ref/coverage/triangle_setups.hpp"
#include "ref/expectation/vertex_numbers.hpp"
#include "tests/unit/ref/coverage_random.hpp"

namespace ref {
namespace {

using test::RandomCases;

// A corner on a sample, on the grid beside one, or anywhere, some of them outside the target.
int64_t corner(RandomCases& random, int64_t step) {
    const int64_t pixel = random.integer(-4, 20) * kFixedOne;
    switch (random.integer(0, 3)) {
        case 0:
            return pixel + kFixedOne / 2;
        case 1:
            return pixel + kFixedOne / 2 + step * random.integer(-2, 2);
        case 2:
            return pixel * random.integer(1, 300);
        default:
            return pixel + step * random.integer(0, kFixedOne / step);
    }
}

TriangleSetup snapped(RandomCases& random, const cases::Case& c) {
    TriangleSetup t;
    t.kind = TriangleSetup::Kind::outlines;
    t.has_outline = true;
    t.window = window_of(c, c.draws[0], cases::Profile::direct3d);
    t.window.sample_mask = random.flip() ? 0xffffffffU : 0x5a5aU;
    t.grid_step = int64_t{1} << (kFixedBits - (random.flip() ? 8 : 4));
    t.may_be_culled = random.integer(0, 3) == 0;
    Outline& o = t.unclipped;
    o.mode = OutlineMode::snapped;
    o.count = 3;
    // Some so small that a sample may be in the bounds of one candidate and not of another.
    const bool is_small = random.flip();
    for (size_t i = 0; i < 3; ++i) {
        const auto next = [&](int64_t first) {
            return i > 0 && is_small ? first + t.grid_step * random.integer(-3, 3)
                                     : corner(random, t.grid_step);
        };
        const int64_t x = next(o.boxes[0].x0);
        const int64_t y = i > 0 && random.integer(0, 4) == 0 ? o.boxes[0].y0 : next(o.boxes[0].y0);
        o.boxes[i] = i > 0 && random.integer(0, 9) == 0
                         ? o.boxes[i - 1]
                         : Box{x, y, x + t.grid_step * random.integer(0, 1),
                               y + t.grid_step * random.integer(0, 1)};
        o.edge.at(i) = static_cast<EdgeLabel>(i);
    }
    return t;
}

auto fields(const fast::Span& s) {
    return std::array<uint32_t, 6>{s.y,  s.sample,   s.x0,
                                   s.x1, s.triangle, static_cast<uint32_t>(s.coverage)};
}

TEST(MeshPaths, SnappedTrianglesAreScannedAsTheirHalfPlanesSay) {
    RandomCases random(20261122);
    size_t must = 0;
    size_t either = 0;
    for (int n = 0; n < 40000; ++n) {
        const cases::Case c = random.triangles();
        const TriangleSetup t = snapped(random, c);
        ASSERT_TRUE(fast::is_plain_snapped(t));
        std::vector<fast::Span> want;
        std::vector<fast::Span> got;
        fast::scan_by_sets(t, 7, c.target, want);
        fast::scan_snapped(t, 7, c.target, got);
        ASSERT_EQ(got.size(), want.size()) << n;
        for (size_t k = 0; k < got.size(); ++k) {
            ASSERT_EQ(fields(got[k]), fields(want[k])) << n;
            ++(got[k].coverage == Coverage::must ? must : either);
        }
    }
    EXPECT_GT(must, 10000U);
    EXPECT_GT(either, 10000U);
}

TEST(MeshPaths, SnappedTrianglesFarAwayAreLeftToTheHalfPlanes) {
    RandomCases random(20261123);
    TriangleSetup t = snapped(random, random.triangles());
    t.unclipped.boxes[2].x1 = int64_t{1} << 29;
    EXPECT_TRUE(fast::is_plain_snapped(t));
    t.unclipped.boxes[2].x1 += 1;
    EXPECT_FALSE(fast::is_plain_snapped(t));
}

// Few values, so that many vertices are the same, and some that only their bits tell apart.
float component(RandomCases& random) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kValues[] = {0.0F,       -0.0F,    1.0F, 0x1.000002p0F, 0x1p-149F,
                                 -0x1p-149F, 0x1p127F, kNan, -kNan};
    return kValues[random.integer(0, 8)];
}
glm::vec4 vector(RandomCases& random) {
    return {component(random), component(random), 0.5F, random.flip() ? 1.0F : component(random)};
}

TEST(MeshPaths, VertexNumbersAreThoseOfAMapOfAllBits) {
    RandomCases random(20261124);
    size_t shared = 0;
    for (int n = 0; n < 200; ++n) {
        cases::Case c = test::blank(8, 8, 1);
        for (int64_t d = random.integer(1, 6); d > 0; --d) {
            cases::Draw& draw = c.draws.emplace_back();
            draw.layer = static_cast<uint32_t>(random.integer(0, 1));
            draw.viewport = {0, random.flip() ? 0.0F : -0.0F, 8, random.flip() ? 8.0F : -8.0F};
            draw.viewport.min_depth = random.flip() ? 0.0F : 0.25F;  // tells no vertices apart
            draw.distances.clip_count = static_cast<uint32_t>(random.integer(0, 2));
            for (int64_t v = random.integer(1, 400); v > 0; --v) {
                draw.positions.push_back(vector(random));
                if (draw.distances.clip_count > 0) {
                    draw.distances.clip.push_back(vector(random));
                }
            }
        }
        VertexNumbers numbers(c);
        std::map<std::array<uint32_t, 14>, uint32_t> known;
        for (int k = 0; k < 1000; ++k) {
            const auto d = static_cast<uint32_t>(random.integer(0, std::ssize(c.draws) - 1));
            const cases::Draw& draw = c.draws[d];
            const auto v = static_cast<uint32_t>(random.integer(0, std::ssize(draw.positions) - 1));
            const glm::vec4 p = draw.positions[v];
            const glm::vec4 cut =
                draw.distances.clip_count > 0 ? draw.distances.clip[v] : glm::vec4(0);
            std::array<uint32_t, 14> key{draw.distances.clip_count, draw.layer};
            size_t at = 2;
            for (const float f :
                 {p.x, p.y, p.z, p.w, draw.viewport.x, draw.viewport.y, draw.viewport.width,
                  draw.viewport.height, cut.x, cut.y, cut.z, cut.w}) {
                key.at(at++) = std::bit_cast<uint32_t>(f);
            }
            const auto next = static_cast<uint32_t>(known.size() + 1);
            const auto [it, is_new] = known.try_emplace(key, next);
            ASSERT_EQ(numbers.of(d, v), it->second);
            shared += is_new ? 0U : 1U;
        }
    }
    EXPECT_GT(shared, 10000U);
}

TEST(MeshPaths, AForgottenSetUpIsMadeAgain) {
    RandomCases random(20261125);
    for (int n = 0; n < 200; ++n) {
        const cases::Case c = random.mesh();
        const std::vector<cases::Triangle> triangles = assemble(c);
        TriangleSetups kept(c, triangles, {}, cases::Profile::direct3d);
        TriangleSetups forgotten(c, triangles, {}, cases::Profile::direct3d);
        for (uint32_t t = 0; t < triangles.size(); ++t) {
            kept[t];
            forgotten[t];
            forgotten.forget_last(t);
        }
        for (uint32_t t = 0; t < triangles.size(); ++t) {
            std::vector<fast::Span> want;
            std::vector<fast::Span> got;
            fast::scan(kept[t], t, c.target, want);
            fast::scan(forgotten[t], t, c.target, got);
            ASSERT_EQ(got.size(), want.size());
            for (size_t k = 0; k < got.size(); ++k) {
                ASSERT_EQ(fields(got[k]), fields(want[k]));
            }
        }
        ASSERT_EQ(forgotten.known(), kept.known());
    }
}

}  // namespace
}  // namespace ref
