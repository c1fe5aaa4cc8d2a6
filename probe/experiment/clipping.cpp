// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether and where triangles are cut. A cut makes new corners, which snap: the edge that is left
// lies elsewhere by up to half a unit, and a vernier shows it.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "probe/base/vote.hpp"
#include "probe/experiment/experiments.hpp"
#include "probe/experiment/snapping.hpp"
#include "probe/experiment/triangle.hpp"
#include "probe/experiment/vernier.hpp"
#include "ref/number/edge_function.hpp"

namespace probe {

namespace {

constexpr uint32_t kRows = 32;
constexpr int kFirst = 4, kLast = 20;  // powers of two: pixels beyond the viewport

// How many pixels of a row lie below the line from a to b, which runs to the right.
Counts below(const ref::FixedPoint& a, const ref::FixedPoint& b, uint32_t row) {
    Counts counts;
    for (int64_t i = 0; i < int64_t{kVernierLength}; ++i) {
        const ref::FixedPoint p{i * ref::kFixedOne + ref::kFixedOne / 2,
                                row * ref::kFixedOne + ref::kFixedOne / 2};
        const int sign = ref::sign_of(ref::edge_function(a, b, p));
        counts.low += sign > 0 ? 1U : 0U;
        counts.high += sign >= 0 ? 1U : 0U;
    }
    return counts;
}

// Edges that begin `reach` pixels left of the viewport; nothing if they were not drawn.
struct Reach {
    uint64_t decisive = 0, whole = 0, cut = 0;  // edges; of them drawn as either predicts
};
std::optional<Reach> look_beyond(const Bench& bench, const Grid& grid, int power,
                                 std::string& why_not) {
    const double reach = std::ldexp(1.0, power);
    const double unit = std::ldexp(1.0, -grid.y.bits);
    const auto on_grid = [&](double v) { return std::round(v / unit) * unit; };
    Scene scene(fmt::format("clip-{}", power), kVernierLength, kRows);
    scene.target().has_depth = false;
    scene.set_viewport(0, -256, kVernierLength, 512);
    std::vector<Edge> edges;
    Dice dice(67);
    for (uint32_t row = 0; row < kRows; ++row) {
        const double slope = dice.real(0.9, 1.1) / 8 / kVernierLength;
        const double left = row + 0.5 - dice.real(0.03, 0.1);  // at the border
        const Edge edge{-reach,         on_grid(left - slope * reach),
                        kVernierLength, on_grid(left + slope * kVernierLength),
                        {0, row + 1.0}, row};
        add_edge(scene, edge, false);
        edges.push_back(edge);
    }
    const Drawn drawn = bench.draw_one(scene.take());
    if (!drawn.picture) {
        why_not = drawn.why_not;
        return std::nullopt;
    }
    Reach out;
    for (const Edge& e : edges) {
        const Counts whole = counts_of(e, fixed(e.across_a), fixed(e.across_b));
        const double at_border =
            e.across_a + (e.across_b - e.across_a) * reach / (reach + kVernierLength);
        Edge rest = e;
        rest.along_a = 0;
        const Counts cut = counts_of(rest, grid.y(fixed(at_border)), fixed(e.across_b));
        if (whole.low > cut.high || whole.high < cut.low) {
            const int64_t count = count_row(*drawn.picture, e.row, false);
            if (count == 0 || count == kVernierLength) {
                continue;  // the edge is not to be seen at all
            }
            ++out.decisive;
            out.whole += whole.has(count) ? 1U : 0U;
            out.cut += cut.has(count) ? 1U : 0U;
        }
    }
    return out;
}

void measure_guard_band(const Bench& bench, const Grid& grid) {
    Finding property(
        bench, "clipping.guard_band", "How far beyond the viewport triangles are drawn uncut",
        "edges that begin 2^4 to 2^20 pixels left of the viewport: the column where one crosses a "
        "row is that of the whole edge, or of one from a corner on the border that has snapped");
    int uncut = 0;  // the largest power, with all smaller ones
    int first_cut = 0;
    for (int power = kFirst; power <= kLast; ++power) {
        const std::optional<Reach> reach = look_beyond(bench, grid, power, property.why);
        if (!reach) {
            return;
        }
        if (reach->decisive == 0) {
            continue;
        }
        const bool is_whole = reach->whole == reach->decisive;
        if (is_whole && first_cut == 0) {
            uncut = power;
            property.agree += reach->whole;
        } else if (!is_whole && first_cut == 0) {
            first_cut = power;
            property.agree += reach->decisive - reach->whole;
        }
        property.picture.kind = PictureKind::curve;
        property.picture.axes = {"pixels beyond the viewport, log2", "share uncut"};
        property.picture.points.push_back(
            {static_cast<double>(power),
             static_cast<double>(reach->whole) / static_cast<double>(reach->decisive)});
    }
    if (uncut == 0 && first_cut == 0) {
        property.why = "no observation told the possible answers apart";
    } else if (uncut == 0) {
        property.answer = "they are cut at its border";
    } else if (first_cut == 0) {
        property.answer = fmt::format("at least 2^{} pixels", uncut);
    } else {
        property.answer = fmt::format("2^{} to 2^{} pixels", uncut, first_cut);
    }
}

// A triangle from (0, -3) and (0, 3) to (1024, 1) that a plane cuts along y = m + x / 8192: what
// lies below is kept. Where the plane meets two edges, corners are made.
struct Cut {
    double m = 0;
    ref::FixedPoint a, b;  // exact, to 2^-16 pixel
    double value(double x, double y) const { return (y - m - x / 8192) / 4; }
};
constexpr std::array<Point, 3> kCorners{{{0, -3}, {kVernierLength, 1}, {0, 3}}};
Cut make_cut(double m) {
    Cut cut{m, {}, {}};
    const double x = (3 + m) / (4.0 / kVernierLength - 1.0 / 8192);  // on the edge y = -3 + x / 256
    cut.a = {0, fixed(m)};
    cut.b = {fixed(x), fixed(m + x / 8192)};
    return cut;
}

// Whether it is clear to which side a coordinate snaps, whatever binary32 makes of the cut.
bool is_plain(int64_t at, const Snapping& snap) {
    const double units = std::ldexp(static_cast<double>(at), snap.bits - ref::kFixedBits);
    const double rest = units - std::floor(units);
    return std::fabs(rest - 0.25) < 0.2 || std::fabs(rest - 0.75) < 0.2;
}

void measure_plane(const Bench& bench, const Grid& grid, bool is_distance) {
    Finding property(
        bench, is_distance ? "clipping.distances" : "clipping.depth",
        is_distance ? "How a clip distance cuts" : "How the near plane cuts",
        "a plane that falls by 1/8 pixel over 1,024 cuts a triangle: the column where the cut "
        "crosses a row is that of the plane, or of a line between corners that have snapped");
    std::vector<Cut> cuts;
    std::vector<cases::Case> cases;
    Dice dice(71);
    for (int k = 0; k < 48; ++k) {
        Cut cut;
        do {
            cut = make_cut(0.5 - dice.real(0.025, 0.1));
        } while (!is_plain(cut.a.y, grid.y) || !is_plain(cut.b.y, grid.y));
        Scene scene(fmt::format("cut-{}-{}", is_distance, k), kVernierLength, 1);
        scene.target().has_depth = false;
        scene.set_viewport(0, -4, kVernierLength, 8);
        std::array<Corner, 3> c;
        for (size_t n = 0; n < 3; ++n) {
            c[n] = {kCorners[n].x, kCorners[n].y};
            const double value = cut.value(c[n].x, c[n].y);
            if (is_distance) {
                scene.draw().distances.clip_count = 1;
                scene.draw().distances.clip.emplace_back(static_cast<float>(value), 0, 0, 0);
            } else {
                c[n].z = value;
            }
        }
        scene.add(c[0], c[1], c[2]);
        cases.push_back(scene.take());
        cuts.push_back(cut);
    }
    const std::vector<Drawn> drawn = bench.draw(std::move(cases));
    Vote vote({"the polygon is cut, and its corners snap",
               "exactly: each sample is tested, or corners do not snap"});
    for (size_t k = 0; k < drawn.size(); ++k) {
        if (!drawn[k].picture) {
            property.why = drawn[k].why_not;
            continue;
        }
        const Cut& cut = cuts[k];
        const int64_t count = count_row(*drawn[k].picture, 0, false);
        const Counts snapped =
            below({grid.x(cut.a.x), grid.y(cut.a.y)}, {grid.x(cut.b.x), grid.y(cut.b.y)}, 0);
        Counts exact = below(cut.a, cut.b, 0);
        exact = {exact.low - 1, exact.high + 1};  // the corners here are rounded, too
        vote.add([&](size_t n) { return n == 0 ? snapped.has(count) : exact.has(count); });
    }
    vote.settle(property);
}

}  // namespace

void measure_clipping(const Bench& bench) {
    const Grid grid = grid_of(bench.sheet, bench.promises.limits.subpixel_bits);
    measure_guard_band(bench, grid);
    measure_plane(bench, grid, false);
    measure_plane(bench, grid, true);
}

}  // namespace probe
