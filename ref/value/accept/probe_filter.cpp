// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Probes in binary64. Every interval here lies inside of the one that probe.cpp accepts (its
// ends are moved inwards by more than its own roundings), and differences, widths and levels of
// detail of smaller intervals are smaller: what is accepted here is accepted there.
#include <algorithm>
#include <array>
#include <cmath>

#include "ref/value/accept/filter.hpp"
#include "ref/value/accept/probe.hpp"

namespace ref::value {

namespace {

struct Inner {
    double low = 1, high = 0;  // empty
    double value = 0, budget = 0;
};

bool is_empty(const Inner& a) {
    return !(a.low <= a.high);
}

// Bounds of the magnitude.
Inner magnitude_of(const Inner& a) {
    return {std::max({0.0, a.low, -a.high}), std::max(std::fabs(a.low), std::fabs(a.high)),
            std::fabs(a.value), a.budget};
}

Inner shrunk(Inner inner, double size) {
    inner.low += size * 0x1p-48;
    inner.high -= size * 0x1p-48;
    return inner;
}

Inner width_of(const Inner& x, const Inner& y) {
    if (is_empty(x) || is_empty(y)) {
        return {};
    }
    const Inner a = magnitude_of(x);
    const Inner b = magnitude_of(y);
    return shrunk({a.low + b.low, a.high + b.high, a.value + b.value, a.budget + b.budget},
                  a.high + b.high);
}

class FilterProber {
  public:
    FilterProber(const Filter& filter, const ProbePlace& place, double factor)
        : filter_(filter), place_(place), factor_(factor) {}

    // The error in budgets if the number is accepted, a negative number if not.
    double judge(const Quantity& q, const Quad& quad, double device) const {
        if (q.probe == cases::Probe::lod) {
            return is_level(q, quad, device) ? 0 : -1;
        }
        double best = -1;
        for (const Inner& inner : alternatives(q, quad)) {
            if (device >= inner.low && device <= inner.high && inner.budget > 0) {
                const double ratio = std::fabs(device - inner.value) / inner.budget;
                best = best < 0 ? ratio : std::min(best, ratio);
            }
        }
        return best;
    }

  private:
    std::vector<Inner> alternatives(const Quantity& q, const Quad& quad) const {
        const auto at_spots = [&](const Spots& spots, std::vector<Inner>& out) {
            for (const auto& spot : spots) {
                out.push_back(value(q, q.plane, spot));
            }
        };
        return alternatives_of<Inner>(
            q, quad, place_, at_spots,
            [&](int axis, bool is_coarse) { return along(q, q.plane, quad, axis, is_coarse); },
            width_of);
    }

    // K budgets around the value, of a budget that is never too large; what the value itself may be
    // off by is taken away.
    Inner value(const Quantity& q, uint32_t index, const std::array<double, 2>& p) const {
        const FilterPlane& plane = filter_.planes[index];
        const Evaluated n = evaluate(plane, {p[0], p[1]});
        if (!q.is_perspective) {
            const double reach = factor_ * plane.budget * kDown - n.e * kUp;
            return shrunk({n.v - reach, n.v + reach, n.v, plane.budget},
                          std::fabs(n.v) + std::fabs(reach));
        }
        const FilterPlane& inv_w = filter_.planes[kPlaneInvW];
        const Evaluated d = evaluate(inv_w, {p[0], p[1]});
        const double room = (d.v - d.e) * kDown;
        if (!(room > 0)) {
            return {};
        }
        const double f = n.v / d.v;
        const double error = ((n.e + std::fabs(f) * d.e) / room + std::fabs(f) * 0x1p-51) * kUp;
        const double f_low = std::max(0.0, std::fabs(f) - error);
        const double planes = (plane.budget + f_low * inv_w.budget) / ((d.v + d.e) * kUp);
        const double budget = (planes + 2 * kUnitRoundoff * f_low) * kDown;
        const double reach = factor_ * budget * kDown - error;
        return shrunk({f - reach, f + reach, f, budget}, std::fabs(f) + std::fabs(reach));
    }

    std::vector<Inner> along(const Quantity& q, uint32_t plane, const Quad& quad, int axis,
                             bool is_coarse) const {
        const double x = place_.id.x + 0.5;
        const double y = place_.id.y + 0.5;
        std::vector<Inner> out;
        for (const Difference& d : differences_of(quad, axis, is_coarse)) {
            const Inner plus = value(q, plane, {x + d.plus[0], y + d.plus[1]});
            const Inner minus = value(q, plane, {x + d.minus[0], y + d.minus[1]});
            if (is_empty(plus) || is_empty(minus)) {
                out.emplace_back();
                continue;
            }
            const double size = std::fabs(plus.value) + std::fabs(minus.value) +
                                (plus.high - plus.low) + (minus.high - minus.low);
            out.push_back(shrunk({plus.low - minus.high, plus.high - minus.low,
                                  plus.value - minus.value, plus.budget + minus.budget},
                                 size));
        }
        return out;
    }

    bool is_level(const Quantity& q, const Quad& quad, double device) const {
        const std::array<uint32_t, 2>& size = place_.draw->attributes[q.id.attribute].texture_size;
        std::array<std::array<double, 2>, 2> low{}, high{};
        for (size_t c = 0; c < 2; ++c) {
            for (size_t axis = 0; axis < 2; ++axis) {
                const auto plane = static_cast<uint32_t>(q.plane - q.id.component + c);
                const Inner inner = along(q, plane, quad, static_cast<int>(axis), false).front();
                if (is_empty(inner)) {
                    return false;
                }
                const Inner m = magnitude_of(inner);
                low[c][axis] = m.low * size[c];
                high[c][axis] = m.high * size[c];
            }
        }
        const int bits = place_.limits.mipmap_bits;
        return is_lod(lod_bounds(low, high, bits), q.id.component, levels_of(size), place_, device);
    }

    const Filter& filter_;
    const ProbePlace& place_;
    double factor_;
};

}  // namespace

bool filter_accepts_probes(const Filter& filter, std::span<const Quantity> quantities,
                           const ProbePlace& place, const FragmentValues& device, double factor,
                           WorstError& worst) {
    const bool has_probes = std::any_of(quantities.begin(), quantities.end(),
                                        [](const Quantity& q) { return q.kind == Kind::probe; });
    if (!has_probes) {
        return true;
    }
    if (!filter.usable || place.target->samples > 1 || !place.target->sample_locations.empty()) {
        return false;
    }
    const FilterProber prober(filter, place, factor);
    for (const Quad& quad : quads_of(place.id)) {
        WorstError found = worst;
        const bool is_accepted =
            std::all_of(quantities.begin(), quantities.end(), [&](const Quantity& q) {
                if (q.kind != Kind::probe) {
                    return true;
                }
                const double ratio = prober.judge(q, quad, static_cast<double>(q.get(device)));
                found.raise(ratio, q);
                return ratio >= 0;
            });
        if (is_accepted) {
            worst = found;
            return true;
        }
    }
    return false;
}

}  // namespace ref::value
