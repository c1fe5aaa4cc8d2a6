// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Every scan finds the samples that the oracle finds.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "rasterizers/algorithms/edge.hpp"
#include "ref/coverage/exact/exact.hpp"
#include "tests/unit/rasterizers/random_triangles.hpp"

namespace rasterizers {
namespace {

using test::RandomTriangles;

struct NamedScan {
    std::string_view name;
    Scan scan = nullptr;
};
constexpr NamedScan kScans[] = {{"flat-parts", scan_flat_parts},
                                {"incremental", scan_incremental},
                                {"quads", scan_quads},
                                {"tiles", scan_tiles},
                                {"same-sign", scan_same_sign},
                                {"areas", scan_areas},
                                {"brown", scan_brown}};

ref::FixedPoint to_fixed(const SubpixelPoint& p) {
    constexpr int64_t kScale = ref::kFixedOne / kPixel;
    return {p.x * kScale, p.y * kScale};
}

// One character a pixel of the rectangle; 'X' for a pixel that came twice or lies outside.
std::string draw(const NamedScan& scan, const Corners& t, const PixelRect& rect,
                 const SubpixelPoint& offset, Work* work = nullptr) {
    Picture picture;
    scan.scan(t, rect, offset, picture);
    const auto width = static_cast<size_t>(rect.x1 - rect.x0);
    std::string out(width * static_cast<size_t>(rect.y1 - rect.y0), '.');
    for (const Span& s : picture.spans) {
        if (s.y < rect.y0 || s.y >= rect.y1 || s.x0 < rect.x0 || s.x1 > rect.x1 || s.x0 >= s.x1) {
            return "a span is empty or outside";
        }
        for (int64_t x = s.x0; x < s.x1; ++x) {
            char& pixel =
                out[static_cast<size_t>(s.y - rect.y0) * width + static_cast<size_t>(x - rect.x0)];
            pixel = pixel == '.' ? '#' : 'X';
        }
    }
    if (work != nullptr) {
        *work = picture.work;
    }
    return out;
}

std::string draw_exactly(const Corners& t, const PixelRect& rect, const SubpixelPoint& offset) {
    std::string out;
    for (int64_t y = rect.y0; y < rect.y1; ++y) {
        for (int64_t x = rect.x0; x < rect.x1; ++x) {
            out += ref::exact::covers(to_fixed(t[0]), to_fixed(t[1]), to_fixed(t[2]),
                                      to_fixed(sample_of(x, y, offset)))
                       ? '#'
                       : '.';
        }
    }
    return out;
}

std::string describe(const Corners& t) {
    std::string out;
    for (const SubpixelPoint& p : t) {
        out += "(" + std::to_string(p.x) + "," + std::to_string(p.y) + ") ";
    }
    return out + "in 1/256 pixel";
}

// More than 10^5 triangles, some 6 million samples for each scan. Each kind must show covered and
// uncovered samples, so that agreement is not that of blank pictures.
TEST(Scans, AgreeWithTheOracleOnRandomTriangles) {
    constexpr int kTriangles = 104000;
    RandomTriangles random(20260101);
    std::map<int64_t, uint64_t> covered;
    std::map<int64_t, uint64_t> uncovered;
    for (int n = 0; n < kTriangles; ++n) {
        const int64_t kind = n % RandomTriangles::kKinds;
        const int64_t size = random.integer(1, 13);
        const Corners t = random.triangle(kind, size);
        PixelRect rect{0, 0, size, size};
        if (n % 5 == 0) {  // cut off by a scissor
            rect = {random.integer(0, size - 1), random.integer(0, size - 1), 0, 0};
            rect.x1 = random.integer(rect.x0 + 1, size);
            rect.y1 = random.integer(rect.y0 + 1, size);
        }
        SubpixelPoint offset{128, 128};
        if (n % 7 == 0) {
            offset = {random.integer(0, 15) * 16, random.integer(0, 15) * 16};
        }
        const std::string expected = draw_exactly(t, rect, offset);
        for (const char c : expected) {
            ++(c == '#' ? covered : uncovered)[kind];
        }
        for (const NamedScan& scan : kScans) {
            ASSERT_EQ(draw(scan, t, rect, offset), expected)
                << scan.name << " " << describe(t) << " kind " << kind;
        }
    }
    for (int64_t kind = 0; kind < RandomTriangles::kKinds; ++kind) {
        EXPECT_GT(covered[kind], 100U) << kind;
        EXPECT_GT(uncovered[kind], 1000U) << kind;
    }
}

// Targets of several tiles, at any place of the largest target.
TEST(Scans, AgreeAcrossTilesAndFarFromTheOrigin) {
    RandomTriangles random(7);
    uint64_t covered = 0;
    for (int n = 0; n < 180; ++n) {
        const int64_t size = random.integer(60, 150);
        const int64_t far = n % 2 == 0 ? 0 : kMaxPixel - size;
        Corners t = random.triangle(n % RandomTriangles::kKinds, size);
        for (SubpixelPoint& p : t) {
            p = {std::clamp(p.x + far * kPixel, -kMaxCoordinate, kMaxCoordinate),
                 std::clamp(p.y + far * kPixel, -kMaxCoordinate, kMaxCoordinate)};
        }
        const PixelRect rect{far, far, far + size, far + size};
        const SubpixelPoint offset{128, 128};
        const std::string expected = draw_exactly(t, rect, offset);
        covered += static_cast<uint64_t>(std::count(expected.begin(), expected.end(), '#'));
        for (const NamedScan& scan : kScans) {
            ASSERT_EQ(draw(scan, t, rect, offset), expected) << scan.name << " " << describe(t);
        }
    }
    EXPECT_GT(covered, 50000U);
}

// The corners of the number format: the largest products that can occur.
TEST(Scans, AgreeAtTheLimitsOfTheFormat) {
    const int64_t m = kMaxCoordinate;
    const int64_t values[] = {-m, -m + 1, -1, 0, 127, 128, 129, m - 1, m};
    uint64_t covered = 0;
    RandomTriangles random(3);
    const PixelRect rects[] = {{0, 0, 5, 5}, {kMaxPixel - 5, kMaxPixel - 5, kMaxPixel, kMaxPixel}};
    for (int n = 0; n < 4000; ++n) {
        Corners t;
        for (SubpixelPoint& p : t) {
            p = {values[random.integer(0, 8)], values[random.integer(0, 8)]};
        }
        for (const PixelRect& rect : rects) {
            const std::string expected = draw_exactly(t, rect, {128, 128});
            covered += static_cast<uint64_t>(std::count(expected.begin(), expected.end(), '#'));
            for (const NamedScan& scan : kScans) {
                ASSERT_EQ(draw(scan, t, rect, {128, 128}), expected)
                    << scan.name << " " << describe(t);
            }
        }
    }
    EXPECT_GT(covered, 1000U);
}

// Edges that pass a sample as near as they can without touching it, E = 1 or E = -1 unit of area: a
// walker's remainder carries exactly there, and nowhere else.
TEST(Scans, AgreeOneUnitOfAreaBesideAnEdge) {
    RandomTriangles random(23);
    int beside = 0;
    for (int n = 0; n < 4000; ++n) {
        const SubpixelPoint p = sample_of(random.integer(1, 14), random.integer(1, 14), {128, 128});
        const int64_t dx = random.integer(-1500, 1500);
        const int64_t dy = random.integer(1, 3000);
        // (u, v) with dx v - dy u = +-1, by the extended Euclidean algorithm.
        int64_t r0 = dy;
        int64_t r1 = std::abs(dx);
        int64_t s0 = 0;
        int64_t s1 = 1;
        while (r1 != 0) {
            const int64_t q = r0 / r1;
            r0 = std::exchange(r1, r0 - q * r1);
            s0 = std::exchange(s1, s0 - q * s1);
        }
        if (r0 != 1) {
            continue;
        }
        const int64_t v = dx < 0 ? -s0 : s0;  // dx v = 1 (mod dy)
        const int64_t sign = random.integer(0, 1) * 2 - 1;
        const SubpixelPoint a{p.x - sign * ((dx * v - 1) / dy), p.y - sign * v};
        const Corners t{
            {a, {a.x + dx, a.y + dy}, {random.integer(0, 4096), random.integer(0, 4096)}}};
        const int64_t e = edge_function(t[0], t[1], p);
        ASSERT_EQ(e, sign);
        ++beside;
        const PixelRect rect{0, 0, 16, 16};
        const std::string expected = draw_exactly(t, rect, {128, 128});
        for (const NamedScan& scan : kScans) {
            ASSERT_EQ(draw(scan, t, rect, {128, 128}), expected) << scan.name << " " << describe(t);
        }
    }
    EXPECT_GT(beside, 2000);
}

// By hand: the square (1.5,1.5)-(4.5,4.5) cut along its diagonal. The upper left half owns its top
// and left edge but not the diagonal, which runs down to the left.
TEST(Scans, HalfSquaresByHand) {
    const Corners upper{{{384, 384}, {1152, 384}, {384, 1152}}};
    const Corners lower{{{1152, 384}, {1152, 1152}, {384, 1152}}};
    for (const NamedScan& scan : kScans) {
        EXPECT_EQ(draw(scan, upper, {0, 0, 6, 6}, {128, 128}),
                  "......"
                  ".###.."
                  ".##..."
                  ".#...."
                  "......"
                  "......")
            << scan.name;
        EXPECT_EQ(draw(scan, lower, {0, 0, 6, 6}, {128, 128}),
                  "......"
                  "......"
                  "...#.."
                  "..##.."
                  "......"
                  "......")
            << scan.name;
    }
}

// What the hierarchy saves and what the quads waste, worked out by hand: a square of 64 pixels as
// one tile, of which the triangle is the whole, and a triangle with one sample in a quad.
TEST(Scans, WorkByHand) {
    const auto named = [](std::string_view name) {
        for (const NamedScan& scan : kScans) {
            if (scan.name == name) {
                return scan;
            }
        }
        return NamedScan{};
    };
    const Corners all{{{-65536, -65536}, {1 << 20, -65536}, {-65536, 1 << 20}}};
    Work work;
    draw(named("tiles"), all, {0, 0, 64, 64}, {128, 128}, &work);
    EXPECT_EQ(work.samples, 0U);
    EXPECT_EQ(work.tiles, 1U);
    draw(named("incremental"), all, {0, 0, 64, 64}, {128, 128}, &work);
    EXPECT_EQ(work.samples, 4096U);
    const Corners one{{{120, 120}, {140, 120}, {120, 140}}};
    draw(named("quads"), one, {0, 0, 8, 8}, {128, 128}, &work);
    EXPECT_EQ(work.samples, 4U);
    draw(named("incremental"), one, {0, 0, 8, 8}, {128, 128}, &work);
    EXPECT_EQ(work.samples, 1U);
    draw(named("flat-parts"), one, {0, 0, 8, 8}, {128, 128}, &work);
    EXPECT_EQ(work.samples, 0U);
}

// E_ab and the other convention are each other's negative, E_ab + E_ba = 0, and the three edge
// functions add up to twice the area, wherever the point is (Giesen, "Why signed areas are a good
// idea").
TEST(Edges, Identities) {
    RandomTriangles random(11);
    for (int n = 0; n < 20000; ++n) {
        const Corners t = random.triangle(n % RandomTriangles::kKinds, 12);
        const SubpixelPoint p{random.integer(-5000, 5000), random.integer(-5000, 5000)};
        const auto& [a, b, c] = t;
        EXPECT_EQ(edge_function(a, b, p), -edge_function_counter(a, b, p));
        EXPECT_EQ(edge_function(a, b, p), -edge_function(b, a, p));
        EXPECT_EQ(edge_function(a, b, p) + edge_function(b, c, p) + edge_function(c, a, p),
                  edge_function(a, b, c));
    }
}

// The picture of the lesson "The Edge Function": a triangle of 512 pixels whose hypotenuse,
// snapped, runs through 342 sample centres. The lesson's program takes all edges as inclusive; the
// rule says that this edge, a right one, owns none of them.
TEST(Edges, TriangleOfTheLesson) {
    // 491.407, 411.407, 148.593, 68.5928 to the nearest 1/256
    const Corners t{{{125800, 105320}, {38040, 17560}, {38040, 105320}}};
    const PixelRect rect{0, 0, 512, 512};
    const std::string expected = draw_exactly(t, rect, {128, 128});
    // Rows 69 to 410, columns from 149 on; both vertices have the same fraction, so row 69 + k has
    // columns 149 to 148 + k, and column 149 + k lies on the edge.
    const auto count = static_cast<uint64_t>(std::count(expected.begin(), expected.end(), '#'));
    EXPECT_EQ(count, 342U * 341 / 2);
    uint64_t inclusive = 0;
    for (int64_t j = 0; j < 512; ++j) {
        for (int64_t i = 0; i < 512; ++i) {
            const SubpixelPoint p = sample_of(i, j, {128, 128});
            inclusive += edge_function(t[1], t[0], p) >= 0 && edge_function(t[0], t[2], p) >= 0 &&
                                 edge_function(t[2], t[1], p) >= 0
                             ? 1U
                             : 0U;
        }
    }
    EXPECT_EQ(inclusive, count + 342);
    for (const NamedScan& scan : kScans) {
        EXPECT_EQ(draw(scan, t, rect, {128, 128}), expected) << scan.name;
    }
}

}  // namespace
}  // namespace rasterizers
