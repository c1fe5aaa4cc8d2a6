// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Sets of hits of which the whole picture fixes how many there are: pairs of triangles at both
// sides of an edge, and closed chains of them.
//
// Exactly one. Take the triangles that may or may not cover sample p, and orient each so that its
// area is positive. Two that share an edge with bitwise-equal end points in one viewport and layer,
// p in the band of that edge (the hull of its two boxes), run along it in opposite directions: they
// lie on either side. Let K be a set of triangles closed under such partnership, in which every
// edge whose band contains p occurs equally often in both directions. However the vertices are
// snapped, if equal vertices are snapped alike, the border of the chain sum(K) stays away from p,
// so its winding number around p, which is the number of triangles of K that cover p, is the same
// for every snapping; on an edge itself the shared-edge rule (Vulkan specification, "Basic Polygon
// Rasterization") keeps the number. So p is hit that often by K. At profile
// direct3d some triangles of K may be decided by themselves, those that do not cover p included;
// the others share what is left of the number. What alpha to coverage or the shader may take away
// afterwards makes it the most that K hits p.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cases/model/profile.hpp"
#include "ref/expectation/complement_sets.hpp"
#include "ref/expectation/discards.hpp"
#include "ref/expectation/shared_edges.hpp"
#include "ref/reason/reason.hpp"

namespace ref {

// Triangles that share a number of hits, and why.
struct FixedSet {
    ReasonKind why = ReasonKind::shared_edge;
    std::vector<uint32_t> triangles;  // all of them, in drawing order
    uint32_t count = 0, least = 0;    // how many of them cover the sample: at most and at least
};

class FixedSets {
  public:
    // `is_by_draw`: meshes of several draws, drawn one over the other, are told apart.
    FixedSets(const cases::Case& c, cases::Profile profile,
              const std::vector<cases::Triangle>& triangles, TriangleSetups& setups,
              const Predicates& predicates, ValueDiscards& discards, bool is_by_draw);
    FixedSets(const FixedSets&) = delete;  // its parts refer to each other
    FixedSets& operator=(const FixedSets&) = delete;

    bool has_complements() const { return !complements_.is_empty(); }
    // The fixed sets that consist of triangles which may, but need not, cover sample `sample` of a
    // pixel, at p.
    std::vector<FixedHits> of(const FixedPoint& p, uint32_t sample, std::span<const Hit> hits);
    FixedSet told(const FixedPoint& p, std::span<const Hit> hits, const FixedHits& set) const;

  private:
    // Whether the fragment of a triangle at p may be as if it had never been.
    bool may_be_taken_away(uint32_t t, const FixedPoint& p);
    // Appends to `sets` those of the open hits that none of them has. They contain triangles that
    // are decided by themselves, too.
    void add_decided_sets(const FixedPoint& p, std::span<const Hit> hits,
                          std::vector<FixedHits>& sets);
    // The sets of hits that are closed under partnership, among those that take part.
    std::vector<FixedHits> closed_sets(const FixedPoint& p, std::span<const Hit> hits,
                                       const std::vector<bool>& takes_part);
    // Adds the edges of a hit near p; false if p lies where no rule fixes anything.
    bool add_sides(const FixedPoint& p, const Hit& hit, uint32_t member, std::vector<Side>& sides);
    // The number of the members that cover p, or -1 if it depends on the outline used.
    int count_of(const FixedPoint& p, std::span<const Hit> hits,
                 const std::vector<uint32_t>& members) const;

    const cases::Case& case_;
    cases::Profile profile_;
    const std::vector<cases::Triangle>& triangles_;
    TriangleSetups& setups_;
    Predicates predicates_;
    ValueDiscards& discards_;
    bool is_by_draw_;
    uint32_t sample_ = 0;  // of the pixel, the one at hand
    SharedEdges edges_;
    ComplementSets complements_;
};

}  // namespace ref
