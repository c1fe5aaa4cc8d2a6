// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Computes which numbers one candidate accepts for a quantity: the hull of the values at its sites,
// widened by the budgets of binary32, then bias, clamp and store of a depth. candidate_reach.hpp
// builds on it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "ref/value/accept/judge_candidates.hpp"

namespace ref::value {

// How well one candidate explains one value at one evaluation.
struct Fit {
    Answer answer = Answer::no;
    double ratio = std::numeric_limits<double>::infinity();  // rounded
};

template <class T>
void widen(Range<T>& range, bool& is_first, const T& low, const T& high) {
    range.low = is_first ? low : smaller(range.low, low);
    range.high = is_first ? high : larger(range.high, high);
    is_first = false;
}

// Whether a candidate explains a point: a clipped piece those inside of its triangle, and at most
// `margin` outside of each edge's line.
template <class T>
Answer is_near(const CandidateSet<T>& set, const Candidate<T>& candidate, const Point<T>& p) {
    Answer all = Answer::yes;
    for (size_t k = 0; candidate.is_piece && k < 3; ++k) {
        const Form<T>& b = candidate.bases.front().bary[k];
        const T slack = set.margin * (magnitude(b.x) + magnitude(b.y));
        all = both(all, is_at_most(T(-slack), b.at(p)));
    }
    return all;
}

// A stretch of numbers, all of which are accepted.
template <class T>
struct Stretch {
    Range<T> range;
    bool is_first = true;  // nothing is in it yet
    // Rounded, for reports: hull of the values alone, and the budget of the one nearest to the
    // device.
    double low = 0, high = 0, budget = 0;

    void note(double device, double value, double one_budget) {
        const bool is_nearer =
            budget <= 0 || distance(device, value, value) < distance(device, low, high);
        if (is_nearer) {
            budget = one_budget;
        }
        low = noted ? std::min(low, value) : value;
        high = noted ? std::max(high, value) : value;
        noted = true;
    }
    static double distance(double device, double from, double to) {
        return std::max({0.0, from - device, device - to});
    }
    bool noted = false;
};

template <class T>
struct Reach {
    Stretch<T> all;
    // FragCoord.z of a draw with a bias has two answers, since the Vulkan specification says only
    // that it is "the interpolated depth value of the primitive" (interfaces-builtin-variables)
    // and of the bias that it is computed for a polygon and added to its fragments' depths
    // (primsrast-depthbias), not which of the two comes first; Direct3D's texts disagree with each
    // other, too: added to "each vertex before interpolator setup" (functional specification,
    // 15.10), or by the output merger. So a device's FragCoord.z has no bias (`all`), or it has
    // the bias (this): no text has a part of it, and what lies between the two is neither.
    Stretch<T> biased;
    bool is_free = false;       // nothing is claimed but a finite value
    bool is_undefined = false;  // nothing at all
    bool is_known = true;
};

inline bool is_depth(const Quantity& q) {
    return q.id.is_depth();
}
inline bool is_frag_coord_z(const Quantity& q) {
    return q.id.of == QuantityId::Of::frag_coord && q.plane == kPlaneDepth;
}

// Whether bias is added to a quantity, or may be.
template <class T>
bool takes_bias(const CandidateSet<T>& set, const Quantity& q) {
    return set.depth.bias && (is_depth(q) || is_frag_coord_z(q));
}

// Whether the whole of a range lies outside of another one.
template <class T>
Answer is_beyond(const T& low, const T& high, const Range<double>& range) {
    const Answer reaches_up = is_at_most(T(range.low), high);
    const Answer reaches_down = is_at_most(low, T(range.high));
    if (reaches_up == Answer::no || reaches_down == Answer::no) {
        return Answer::yes;
    }
    return reaches_up == Answer::yes && reaches_down == Answer::yes ? Answer::no : Answer::unknown;
}

template <class T>
void add_hull(const Range<T>& hull, const T& widest, double device, Stretch<T>& out) {
    out.note(device, nearest_double(hull.low), nearest_double(widest));
    out.note(device, nearest_double(hull.high), nearest_double(widest));
    widen(out.range, out.is_first, T(hull.low - widest), T(hull.high + widest));
}

// Whether the hull of the vertex values holds a smooth value whose denominator binary32 cannot tell
// from zero: that of a sample inside of the basis's triangle. `is_covered`: a device that uses this
// basis covers the sample by the same positions.
template <class T>
Answer is_in_hull(const CandidateSet<T>& set, const Site<T>& site, bool at_sample,
                  bool is_covered) {
    if (!at_sample) {
        return Answer::no;
    }
    const Answer inside = is_covered ? Answer::yes : site.is_inside;
    const Answer has_least = is_positive(set.least_inv_w);
    if (inside == Answer::unknown || has_least == Answer::unknown) {
        return Answer::unknown;
    }
    return inside == Answer::yes && has_least == Answer::yes ? Answer::yes : Answer::no;
}

// Adds what is accepted around a value; nothing if the bias is not added.
template <class T>
void add_value(const CandidateSet<T>& set, const Quantity& q, const Valued<T>& v,
               const std::optional<Range<T>>& bias, double device, Reach<T>& reach,
               Stretch<T>& out) {
    const T least = bias ? T(v.value + bias->low) : v.value;
    const T most = bias ? T(v.value + bias->high) : v.value;
    out.note(device, nearest_double(least), nearest_double(v.budget));
    out.note(device, nearest_double(most), nearest_double(v.budget));
    // Adding the bias is one more rounding.
    const T rounding = bias ? T(set.factor * T(kUnitRoundoff)) : T{};
    const T low = least - v.reach - rounding * magnitude(least);
    const T high = most + v.reach + rounding * magnitude(most);
    if (is_depth(q) && set.any_of_all && !set.depth.is_clamped) {
        // Vulkan: depth outside of the viewport's range is undefined unless it is clamped.
        const Answer beyond =
            is_beyond(T(least - v.budget), T(most + v.budget), set.depth.viewport);
        reach.is_known = reach.is_known && beyond != Answer::unknown;
        reach.is_undefined = reach.is_undefined || beyond == Answer::yes;
    }
    widen(out.range, out.is_first, low, high);
}

// Adds what one basis accepts for a quantity at the sites; `widest` is the largest reach.
// `is_covered`: as above, of each site. `at_sample`: they are the covered sample itself.
template <class T>
void add_reach(const CandidateSet<T>& set, const Basis<T>& basis, const Quantity& q,
               std::span<const Site<T>> sites, const Range<T>& hull, bool at_sample,
               bool is_covered, double device, T& widest, Reach<T>& out) {
    const T& factor = set.factor;
    std::optional<Range<T>> bias;
    if (takes_bias(set, q)) {
        bias = bias_of(set.depth, basis, factor);
    }
    // Whether the denominator may be at least zero at some of the sites, and at most zero at some.
    Answer reaches_up = Answer::no;
    bool reaches_down = false;
    for (const Site<T>& site : sites) {
        const Valued<T> v =
            value_at(site, basis.planes[q.plane], q.kind == Kind::perspective, factor);
        if (v.exists == Answer::unknown) {
            out.is_known = false;
            return;
        }
        if (v.exists == Answer::no) {
            const Plane<T>& inv_w = basis.planes[kPlaneInvW];
            const Answer in_hull = is_in_hull(set, site, at_sample, is_covered);
            if (in_hull == Answer::yes) {
                const T most = larger(T(magnitude(hull.low)), T(magnitude(hull.high)));
                const Plane<T>& plane = basis.planes[q.plane];
                add_hull(hull, hull_reach(site, inv_w, plane, set.least_inv_w, most, factor),
                         device, out.all);
            } else if (in_hull == Answer::no) {
                out.is_free = true;
                reaches_down = true;
                reaches_up = either(reaches_up, is_at_most(T(0.0), T(site.d + factor * site.bd)));
            } else {
                out.is_known = false;
            }
            continue;
        }
        reaches_up = Answer::yes;
        widest = larger(widest, v.reach);
        if (is_frag_coord_z(q)) {
            add_value<T>(set, q, v, std::nullopt, device, out, out.all);
            if (bias) {
                add_value(set, q, v, bias, device, out, out.biased);
            }
        } else {
            add_value(set, q, v, bias, device, out, out.all);
        }
    }
    // Where the denominator may be zero in binary32, a device may divide by that, which leaves
    // infinity or NaN.
    if (reaches_down && reaches_up == Answer::unknown) {
        out.is_known = false;
    } else if (reaches_down && reaches_up == Answer::yes) {
        out.is_undefined = true;
    }
}

// What a quantity is held to besides its range: depth is clamped and stored, FragCoord.z may be
// clamped.
struct Store {
    bool may_clamp = false;   // to the viewport's range
    bool must_clamp = false;  // depthClampEnable
    // To 0 and 1: what becomes of depth outside of the viewport's range without depth clamp is
    // undefined, and VK_KHR_depth_clamp_zero_one, which defines it, has it so.
    bool may_clamp_to_one = false;
    Range<double> viewport;
    double steps = 0;  // 2^n - 1; 0 for binary32
    double rounding =
        1;  // of a store, in steps: less than 1 is either neighbour of a number between
};

template <class T>
Store store_of(const CandidateSet<T>& set, const Quantity& q) {
    Store store;
    store.viewport = set.depth.viewport;
    if (is_depth(q)) {
        store.may_clamp = true;
        store.must_clamp = set.depth.is_clamped;
        store.may_clamp_to_one = !set.depth.is_clamped;
        store.steps = cases::depth_steps(set.depth.format);
        // Direct3D 11.3, 3.2.3.6: within 0.6 of a step; max norm is what that profile has, too.
        store.rounding = set.depth.is_max_norm ? 0.6 : 1;
    } else if (is_frag_coord_z(q)) {
        store.may_clamp = set.depth.is_clamped;
    }
    return store;
}

// Whether a stored value may come from the range. A number of steps is stored as itself; any other
// as either neighbour (Vulkan specification, "Conversion From Floating-Point to Normalized
// Fixed-Point").
template <class T>
Answer may_store(const Range<T>& range, double device, const Store& store) {
    if (store.steps <= 0) {
        return both(is_at_most(range.low, T(device)), is_at_most(T(device), range.high));
    }
    const double code = std::round(device * store.steps);
    // depth_of_code() of cases/format/depth_format.hpp is within 2^-25 of the code's value.
    if (std::fabs(device * store.steps - code) > 0.5) {
        return Answer::no;
    }
    const T low = range.low * T(store.steps);
    const T high = range.high * T(store.steps);
    if (store.rounding < 1) {
        return both(is_at_most(low, T(code + store.rounding)),
                    is_at_most(T(code - store.rounding), high));
    }
    return both(is_positive(T(T(code + 1) - low)), is_positive(T(high - T(code - 1))));
}

// Whether the number may come from a stretch, and how many budgets it is from the values there.
template <class T>
Fit fit(const Stretch<T>& stretch, double device, const Store& store) {
    if (stretch.is_first) {
        return {};
    }
    const double step = store.steps > 0 ? store.rounding / store.steps : 0;
    const double distance =
        std::max(0.0, Stretch<T>::distance(device, stretch.low, stretch.high) - step);
    const double ratio = stretch.budget > 0 ? distance / stretch.budget
                         : distance > 0     ? std::numeric_limits<double>::infinity()
                                            : 0.0;
    Answer answer = store.must_clamp ? Answer::no : may_store(stretch.range, device, store);
    if (answer != Answer::yes && store.may_clamp) {
        Answer other = may_store(clamped(stretch.range, store.viewport), device, store);
        if (other != Answer::yes && store.may_clamp_to_one) {
            constexpr Range<double> kZeroToOne{0, 1};
            other = either(other, may_store(clamped(stretch.range, kZeroToOne), device, store));
        }
        if (other == Answer::yes) {
            // A clamped value says nothing of the plane's error.
            const bool is_inside = answer != Answer::no;
            return {Answer::yes, is_inside || ratio <= 1 ? ratio : 0};
        }
        answer = other == Answer::unknown ? other : answer;
    }
    return {answer, ratio};
}

template <class T>
Fit fit(const Reach<T>& reach, double device, const Store& store) {
    const bool is_outside =
        store.must_clamp && (device < store.viewport.low || device > store.viewport.high);
    if (reach.is_known && reach.is_undefined && !is_outside) {
        return {Answer::yes, 0};
    }
    if (!std::isfinite(device)) {
        return {reach.is_known ? Answer::no : Answer::unknown,
                std::numeric_limits<double>::infinity()};
    }
    if (!reach.is_known) {
        return {Answer::unknown, 0};
    }
    if (reach.is_free && (!store.must_clamp || store.steps > 0)) {
        return {Answer::yes, 0};
    }
    if (reach.is_free) {
        return {is_outside ? Answer::no : Answer::yes, 0};
    }
    const Fit all = fit(reach.all, device, store);
    const Fit biased = fit(reach.biased, device, store);
    return {either(all.answer, biased.answer), std::min(all.ratio, biased.ratio)};
}

inline bool is_judged(const Asked& asked, size_t index) {
    return is_numeric(asked.quantities[index]) && asked.has(index);
}

// Whether the points are the sample and nothing else. Both are exact in binary64.
template <class T>
bool is_same(const std::vector<Point<T>>& points, const Point<T>& sample) {
    const auto same = [](const T& a, const T& b) {
        return !(std::fabs(nearest_double(a) - nearest_double(b)) > 0);
    };
    return points.size() == 1 && same(points[0].x, sample.x) && same(points[0].y, sample.y);
}

// Gives several sites one budget for values between them: each term is the largest of any site.
template <class T>
void spread_budgets(const Plane<T>& inv_w, const T& factor, std::vector<Site<T>>& sites) {
    if (sites.size() < 2) {
        return;
    }
    Site<T> most;
    for (const Site<T>& s : sites) {
        most.extent_x = larger(most.extent_x, s.extent_x);
        most.extent_y = larger(most.extent_y, s.extent_y);
        most.spread = larger(most.spread, s.spread);
    }
    for (Site<T>& s : sites) {
        s.extent_x = most.extent_x;
        s.extent_y = most.extent_y;
        s.spread = most.spread;
        s.bd = inv_w.budget(s.extent_x, s.extent_y, s.spread);
        s.safe = s.d - factor * s.bd;
        s.exists = is_positive(s.safe);
    }
}

}  // namespace ref::value
