// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// From the coverage of single triangles to the hits that a sample may show.
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
// the others share what is left of the number.
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

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/triangle.hpp"
#include "ref/coverage/setup.hpp"
#include "ref/coverage/triangle_setups.hpp"
#include "ref/depth/outcome.hpp"
#include "ref/expectation/complement.hpp"
#include "ref/expectation/discards.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/vertex_numbers.hpp"
#include "ref/stencil/outcome.hpp"

namespace ref {

// A triangle that must or may cover the sample at hand. Fragments that their shader takes away are
// no hits, and where it may do so the triangle may cover the sample.
struct Hit {
    uint32_t triangle = 0;
    Coverage coverage = Coverage::either;
};

// Whether a hit is that of another piece of the triangle before it (ref/coverage/pieces.hpp).
inline bool is_further(std::span<const Hit> hits, size_t m) {
    return m > 0 && hits[m - 1].triangle == hits[m].triangle;
}

// Triangles that share a number of hits, and why.
struct FixedSet {
    ReasonKind why = ReasonKind::shared_edge;
    std::vector<uint32_t> triangles;  // all of them, in drawing order
    uint32_t count = 0, least = 0;    // how many of them cover the sample: at most and at least
};

// Holds what judge() rests on, for those who tell it.
struct JudgeReasons {
    std::vector<FixedSet> sets;
    DepthResolution depth;             // of each hit; empty if the case tests no depth
    std::vector<stencil::Fate> fates;  // of each hit; empty if the case follows no courses
};

// What judge() appends to: of an expectation, or of an explanation.
struct JudgedLists {
    std::vector<uint32_t>& writers;        // that may have written last
    std::vector<uint32_t>& depth_writers;  // whose depth may be stored
    std::vector<stencil::Outcome>& stencils;
};

// The arithmetic that narrowing rests on, so that both implementations bring their own.
struct Predicates {
    // p lies in the closed convex hull of the boxes.
    bool (*is_in_hull)(std::span<const Box>, const FixedPoint&);
    // How often the polygon runs around p, clockwise positive, with the top-left rule on its
    // border.
    int (*winding)(std::span<const FixedPoint>, const FixedPoint&);
    // An outline covers p but for its cuts, whatever positions the device uses.
    bool (*is_inside_whole)(const TriangleSetup&, const Outline&, const FixedPoint&);
    stencil::Resolve resolve_stencil;
};

// Whether what a sample shows hangs on the whole course of its fragments (ref/stencil/outcome.hpp):
// the stencil of each fragment or the depth that is stored chooses, or some store depth or stencil
// and do not show, or queries count what becomes of each.
inline bool follows_courses(const cases::Case& c) {
    return stencil::is_needed(c) || stores_discarded(c) || tests_bounds(c) || counts_fragments(c);
}

// Keeps the hits of a sample for the colour target, if the case has one. `fates`: of each hit, if
// the case follows courses.
inline void add_fragments(Expectation& out, const cases::Case& c, std::span<const Hit> hits,
                          std::span<const stencil::Fate> fates, SampleExpectation& sample) {
    if (!out.target.color) {
        return;
    }
    sample.fragments_begin = static_cast<uint32_t>(out.fragments.size());
    for (size_t k = 0; k < fates.size(); ++k) {
        if (fates[k].passes) {
            out.fragments.push_back({hits[k].triangle, fates[k].always_passes()});
        }
    }
    sample.fragments_count = static_cast<uint32_t>(out.fragments.size()) - sample.fragments_begin;
    if (follows_courses(c)) {
        return;
    }
    sample.fragments_count = static_cast<uint32_t>(hits.size());
    for (const Hit& hit : hits) {
        // A depth test or a mask may still take it away; the bounds of the sample know how many.
        const cases::Draw& draw = c.draws[out.triangles[hit.triangle].draw];
        const bool is_tested =
            out.target.has_depth && draw.depth.compare != cases::CompareOp::always;
        const bool passes = !is_tested && draw.multisample.sample_mask == 0xffffffffU &&
                            !draw.multisample.shader_mask;
        out.fragments.push_back({hit.triangle, passes && hit.coverage == Coverage::must});
    }
}

// Keeps what queries may count of the hits of a sample, if a draw of the case has one.
void add_counted(Expectation& out, const cases::Case& c, std::span<const Hit> hits,
                 std::span<const stencil::Fate> fates, SampleExpectation& sample);

class Narrowing {
  public:
    Narrowing(const cases::Case& c, cases::Profile profile,
              const std::vector<cases::Triangle>& triangles, TriangleSetups& setups,
              Predicates predicates, DepthTest* depth, ValueDiscards& discards);

    // Bounds for sample `s` of a pixel, at p, from the triangles that must or may cover it, in
    // drawing order; appends to `lists` what it says of them. Fills `reasons`, unless it is null.
    SampleExpectation judge(const FixedPoint& p, uint32_t s, std::span<const Hit> hits,
                            const JudgedLists& lists, JudgeReasons* reasons = nullptr);
    // What may have become of each hit of the last judge(), if the case follows courses.
    std::span<const stencil::Fate> fates() const { return fates_; }
    // Whether judge() says the same wherever the sample lies that these triangles touch.
    bool is_anywhere(std::span<const Hit> hits) const;

  private:
    // Triangles of which exactly `count` cover the sample, or from `least` to `count`.
    struct Fixed {
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

    // Pairs of triangles with complementary clip distances; their members are marked.
    std::vector<Fixed> complementary_pairs(const FixedPoint& p, std::span<const Hit> hits,
                                           std::vector<bool>& is_paired) const;
    // Whether the fragment of a triangle at p may be as if it had never been.
    bool may_be_taken_away(uint32_t t, const FixedPoint& p);
    // Whether a triangle covers p but for its clip distances, whatever the device's freedom, and no
    // edge of the triangle or border of the viewport is near.
    bool is_inside_whole(const FixedPoint& p, const TriangleSetup& setup) const;
    // Where a cut crosses edges that its triangles share: sets of such pairs of which exactly one
    // triangle covers p, in place of the pairs.
    void join_pairs(const FixedPoint& p, std::span<const Hit> hits, std::vector<Fixed>& pairs);
    std::optional<Fixed> joined_set(const FixedPoint& p, std::span<const Hit> hits, uint32_t first);
    // As add_sides(), of a triangle and its complement: the edges of the triangle that they cut.
    bool add_whole_sides(const FixedPoint& p, uint32_t whole, uint32_t member,
                         std::vector<Side>& sides);
    // How often triangles cover p that no clip distance cuts; -1 if it depends on the outline.
    int count_of_wholes(const FixedPoint& p, std::span<const uint32_t> wholes) const;
    DepthResolution resolve_depth(const FixedPoint& p, std::span<const Hit> hits,
                                  const std::vector<Fixed>& sets);
    FixedSet told_set(const FixedPoint& p, std::span<const Hit> hits, const Fixed& set) const;
    // Takes the fragments away that fail the depth test.
    void apply_depth(const FixedPoint& p, std::span<const Hit> hits, std::vector<Fixed>& sets,
                     std::vector<Coverage>& coverage, std::vector<uint32_t>& depth_writers,
                     SampleExpectation& out, JudgeReasons* reasons);
    // The same of stencil and depth test together (narrowing_stencil.cpp): all that judge() says.
    stencil::Question stencil_question(const FixedPoint& p, std::span<const Hit> hits,
                                       const std::vector<Fixed>& sets,
                                       std::vector<ReasonKind>& depth_reasons);
    SampleExpectation judge_by_stencil(const FixedPoint& p, std::span<const Hit> hits,
                                       const std::vector<Fixed>& sets, const JudgedLists& lists,
                                       JudgeReasons* reasons);
    struct EdgeOwner {
        uint64_t edge = 0;
        uint32_t triangle = 0;
    };

    // The fixed sets that consist of triangles which may, but need not, cover p.
    std::vector<Fixed> fixed_sets(const FixedPoint& p, std::span<const Hit> hits);
    // Appends to `sets` those of the open hits that no set of fixed_sets has. They contain
    // triangles that are decided by themselves, too.
    void add_decided_sets(const FixedPoint& p, std::span<const Hit> hits, std::vector<Fixed>& sets);
    // The sets of hits that are closed under partnership, among those that take part.
    std::vector<Fixed> closed_sets(const FixedPoint& p, std::span<const Hit> hits,
                                   const std::vector<bool>& takes_part);
    // The triangles that have this edge, given by its two vertices. Triangles that touch no sample
    // are left out, since no sample lies in the band of their edges.
    std::span<const EdgeOwner> triangles_at(uint64_t edge);
    uint64_t edge_number(const cases::Triangle& triangle, uint32_t edge);
    // Adds the edges of a hit near p; false if p lies where no rule fixes anything.
    bool add_sides(const FixedPoint& p, const Hit& hit, uint32_t member, std::vector<Side>& sides);
    // The number of the members that cover p, or -1 if it depends on the outline used.
    int count_of(const FixedPoint& p, std::span<const Hit> hits,
                 const std::vector<uint32_t>& members) const;
    int winding_of(const FixedPoint& p, const TriangleSetup& setup, const Outline& outline) const;

    const cases::Case& case_;
    cases::Profile profile_;
    const std::vector<cases::Triangle>& triangles_;
    TriangleSetups& setups_;
    Predicates predicates_;
    uint32_t sample_ = 0;                  // of the pixel, the one at hand
    std::vector<Complement> complements_;  // by triangle, or empty
    DepthTest* depth_;                     // null: every fragment passes and writes
    ValueDiscards& discards_;
    bool follows_courses_;
    bool stores_discarded_;
    std::vector<stencil::Fate> fates_;  // of the hits at hand
    VertexNumbers vertex_numbers_;
    std::vector<EdgeOwner> edge_owners_;  // sorted by edge, then triangle; when first asked for
};

}  // namespace ref
