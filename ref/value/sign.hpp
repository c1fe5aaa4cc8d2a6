// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a value is negative, by all that a profile accepts of it (reference.hpp, Sign).
#pragma once

#include "ref/value/reference.hpp"
#include "ref/value/set_ups.hpp"

namespace ref::value {

// As ValueReference::sign().
Sign sign_of(SetUps& set_ups, uint32_t t, cases::SampleId sample, bool exact_only);

}  // namespace ref::value
