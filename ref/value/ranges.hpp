// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The interval of a value that a profile allows.
#pragma once

#include <array>
#include <span>

#include "ref/value/reference.hpp"
#include "ref/value/set_ups.hpp"

namespace ref::value {

// What some quantities of a fragment may be, by component; nothing is promised of the others.
// `may_be_outer`: ranges that hold those are enough.
std::array<ValueRange, 4> ranges_of(SetUps& set_ups, uint32_t t, cases::SampleId sample,
                                    std::span<const QuantityId> ids, bool may_be_outer);

}  // namespace ref::value
