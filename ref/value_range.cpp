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

#include "ref/sample_values.hpp"
#include "ref/value_describe.hpp"
#include "ref/value_reference.hpp"

namespace ref {

using cases::Profile;
using value::Answer;
using value::Ball;
using value::is_plain_depth;
using value::Kind;
using value::nominal_depth;
using value::Quantity;

ValueRange ValueReference::range(uint32_t t, SampleId sample, int32_t attribute,
                                 uint32_t component) {
    const value::Primitive& primitive = impl_->load(t).primitive;
    if (!primitive.is_finite) {
        return {};
    }
    if (attribute >= 0) {
        const cases::Attribute& a = primitive.draw->attributes[static_cast<size_t>(attribute)];
        if (component >= a.components) {
            return {true, 0, 0};
        }
        if (a.interpolation == cases::Interpolation::flat) {
            const auto v =
                static_cast<double>(a.values[primitive.triangle.provoking]
                                            [static_cast<glm::vec4::length_type>(component)]);
            return {std::isfinite(v), v, v};
        }
    }
    const std::vector<Quantity>& all = impl_->quantities_of(t);
    const auto found = std::find_if(all.begin(), all.end(), [&](const Quantity& q) {
        return q.attribute == attribute && q.component == component &&
               (q.kind == Kind::linear || q.kind == Kind::perspective);
    });
    const auto index = static_cast<size_t>(found - all.begin());
    if (found == all.end() || !impl_->is_asked(t, index, impl_->profile)) {
        return {};
    }
    const std::span<const Quantity> span(all);
    const auto& balls = impl_->balls.get(t, impl_->profile, [&] {
        return value::make_wide_set<Ball>(primitive, span, impl_->limits, impl_->profile);
    });
    ValueRange out;
    value::WideRange<Ball> range;
    range.is_known = false;
    if (balls.is_known) {
        range = value::range_wide(balls, span, primitive.is_projectable,
                                  impl_->places_of_range(t, sample), index);
    }
    if (range.is_known) {
        out = {!range.is_free, range.range.low.v - range.range.low.e,
               range.range.high.v + range.range.high.e};
    } else {
        const auto& exact = impl_->rationals.get(t, impl_->profile, [&] {
            return value::make_wide_set<mpq_class>(primitive, span, impl_->limits, impl_->profile);
        });
        const auto wide =
            value::range_wide(exact, span, primitive.is_projectable,
                              value::evaluations<mpq_class>(
                                  impl_->fragment(t, sample, impl_->profile), impl_->profile),
                              index);
        out = {!wide.is_free, wide.range.low.get_d(), wide.range.high.get_d()};
    }
    // Outwards: a subtraction rounds by half an ulp, get_d truncates by less than one.
    out.low = std::nextafter(std::nextafter(out.low, -HUGE_VAL), -HUGE_VAL);
    out.high = std::nextafter(std::nextafter(out.high, HUGE_VAL), HUGE_VAL);
    out.is_promised = out.is_promised && std::isfinite(out.low) && std::isfinite(out.high);
    return out;
}

std::vector<ExpectedValue> ValueReference::expected(uint32_t t, SampleId sample) {
    const value::Primitive& primitive = impl_->load(t).primitive;
    std::vector<ExpectedValue> out;
    if (!primitive.is_finite) {
        return out;
    }
    const std::vector<Quantity>& all = impl_->quantities_of(t);
    const value::Fragment fragment = impl_->fragment(t, sample, impl_->profile);
    const auto place = value::evaluations<mpq_class>(fragment, impl_->profile).front();
    const value::Basis<mpq_class>& basis = impl_->exact_basis(t);
    for (const Quantity& q : all) {
        ExpectedValue e;
        e.quantity = q.name;
        if (value::is_sample_kind(q.kind) || q.kind == Kind::flat) {
            e.is_flat = true;
            float f = nominal_number(fragment, q);
            if (q.kind == Kind::flat) {
                f = primitive.draw->attributes[static_cast<size_t>(q.attribute)]
                        .values[primitive.triangle.provoking]
                               [static_cast<glm::vec4::length_type>(q.component)];
            }
            e.nearest = static_cast<double>(f);
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
            const auto v = value::exact_value(basis, q, place);
            if (v.exists != Answer::yes) {
                continue;
            }
            e.exact = v.value.get_str();
            e.nearest = v.value.get_d();
            e.budget = v.budget.get_d();
            if (q.attribute == -2 && !is_plain_depth(primitive)) {
                e.nearest = nominal_depth(primitive, basis, e.nearest, impl_->profile);
            }
        }
        out.push_back(std::move(e));
    }
    return out;
}

}  // namespace ref
