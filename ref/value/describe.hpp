// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Tells what the reference expects, as numbers and words for reports. No verdict rests on it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ref/value/accept/judge_candidates.hpp"
#include "ref/value/accept/probe.hpp"
#include "ref/value/reference.hpp"

namespace ref::value {

// A linear or perspective value at its first place, and what the profile accepts around it.
template <class T>
Valued<T> nominal_value(const Basis<T>& basis, const Quantity& q, const Evaluation<T>& place,
                        cases::Profile profile);

// The value alone, where it is known that there is one.
mpq_class exact_value(const Basis<mpq_class>& basis, const Quantity& q,
                      const Evaluation<mpq_class>& place);

// "0.333333333 = 1/3"; without the fraction if it says no more, or is too long to be read.
std::string number_text(double nearest, const std::optional<mpq_class>& exact);

// What a probe is expected to be: the number of the likeliest quad, and what it is made of.
std::string probe_text(const Basis<mpq_class>& basis, const Quantity& q, const ProbePlace& place);

// What else FragCoord.z or w may be near, besides its value at the first place: its values at the
// other single places of a profile that has nothing between them, and z with the bias. Each ends
// with what it is: {0.4375, "with the bias"}, {0.375, "at a sample"}.
struct OtherCoord {
    double nearest = 0;
    std::string what;
};
std::vector<OtherCoord> other_coords(const Primitive& primitive, const Basis<mpq_class>& basis,
                                     const Quantity& q,
                                     std::span<const Evaluation<mpq_class>> places,
                                     cases::Profile profile);

// Whether a barycentric component holds what another component of the attribute ought to.
template <class T>
Answer is_other_vertex(const Basis<T>& basis, const Quantity& q, std::span<const Quantity> all,
                       const Evaluation<T>& place, cases::Profile profile, double device);

// Appends the expected value of a probe; of a derivative also Brown's partials
// (ref/value/fragment/partials.hpp), called "partial x of attribute 0.x", "total differential of
// ...".
void add_expected_probe(const Primitive& primitive, const Basis<mpq_class>& basis,
                        const Quantity& q, const ProbePlace& place,
                        std::vector<ExpectedValue>& out);

}  // namespace ref::value
