// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cases/case.hpp"
#include "cases/profile.hpp"
#include "ref/limits.hpp"
#include "ref/value.hpp"

namespace cli {

// The story of one sample in exact arithmetic, for a terminal: where the sample lies, for every
// triangle near it the snapped vertices (pixels), the three edge functions (square pixels), the tie
// rule, the class under the profile, how many hits are allowed, and the exact values there. Needs
// no device.
std::string explain_text(const cases::Case& c, const ref::Limits& limits, cases::Profile profile,
                         ref::SampleId sample);

}  // namespace cli
