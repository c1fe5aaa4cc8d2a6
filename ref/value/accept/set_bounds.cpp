// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/accept/set_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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

// The largest extent of a basis (make_site) at a point between two.
Ball extent_of(const Ball& basis_low, const Ball& basis_high, const Ball& low, const Ball& high) {
    const auto at = [&](const Ball& p) {
        return Ball(larger(basis_high, p) - smaller(basis_low, p));
    };
    return larger(at(low), at(high));
}

// A basis's three barycentrics come first, its planes behind them.
constexpr size_t kBary = 3;
const Form<Ball>& form_of(const Basis<Ball>& basis, size_t k) {
    return k < kBary ? basis.bary.at(k) : basis.planes[k - kBary].form;
}
FilterPlane held(const Form<Ball>& form, double budget) {
    return {form.x.v,       form.y.v,       form.c.v,
            form.x.e * kUp, form.y.e * kUp, form.c.e * kUp + ball::kTiny,
            budget};
}

// Not less than the sum of the magnitudes of a basis's barycentrics at any of the points: as
// spread_budgets(), which gives the largest to all of them.
double spread_at(std::span<const FilterPlane> planes, std::span<const Point<Ball>> points) {
    double most = 0;
    for (const Point<Ball>& p : points) {
        double sum = 0;
        for (const FilterPlane& b : planes.first(kBary)) {
            const Evaluated at = evaluate(b, {p.x.v, p.y.v});
            sum += std::fabs(at.v) + at.e;
        }
        most = std::max(most, sum);
    }
    return most * kUp;
}

// A noperspective value of a triangle that reaches behind the eye: as in add_candidate().
bool is_without_plane(const Asked& asked, size_t index) {
    const Quantity& q = asked.quantities[index];
    return q.kind == Kind::linear && q.id.is_attribute() && !asked.is_projectable;
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
        if (groups_.empty() || !is_any_of_all_) {
            groups_.push_back({bases_.size(), 0, false});
        }
        Group& group = groups_.back();
        group.size += candidate.bases.size();
        group.has_unbounded = group.has_unbounded || candidate.is_unbounded;
        for (const Basis<Ball>& basis : candidate.bases) {
            // The extents at their largest in the box.
            const Ball extent_x =
                extent_of(basis.low_x, basis.high_x, Ball(box.low_x), Ball(box.high_x));
            const Ball extent_y =
                extent_of(basis.low_y, basis.high_y, Ball(box.low_y), Ball(box.high_y));
            const bool is_first = first == nullptr;
            first = is_first ? &basis : first;
            Planes own;
            own.reserve(basis.planes.size() + 3);
            for (const Form<Ball>& form : basis.bary) {
                own.push_back(held(form, 0));
            }
            for (const Plane<Ball>& plane : basis.planes) {
                own.push_back(held(plane.form, upper(plane.budget(extent_x, extent_y, Ball(1.0)))));
            }
            if (is_first) {
                all_ = own;
            }
            for (size_t k = 0; k < own.size() && !is_first; ++k) {
                FilterPlane& all = all_[k];
                const Form<Ball>& here = form_of(*first, k);
                all.budget = std::max(all.budget, own[k].budget);
                all.ec = std::max(
                    all.ec,
                    (here.c.e + difference(form_of(basis, k), here, corners)) * kUp + ball::kTiny);
            }
            bases_.push_back(std::move(own));
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

void SetBounds::Bound::widen(const Bound& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
    reach = std::max(reach, other.reach);
}

std::optional<SetBounds::Bound> SetBounds::bound_at(const Planes& planes, const Quantity& q,
                                                    const Point<Ball>& p, double spread) const {
    const bool is_inside =
        p.x.v >= box_.low_x && p.x.v <= box_.high_x && p.y.v >= box_.low_y && p.y.v <= box_.high_y;
    if (!is_inside || p.x.e > 0 || p.y.e > 0) {
        return std::nullopt;
    }
    const Point<double> at{p.x.v, p.y.v};
    const FilterPlane& plane = planes[kBary + q.plane];
    const double budget = plane.budget * spread * kUp;
    const Evaluated n = evaluate(plane, at);
    if (q.kind == Kind::linear) {
        return Bound{n.v - n.e * kUp, n.v + n.e * kUp, factor_ * budget * kUp};
    }
    const FilterPlane& inv_w = planes[kBary + kPlaneInvW];
    const double inv_w_budget = inv_w.budget * spread * kUp;
    const Evaluated d = evaluate(inv_w, at);
    const double d_low = (d.v - d.e) * kDown;
    const double d_high = (d.v + d.e) * kUp;
    const double safe = (d_low - factor_ * inv_w_budget * kUp) * kDown;
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
    out.reach = factor_ * ((budget + most * inv_w_budget) / safe + 2 * kUnitRoundoff * most) * kUp;
    return out;
}

// Whether all of the values lie in the viewport's range, which they may leave by less than a
// budget: then none is undefined, and clamping takes none to where it was not.
bool SetBounds::is_inside_depths(const Bound& bound) const {
    return bound.low >= depths_.low - least_depth_budget_ &&
           bound.high <= depths_.high + least_depth_budget_;
}

std::optional<SetBounds::Bound> SetBounds::bound_over(const Planes& planes,
                                                      const Evaluation<Ball>& where,
                                                      const Quantity& q) const {
    const std::span<const Point<Ball>> points = points_at(where, place_of(q, where));
    const double spread = spread_at(planes, points);
    std::optional<Bound> all;
    for (const Point<Ball>& p : points) {
        const std::optional<Bound> one = bound_at(planes, q, p, spread);
        if (!one || ((is_depth(q) || is_frag_coord_z(q)) && !is_inside_depths(*one))) {
            return std::nullopt;
        }
        if (all) {
            all->widen(*one);
        } else {
            all = one;
        }
    }
    return all;
}

Range<double> SetBounds::accepted_around(Bound bound, bool has_hull, const Quantity& q,
                                         size_t index) const {
    if (has_hull) {
        bound.widen({lower(hulls_[index].low), upper(hulls_[index].high), 0});
    }
    // A store of fixed point takes either neighbour.
    const double step = is_depth(q) && steps_ > 0 ? 2 / steps_ : 0;
    const double slack =
        (bound.reach + step + (std::fabs(bound.low) + std::fabs(bound.high)) * 0x1p-48) * kUp;
    return {bound.low - slack, bound.high + slack};
}

bool SetBounds::is_outside(std::span<const Planes> bases, bool has_unbounded,
                           const Evaluation<Ball>& where, const Asked& asked, size_t index) const {
    const Quantity& q = asked.quantities[index];
    const double device = asked.got(index);
    std::optional<Bound> all;
    for (const Planes& planes : bases) {
        const std::optional<Bound> one = bound_over(planes, where, q);
        if (!one) {
            return false;
        }
        if (all) {
            all->widen(*one);
        } else {
            all = one;
        }
        if (device >= all->low && device <= all->high) {
            return false;
        }
    }
    if (!all) {
        return false;
    }
    const auto [low, high] =
        accepted_around(*all, has_unbounded || is_without_plane(asked, index), q, index);
    return device < low || device > high;
}

bool SetBounds::bounds_values_of(const Quantity& q) const {
    return is_usable_ && is_numeric(q) && !((is_depth(q) || is_frag_coord_z(q)) && has_bias_);
}

bool SetBounds::rejects(std::span<const Evaluation<Ball>> evaluations, const Asked& asked,
                        size_t index) const {
    return bounds_values_of(asked.quantities[index]) && !evaluations.empty() &&
           std::all_of(evaluations.begin(), evaluations.end(), [&](const auto& where) {
               return is_outside({&all_, 1}, has_unbounded_, where, asked, index) ||
                      std::all_of(groups_.begin(), groups_.end(), [&](const Group& group) {
                          return is_outside(std::span(bases_).subspan(group.first, group.size),
                                            group.has_unbounded, where, asked, index);
                      });
           });
}

std::optional<Range<double>> SetBounds::outer(std::span<const Evaluation<Ball>> evaluations,
                                              const Asked& asked, size_t index) const {
    const Quantity& q = asked.quantities[index];
    std::optional<Range<double>> out;
    for (const Evaluation<Ball>& where : evaluations) {
        const std::optional<Bound> bound =
            bounds_values_of(q) ? bound_over(all_, where, q) : std::nullopt;
        if (!bound) {
            return std::nullopt;
        }
        const Range<double> one =
            accepted_around(*bound, has_unbounded_ || is_without_plane(asked, index), q, index);
        if (!std::isfinite(one.low) || !std::isfinite(one.high)) {
            return std::nullopt;
        }
        out = out ? Range<double>{std::min(out->low, one.low), std::max(out->high, one.high)} : one;
    }
    return out;
}

bool SetBounds::accepts(const Evaluation<Ball>& where, const Asked& asked, size_t index) const {
    const Quantity& q = asked.quantities[index];
    const bool is_plain_depth = !has_bias_ && !is_clamped_ && !(steps_ > 0);
    if (!is_usable_ || !is_any_of_all_ || !is_numeric(q) || (is_depth(q) && !is_plain_depth)) {
        return false;
    }
    const double device = asked.got(index);
    if ((has_unbounded_ || is_without_plane(asked, index)) && device >= upper(hulls_[index].low) &&
        device <= lower(hulls_[index].high)) {
        return true;
    }
    const std::span<const Point<Ball>> at = points_at(where, place_of(q, where));
    if (at.size() != 1 || at.front().x.e > 0 || at.front().y.e > 0) {
        return false;
    }
    // A quotient is accepted around its value where its denominator is safe.
    if (q.kind == Kind::perspective && !bound_at(all_, q, at.front(), spread_at(all_, at))) {
        return false;
    }
    const Point<double> p{at.front().x.v, at.front().y.v};
    WorstError worst;
    return filter_accepts(first_, {&q, 1}, {p, p, p}, *asked.device, factor_ * kDown * kDown,
                          worst);
}

}  // namespace ref::value
