// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Tells what the reference expects, as numbers and words for reports. No verdict rests on it.
#pragma once

#include <string>
#include <vector>

#include "ref/value/reference.hpp"
#include "ref/value/set_ups.hpp"

namespace ref::value {

// A linear or perspective value at its first place, and what the profile accepts around it.
template <class T>
Valued<T> nominal_value(const Basis<T>& basis, const Quantity& q, const Evaluation<T>& place,
                        cases::Profile profile);

// Whether a barycentric component holds what another component of the attribute ought to.
template <class T>
Answer is_other_vertex(const Basis<T>& basis, const Quantity& q, std::span<const Quantity> all,
                       const Evaluation<T>& place, cases::Profile profile, double device);

// What a linear or perspective quantity, or a probe, is expected to be.
std::string expected_text(SetUps& set_ups, uint32_t t, cases::SampleId id, const Quantity& q);

// As ValueReference::expected(). A derivative is followed by Brown's partials
// (ref/value/fragment/partials.hpp), called "partial x of attribute 0.x", "total differential of
// ...".
std::vector<ExpectedValue> expected_values(SetUps& set_ups, uint32_t t, cases::SampleId sample);

}  // namespace ref::value
