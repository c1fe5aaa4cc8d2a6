// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "probe/experiment/vernier.hpp"

#include "ref/number/edge_function.hpp"

namespace probe {

Counts counts_of(const Edge& edge, int64_t across_a, int64_t across_b) {
    // Column i is covered if the edge is not below the row's centre there:
    // a + (i + 1/2 - from) (b - a) / run <= centre, times 2 run.
    const ref::Int128 a = across_a;
    const ref::Int128 b = across_b;
    const ref::Int128 centre = ref::kFixedOne * int64_t{edge.row} + ref::kFixedOne / 2;
    const auto run = static_cast<ref::Int128>(edge.along_b - edge.along_a);
    const auto from = static_cast<ref::Int128>(edge.along_a);
    Counts counts;
    for (int64_t i = 0; i < int64_t{kVernierLength}; ++i) {
        const ref::Int128 at = (2 * (i - from) + 1) * (b - a);
        const ref::Int128 limit = 2 * run * (centre - a);
        counts.low += at < limit ? 1U : 0U;
        counts.high += at <= limit ? 1U : 0U;
    }
    return counts;
}

void add_edge(Scene& scene, const Edge& e, bool is_x) {
    const auto placed = [is_x](double along, double across) {
        return is_x ? Corner{across, along} : Corner{along, across};
    };
    scene.add(placed(e.along_a, e.across_a), placed(e.along_b, e.across_b),
              placed(e.third.x, e.third.y));
}

int64_t count_row(const capture::Capture& picture, uint32_t row, bool is_x) {
    int64_t count = 0;
    for (uint32_t i = 0; i < kVernierLength; ++i) {
        count += is_hit(picture, is_x ? row : i, is_x ? i : row) ? 1U : 0U;
    }
    return count;
}

}  // namespace probe
