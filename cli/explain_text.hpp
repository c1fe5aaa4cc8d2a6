// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/rule.hpp"
#include "ref/position/limits.hpp"
#include "ref/value/reference.hpp"

namespace cli {

// The story of one sample in exact arithmetic, for a terminal: where the sample lies, for every
// triangle near it the snapped vertices (pixels), the three edge functions (square pixels), the tie
// rule, the class under the profile, how many hits are allowed, and the exact values there. Needs
// no device.
std::string explain_text(const cases::Case& c, const ref::Limits& limits, cases::Profile profile,
                         cases::SampleId sample);

// The same of a case as a whole, which has no blit: how many samples must be covered, and what its
// queries have to give.
std::string explain_text(const cases::Case& c, const ref::Limits& limits, cases::Profile profile);

// A rule as docs/rules.md tells it: title, profile, text, anchors, code, and the cases that name it
// (their ids, without matrix parts).
std::string rule_text(const cases::Rule& rule, const std::vector<cases::Case>& suite);

}  // namespace cli
