// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "ref/value/accept/judge_candidates.hpp"

namespace ref::value {

namespace {

Form<Ball> rounded(const Form<mpq_class>& f) {
    return {tight_ball(f.x), tight_ball(f.y), tight_ball(f.c)};
}

Range<Ball> rounded(const Range<mpq_class>& r) {
    return {tight_ball(r.low), tight_ball(r.high)};
}

Plane<Ball> rounded(const Plane<mpq_class>& exact) {
    Plane<Ball> plane;
    plane.form = rounded(exact.form);
    std::ranges::transform(exact.bx, plane.bx.begin(), tight_ball);
    std::ranges::transform(exact.by, plane.by.begin(), tight_ball);
    plane.constant = tight_ball(exact.constant);
    return plane;
}

Basis<Ball> rounded(const Basis<mpq_class>& exact) {
    Basis<Ball> basis;
    for (size_t i = 0; i < basis.bary.size(); ++i) {
        basis.bary.at(i) = rounded(exact.bary.at(i));
    }
    basis.low_x = tight_ball(exact.low_x);
    basis.high_x = tight_ball(exact.high_x);
    basis.low_y = tight_ball(exact.low_y);
    basis.high_y = tight_ball(exact.high_y);
    basis.orientation = exact.orientation;
    for (const Plane<mpq_class>& plane : exact.planes) {
        basis.planes.push_back(rounded(plane));
    }
    return basis;
}

}  // namespace

CandidateSet<Ball> rounded(const CandidateSet<mpq_class>& exact) {
    CandidateSet<Ball> set;
    set.exact = std::make_shared<const CandidateSet<mpq_class>>(exact);
    for (const Candidate<mpq_class>& from : exact.candidates) {
        Candidate<Ball> to{from.name, {}, from.is_unbounded, from.is_piece, from.is_free};
        for (const Basis<mpq_class>& basis : from.bases) {
            to.bases.push_back(rounded(basis));
        }
        set.candidates.push_back(std::move(to));
    }
    for (const Range<mpq_class>& hull : exact.hulls) {
        set.hulls.push_back(rounded(hull));
    }
    set.factor = tight_ball(exact.factor);
    set.margin = tight_ball(exact.margin);
    set.least_inv_w = tight_ball(exact.least_inv_w);
    set.depth = {exact.depth.format,        exact.depth.bias,
                 exact.depth.is_clamped,    exact.depth.is_max_norm,
                 rounded(exact.depth.unit), tight_ball(exact.depth.nominal_unit),
                 exact.depth.viewport};
    set.any_of_all = exact.any_of_all;
    set.covers_samples = exact.covers_samples;
    return set;
}

}  // namespace ref::value
