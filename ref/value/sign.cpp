// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/sign.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cases/model/sample.hpp"
#include "cases/model/texels.hpp"
#include "ref/value/accept/candidate_reach.hpp"
#include "ref/value/texel.hpp"

namespace ref::value {

using cases::kLeastNormal;

namespace {

// From which number on a value is not negative, and up to which it is.
struct Ends {
    double not_negative, negative;
};

// A number that is no normal one is 0 for a device that flushes it, and negative for one that does
// not. A mask is read at the value plus 1/2, and tells whether that lies in its left half: the sum
// is off by 2^-25 at most where it is near 1/2.
Ends ends_of(const cases::Draw& draw, cases::Profile profile) {
    if (draw.color.from == cases::ColorFrom::mask) {
        const double off = texel_step(profile) / cases::kMaskColumns + 0x1p-25;
        return {off, -off};
    }
    return {0, -static_cast<double>(kLeastNormal)};
}

// Of a range whose ends T bounds; open if T cannot tell.
Sign sign_of(const AcceptedRange<mpq_class>& accepted, const Ends& ends) {
    const auto& [low, high] = accepted.range;
    return accepted.is_free                      ? Sign::open
           : high <= mpq_class(ends.negative)    ? Sign::negative
           : low >= mpq_class(ends.not_negative) ? Sign::not_negative
                                                 : Sign::open;
}

// Nothing if the Balls cannot tell.
std::optional<Sign> sign_of(const AcceptedRange<Ball>& accepted, const Ends& ends) {
    if (!accepted.is_known) {
        return std::nullopt;
    }
    const auto& [low, high] = accepted.range;
    // A Ball's ends are rounded once more here.
    const double room = 0x1p-50 * (std::fabs(low.v) + low.e + std::fabs(high.v) + high.e);
    if (!accepted.is_free && high.v + high.e + room <= ends.negative) {
        return Sign::negative;
    }
    constexpr auto kLeast = static_cast<double>(kLeastNormal);
    if (!accepted.is_free && low.v - low.e - room >= std::max(ends.not_negative, kLeast)) {
        return Sign::not_negative;
    }
    // Of a range that may hold too much, no end is sure to be reached.
    const bool is_open = accepted.is_free || (low.v + low.e + room < ends.not_negative &&
                                              high.v - high.e - room > ends.negative);
    return is_open && !accepted.is_outer ? std::optional(Sign::open) : std::nullopt;
}

Sign sign_of(float flat, const Ends& ends) {
    const auto v = static_cast<double>(flat);
    return !std::isfinite(v)        ? Sign::open
           : v <= ends.negative     ? Sign::negative
           : v >= ends.not_negative ? Sign::not_negative
                                    : Sign::open;
}

}  // namespace

Sign sign_of(SetUps& set_ups, uint32_t t, cases::SampleId sample, bool exact_only) {
    const Primitive& primitive = set_ups.primitive(t);
    const QuantityId id = QuantityId::of_attribute(primitive.draw->discard_attribute, 0);
    if (!primitive.is_finite) {
        return Sign::open;
    }
    const Ends ends = ends_of(*primitive.draw, set_ups.profile());
    if (primitive.draw->attributes.at(id.attribute).interpolation == cases::Interpolation::flat) {
        return sign_of(provoking_value(primitive, id), ends);
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
        if (outer && outer->low >= ends.not_negative) {
            return Sign::not_negative;
        }
        if (outer && outer->high <= ends.negative) {
            return Sign::negative;
        }
        const std::optional<Sign> sign = set_ups.ask_balls(
            t, profile, [&](const CandidateSet<Ball>& set) -> std::optional<Sign> {
                const std::optional<Sign> told = sign_of(
                    accepted_ranges(set, set_ups.kept_places(t, sample), asked).front(), ends);
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
                       .front(),
                   ends);
}

}  // namespace ref::value
