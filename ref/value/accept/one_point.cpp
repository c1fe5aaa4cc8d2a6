// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/accept/one_point.hpp"

#include "ref/value/accept/reach.hpp"
#include "ref/value/fragment/fragment_coverage.hpp"

namespace ref::value {

namespace {

// Bounds over all points of the region: each term of the budget at its largest.
Site<mpq_class> widest_site(const Basis<mpq_class>& basis, const mpq_class& factor,
                            const std::vector<Point<mpq_class>>& region) {
    const Plane<mpq_class>& inv_w = basis.planes[kPlaneInvW];
    Site<mpq_class> out;
    bool is_first = true;
    for (const Point<mpq_class>& p : region) {
        const Site<mpq_class> s = make_site(basis, inv_w, p, factor);
        out.extent_x = larger(out.extent_x, s.extent_x);
        out.extent_y = larger(out.extent_y, s.extent_y);
        out.spread = larger(out.spread, s.spread);
        out.d = is_first ? s.d : smaller(out.d, s.d);
        is_first = false;
    }
    out.bd = inv_w.budget(out.extent_x, out.extent_y, out.spread);
    out.safe = out.d - factor * out.bd;
    out.exists = is_positive(out.safe);
    return out;
}

// a + t b
Form<mpq_class> sum(const Form<mpq_class>& a, const mpq_class& t, const Form<mpq_class>& b) {
    return {mpq_class(a.x + t * b.x), mpq_class(a.y + t * b.y), mpq_class(a.c + t * b.c)};
}

// The first of the quantities `which` (indices) that leaves no point of the region, given those
// before it; nothing if one point explains all of them. `factor` is K.
std::optional<size_t> first_unexplained(const Basis<mpq_class>& basis, const mpq_class& factor,
                                        std::vector<Point<mpq_class>> region,
                                        std::span<const Quantity> quantities,
                                        std::span<const size_t> which,
                                        const FragmentValues& device) {
    const Site<mpq_class> widest = widest_site(basis, factor, region);
    const std::vector<Point<mpq_class>> corners = region;
    const Form<mpq_class>& d = basis.planes[kPlaneInvW].form;
    const Form<mpq_class> one{mpq_class(0), mpq_class(0), mpq_class(1)};
    for (const size_t index : which) {
        const Quantity& q = quantities[index];
        const Plane<mpq_class>& plane = basis.planes[q.plane];
        const bool is_quotient = q.kind == Kind::perspective;
        if (is_quotient && widest.exists != Answer::yes) {
            continue;  // nothing is claimed of it, it need not even be finite
        }
        const mpq_class v(static_cast<double>(q.get(device)));
        const mpq_class bn = plane.budget(widest.extent_x, widest.extent_y, widest.spread);
        mpq_class reach = factor * bn;
        if (is_quotient) {
            mpq_class most;  // |f|: a quotient of linear functions is largest at a corner
            for (const Point<mpq_class>& p : corners) {
                most = larger(most, magnitude(mpq_class(plane.form.at(p) / d.at(p))));
            }
            // As value_at().
            const mpq_class planes = bn + most * widest.bd;
            reach = factor * (planes / widest.safe + mpq_class(2 * kUnitRoundoff) * most);
        }
        const Form<mpq_class>& scale = is_quotient ? d : one;
        // N - (v - r) D >= 0 and (v + r) D - N >= 0.
        const mpq_class low = v - reach;
        const mpq_class high = v + reach;
        const Form<mpq_class> above = sum(plane.form, mpq_class(-low), scale);
        const Form<mpq_class> below =
            sum({mpq_class(-plane.form.x), mpq_class(-plane.form.y), mpq_class(-plane.form.c)},
                high, scale);
        region = cut(cut(region, above), below);
        if (region.empty()) {
            return index;
        }
    }
    return std::nullopt;
}

// The numeric inputs that are evaluated at one place with each other.
std::vector<size_t> inputs_at(const Asked& asked, bool at_centroid) {
    std::vector<size_t> out;
    for (size_t i = 0; i < asked.quantities.size(); ++i) {
        const Quantity& q = asked.quantities[i];
        if (is_judged(asked, i) && q.id.is_attribute() && !q.at_sample &&
            q.at_centroid == at_centroid) {
            out.push_back(i);
        }
    }
    return out;
}

}  // namespace

template <class T>
Answer has_one_point(const CandidateSet<T>& set, size_t index, const OnePoint& where,
                     const Asked& asked, size_t& blamed) {
    if constexpr (std::is_same_v<T, Ball>) {
        const bool is_single =
            inputs_at(asked, false).size() < 2 && inputs_at(asked, true).size() < 2;
        return is_single   ? Answer::yes
               : set.exact ? has_one_point(*set.exact, index, where, asked, blamed)
                           : Answer::unknown;
    } else {
        const Candidate<T>& candidate = set.candidates[index];
        if (candidate.bases.size() != 1 || candidate.is_unbounded) {
            return Answer::yes;  // anywhere between several planes: each value alone
        }
        for (const bool at_centroid : {false, true}) {
            const std::vector<size_t> which = inputs_at(asked, at_centroid);
            if (which.size() < 2) {
                continue;
            }
            const auto wrong = first_unexplained(candidate.bases.front(), set.factor,
                                                 at_centroid ? where.centroid : where.attributes,
                                                 asked.quantities, which, *asked.device);
            if (wrong) {
                blamed = *wrong;
                return Answer::no;
            }
        }
        return Answer::yes;
    }
}

template Answer has_one_point<Ball>(const CandidateSet<Ball>&, size_t, const OnePoint&,
                                    const Asked&, size_t&);
template Answer has_one_point<mpq_class>(const CandidateSet<mpq_class>&, size_t, const OnePoint&,
                                         const Asked&, size_t&);

}  // namespace ref::value
