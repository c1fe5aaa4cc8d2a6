// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/accept/probe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "ref/value/fragment/shading_rate.hpp"

namespace ref::value {

namespace {

using cases::Probe;

// Flushing a result below 2^-126 to zero.
constexpr double kFlushed = 0x1p-126;

// What is accepted of one scalar.
template <class T>
struct Accepted {
    Range<T> range;
    Range<double> values;  // without the reach, rounded, for reports
    double budget = 0;  // the largest of the bases', likewise: what is accepted is within K of it
    bool is_known = true;
    bool is_undefined = false;
    bool is_first = true;
};

// An input's value anywhere in the hull of the points, by any of the candidates.
template <class T>
Accepted<T> value_over(const CandidateSet<T>& set, std::span<const Candidate<T>> candidates,
                       uint32_t plane, bool is_perspective, std::span<const Point<T>> points) {
    Accepted<T> out;
    for (const Candidate<T>& candidate : candidates) {
        // Between positions of different orientation a plane may be as steep as one likes.
        out.is_undefined = out.is_undefined || candidate.is_unbounded || candidate.is_free;
        for (const Basis<T>& basis : candidate.bases) {
            for (const Point<T>& p : points) {
                const Site<T> site = make_site(basis, basis.planes[kPlaneInvW], p, set.factor);
                const Valued<T> v = value_at(site, basis.planes[plane], is_perspective, set.factor);
                out.is_known = out.is_known && v.exists != Answer::unknown;
                out.is_undefined = out.is_undefined || v.exists == Answer::no;
                if (v.exists != Answer::yes) {
                    continue;
                }
                const T low = v.value - v.reach;
                const T high = v.value + v.reach;
                if (out.is_first) {
                    out.range = {low, high};
                    out.values = {nearest_double(v.value), nearest_double(v.value)};
                    out.is_first = false;
                }
                out.budget = std::max(out.budget, nearest_double(v.budget));
                out.values.low = std::min(out.values.low, nearest_double(v.value));
                out.values.high = std::max(out.values.high, nearest_double(v.value));
                out.range.low = smaller(out.range.low, low);
                out.range.high = larger(out.range.high, high);
            }
        }
    }
    out.is_undefined = out.is_undefined || (out.is_first && out.is_known);
    return out;
}

// One correctly rounded operation more; results below 2^-126 may be flushed.
template <class T>
void round_once(Accepted<T>& a) {
    a.range.low = a.range.low - T(kUnitRoundoff) * magnitude(a.range.low) - T(kFlushed);
    a.range.high = a.range.high + T(kUnitRoundoff) * magnitude(a.range.high) + T(kFlushed);
    a.budget += kUnitRoundoff * std::max(std::fabs(a.values.low), std::fabs(a.values.high));
}

template <class T>
void merge_flags(Accepted<T>& into, const Accepted<T>& from) {
    into.is_known = into.is_known && from.is_known;
    into.is_undefined = into.is_undefined || from.is_undefined;
    into.budget += from.budget;
}

template <class T>
Accepted<T> difference(Accepted<T> plus, const Accepted<T>& minus) {
    merge_flags(plus, minus);
    plus.range = {T(plus.range.low - minus.range.high), T(plus.range.high - minus.range.low)};
    plus.values = {plus.values.low - minus.values.high, plus.values.high - minus.values.low};
    round_once(plus);
    return plus;
}

// Bounds of the magnitude of what lies in a range.
template <class T>
Range<T> magnitudes(const Range<T>& r) {
    const T zero(0.0);
    return {larger(zero, larger(r.low, T(zero - r.high))),
            larger(T(magnitude(r.low)), T(magnitude(r.high)))};
}
Range<double> magnitudes(const Range<double>& r) {
    return {std::max({0.0, r.low, -r.high}), std::max(std::fabs(r.low), std::fabs(r.high))};
}

template <class T>
Accepted<T> width(const Accepted<T>& x, const Accepted<T>& y) {
    Accepted<T> out;
    merge_flags(out, x);
    merge_flags(out, y);
    const Range<T> a = magnitudes(x.range);
    const Range<T> b = magnitudes(y.range);
    out.range = {T(a.low + b.low), T(a.high + b.high)};
    const Range<double> c = magnitudes(x.values);
    const Range<double> d = magnitudes(y.values);
    out.values = {c.low + d.low, c.high + d.high};
    round_once(out);
    return out;
}

double low_double(const mpq_class& a) {
    const double v = a.get_d();
    return v - std::fabs(v) * 0x1p-51;
}
double high_double(const mpq_class& a) {
    const double v = a.get_d();
    return v + std::fabs(v) * 0x1p-51;
}
double low_double(const Ball& a) {
    return (a.v - a.e) - std::fabs(a.v) * 0x1p-51;
}
double high_double(const Ball& a) {
    return (a.v + a.e) + std::fabs(a.v) * 0x1p-51;
}

template <class T>
class Prober {
  public:
    Prober(const CandidateSet<T>& set, std::span<const Candidate<T>> candidates,
           bool is_projectable, const Evaluation<T>& where, const ProbePlace& place)
        : set_(set),
          candidates_(candidates),
          is_projectable_(is_projectable),
          where_(where),
          place_(place),
          shades_some_samples_(shading_rate(*place.draw, place.target->samples) ==
                               ShadingRate::some) {}

    struct Result {
        Answer answer = Answer::no;
        double ratio = std::numeric_limits<double>::infinity();
    };

    Result judge(const Quantity& q, const Quad& quad, double device) const {
        // A noperspective value of a triangle that reaches behind the eye has no plane that agrees
        // with the vertices.
        if (!q.is_perspective && !is_projectable_) {
            return {Answer::yes, 0};
        }
        if (q.probe == Probe::lod) {
            return judge_lod(q, quad, device);
        }
        Result best;
        for (const Accepted<T>& accepted : alternatives(q, quad)) {
            const Result r = fit(accepted, device);
            if (r.answer == Answer::unknown) {
                return r;
            }
            if ((r.answer == Answer::yes && best.answer != Answer::yes) ||
                (r.answer == best.answer && r.ratio < best.ratio)) {
                best = r;
            }
        }
        return best;
    }

  private:
    Accepted<T> at(const Quantity& q, uint32_t plane, std::span<const Point<T>> points) const {
        return value_over(set_, candidates_, plane, q.is_perspective, points);
    }

    // Where an input may be evaluated in a pixel of the quad.
    std::vector<Point<T>> points_of(const Quantity& q, const std::array<int, 2>& step) const {
        std::vector<Point<T>> points = where_.attributes;
        const double x = place_.id.x;
        const double y = place_.id.y;
        const cases::Auxiliary auxiliary = place_.draw->attributes[q.id.attribute].auxiliary;
        if (place_.target->samples > 1 && auxiliary == cases::Auxiliary::sample) {
            points = {where_.sample};  // the same sample of each pixel
        } else if (place_.target->samples > 1 &&
                   (auxiliary == cases::Auxiliary::centroid || shades_some_samples_)) {
            // Anywhere in each pixel: an invocation that stands for several samples may be at any
            // of them that its triangle covers, and those beside it at others.
            points = {{T(x), T(y)}, {T(x + 1), T(y)}, {T(x + 1), T(y + 1)}, {T(x), T(y + 1)}};
        }
        for (Point<T>& p : points) {
            p.x = p.x + T(static_cast<double>(step[0]));
            p.y = p.y + T(static_cast<double>(step[1]));
        }
        return points;
    }

    // The same for all differences of all quads that a pixel's value is in.
    const Accepted<T>& at_pixel(const Quantity& q, uint32_t plane,
                                const std::array<int, 2>& step) const {
        const auto [pixel, is_new] = pixels_.try_emplace({plane, step});
        if (is_new) {
            pixel->second = at(q, plane, points_of(q, step));
        }
        return pixel->second;
    }

    std::vector<Accepted<T>> along(const Quantity& q, uint32_t plane, const Quad& quad, int axis,
                                   bool is_coarse) const {
        std::vector<Accepted<T>> out;
        for (const Difference& d : differences_of(quad, axis, is_coarse)) {
            out.push_back(difference(at_pixel(q, plane, d.plus), at_pixel(q, plane, d.minus)));
        }
        return out;
    }

    std::vector<Accepted<T>> alternatives(const Quantity& q, const Quad& quad) const {
        const auto at_spots = [&](const Spots& spots, std::vector<Accepted<T>>& out) {
            std::vector<Point<T>> points;
            for (const auto& spot : spots) {
                points.push_back({T(spot[0]), T(spot[1])});
            }
            out.push_back(at(q, q.plane, points));
        };
        return alternatives_of<Accepted<T>>(
            q, quad, place_, at_spots,
            [&](int axis, bool is_coarse) { return along(q, q.plane, quad, axis, is_coarse); },
            width<T>);
    }

    static Result fit(const Accepted<T>& accepted, double device) {
        if (!accepted.is_known) {
            return {Answer::unknown, 0};
        }
        if (accepted.is_undefined) {
            return {Answer::yes, 0};
        }
        if (!std::isfinite(device)) {
            return {};
        }
        const T v(device);
        const Answer answer =
            both(is_at_most(accepted.range.low, v), is_at_most(v, accepted.range.high));
        const double distance =
            std::max({0.0, accepted.values.low - device, device - accepted.values.high});
        return {answer, accepted.budget > 0 ? distance / accepted.budget : 0};
    }

    // Each of the quad's pixels and each of its rows and columns may stand for the quad.
    Result judge_lod(const Quantity& q, const Quad& quad, double device) const {
        const std::array<uint32_t, 2>& size = place_.draw->attributes[q.id.attribute].texture_size;
        const uint32_t first_plane = q.plane - q.id.component;
        std::array<std::array<std::vector<Accepted<T>>, 2>, 2> m;  // of u and v, by x and y
        for (uint32_t c = 0; c < 2; ++c) {
            for (int axis = 0; axis < 2; ++axis) {
                m[c][static_cast<size_t>(axis)] = along(q, first_plane + c, quad, axis, true);
            }
        }
        Result best;
        for (size_t row = 0; row < 2; ++row) {
            for (size_t column = 0; column < 2; ++column) {
                std::array<std::array<double, 2>, 2> low{}, high{};
                bool is_undefined = false;
                for (size_t c = 0; c < 2; ++c) {
                    for (size_t axis = 0; axis < 2; ++axis) {
                        const Accepted<T>& a = m[c][axis][axis == 0 ? row : column];
                        if (!a.is_known) {
                            return {Answer::unknown, 0};
                        }
                        is_undefined = is_undefined || a.is_undefined;
                        const Range<T> r = magnitudes(a.range);
                        low[c][axis] = low_double(r.low) * size[c];
                        high[c][axis] = high_double(r.high) * size[c];
                    }
                }
                const int bits = place_.limits.mipmap_bits;
                if (is_undefined || is_lod(lod_bounds(low, high, bits), q.id.component,
                                           levels_of(size), place_, device)) {
                    best = {Answer::yes, 0};
                }
            }
        }
        return best;
    }

    const CandidateSet<T>& set_;
    std::span<const Candidate<T>> candidates_;
    bool is_projectable_;
    const Evaluation<T>& where_;
    const ProbePlace& place_;
    bool shades_some_samples_;
    // By plane and by what is added to the pixel's place.
    mutable std::map<std::pair<uint32_t, std::array<int, 2>>, Accepted<T>> pixels_;
};

// Whether the arrangement of the quad matters to any of the probes, and whether plain derivatives
// are among them.
std::array<bool, 2> depends_on_quad(std::span<const Quantity> quantities) {
    std::array<bool, 2> out{};
    for (const Quantity& q : quantities) {
        if (q.kind == Kind::probe) {
            const auto derivative = derivative_of(q.probe);
            out[0] = out[0] || derivative || q.probe == Probe::lod;
            out[1] = out[1] || (derivative && derivative->fineness == Fineness::plain);
        }
    }
    return out;
}

}  // namespace

template <class T>
void judge_probes(const CandidateSet<T>& set, std::span<const Candidate<T>> candidates,
                  const Evaluation<T>& where, const Asked& asked, CandidateVerdict& verdict) {
    const std::span<const Quantity> quantities = asked.quantities;
    const Prober<T> prober(set, candidates, asked.is_projectable, where, *asked.place);
    const auto [has_quad, has_plain] = depends_on_quad(quantities);
    std::vector<size_t> failing;
    std::vector<double> ratios;
    WorstError worst;
    bool is_first = true;
    for (const Quad& quad : quads_of(asked.place->id)) {
        if (!is_first && (!has_quad || (quad.is_coarse && !has_plain))) {
            continue;
        }
        std::vector<size_t> now;
        std::vector<double> now_ratios;
        WorstError now_worst;
        for (size_t i = 0; i < quantities.size(); ++i) {
            if (quantities[i].kind != Kind::probe || !asked.has(i)) {
                continue;
            }
            const auto r = prober.judge(quantities[i], quad, asked.got(i));
            if (r.answer == Answer::unknown) {
                verdict.is_known = false;
                return;
            }
            now_worst.raise(r.ratio, quantities[i]);
            if (r.answer == Answer::no) {
                now.push_back(i);
                now_ratios.push_back(r.ratio);
            }
        }
        if (is_first || now.size() < failing.size() ||
            (now.size() == failing.size() && now_worst.ratio < worst.ratio)) {
            failing = std::move(now);
            ratios = std::move(now_ratios);
            worst = now_worst;
        }
        is_first = false;
        if (failing.empty() && worst.ratio <= 1) {
            break;
        }
    }
    verdict.failing.insert(verdict.failing.end(), failing.begin(), failing.end());
    verdict.ratios.insert(verdict.ratios.end(), ratios.begin(), ratios.end());
    if (worst.ratio > verdict.worst.ratio) {
        verdict.worst = worst;
    }
}

template void judge_probes<Ball>(const CandidateSet<Ball>&, std::span<const Candidate<Ball>>,
                                 const Evaluation<Ball>&, const Asked&, CandidateVerdict&);
template void judge_probes<mpq_class>(const CandidateSet<mpq_class>&,
                                      std::span<const Candidate<mpq_class>>,
                                      const Evaluation<mpq_class>&, const Asked&,
                                      CandidateVerdict&);

}  // namespace ref::value
