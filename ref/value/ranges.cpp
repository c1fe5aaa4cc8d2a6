// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "ref/number/rational.hpp"
#include "ref/value/accept/candidate_reach.hpp"
#include "ref/value/accept/reach.hpp"
#include "ref/value/sample_values.hpp"

namespace ref::value {

using cases::Profile;

namespace {

// The numbers that the attachment may hold of depths in `range`: clamped and, in fixed point,
// rounded as judging allows (store_of() and may_store() of ref/value/accept/reach.hpp).
void store_depth(const Store& store, cases::DepthFormat format, ValueRange& range) {
    const auto clamped = [&](double z) {
        return std::clamp(z, store.viewport.low, store.viewport.high);
    };
    const double low = clamped(range.low);
    const double high = clamped(range.high);
    range.low = store.must_clamp ? low : std::min(low, range.low);
    range.high = store.must_clamp ? high : std::max(high, range.high);
    if (store.steps <= 0) {
        return;
    }
    const mpq_class least = mpq_class(range.low) * mpq_class(store.steps);
    const mpq_class most = mpq_class(range.high) * mpq_class(store.steps);
    const mpq_class rounding(store.rounding);
    const bool is_neighbour = store.rounding >= 1;
    const double first =
        is_neighbour ? floor_of(least).get_d() : ceil_of(mpq_class(least - rounding)).get_d();
    const double last =
        is_neighbour ? ceil_of(most).get_d() : floor_of(mpq_class(most + rounding)).get_d();
    const auto depth_of = [&](double code) {
        const double inside = std::clamp(code, 0.0, store.steps);
        return static_cast<double>(cases::depth_of_code(static_cast<uint32_t>(inside), format));
    };
    range.low = depth_of(first);
    range.high = depth_of(last);
}

double low_of(const Ball& a) {
    return a.v - a.e;
}
double high_of(const Ball& a) {
    return a.v + a.e;
}
double low_of(const mpq_class& a) {
    return a.get_d();
}
double high_of(const mpq_class& a) {
    return a.get_d();
}

// Outwards: a subtraction rounds by half an ulp, get_d truncates by less than one.
template <class T>
std::pair<double, double> outwards(const Range<T>& range) {
    return {std::nextafter(std::nextafter(low_of(range.low), -HUGE_VAL), -HUGE_VAL),
            std::nextafter(std::nextafter(high_of(range.high), HUGE_VAL), HUGE_VAL)};
}

template <class T>
ValueRange told(const AcceptedRange<T>& accepted) {
    const auto [low, high] = outwards(accepted.range);
    ValueRange out{!accepted.is_free && std::isfinite(low) && std::isfinite(high), low, high};
    if (!out.is_promised || !accepted.biased) {
        return out;
    }
    const auto [biased_low, biased_high] = outwards(*accepted.biased);
    out.is_promised = std::isfinite(biased_low) && std::isfinite(biased_high);
    if (biased_low <= high && low <= biased_high) {
        out.low = std::min(low, biased_low);
        out.high = std::max(high, biased_high);
    } else {
        out.has_biased = true;
        out.biased_low = biased_low;
        out.biased_high = biased_high;
    }
    return out;
}

// Whether FragCoord.z and w are those of one of several places, and never anything between.
bool are_coord_places_single(std::span<const Evaluation<Ball>> places) {
    const auto is_single = [](const auto& place) { return place.frag_coord.size() == 1; };
    const auto is_first = [&](const auto& place) {
        const Point<Ball>&p = place.frag_coord.front(), &first = places.front().frag_coord.front();
        return is_identical(p.x, first.x) && is_identical(p.y, first.y);
    };
    return std::ranges::all_of(places, is_single) && !std::ranges::all_of(places, is_first);
}

// Of what is no plane: it is known to the bit, or to a step of fixed point.
std::optional<ValueRange> known_range(const Primitive& primitive, cases::SampleId sample,
                                      const QuantityId& id) {
    if (id.is_attribute()) {
        const cases::Attribute& a = primitive.draw->attributes[id.attribute];
        if (id.component >= a.components) {
            return ValueRange{true, 0, 0};
        }
        if (a.interpolation == cases::Interpolation::flat) {
            const auto v = static_cast<double>(provoking_value(primitive, id));
            return ValueRange{std::isfinite(v), v, v};
        }
    }
    const auto z = cases::written_depth(*primitive.draw, sample.x, sample.y);
    if (z && id.is_depth()) {
        const auto [low, high] = StoredDepth(*primitive.draw, primitive.depth_format, *z).range();
        return ValueRange{true, low, high};
    }
    return std::nullopt;
}

// Ranges that hold what is accepted of each quantity in `asked.only`; nothing if one has no bound.
std::optional<std::vector<ValueRange>> outer_ranges(SetUps& set_ups, uint32_t t,
                                                    cases::SampleId sample, const Asked& asked) {
    std::vector<ValueRange> out;
    for (const size_t index : asked.only) {
        const auto range = set_ups.bounds(t, set_ups.profile())
                               .outer(set_ups.kept_places(t, sample), asked, index);
        if (!range) {
            return std::nullopt;
        }
        out.push_back({true, range->low, range->high});
    }
    return out;
}

// The ranges of each quantity in `asked.only`.
std::vector<ValueRange> told_ranges(SetUps& set_ups, uint32_t t, cases::SampleId sample,
                                    const Asked& asked) {
    const Profile profile = set_ups.profile();
    std::vector<AcceptedRange<Ball>> wide;
    set_ups.ask_balls(t, profile, [&](const CandidateSet<Ball>& set) {
        wide = accepted_ranges(set, set_ups.kept_places(t, sample), asked);
        return std::ranges::all_of(wide, &AcceptedRange<Ball>::is_known) ? std::optional(true)
                                                                         : std::nullopt;
    });
    std::vector<ValueRange> out;
    for (size_t k = 0; k < wide.size(); ++k) {
        const Quantity& q = asked.quantities[asked.only[k]];
        ValueRange& range = out.emplace_back(
            wide[k].is_known ? told(wide[k])
                             : told(accepted_ranges(set_ups.candidates<mpq_class>(t, profile),
                                                    set_ups.places<mpq_class>(t, sample, profile),
                                                    asked.of(asked.only.subspan(k, 1)))
                                        .front()));
        range.is_of_places = q.id.of == QuantityId::Of::frag_coord &&
                             are_coord_places_single(set_ups.kept_places(t, sample));
        if (range.is_promised && q.id.is_depth()) {
            store_depth(store_of(set_ups.candidates<Ball>(t, profile), q),
                        set_ups.target().depth_format, range);
        }
    }
    return out;
}

}  // namespace

std::array<ValueRange, 4> ranges_of(SetUps& set_ups, uint32_t t, cases::SampleId sample,
                                    std::span<const QuantityId> ids, bool may_be_outer) {
    std::array<ValueRange, 4> out;
    const Primitive& primitive = set_ups.primitive(t);
    if (!primitive.is_finite) {
        return out;
    }
    std::vector<size_t> only;  // the interpolated ones that are asked for
    std::vector<uint32_t> component_of;
    for (const QuantityId& id : ids) {
        if (const auto known = known_range(primitive, sample, id)) {
            out.at(id.component) = *known;
        } else if (const auto index = set_ups.asked_plane(t, id)) {
            only.push_back(*index);
            component_of.push_back(id.component);
        }
    }
    if (only.empty()) {
        return out;
    }
    const Asked asked{set_ups.quantities_of(t), primitive.is_projectable, nullptr, nullptr, only};
    auto ranges = may_be_outer ? outer_ranges(set_ups, t, sample, asked) : std::nullopt;
    if (!ranges) {
        ranges = told_ranges(set_ups, t, sample, asked);
    }
    for (size_t k = 0; k < only.size(); ++k) {
        out.at(component_of[k]) = (*ranges)[k];
    }
    return out;
}

}  // namespace ref::value
