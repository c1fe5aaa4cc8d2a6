// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether the bounds of viewports lie on a grid of their own: a viewport that begins between two
// pixels carries its edges along, and a vernier tells how far.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "probe/base/vote.hpp"
#include "probe/experiment/experiments.hpp"
#include "probe/experiment/snapping.hpp"
#include "probe/experiment/vernier.hpp"

namespace probe {

namespace {

constexpr uint32_t kRows = 64;  // one draw each
constexpr int kFinest = 8;      // of a viewport's grid

// A bound on a grid of so many bits, halves up; as it is for -1.
double bound_on(double bound, int bits) {
    return bits < 0 ? bound : std::ldexp(std::floor(std::ldexp(bound, bits) + 0.5), -bits);
}

struct Row {
    double bound = 0;  // the top of the viewport; its height is whole
    Edge edge;
};

}  // namespace

void measure_viewport(const Bench& bench) {
    Finding property(
        bench, "grid.viewport", "Where bounds of viewports lie that begin between two pixels",
        "edges in viewports that begin at fractions of a pixel: where one crosses a row tells how "
        "far the viewport was moved");
    const Grid grid = grid_of(bench.sheet, bench.promises.limits.subpixel_bits);
    cases::Case c;
    std::vector<Row> rows;
    Dice dice(137);
    const auto fraction = [&](int64_t most) {
        return std::ldexp(static_cast<double>(dice.whole(-most, most)), -12);
    };
    for (uint32_t n = 0; n < kRows; ++n) {
        // At most 0.38 pixel from a whole one, so that a row is crossed however far it is moved.
        const double bound =
            std::floor(((dice.whole(0, 1) == 0 ? 0.2 : 0.8) + dice.real(-0.18, 0.18)) * 4096) /
            4096;
        const Edge edge{
            0, n + 0.125 + fraction(64), kVernierLength, n + 0.875 + fraction(64), {0, n + 1.0}, n};
        Scene scene("viewport", kVernierLength, kRows);
        scene.target().has_depth = false;
        scene.set_viewport(0, static_cast<float>(bound), kVernierLength, 256);
        add_edge(scene, edge, false);
        rows.push_back({bound, edge});
        if (n == 0) {
            c = scene.take();
        } else {
            c.draws.push_back(scene.draw());
        }
    }
    const auto picture = bench.picture_of(std::move(c), property);
    if (!picture) {
        return;
    }
    std::vector<std::string> names{"where they are put"};
    for (int bits = 0; bits <= kFinest; ++bits) {
        names.push_back(fmt::format("on a grid of {} bits", bits));
    }
    Vote vote(names);
    for (const auto& [bound, edge] : rows) {
        const int64_t count = count_row(*picture, edge.row, false);
        vote.add([&, bound = bound, &edge = edge](size_t k) {
            const double moved = bound_on(bound, static_cast<int>(k) - 1) - bound;
            return counts_of(edge, grid.y(fixed(edge.across_a + moved)),
                             grid.y(fixed(edge.across_b + moved)))
                .has(count);
        });
    }
    vote.settle(property);
}

}  // namespace probe
