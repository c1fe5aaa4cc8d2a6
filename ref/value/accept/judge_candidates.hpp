// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Collects what a device may have set its planes up from under one profile, and judges whether one
// of these candidates explains a fragment.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "ref/number/plane_budget.hpp"
#include "ref/value/fragment/depth_path.hpp"
#include "ref/value/fragment/quantities.hpp"

namespace ref::value {

// One way to explain a fragment. If it has several bases, the device may be anywhere between them.
template <class T>
struct Candidate {
    ref::BasisKind name = ref::BasisKind::unsnapped;
    std::vector<Basis<T>> bases;
    // Some of the positions make no area or another orientation, so that only the vertex values
    // bound the values in between.
    bool is_unbounded = false;
    // It is a clipped piece, which explains points inside its triangle or within `margin` of it.
    bool is_piece = false;
    // Nothing bounds its values, the vertex values included: only a finite one is claimed.
    bool is_free = false;
};

template <class T>
struct CandidateSet {
    std::vector<Candidate<T>> candidates;
    std::vector<Range<T>> hulls;  // of the vertex values, by quantity (numeric ones only)
    T factor{};                   // K
    T margin{};                   // pixels, for pieces
    T least_inv_w{};              // of the visible part of the triangle
    DepthPath<T> depth;           // from interpolated to stored depth
    bool any_of_all = false;      // profile vulkan: each value alone, any candidate, their hull
    // The positions that cover a sample have it inside; not where primitives are enlarged.
    bool covers_samples = true;
    // What the numbers are the roundings of; null if they were made as they are.
    std::shared_ptr<const CandidateSet<mpq_class>> exact;
};

// The set for a profile. `factor` is K of docs/precision.md for that profile. Balls that cannot
// tell an orientation give way to the exact set, rounded.
template <class T>
CandidateSet<T> make_candidates(const Primitive& primitive, std::span<const Quantity> quantities,
                                const Limits& limits, cases::Profile profile);

// The exact set with each number as the nearest Ball: tighter than the set that is made in Balls
// where roundings pile up in the set-up of a triangle (next to no area, clipped, unequal w).
CandidateSet<Ball> rounded(const CandidateSet<mpq_class>& exact);

// The corners of the two lists of points that follow, exactly.
struct OnePoint {
    std::vector<Point<mpq_class>> attributes, centroid;
};

// Where the values may be evaluated, which is anywhere in the hull of the points.
template <class T>
struct Evaluation {
    std::vector<Point<T>> attributes;  // without decoration
    // FragCoord.z and w, of which the specification does not say where. If empty, `attributes`.
    std::vector<Point<T>> frag_coord;
    Point<T> sample;  // depth, and inputs decorated with Sample
    std::vector<Point<T>> centroid;
    // One point of `attributes` explains all inputs that are evaluated there, one of `centroid`
    // all of those. Without this each value may have its own.
    std::optional<OnePoint> one_point;
};

// All that a quantity may be.
template <class T>
struct AcceptedRange {
    bool is_known = true;  // false: T cannot tell; use rationals
    bool is_free = false;  // nothing is claimed of it
    Range<T> range;
    std::optional<Range<T>> biased;  // the other answer of a FragCoord.z (Reach::biased)
    bool is_outer = false;           // T cannot tell whether all that is in it is accepted
};

// All depths that the set's devices may compare and store at a point, after bias and clamp.
template <class T>
AcceptedRange<T> reach_of_depth(const CandidateSet<T>& set, const Quantity& depth,
                                bool is_projectable, const Point<T>& sample);

struct ProbePlace;

// What is asked of a set of candidates: the quantities of a fragment, and what the device has.
struct Asked {
    std::span<const Quantity> quantities;
    bool is_projectable = false;             // the triangle
    const ProbePlace* place = nullptr;       // where probes are asked for (probe.hpp)
    const FragmentValues* device = nullptr;  // null where only ranges are asked for
    std::span<const size_t> only = {};       // indices into the quantities; empty: all of them

    bool has(size_t index) const {
        return only.empty() || std::find(only.begin(), only.end(), index) != only.end();
    }
    // What the device has; 0 if that does not matter.
    double got(size_t index) const {
        return device != nullptr ? static_cast<double>(quantities[index].get(*device)) : 0;
    }
    Asked of(std::span<const size_t> other) const {
        Asked out = *this;
        out.only = other;
        return out;
    }
};

struct CandidateVerdict {
    bool is_known = true;
    bool ok = false;
    ref::BasisKind basis = ref::BasisKind::unsnapped;
    WorstError worst;
    std::vector<size_t> failing;  // indices into the quantities
    std::vector<double> ratios;   // of the failing ones
};

// The verdict on two groups of quantities, each with a candidate of its own; the basis is that of
// the second.
CandidateVerdict verdict_of_both(const CandidateVerdict& a, const CandidateVerdict& b);

// The verdict on some of the quantities, with a candidate of their own.
struct GroupVerdict {
    std::vector<size_t> only;
    CandidateVerdict verdict;
};

// Of a fragment that no candidate explains, and that has no probes, `groups` get the verdicts that
// they would have each by itself, for much less: what a candidate accepts is the same for all. A
// group that T cannot judge gets one that is not known.
template <class T>
CandidateVerdict judge_candidates(const CandidateSet<T>& set,
                                  const std::vector<Evaluation<T>>& evaluations, const Asked& asked,
                                  std::span<GroupVerdict> groups = {});

// Everything that some quantities may be, whichever candidate and place the device uses: by place
// in `asked.only`. What they share, sites and their budgets, is made once.
template <class T>
std::vector<AcceptedRange<T>> accepted_ranges(const CandidateSet<T>& set,
                                              const std::vector<Evaluation<T>>& evaluations,
                                              const Asked& asked);

}  // namespace ref::value
