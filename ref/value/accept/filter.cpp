// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/accept/filter.hpp"

#include <algorithm>
#include <cmath>

namespace ref::value {

// x px + y py + c: two products and two sums, each within 2^-53 of terms that are bounded by the
// sum of magnitudes; 2^-50 of it is more than twice all four. The e's are evaluated alike.
Evaluated evaluate(const FilterPlane& plane, const Point<double>& p) {
    const double tx = plane.x * p.x;
    const double ty = plane.y * p.y;
    const double size = std::fabs(tx) + std::fabs(ty) + std::fabs(plane.c);
    const double input = plane.ex * std::fabs(p.x) + plane.ey * std::fabs(p.y) + plane.ec;
    return {tx + ty + plane.c, input + size * 0x1p-50};
}

Filter make_filter(const Basis<Ball>& basis) {
    Filter f;
    if (basis.orientation != 1 && basis.orientation != -1) {
        return f;
    }
    f.usable = true;
    // The extents of the vertices alone and a spread of 1 give a budget that is never too large.
    const Ball one(1.0);
    const Ball extent_x = basis.high_x - basis.low_x;
    const Ball extent_y = basis.high_y - basis.low_y;
    for (const Plane<Ball>& plane : basis.planes) {
        const Ball budget = plane.budget(extent_x, extent_y, one);
        FilterPlane p{plane.form.x.v,
                      plane.form.y.v,
                      plane.form.c.v,
                      plane.form.x.e * kUp,
                      plane.form.y.e * kUp,
                      plane.form.c.e * kUp + ball::kTiny,
                      (budget.v - budget.e) * kDown};
        f.usable = f.usable && p.budget > 0 && std::isfinite(p.ex + p.ey + p.ec + p.budget);
        f.planes.push_back(p);
    }
    return f;
}

bool filter_accepts(const Filter& filter, std::span<const Quantity> quantities,
                    const FilterPoints& places, const FragmentValues& device, double factor,
                    WorstError& worst) {
    if (!filter.usable) {
        return false;
    }
    const FilterPlane& inv_w = filter.planes[kPlaneInvW];
    const Evaluated d_centre = evaluate(inv_w, places.centre);
    const Evaluated d_sample = evaluate(inv_w, places.sample);
    const Evaluated d_centroid = evaluate(inv_w, places.centroid);
    WorstError found;
    for (const Quantity& q : quantities) {
        if (!is_numeric(q)) {
            continue;
        }
        const FilterPlane& plane = filter.planes[q.plane];
        const double v = static_cast<double>(q.get(device));
        const Evaluated n = evaluate(plane, q.at_sample     ? places.sample
                                            : q.at_centroid ? places.centroid
                                                            : places.centre);
        if (q.kind == Kind::linear) {
            const double error = std::fabs(v - n.v);
            if (!((error + n.e) * kUp <= factor * plane.budget)) {
                return false;
            }
            found.raise(error / plane.budget, q);
            continue;
        }
        // |v - n/d| <= K ((b_n + f b_d)/d + 2u f), times d: |v d - n| <= K (b_n + f b_d + 2u |n|).
        const Evaluated& d = q.at_sample ? d_sample : q.at_centroid ? d_centroid : d_centre;
        if (!((d.v - d.e) * kDown > 0)) {
            return false;
        }
        const double n_low = std::max(0.0, std::fabs(n.v) - n.e) * kDown;
        const double f_low = n_low / ((d.v + d.e) * kUp) * kDown;
        const double scaled = plane.budget + f_low * inv_w.budget + 2 * kUnitRoundoff * n_low;
        const double vd = v * d.v;
        const double error = std::fabs(vd - n.v);
        const double slack = n.e + std::fabs(v) * d.e + std::fabs(vd) * 0x1p-52;
        if (!((error + slack) * kUp <= factor * scaled * kDown)) {
            return false;
        }
        found.raise(error / scaled, q);
    }
    worst = found;
    return true;
}

}  // namespace ref::value
