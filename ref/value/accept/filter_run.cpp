// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/accept/filter_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "ref/number/wide.hpp"

namespace ref::value {

namespace {

using Lanes = std::array<double, kRunLength>;

struct EvaluatedRow {
    Lanes v, e;
};

// As evaluate(), at n pixels from p to the right.
EDGECASE_INLINED void evaluate_row(const FilterPlane& plane, const Point<double>& p, size_t n,
                                   EvaluatedRow& out) {
    const double ty = plane.y * p.y;
    const double ey = plane.ey * std::fabs(p.y);
    for (size_t k = 0; k < n; ++k) {
        const double x = p.x + static_cast<double>(static_cast<int>(k));
        const double tx = plane.x * x;
        const double size = std::fabs(tx) + std::fabs(ty) + std::fabs(plane.c);
        const double input = plane.ex * std::fabs(x) + ey + plane.ec;
        out.v[k] = tx + ty + plane.c;
        out.e[k] = input + size * 0x1p-50;
    }
}

EDGECASE_INLINED void judge_linear(const FilterPlane& plane, const EvaluatedRow& n,
                                   const Lanes& device, double factor, std::span<double> ratios) {
    const double most = factor * plane.budget;
    Lanes in_budgets, reach;  // of all lanes, before any is chosen: there is no branch then
    for (size_t k = 0; k < ratios.size(); ++k) {
        const double error = std::fabs(device[k] - n.v[k]);
        in_budgets[k] = error / plane.budget;
        reach[k] = (error + n.e[k]) * kUp;
    }
    for (size_t k = 0; k < ratios.size(); ++k) {
        ratios[k] = std::max(ratios[k], reach[k] <= most ? in_budgets[k] : HUGE_VAL);
    }
}

EDGECASE_INLINED void judge_perspective(const FilterPlane& plane, const FilterPlane& inv_w,
                                        const EvaluatedRow& n, const EvaluatedRow& d,
                                        const Lanes& device, double factor,
                                        std::span<double> ratios) {
    for (size_t k = 0; k < ratios.size(); ++k) {
        const double n_low = std::max(0.0, std::fabs(n.v[k]) - n.e[k]) * kDown;
        const double f_low = n_low / ((d.v[k] + d.e[k]) * kUp) * kDown;
        const double scaled = plane.budget + f_low * inv_w.budget + 2 * kUnitRoundoff * n_low;
        const double vd = device[k] * d.v[k];
        const double error = std::fabs(vd - n.v[k]);
        const double slack = n.e[k] + std::fabs(device[k]) * d.e[k] + std::fabs(vd) * 0x1p-52;
        const bool is_safe = (d.v[k] - d.e[k]) * kDown > 0;
        const bool is_near = (error + slack) * kUp <= factor * scaled * kDown;
        const double in_budgets = error / scaled;
        ratios[k] = std::max(ratios[k], is_safe && is_near ? in_budgets : HUGE_VAL);
    }
}

}  // namespace

EDGECASE_WIDE void filter_run(const Filter& filter, std::span<const RunValue> values,
                              const RunPoints& points, double factor, std::span<double> ratios) {
    std::fill(ratios.begin(), ratios.end(), filter.usable ? 0 : HUGE_VAL);
    if (!filter.usable) {
        return;
    }
    const size_t n = ratios.size();
    const FilterPlane& inv_w = filter.planes[kPlaneInvW];
    std::array<EvaluatedRow, 2> denominators;  // at the centre, at the sample
    std::array<bool, 2> has_denominator{};
    EvaluatedRow numerator;
    Lanes device;
    for (const RunValue& value : values) {
        const Quantity& q = *value.quantity;
        const Point<double>& p = q.at_sample ? points.sample : points.centre;
        const FilterPlane& plane = filter.planes[q.plane];
        evaluate_row(plane, p, n, numerator);
        for (size_t k = 0; k < n; ++k) {
            device[k] = static_cast<double>(value.at[k * value.step]);
        }
        if (q.kind == Kind::linear) {
            judge_linear(plane, numerator, device, factor, ratios);
            continue;
        }
        const size_t place = q.at_sample ? 1 : 0;
        if (!has_denominator.at(place)) {
            has_denominator.at(place) = true;
            evaluate_row(inv_w, p, n, denominators.at(place));
        }
        judge_perspective(plane, inv_w, numerator, denominators.at(place), device, factor, ratios);
    }
}

}  // namespace ref::value
