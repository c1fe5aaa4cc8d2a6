// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/accept/set_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "ref/value/accept/candidate_reach.hpp"

namespace ref::value {

namespace {

// Not less than the exact number that a Ball holds, and not more; infinite where it knows none.
double upper(const Ball& a) {
    const double high = a.v + a.e + std::fabs(a.v) * 0x1p-50;
    return std::isfinite(high) ? high : HUGE_VAL;
}
double lower(const Ball& a) {
    return -upper(-a);
}

std::array<Point<Ball>, 4> corners_of(const PixelBox& box) {
    return {{{box.low_x, box.low_y},
             {box.high_x, box.low_y},
             {box.high_x, box.high_y},
             {box.low_x, box.high_y}}};
}

// The largest difference of two planes in the box: a linear function's, so at a corner.
double difference(const Form<Ball>& a, const Form<Ball>& b, std::span<const Point<Ball>> corners) {
    const Form<Ball> d{a.x - b.x, a.y - b.y, a.c - b.c};
    double most = 0;
    for (const Point<Ball>& corner : corners) {
        most = std::max(most, upper(magnitude(d.at(corner))));
    }
    return most;
}

}  // namespace

SetBounds::SetBounds(const CandidateSet<Ball>& set, const PixelBox& box)
    : box_(box),
      is_any_of_all_(set.any_of_all),
      factor_(upper(set.factor)),
      hulls_(set.hulls),
      has_bias_(set.depth.bias.has_value()),
      is_clamped_(set.depth.is_clamped),
      depths_(set.depth.viewport),
      steps_(cases::depth_steps(set.depth.format)) {
    const std::array<Point<Ball>, 4> corners = corners_of(box);
    const Basis<Ball>* first = nullptr;
    bool is_free = false;
    for (const Candidate<Ball>& candidate : set.candidates) {
        is_free = is_free || candidate.is_free;
        has_unbounded_ = has_unbounded_ || candidate.is_unbounded;
        for (const Basis<Ball>& basis : candidate.bases) {
            Site<Ball> most;  // each term of a budget at its largest in the box
            for (const Point<Ball>& corner : corners) {
                const Site<Ball> s = make_site(basis, basis.planes[kPlaneInvW], corner, set.factor);
                most.extent_x = larger(most.extent_x, s.extent_x);
                most.extent_y = larger(most.extent_y, s.extent_y);
                most.spread = larger(most.spread, s.spread);
            }
            const bool is_first = first == nullptr;
            first = is_first ? &basis : first;
            for (size_t k = 0; k < basis.planes.size(); ++k) {
                const Plane<Ball>& plane = basis.planes[k];
                const double budget =
                    upper(plane.budget(most.extent_x, most.extent_y, most.spread));
                if (is_first) {
                    planes_.push_back({plane.form.x.v, plane.form.y.v, plane.form.c.v,
                                       plane.form.x.e * kUp, plane.form.y.e * kUp,
                                       plane.form.c.e * kUp + ball::kTiny, budget});
                    continue;
                }
                FilterPlane& all = planes_[k];
                all.budget = std::max(all.budget, budget);
                all.ec = std::max(all.ec, (first->planes[k].form.c.e +
                                           difference(plane.form, first->planes[k].form, corners)) *
                                                  kUp +
                                              ball::kTiny);
            }
            // The extents of the vertices alone and a spread of 1 give the least budget there is.
            const double depth_budget = lower(basis.planes[kPlaneDepth].budget(
                basis.high_x - basis.low_x, basis.high_y - basis.low_y, Ball(1.0)));
            least_depth_budget_ =
                is_first ? depth_budget : std::min(least_depth_budget_, depth_budget);
        }
    }
    is_usable_ = first != nullptr && !is_free;
    if (is_usable_) {
        first_ = make_filter(*first);
    }
}

std::optional<SetBounds::Bound> SetBounds::bound_at(const Quantity& q, const Point<Ball>& p) const {
    const bool is_inside =
        p.x.v >= box_.low_x && p.x.v <= box_.high_x && p.y.v >= box_.low_y && p.y.v <= box_.high_y;
    if (!is_inside || p.x.e > 0 || p.y.e > 0) {
        return std::nullopt;
    }
    const Point<double> at{p.x.v, p.y.v};
    const FilterPlane& plane = planes_[q.plane];
    const Evaluated n = evaluate(plane, at);
    if (q.kind == Kind::linear) {
        return Bound{n.v - n.e * kUp, n.v + n.e * kUp, factor_ * plane.budget * kUp};
    }
    const FilterPlane& inv_w = planes_[kPlaneInvW];
    const Evaluated d = evaluate(inv_w, at);
    const double d_low = (d.v - d.e) * kDown;
    const double d_high = (d.v + d.e) * kUp;
    const double safe = (d_low - factor_ * inv_w.budget * kUp) * kDown;
    if (!(safe > 0)) {
        return std::nullopt;
    }
    Bound out;
    const double n_low = n.v - n.e * kUp;
    const double n_high = n.v + n.e * kUp;
    out.low = n_low / (n_low < 0 ? d_low : d_high);
    out.high = n_high / (n_high < 0 ? d_high : d_low);
    const double most = std::max(std::fabs(out.low), std::fabs(out.high)) * kUp;
    // As value_at().
    out.reach =
        factor_ * ((plane.budget + most * inv_w.budget) / safe + 2 * kUnitRoundoff * most) * kUp;
    return out;
}

// Whether all of the values lie in the viewport's range, which they may leave by less than a
// budget: then none is undefined, and clamping takes none to where it was not.
bool SetBounds::is_inside_depths(const Bound& bound) const {
    return bound.low >= depths_.low - least_depth_budget_ &&
           bound.high <= depths_.high + least_depth_budget_;
}

bool SetBounds::takes_hull(const Asked& asked, size_t index) const {
    const Quantity& q = asked.quantities[index];
    return has_unbounded_ ||
           (q.kind == Kind::linear && q.id.is_attribute() && !asked.is_projectable);
}

bool SetBounds::rejects(std::span<const Evaluation<Ball>> evaluations, const Asked& asked,
                        size_t index) const {
    const Quantity& q = asked.quantities[index];
    const bool is_depth_like = is_depth(q) || is_frag_coord_z(q);
    if (!is_usable_ || !is_numeric(q) || evaluations.empty() || (is_depth_like && has_bias_)) {
        return false;
    }
    const double device = asked.got(index);
    for (const Evaluation<Ball>& where : evaluations) {
        std::optional<Bound> all;
        for (const Point<Ball>& p : points_at(where, place_of(q, where))) {
            const std::optional<Bound> one = bound_at(q, p);
            if (!one || (is_depth_like && !is_inside_depths(*one))) {
                return false;
            }
            all = all ? Bound{std::min(all->low, one->low), std::max(all->high, one->high),
                              std::max(all->reach, one->reach)}
                      : *one;
        }
        if (!all) {
            return false;
        }
        if (takes_hull(asked, index)) {
            all->low = std::min(all->low, lower(hulls_[index].low));
            all->high = std::max(all->high, upper(hulls_[index].high));
        }
        // A store of fixed point takes either neighbour.
        const double step = is_depth(q) && steps_ > 0 ? 2 / steps_ : 0;
        const double slack =
            all->reach + step + (std::fabs(all->low) + std::fabs(all->high)) * 0x1p-48;
        if (!(device < all->low - slack * kUp || device > all->high + slack * kUp)) {
            return false;
        }
    }
    return true;
}

bool SetBounds::accepts(const Evaluation<Ball>& where, const Asked& asked, size_t index) const {
    const Quantity& q = asked.quantities[index];
    const bool is_plain_depth = !has_bias_ && !is_clamped_ && !(steps_ > 0);
    if (!is_usable_ || !is_any_of_all_ || !is_numeric(q) || (is_depth(q) && !is_plain_depth)) {
        return false;
    }
    const double device = asked.got(index);
    if (takes_hull(asked, index) && device >= upper(hulls_[index].low) &&
        device <= lower(hulls_[index].high)) {
        return true;
    }
    const std::span<const Point<Ball>> at = points_at(where, place_of(q, where));
    if (at.size() != 1 || at.front().x.e > 0 || at.front().y.e > 0) {
        return false;
    }
    // A quotient is accepted around its value where its denominator is safe.
    if (q.kind == Kind::perspective && !bound_at(q, at.front())) {
        return false;
    }
    const Point<double> p{at.front().x.v, at.front().y.v};
    WorstError worst;
    return filter_accepts(first_, {&q, 1}, {p, p, p}, *asked.device, factor_ * kDown * kDown,
                          worst);
}

}  // namespace ref::value
