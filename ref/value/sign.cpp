// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a value is negative, by all that a profile accepts of it (reference.hpp, Sign).
#include <algorithm>
#include <cmath>
#include <optional>

#include "cases/model/sample.hpp"
#include "ref/value/accept/candidate_reach.hpp"
#include "ref/value/set_ups.hpp"

namespace ref {

using cases::kLeastNormal;
using value::Ball;
using value::Kind;
using value::Quantity;

namespace {

// Of a range whose ends T bounds; open if T cannot tell. A number that is no normal one is 0 for a
// device that flushes it, and negative for one that does not.
Sign sign_of(const value::AcceptedRange<mpq_class>& accepted) {
    const auto& [low, high] = accepted.range;
    return accepted.is_free                                        ? Sign::open
           : high <= mpq_class(-static_cast<double>(kLeastNormal)) ? Sign::negative
           : low >= 0                                              ? Sign::not_negative
                                                                   : Sign::open;
}

// Nothing if the Balls cannot tell.
std::optional<Sign> sign_of(const value::AcceptedRange<Ball>& accepted) {
    if (!accepted.is_known) {
        return std::nullopt;
    }
    const auto& [low, high] = accepted.range;
    // A Ball's ends are rounded once more here.
    const double room = 0x1p-50 * (std::fabs(low.v) + low.e + std::fabs(high.v) + high.e);
    constexpr auto kLeast = static_cast<double>(kLeastNormal);
    if (!accepted.is_free && high.v + high.e + room <= -kLeast) {
        return Sign::negative;
    }
    if (!accepted.is_free && low.v - low.e - room >= kLeast) {
        return Sign::not_negative;
    }
    // Of a range that may hold too much, no end is sure to be reached.
    const bool is_open =
        accepted.is_free || (low.v + low.e + room < 0 && high.v - high.e - room > -kLeast);
    return is_open && !accepted.is_outer ? std::optional(Sign::open) : std::nullopt;
}

Sign sign_of(float flat) {
    return !std::isfinite(flat)    ? Sign::open
           : flat <= -kLeastNormal ? Sign::negative
           : flat >= 0             ? Sign::not_negative
                                   : Sign::open;
}

}  // namespace

Sign ValueReference::sign(uint32_t t, cases::SampleId sample, bool exact_only) {
    const value::Primitive& primitive = impl_->load(t).primitive;
    const QuantityId id = QuantityId::of_attribute(primitive.draw->discard_attribute, 0);
    const cases::Attribute& a = primitive.draw->attributes.at(primitive.draw->discard_attribute);
    if (!primitive.is_finite) {
        return Sign::open;
    }
    if (a.interpolation == cases::Interpolation::flat) {
        return sign_of(a.values[primitive.triangle.provoking].x);
    }
    const std::vector<Quantity>& all = impl_->quantities_of(t);
    const auto found = std::find_if(all.begin(), all.end(), [&](const Quantity& q) {
        return q.id == id && (q.kind == Kind::linear || q.kind == Kind::perspective);
    });
    const std::vector<size_t> only{static_cast<size_t>(found - all.begin())};
    if (found == all.end() || !impl_->is_asked(t, only.front(), impl_->profile)) {
        return Sign::open;
    }
    value::Asked asked{all, primitive.is_projectable};
    asked.only = only;
    if (!exact_only) {
        if (const auto outer = impl_->outer(t, sample, only.front())) {
            if (outer->low >= 0) {
                return Sign::not_negative;
            }
            if (outer->high <= -static_cast<double>(kLeastNormal)) {
                return Sign::negative;
            }
        }
        const std::optional<Sign> sign = impl_->ask_balls(
            t, impl_->profile, [&](const value::CandidateSet<Ball>& set) -> std::optional<Sign> {
                const std::optional<Sign> told = sign_of(
                    value::accepted_ranges(set, impl_->places_of_range(t, sample), asked).front());
                // Where Balls cannot tell a corner of a piece from one at the eye they take it for
                // unbounded, and accept more than rationals may.
                const bool may_be_wide =
                    !set.exact && std::ranges::any_of(set.candidates,
                                                      [](const auto& c) { return c.is_unbounded; });
                return told == Sign::open && may_be_wide ? std::nullopt : told;
            });
        if (sign) {
            return *sign;
        }
    }
    return sign_of(value::accepted_ranges(
                       impl_->candidates<mpq_class>(t, impl_->profile),
                       value::evaluations<mpq_class>(
                           impl_->fragment(t, sample, impl_->profile, exact_only), impl_->profile),
                       asked)
                       .front());
}

}  // namespace ref
