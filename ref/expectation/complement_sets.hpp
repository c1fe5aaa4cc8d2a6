// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Triangles with complementary clip distances: a triangle and its complement, and sets of such
// pairs where the cut crosses edges that the triangles share.
//
// Complementary clip distances (ref/expectation/complement.hpp). Of a triangle and the same one
// with negated distances never both cover p; with a single distance one of them does, if p lies so
// deep in the triangle that only the distance leaves it open. Near an edge the two hold together
// what the triangle would cover by itself, so they stand for it in a set K: "primitives must not be
// missing any pixels, and pixels must not be drawn twice" is said of the whole "series of
// primitives", and the border of chain sum(K) has no cut, since a triangle and its complement run
// along it in opposite directions.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cases/model/profile.hpp"
#include "ref/expectation/complement.hpp"
#include "ref/expectation/shared_edges.hpp"

namespace ref {

class ComplementSets {
  public:
    // Keeps references.
    ComplementSets(const cases::Case& c, cases::Profile profile,
                   const std::vector<cases::Triangle>& triangles, TriangleSetups& setups,
                   const Predicates& predicates, SharedEdges& edges);

    bool is_empty() const { return complements_.empty(); }
    // The sets of a sample's hits; the members of pairs are marked.
    std::vector<FixedHits> of(const FixedPoint& p, uint32_t sample, std::span<const Hit> hits,
                              std::vector<bool>& is_paired);

  private:
    // Pairs of triangles with complementary clip distances; their members are marked.
    std::vector<FixedHits> complementary_pairs(const FixedPoint& p, std::span<const Hit> hits,
                                               std::vector<bool>& is_paired) const;
    // Whether a triangle covers p but for its clip distances, whatever the device's freedom, and no
    // edge of the triangle or border of the viewport is near.
    bool is_inside_whole(const FixedPoint& p, const TriangleSetup& setup) const;
    // Where a cut crosses edges that its triangles share: sets of such pairs of which exactly one
    // triangle covers p, in place of the pairs.
    void join_pairs(const FixedPoint& p, std::span<const Hit> hits, std::vector<FixedHits>& pairs);
    std::optional<FixedHits> joined_set(const FixedPoint& p, std::span<const Hit> hits,
                                        uint32_t first);
    // Adds the edges near p of a triangle that it and its complement cut; false if p lies where no
    // rule fixes anything.
    bool add_whole_sides(const FixedPoint& p, uint32_t whole, uint32_t member,
                         std::vector<Side>& sides);
    // How often triangles cover p that no clip distance cuts; -1 if it depends on the outline.
    int count_of_wholes(const FixedPoint& p, std::span<const uint32_t> wholes) const;

    const cases::Case& case_;
    cases::Profile profile_;
    const std::vector<cases::Triangle>& triangles_;
    TriangleSetups& setups_;
    const Predicates& predicates_;
    SharedEdges& edges_;
    uint32_t sample_ = 0;                  // of the pixel, the one at hand
    std::vector<Complement> complements_;  // by triangle, or empty
};

}  // namespace ref
