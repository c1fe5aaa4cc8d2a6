// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Errors that hold in a part of the pictures only.
#pragma once

#include <span>
#include <vector>

#include "diagnosis/hypothesis.hpp"
#include "diagnosis/tally.hpp"

namespace diagnosis {

// Finds conditions (condition.hpp) under which a hypothesis fails as the device did: it explains
// the subject `seed` and some other, fails otherwise in no subject, and has no case fail that
// passed. This is stricter than for an error without a condition, since there are many conditions.
// Of those of one kind the narrowest is kept.
std::vector<Tally> partial_tallies(const Hypothesis& hypothesis, size_t number,
                                   std::span<const Subject> subjects, size_t seed,
                                   std::span<const Subject* const> passed);

}  // namespace diagnosis
