// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A vernier of coverage: a long edge that falls by little over 1,024 pixels crosses the centres of
// a row of pixels at a column that tells where the edge's ends were put.
#pragma once

#include <cstdint>

#include "probe/base/scene.hpp"

namespace probe {

inline constexpr uint32_t kVernierLength = 1024;  // pixels along the edge

// An edge: `across` of its two ends is what is looked at, `along` is a whole number. The triangle
// lies at smaller `along`.
struct Edge {
    double along_a = 0, across_a = 0, along_b = 0, across_b = 0;
    Corner third;      // x: along, y: across
    uint32_t row = 0;  // whose centres are crossed
};

// How many pixels of the row are covered: from `low`, without those whose centre lies on the edge,
// to `high`, with them.
struct Counts {
    int64_t low = 0, high = 0;
    bool has(int64_t n) const { return low <= n && n <= high; }
};
// If the ends of the edge are put at these coordinates, S47.16.
Counts counts_of(const Edge& edge, int64_t across_a, int64_t across_b);

// Rows are columns if what is looked at is x.
void add_edge(Scene& scene, const Edge& edge, bool is_x);
int64_t count_row(const capture::Capture& picture, uint32_t row, bool is_x);

}  // namespace probe
