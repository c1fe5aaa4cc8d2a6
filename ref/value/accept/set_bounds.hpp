// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Proves in binary64 that all set-ups which a profile admits reject a value, or, at profile vulkan,
// that one of them accepts it. A device that is wrong everywhere is far off in most of its values,
// and trying up to 66 set-ups for each of them costs more than all else that is judged.
//
// The planes of all bases differ little inside the triangle's bounding box. The difference of two
// linear functions is largest at a corner of the box, so the first basis's plane, with the largest
// difference at the four corners as its bound, holds every plane of the set in the whole box.
// Budgets are the largest of any basis at any corner, because the extents are convex, times the
// spread at the point, a sum of magnitudes of linear functions that are held likewise. What lies
// outside of the values that these bounds leave, widened as value_at() widens one value, is
// accepted by none (docs/precision.md, "All set-ups at once").
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ref/value/accept/filter.hpp"
#include "ref/value/accept/judge_candidates.hpp"

namespace ref::value {

// Pixels.
struct PixelBox {
    double low_x = 0, low_y = 0, high_x = 0, high_y = 0;
};

class SetBounds {
  public:
    // `box` holds the points that will be asked for; it may be as large as the target, but the
    // larger, the less is rejected.
    SetBounds(const CandidateSet<Ball>& set, const PixelBox& box);

    // Whether no member of the set accepts the device's value of quantity `index` at any of these
    // evaluations. "No" proves nothing. A probe is never rejected, nor a depth with a bias.
    bool rejects(std::span<const Evaluation<Ball>> evaluations, const Asked& asked,
                 size_t index) const;

    // Values between which lie all that some member of the set accepts of quantity `index` at any
    // of these evaluations; nothing where rejects() never says yes.
    std::optional<Range<double>> outer(std::span<const Evaluation<Ball>> evaluations,
                                       const Asked& asked, size_t index) const;

    // Of a set at profile vulkan, where each value stands alone: whether its first basis, or the
    // hull of the vertex values where a member takes that, accepts the value at the one point where
    // it is evaluated. "No" proves nothing.
    bool accepts(const Evaluation<Ball>& where, const Asked& asked, size_t index) const;

  private:
    // The barycentrics and the planes of a basis, or of several in one; each `budget` is the
    // largest in the box for a spread of 1.
    using Planes = std::vector<FilterPlane>;
    // Bases between whose values all is accepted: those of a candidate, or of all candidates where
    // each value stands alone.
    struct Group {
        size_t first = 0, size = 0;  // in bases_
        bool has_unbounded = false;  // some candidate takes the hull of the vertex values
    };
    // All values that some basis has at a point, and the most that is accepted around them.
    struct Bound {
        double low = 0, high = 0, reach = 0;

        void widen(const Bound& other);
    };
    // Nothing if a denominator may not be safe, or if the point lies outside of the box.
    std::optional<Bound> bound_at(const Planes& planes, const Quantity& q, const Point<Ball>& p,
                                  double spread) const;
    bool is_inside_depths(const Bound& bound) const;
    // Of all points at which the quantity is evaluated there, and inside of the viewport's depths.
    std::optional<Bound> bound_over(const Planes& planes, const Evaluation<Ball>& where,
                                    const Quantity& q) const;
    // All that is accepted around a bound; `has_hull`: and anything between the vertices' values.
    Range<double> accepted_around(Bound bound, bool has_hull, const Quantity& q,
                                  size_t index) const;
    // Whether rejects() may say yes of a quantity.
    bool bounds_values_of(const Quantity& q) const;
    // Whether the device's value lies outside of all that these bases accept.
    bool is_outside(std::span<const Planes> bases, bool has_unbounded,
                    const Evaluation<Ball>& where, const Asked& asked, size_t index) const;

    PixelBox box_;
    bool is_usable_ = false;
    bool is_any_of_all_ = false;
    bool has_unbounded_ = false;  // some candidate takes the hull of the vertex values
    double factor_ = 0;           // K or a little more
    Planes all_;                  // of all bases in one
    std::vector<Planes> bases_;   // each by itself
    std::vector<Group> groups_;
    Filter first_;  // of the first basis; its budgets are the least
    double least_depth_budget_ = 0;
    std::vector<Range<Ball>> hulls_;  // of the vertex values, by quantity
    bool has_bias_ = false;
    bool is_clamped_ = false;
    Range<double> depths_;  // of the viewport
    double steps_ = 0;      // of a stored depth, 2^n - 1; 0 for binary32
};

}  // namespace ref::value
