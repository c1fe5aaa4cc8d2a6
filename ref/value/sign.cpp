// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/sign.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cases/model/sample.hpp"
#include "ref/value/accept/candidate_reach.hpp"

namespace ref::value {

using cases::kLeastNormal;

namespace {

// Of a range whose ends T bounds; open if T cannot tell. A number that is no normal one is 0 for a
// device that flushes it, and negative for one that does not.
Sign sign_of(const AcceptedRange<mpq_class>& accepted) {
    const auto& [low, high] = accepted.range;
    return accepted.is_free                                        ? Sign::open
           : high <= mpq_class(-static_cast<double>(kLeastNormal)) ? Sign::negative
           : low >= 0                                              ? Sign::not_negative
                                                                   : Sign::open;
}

// Nothing if the Balls cannot tell.
std::optional<Sign> sign_of(const AcceptedRange<Ball>& accepted) {
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

Sign sign_of(SetUps& set_ups, uint32_t t, cases::SampleId sample, bool exact_only) {
    const Primitive& primitive = set_ups.primitive(t);
    const QuantityId id = QuantityId::of_attribute(primitive.draw->discard_attribute, 0);
    if (!primitive.is_finite) {
        return Sign::open;
    }
    if (primitive.draw->attributes.at(id.attribute).interpolation == cases::Interpolation::flat) {
        return sign_of(provoking_value(primitive, id));
    }
    const std::optional<size_t> index = set_ups.asked_plane(t, id);
    if (!index) {
        return Sign::open;
    }
    const cases::Profile profile = set_ups.profile();
    const Asked asked{
        set_ups.quantities_of(t), primitive.is_projectable, nullptr, nullptr, {&*index, 1}};
    if (!exact_only) {
        const auto outer =
            set_ups.bounds(t, profile).outer(set_ups.kept_places(t, sample), asked, *index);
        if (outer && outer->low >= 0) {
            return Sign::not_negative;
        }
        if (outer && outer->high <= -static_cast<double>(kLeastNormal)) {
            return Sign::negative;
        }
        const std::optional<Sign> sign = set_ups.ask_balls(
            t, profile, [&](const CandidateSet<Ball>& set) -> std::optional<Sign> {
                const std::optional<Sign> told =
                    sign_of(accepted_ranges(set, set_ups.kept_places(t, sample), asked).front());
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
    return sign_of(accepted_ranges(set_ups.candidates<mpq_class>(t, profile),
                                   set_ups.places<mpq_class>(t, sample, profile, exact_only), asked)
                       .front());
}

}  // namespace ref::value
