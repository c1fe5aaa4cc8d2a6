// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/shared_edges.hpp"

#include <algorithm>

namespace ref {

SharedEdges::SharedEdges(const cases::Case& c, const std::vector<cases::Triangle>& triangles,
                         TriangleSetups& setups, const Predicates& predicates)
    : triangles_(triangles), setups_(setups), predicates_(predicates), vertex_numbers_(c) {}

uint64_t SharedEdges::number(const cases::Triangle& triangle, uint32_t edge) {
    const uint32_t a = vertex_numbers_.of(triangle.draw, triangle.vertex[edge]);
    const uint32_t b = vertex_numbers_.of(triangle.draw, triangle.vertex[(edge + 1) % 3]);
    return uint64_t{std::min(a, b)} << 32U | std::max(a, b);
}

std::span<const EdgeOwner> SharedEdges::triangles_at(uint64_t edge) {
    if (edge_owners_.empty()) {
        edge_owners_.reserve(3 * setups_.known().size());
        for (const uint32_t t : setups_.known()) {
            for (uint32_t e = 0; e < 3; ++e) {
                edge_owners_.push_back({number(triangles_[t], e), t});
            }
        }
        std::sort(edge_owners_.begin(), edge_owners_.end(),
                  [](const EdgeOwner& a, const EdgeOwner& b) {
                      return a.edge < b.edge || (a.edge == b.edge && a.triangle < b.triangle);
                  });
    }
    const auto by_edge = [](const EdgeOwner& a, const EdgeOwner& b) { return a.edge < b.edge; };
    const auto [begin, end] =
        std::equal_range(edge_owners_.begin(), edge_owners_.end(), EdgeOwner{edge, 0}, by_edge);
    return {begin, end};
}

bool SharedEdges::find_near(const FixedPoint& p, const Outline& o, int end, Near& near) const {
    for (uint32_t i = 0; i < o.count; ++i) {
        const std::array<Box, 2> ends{o.boxes[i], o.boxes[(i + 1) % o.count]};
        if (o.edge[i] >= end || !predicates_.is_in_hull(ends, p)) {
            continue;
        }
        if (o.edge[i] >= kFirstClipEdge) {
            return false;
        }
        near.at(o.edge[i]) = true;
    }
    return true;
}

bool SharedEdges::add(uint32_t t, const Near& near, uint32_t member, std::vector<Side>& sides) {
    const cases::Triangle& triangle = triangles_[t];
    for (uint32_t e = 0; e < 3; ++e) {
        if (near.at(e)) {
            const uint32_t a = vertex_numbers_.of(triangle.draw, triangle.vertex[e]);
            const uint32_t b = vertex_numbers_.of(triangle.draw, triangle.vertex[(e + 1) % 3]);
            sides.push_back({number(triangle, e), (a < b) == (setups_[t].orientation > 0), member});
        }
    }
    return near[0] || near[1] || near[2];
}

int SharedEdges::winding_of(const FixedPoint& p, const TriangleSetup& setup,
                            const Outline& outline) const {
    // One choice of positions that is the same for equal vertices: the low corners.
    std::array<FixedPoint, kMaxClippedVertices> polygon;
    for (uint32_t i = 0; i < outline.count; ++i) {
        polygon[i] = {outline.boxes[i].x0, outline.boxes[i].y0};
    }
    const std::span<const FixedPoint> vertices(polygon.data(), outline.count);
    return setup.orientation * predicates_.winding(vertices, p);
}

}  // namespace ref
