// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/reproducer/probe_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "ref/value/accept/judge_candidates.hpp"
#include "ref/value/accept/probe.hpp"
#include "ref/value/fragment/promise.hpp"
#include "ref/value/places.hpp"

namespace cli {

namespace {

using cases::Probe;
using ref::value::Answer;
using ref::value::CandidateSet;
using ref::value::Point;
using ref::value::Quad;
using ref::value::Quantity;
using Bounds = ref::value::Range<double>;

// Bounds, or nothing where all is right.
struct Open {
    bool is_known = true;  // false: T could not tell
    std::optional<Bounds> bounds;
};

double outwards(double v, double up) {
    return std::nextafter(std::nextafter(v, up), up);
}
double low_of(const ref::value::Ball& a) {
    return outwards(a.v - a.e, -HUGE_VAL);
}
double high_of(const ref::value::Ball& a) {
    return outwards(a.v + a.e, HUGE_VAL);
}
double low_of(const mpq_class& a) {
    return outwards(a.get_d(), -HUGE_VAL);
}
double high_of(const mpq_class& a) {
    return outwards(a.get_d(), HUGE_VAL);
}

void widen(std::optional<Bounds>& into, const Bounds& by) {
    into = into ? Bounds{std::min(into->low, by.low), std::max(into->high, by.high)} : by;
}

// An input's value anywhere in the hull of the points, by any candidate (value_over in
// ref/value/accept/probe.cpp).
template <class T>
Open value_over(const CandidateSet<T>& set, uint32_t plane, bool is_perspective,
                std::span<const Point<T>> points) {
    Open out;
    bool is_undefined = false;
    for (const auto& candidate : set.candidates) {
        is_undefined = is_undefined || candidate.is_unbounded;
        for (const auto& basis : candidate.bases) {
            for (const Point<T>& p : points) {
                const auto site =
                    make_site(basis, basis.planes[ref::value::kPlaneInvW], p, set.factor);
                const auto v = value_at(site, basis.planes[plane], is_perspective, set.factor);
                out.is_known = out.is_known && v.exists != Answer::unknown;
                is_undefined = is_undefined || v.exists == Answer::no;
                if (v.exists == Answer::yes) {
                    widen(out.bounds,
                          {low_of(T(v.value - v.reach)), high_of(T(v.value + v.reach))});
                }
            }
        }
    }
    if (is_undefined) {
        out.bounds.reset();
    }
    return out;
}

// One correctly rounded operation more; results below 2^-126 may be flushed.
Bounds rounded_once(const Bounds& a) {
    constexpr double kFlushed = 0x1p-126;
    return {outwards(a.low - ref::value::kUnitRoundoff * std::fabs(a.low) - kFlushed, -HUGE_VAL),
            outwards(a.high + ref::value::kUnitRoundoff * std::fabs(a.high) + kFlushed, HUGE_VAL)};
}

Bounds magnitudes(const Bounds& a) {
    return {std::max({0.0, a.low, -a.high}), std::max(std::fabs(a.low), std::fabs(a.high))};
}

// All that one probe may be in one fragment.
template <class T>
class Prober {
  public:
    Prober(const CandidateSet<T>& set, const ref::value::Evaluation<T>& where,
           const ref::value::ProbePlace& place)
        : set_(set), where_(where), place_(place) {}

    Open of(const Quantity& q) const {
        const std::optional<ref::value::Derivative> derivative = ref::value::derivative_of(q.probe);
        Open out;
        if (q.probe != Probe::lod && !derivative) {
            for (const ref::value::Spots& spots : probe_spots(q, place_)) {
                std::vector<Point<T>> points;
                for (const auto& spot : spots) {
                    points.push_back({T(spot[0]), T(spot[1])});
                }
                if (!merge(out, value_over<T>(set_, q.plane, q.is_perspective, points))) {
                    return out;
                }
            }
            return out;
        }
        for (const Quad& quad : ref::value::quads_of(place_.id)) {
            const Open one = q.probe == Probe::lod ? level(q, quad) : change(q, *derivative, quad);
            if (!merge(out, one)) {
                return out;
            }
        }
        return out;
    }

  private:
    // False: nothing more can change the result.
    static bool merge(Open& into, const Open& by) {
        if (!by.is_known || !by.bounds) {
            into = by;
            return false;
        }
        widen(into.bounds, *by.bounds);
        return true;
    }

    std::vector<Point<T>> points_of(const Quantity& q, const std::array<int, 2>& step) const {
        std::vector<Point<T>> points = where_.attributes;
        const double x = place_.id.x;
        const double y = place_.id.y;
        const cases::Auxiliary auxiliary = place_.draw->attributes[q.id.attribute].auxiliary;
        if (place_.target->samples > 1 && auxiliary == cases::Auxiliary::sample) {
            points = {where_.sample};
        } else if (place_.target->samples > 1 && auxiliary == cases::Auxiliary::centroid) {
            points = {{T(x), T(y)}, {T(x + 1), T(y)}, {T(x + 1), T(y + 1)}, {T(x), T(y + 1)}};
        }
        for (Point<T>& p : points) {
            p.x = p.x + T(static_cast<double>(step[0]));
            p.y = p.y + T(static_cast<double>(step[1]));
        }
        return points;
    }

    Open along(const Quantity& q, uint32_t plane, const Quad& quad, int axis,
               bool is_coarse) const {
        Open out;
        for (const auto& d : ref::value::differences_of(quad, axis, is_coarse)) {
            const Open plus = value_over<T>(set_, plane, q.is_perspective, points_of(q, d.plus));
            const Open minus = value_over<T>(set_, plane, q.is_perspective, points_of(q, d.minus));
            Open one;
            one.is_known = plus.is_known && minus.is_known;
            if (plus.bounds && minus.bounds) {
                one.bounds = rounded_once(
                    {plus.bounds->low - minus.bounds->high, plus.bounds->high - minus.bounds->low});
            }
            if (!merge(out, one)) {
                return out;
            }
        }
        return out;
    }

    Open change(const Quantity& q, const ref::value::Derivative& derivative,
                const Quad& quad) const {
        const bool is_coarse =
            derivative.fineness == ref::value::Fineness::coarse ||
            (derivative.fineness == ref::value::Fineness::plain && quad.is_coarse);
        Open x, y;
        if (derivative.has_x) {
            x = along(q, q.plane, quad, 0, is_coarse);
        }
        if (derivative.has_y) {
            y = along(q, q.plane, quad, 1, is_coarse);
        }
        if (!derivative.has_x || !derivative.has_y) {
            return derivative.has_x ? x : y;
        }
        Open out;
        out.is_known = x.is_known && y.is_known;
        if (x.bounds && y.bounds) {
            const Bounds a = magnitudes(*x.bounds);
            const Bounds b = magnitudes(*y.bounds);
            out.bounds = rounded_once({a.low + b.low, a.high + b.high});
        }
        return out;
    }

    // What is_lod accepts (ref/value/accept/probe.hpp), but for 2^-mipmapPrecisionBits, which the
    // program grants by its device.
    Open level(const Quantity& q, const Quad& quad) const {
        const std::array<uint32_t, 2>& size = place_.draw->attributes[q.id.attribute].texture_size;
        const uint32_t first_plane = q.plane - q.id.component;
        std::array<std::array<double, 2>, 2> low{}, high{};
        for (uint32_t c = 0; c < 2; ++c) {
            for (uint32_t axis = 0; axis < 2; ++axis) {
                const Open one = along(q, first_plane + c, quad, static_cast<int>(axis), true);
                if (!one.is_known || !one.bounds) {
                    return one;
                }
                const Bounds m = magnitudes(*one.bounds);
                low[c][axis] = m.low * size[c];
                high[c][axis] = m.high * size[c];
            }
        }
        constexpr int kNoMore = 60;
        const Bounds lambda = ref::value::lod_bounds(low, high, kNoMore);
        Open out;
        if (q.id.component == 1) {
            out.bounds = lambda;
            return out;
        }
        const double last = ref::value::levels_of(size) - 1;
        const double most =
            place_.profile == cases::Profile::vulkan ? std::max(lambda.high, last) : last;
        out.bounds = Bounds{std::clamp(lambda.low, 0.0, last), std::clamp(lambda.high, 0.0, most)};
        return out;
    }

    const CandidateSet<T>& set_;
    const ref::value::Evaluation<T>& where_;
    const ref::value::ProbePlace& place_;
};

}  // namespace

// False: T could not tell.
template <class T>
bool ProbeRanges::add(uint32_t t, cases::SampleId sample, size_t attribute,
                      std::array<ref::ValueRange, 4>& out) {
    const cases::Draw& draw = case_.draws[triangles_[t].draw];
    const ref::value::Primitive primitive = ref::value::make_primitive(case_, triangles_[t]);
    const std::vector<Quantity> all = ref::value::quantities(draw, case_.target);
    if (!primitive.is_finite) {
        return true;
    }
    const auto set = ref::value::make_candidates<T>(primitive, all, limits_, profile_);
    ref::value::Fragment fragment;
    fragment.id = sample;
    fragment.target = &case_.target;
    fragment.draw = &draw;
    if (case_.target.samples > 1 && ref::value::has_centroid(draw)) {
        fragment.coverage = coverage_.of(t, sample.x, sample.y);
        fragment.region = coverage_.region(t, sample.x, sample.y);
    }
    const auto promises = ref::value::promises_of(primitive, all);
    const ref::value::ProbePlace place{sample, &case_.target, &draw, limits_, profile_};
    const auto evaluations = ref::value::evaluations<T>(fragment, profile_);
    for (size_t k = 0; k < all.size(); ++k) {
        const Quantity& q = all[k];
        const bool is_asked = promises[k].is_number &&
                              (profile_ != cases::Profile::vulkan || promises[k].is_guaranteed);
        if (q.kind != ref::value::Kind::probe || q.id.attribute != attribute || !is_asked ||
            (!q.is_perspective && !primitive.is_projectable)) {
            continue;
        }
        std::optional<Bounds> bounds;
        bool is_free = false;
        for (const auto& where : evaluations) {
            const Open one = Prober<T>(set, where, place).of(q);
            if (!one.is_known) {
                return false;
            }
            is_free = is_free || !one.bounds;
            if (one.bounds) {
                widen(bounds, *one.bounds);
            }
        }
        if (!is_free && bounds) {
            out.at(q.id.component) = {true, bounds->low, bounds->high};
        }
    }
    return true;
}

std::array<ref::ValueRange, 4> ProbeRanges::of(uint32_t t, cases::SampleId sample,
                                               size_t attribute) {
    std::array<ref::ValueRange, 4> out;
    if (!add<ref::value::Ball>(t, sample, attribute, out)) {
        out = {};
        add<mpq_class>(t, sample, attribute, out);
    }
    return out;
}

}  // namespace cli
