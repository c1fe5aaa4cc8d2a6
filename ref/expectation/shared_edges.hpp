// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which edges of triangles lie near a sample, and which triangles share them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/triangle.hpp"
#include "ref/coverage/setup.hpp"
#include "ref/coverage/triangle_setups.hpp"
#include "ref/expectation/vertex_numbers.hpp"
#include "ref/path/path.hpp"

namespace ref {

// A triangle that must or may cover the sample at hand. Fragments that their shader takes away are
// no hits, and where it may do so the triangle may cover the sample.
struct Hit {
    uint32_t triangle = 0;
    Coverage coverage = Coverage::either;
    // A value may take its fragment away, and may not; but for that it covers the sample.
    bool is_value_open = false, is_sure_but_for_value = false;
    friend bool operator==(const Hit&, const Hit&) = default;
};

// A hit that a value may take away.
inline Hit but_for_value(const Hit& hit) {
    return {hit.triangle, Coverage::either, true, hit.coverage == Coverage::must};
}

// Whether a hit is that of another piece of the triangle before it (ref/coverage/pieces.hpp).
inline bool is_further(std::span<const Hit> hits, size_t m) {
    return m > 0 && hits[m - 1].triangle == hits[m].triangle;
}

// The arithmetic that narrowing rests on, so that both implementations bring their own.
struct Predicates {
    // p lies in the closed convex hull of the boxes.
    bool (*is_in_hull)(std::span<const Box>, const FixedPoint&);
    // How often the polygon runs around p, clockwise positive, with the top-left rule on its
    // border.
    int (*winding)(std::span<const FixedPoint>, const FixedPoint&);
    // An outline covers p but for its cuts, whatever positions the device uses.
    bool (*is_inside_whole)(const TriangleSetup&, const Outline&, const FixedPoint&);
    path::Resolve resolve_paths;
};

// Triangles of which exactly `count` cover the sample, or from `least` to `count`.
struct FixedHits {
    std::vector<uint32_t> members;  // positions in the list of hits, ascending
    uint32_t count = 0;
    uint32_t least = 0;
    bool is_complement = false;
    std::vector<uint32_t> decided = {};  // triangles that belong to it and are decided alone
};

// An edge of a member; its band contains the sample.
struct Side {
    uint64_t edge = 0;  // both vertex numbers, smaller one first
    bool is_forward = false;
    uint32_t member = 0;
};

struct EdgeOwner {
    uint64_t edge = 0;
    uint32_t triangle = 0;
};

class SharedEdges {
  public:
    using Near = std::array<bool, 3>;  // which edges of a triangle are

    // Keeps references.
    SharedEdges(const cases::Case& c, const std::vector<cases::Triangle>& triangles,
                TriangleSetups& setups, const Predicates& predicates);

    uint64_t number(const cases::Triangle& triangle, uint32_t edge);
    // The triangles that have this edge, given by its two vertices. Triangles that touch no sample
    // are left out, since no sample lies in the band of their edges.
    std::span<const EdgeOwner> triangles_at(uint64_t edge);
    // Notes the edges of the triangle that an outline has near p; false if another one is near,
    // whose label is below `end`.
    bool find_near(const FixedPoint& p, const Outline& o, int end, Near& near) const;
    // Adds these edges of triangle t; false if there are none.
    bool add(uint32_t t, const Near& near, uint32_t member, std::vector<Side>& sides);
    // How often the outline runs around p, in the triangle's orientation.
    int winding_of(const FixedPoint& p, const TriangleSetup& setup, const Outline& outline) const;

  private:
    const std::vector<cases::Triangle>& triangles_;
    TriangleSetups& setups_;
    const Predicates& predicates_;
    VertexNumbers vertex_numbers_;
    std::vector<EdgeOwner> edge_owners_;  // sorted by edge, then triangle; when first asked for
};

}  // namespace ref
