// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "ref/coverage/exact/exact.hpp"
#include "tests/docs/algorithm_figures.hpp"
#include "tests/unit/rasterizers/float_loss.hpp"
#include "tests/unit/rasterizers/random_triangles.hpp"

namespace figures {

namespace {

using namespace rasterizers;
using test::RandomTriangles;

constexpr SubpixelPoint kCentre{kPixel / 2, kPixel / 2};

bool covers_exactly(const Corners& t, const SubpixelPoint& p) {
    constexpr int64_t kScale = ref::kFixedOne / kPixel;
    const auto fixed = [](const SubpixelPoint& q) {
        return ref::FixedPoint{q.x * kScale, q.y * kScale};
    };
    return ref::exact::covers(fixed(t[0]), fixed(t[1]), fixed(t[2]), fixed(p));
}

// Lanes of the 2x2 quads that have a covered pixel.
uint64_t lanes(const Picture& picture) {
    std::set<std::pair<int64_t, int64_t>> quads;
    for (const Span& s : picture.spans) {
        for (int64_t x = s.x0; x < s.x1; ++x) {
            quads.emplace(s.y >> 1, x >> 1);
        }
    }
    return 4 * quads.size();
}

// A clockwise triangle in a box of size x size / thin, somewhere at `offset` units.
Corners shaped(RandomTriangles& random, int64_t size, int64_t thin, int64_t offset) {
    for (;;) {
        Corners t;
        const int64_t reach = size * kPixel;
        for (SubpixelPoint& p : t) {
            const int64_t s = random.integer(0, reach);
            p = {offset + s, offset + s / 2 + random.integer(0, reach / thin)};
        }
        if (const std::optional<Corners> c = clockwise(t);
            c && edge_function((*c)[0], (*c)[1], (*c)[2]) > reach / thin * (reach / 8)) {
            return *c;
        }
    }
}

SubpixelPoint point_in(RandomTriangles& random, const Corners& t) {
    const int64_t s = random.integer(0, 1000);
    const int64_t r = random.integer(0, 1000 - s);
    return {(t[0].x * (1000 - s - r) + t[1].x * s + t[2].x * r) / 1000,
            (t[0].y * (1000 - s - r) + t[1].y * s + t[2].y * r) / 1000};
}

}  // namespace

std::string work_table() {
    std::string out =
        "| size in pixels | covered | tested, incremental | tested, tiles | blocks decided whole | "
        "lanes of 2x2 quads |\n| --- | --- | --- | --- | --- | --- |\n";
    for (const int64_t size : {2, 4, 8, 16, 32, 64, 128, 256}) {
        RandomTriangles random(1988);
        uint64_t covered = 0;
        uint64_t tested = 0;
        uint64_t tested_in_tiles = 0;
        uint64_t tiles = 0;
        uint64_t quad_lanes = 0;
        const int count = size < 64 ? 2000 : 200;
        for (int n = 0; n < count; ++n) {
            const Corners t = shaped(random, size, 1, random.integer(0, 64 * kPixel));
            const PixelRect rect{0, 0, 1024, 1024};
            Picture incremental;
            Picture in_tiles;
            scan_incremental(t, rect, kCentre, incremental);
            scan_tiles(t, rect, kCentre, in_tiles);
            for (const Span& s : incremental.spans) {
                covered += static_cast<uint64_t>(s.x1 - s.x0);
            }
            tested += incremental.work.samples;
            tested_in_tiles += in_tiles.work.samples;
            tiles += in_tiles.work.tiles;
            quad_lanes += lanes(incremental);
        }
        const auto per_covered = [&](uint64_t v) {
            return static_cast<double>(v) / static_cast<double>(covered);
        };
        out +=
            fmt::format("| {} | {:.1f} | {:.2f} | {:.2f} | {:.3f} | {:.2f} |\n", size,
                        static_cast<double>(covered) / count, per_covered(tested),
                        per_covered(tested_in_tiles), per_covered(tiles), per_covered(quad_lanes));
    }
    return out;
}

std::string float_table() {
    std::string out =
        "| length x thickness | at | areas exact: three | two | areas in binary32: three | bound | "
        "two | "
        "bound |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    struct Shape {
        int64_t size, thin, offset;
        const char* place;
    };
    const Shape shapes[] = {{64, 1, 0, "0"},    {64, 16, 0, "0"},      {64, 256, 0, "0"},
                            {64, 4096, 0, "0"}, {64, 1, 8000, "8000"}, {4, 1, 8000, "8000"},
                            {2048, 1, 0, "0"},  {2048, 256, 0, "0"},   {2048, 65536, 0, "0"}};
    for (const Shape& shape : shapes) {
        RandomTriangles random(1998);
        std::array<double, 6> worst{};
        for (int n = 0; n < 1500; ++n) {
            const Corners t = shaped(random, shape.size, shape.thin, shape.offset * kPixel);
            Values z{};
            for (float& v : z) {  // in [0,1]
                v = static_cast<float>(random.integer(0, 1 << 20)) / static_cast<float>(1 << 20);
            }
            const test::FloatLoss loss = test::float_loss(t, point_in(random, t), z);
            const auto in_u = [](const mpq_class& v) { return std::ldexp(v.get_d(), 24); };
            const double values[] = {in_u(loss.exact_three.measured),
                                     in_u(loss.exact_two.measured),
                                     loss.is_bounded ? in_u(loss.three.measured) : HUGE_VAL,
                                     loss.is_bounded ? in_u(loss.three.bound) : HUGE_VAL,
                                     loss.is_bounded ? in_u(loss.two.measured) : HUGE_VAL,
                                     loss.is_bounded ? in_u(loss.two.bound) : HUGE_VAL};
            for (size_t k = 0; k < worst.size(); ++k) {
                worst[k] = std::max(worst[k], values[k]);
            }
        }
        const auto text = [](double v) {
            return std::isinf(v) ? std::string("none") : fmt::format("{:.3g}", v);
        };
        out += fmt::format("| {} x {} | {} | {} | {} | {} | {} | {} | {} |\n", shape.size,
                           shape.thin <= shape.size ? fmt::format("{}", shape.size / shape.thin)
                                                    : fmt::format("1/{}", shape.thin / shape.size),
                           shape.place, text(worst[0]), text(worst[1]), text(worst[2]),
                           text(worst[3]), text(worst[4]), text(worst[5]));
    }
    return out;
}

std::string float_coverage_table() {
    std::string out =
        "| size in pixels | samples within 1/256 pixel of an edge | on the wrong side |\n| --- | "
        "--- | --- |\n";
    for (const int64_t size : {15, 32, 64, 256, 1024, 4096, 16384}) {
        RandomTriangles random(2012);
        int wrong = 0;
        int samples = 0;
        for (; samples < 40000; ++samples) {
            const auto [t, p] = random.beside_edge(size);
            wrong += covers_in_float(t, p) != covers_exactly(t, p) ? 1 : 0;
        }
        out += fmt::format("| {} | {} | {} |\n", size, samples, wrong);
    }
    return out;
}

}  // namespace figures
