// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What to expect of a fragment: the interval of a value that its profile allows, and the exact
// value of each plane.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "cases/model/sample.hpp"
#include "ref/number/rational.hpp"
#include "ref/value/accept/candidate_reach.hpp"
#include "ref/value/accept/reach.hpp"
#include "ref/value/describe.hpp"
#include "ref/value/sample_values.hpp"
#include "ref/value/set_ups.hpp"

namespace ref {

using cases::Profile;
using value::Answer;
using value::Ball;
using value::is_plain_depth;
using value::Kind;
using value::nominal_depth;
using value::Quantity;

namespace {

// The numbers that the attachment may hold of depths in `range`: clamped and, in fixed point,
// rounded as judging allows (store_of() and may_store() of ref/value/accept/reach.hpp).
void store_depth(const value::Store& store, cases::DepthFormat format, ValueRange& range) {
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
std::pair<double, double> outwards(const value::Range<T>& range) {
    return {std::nextafter(std::nextafter(low_of(range.low), -HUGE_VAL), -HUGE_VAL),
            std::nextafter(std::nextafter(high_of(range.high), HUGE_VAL), HUGE_VAL)};
}

template <class T>
ValueRange told(const value::AcceptedRange<T>& accepted) {
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
bool are_coord_places_single(std::span<const value::Evaluation<Ball>> places) {
    const auto is_single = [](const auto& place) { return place.frag_coord.size() == 1; };
    const auto is_first = [&](const auto& place) {
        const value::Point<Ball>&p = place.frag_coord.front(),
              &first = places.front().frag_coord.front();
        return value::is_identical(p.x, first.x) && value::is_identical(p.y, first.y);
    };
    return std::ranges::all_of(places, is_single) && !std::ranges::all_of(places, is_first);
}

}  // namespace

ValueRange ValueReference::range(uint32_t t, cases::SampleId sample, const QuantityId& id) {
    std::array<ValueRange, 4> out;
    add_ranges(t, sample, {&id, 1}, false, out);
    return out.at(id.component);
}

namespace {

std::array<QuantityId, 4> components_of(size_t attribute) {
    std::array<QuantityId, 4> ids;
    for (size_t k = 0; k < ids.size(); ++k) {
        ids[k] = QuantityId::of_attribute(attribute, k);
    }
    return ids;
}

}  // namespace

std::array<ValueRange, 4> ValueReference::ranges(uint32_t t, cases::SampleId sample,
                                                 size_t attribute) {
    std::array<ValueRange, 4> out;
    add_ranges(t, sample, components_of(attribute), false, out);
    return out;
}

std::array<ValueRange, 4> ValueReference::outer_ranges(uint32_t t, cases::SampleId sample,
                                                       size_t attribute) {
    std::array<ValueRange, 4> out;
    add_ranges(t, sample, components_of(attribute), true, out);
    return out;
}

void ValueReference::add_ranges(uint32_t t, cases::SampleId sample, std::span<const QuantityId> ids,
                                bool may_be_outer, std::array<ValueRange, 4>& out) {
    const value::Primitive& primitive = impl_->load(t).primitive;
    if (!primitive.is_finite) {
        return;
    }
    const std::vector<Quantity>& all = impl_->quantities_of(t);
    std::vector<size_t> only;  // the interpolated ones that are asked for
    std::vector<uint32_t> component_of;
    for (const QuantityId& id : ids) {
        const uint32_t component = id.component;
        if (id.is_attribute()) {
            const cases::Attribute& a = primitive.draw->attributes[id.attribute];
            if (component >= a.components) {
                out.at(component) = {true, 0, 0};
                continue;
            }
            if (a.interpolation == cases::Interpolation::flat) {
                const auto v =
                    static_cast<double>(a.values[primitive.triangle.provoking]
                                                [static_cast<glm::vec4::length_type>(component)]);
                out.at(component) = {std::isfinite(v), v, v};
                continue;
            }
        }
        if (const auto z = cases::written_depth(*primitive.draw, sample.x, sample.y);
            z && id.is_depth()) {
            const auto [low, high] =
                value::StoredDepth(*primitive.draw, primitive.depth_format, *z).range();
            out.at(component) = {true, low, high};
            continue;
        }
        const auto found = std::find_if(all.begin(), all.end(), [&](const Quantity& q) {
            return q.id == id && (q.kind == Kind::linear || q.kind == Kind::perspective);
        });
        const auto index = static_cast<size_t>(found - all.begin());
        if (found != all.end() && impl_->is_asked(t, index, impl_->profile)) {
            only.push_back(index);
            component_of.push_back(component);
        }
    }
    if (only.empty()) {
        return;
    }
    value::Asked asked{all, primitive.is_projectable};
    if (may_be_outer) {
        std::vector<ValueRange> outer;
        for (const size_t index : only) {
            if (const auto range = impl_->outer(t, sample, index)) {
                outer.push_back({true, range->low, range->high});
            }
        }
        if (outer.size() == only.size()) {
            for (size_t k = 0; k < only.size(); ++k) {
                out.at(component_of[k]) = outer[k];
            }
            return;
        }
    }
    asked.only = only;
    std::vector<value::AcceptedRange<Ball>> wide;
    impl_->ask_balls(t, impl_->profile, [&](const value::CandidateSet<Ball>& set) {
        wide = value::accepted_ranges(set, impl_->places_of_range(t, sample), asked);
        return std::ranges::all_of(wide, &value::AcceptedRange<Ball>::is_known)
                   ? std::optional(true)
                   : std::nullopt;
    });
    for (size_t k = 0; k < only.size(); ++k) {
        ValueRange& range = out.at(component_of[k]);
        if (wide[k].is_known) {
            range = told(wide[k]);
        } else {
            const auto exact = value::accepted_ranges(
                                   impl_->candidates<mpq_class>(t, impl_->profile),
                                   value::evaluations<mpq_class>(
                                       impl_->fragment(t, sample, impl_->profile), impl_->profile),
                                   asked.of(std::span(only).subspan(k, 1)))
                                   .front();
            range = told(exact);
        }
        range.is_of_places = all[only[k]].id.of == QuantityId::Of::frag_coord &&
                             are_coord_places_single(impl_->places_of_range(t, sample));
        if (range.is_promised && all[only[k]].id.is_depth()) {
            store_depth(value::store_of(impl_->candidates<Ball>(t, impl_->profile), all[only[k]]),
                        primitive.depth_format, range);
        }
    }
}

namespace {

// The exact value of a linear or perspective quantity, and one budget. Rationals have the value;
// its budget, by which nobody is judged, is of Balls where these prove that there is a value.
struct Nominal {
    mpq_class value;
    double budget = 0;
};
std::optional<Nominal> nominal_of(const value::Basis<mpq_class>& basis,
                                  const value::Basis<Ball>& near, const Quantity& q,
                                  const value::Evaluation<mpq_class>& place,
                                  const value::Evaluation<Ball>& near_place, Profile profile) {
    if (near.orientation == 1 || near.orientation == -1) {
        const value::Valued<Ball> v = value::nominal_value(near, q, near_place, profile);
        if (v.exists == Answer::no) {
            return std::nullopt;
        }
        if (v.exists == Answer::yes) {
            return Nominal{value::exact_value(basis, q, place), value::nearest_double(v.budget)};
        }
    }
    const value::Valued<mpq_class> v = value::nominal_value(basis, q, place, profile);
    if (v.exists != Answer::yes) {
        return std::nullopt;
    }
    return Nominal{v.value, v.budget.get_d()};
}

}  // namespace

std::vector<ExpectedValue> ValueReference::expected(uint32_t t, cases::SampleId sample) {
    const value::Primitive& primitive = impl_->load(t).primitive;
    std::vector<ExpectedValue> out;
    if (!primitive.is_finite) {
        return out;
    }
    const std::vector<Quantity>& all = impl_->quantities_of(t);
    const value::Fragment fragment = impl_->fragment(t, sample, impl_->profile);
    const auto places = value::evaluations<mpq_class>(fragment, impl_->profile);
    const value::Evaluation<mpq_class>& place = places.front();
    const auto near_places = value::evaluations<Ball>(fragment, impl_->profile);
    const value::Basis<mpq_class>& basis = impl_->unsnapped_basis<mpq_class>(t);
    const value::Basis<Ball>& near = impl_->unsnapped_basis<Ball>(t);
    for (const Quantity& q : all) {
        ExpectedValue e;
        e.quantity = q.id;
        if (value::is_sample_kind(q.kind) || q.kind == Kind::flat) {
            e.is_flat = true;
            float f = nominal_number(fragment, q);
            if (q.kind == Kind::flat) {
                f = primitive.draw->attributes[q.id.attribute]
                        .values[primitive.triangle.provoking]
                               [static_cast<glm::vec4::length_type>(q.id.component)];
            }
            e.nearest = static_cast<double>(f);
            e.also =
                q.kind == Kind::flat ? std::string() : also_allowed(fragment, q, impl_->profile);
            e.exact = std::isfinite(f) ? mpq_class(e.nearest).get_str() : fmt::format("{}", f);
        } else {
            const auto index = static_cast<size_t>(&q - all.data());
            if (basis.orientation == 0 || !impl_->promises(t)[index].is_number) {
                continue;
            }
            if (q.kind == Kind::probe) {
                value::add_expected_probe(primitive, basis, q,
                                          impl_->probe_place(t, sample, impl_->profile), out);
                continue;
            }
            const std::optional<Nominal> v =
                nominal_of(basis, near, q, place, near_places.front(), impl_->profile);
            if (!v) {
                continue;
            }
            e.exact = v->value.get_str();
            e.nearest = v->value.get_d();
            e.budget = v->budget;
            e.factor = budget_factor(impl_->profile);
            if (q.id.is_depth() && !is_plain_depth(primitive)) {
                const mpq_class stored = nominal_depth(primitive, basis, v->value, impl_->profile);
                e.exact = stored.get_str();
                e.nearest = stored.get_d();
            }
            if (q.id.of == QuantityId::Of::frag_coord) {
                for (const value::OtherCoord& other :
                     value::other_coords(primitive, basis, q, places, impl_->profile)) {
                    e.also += fmt::format("{}or {:.9g} {}", e.also.empty() ? "" : ", ",
                                          other.nearest, other.what);
                }
            }
        }
        out.push_back(std::move(e));
    }
    return out;
}

}  // namespace ref
