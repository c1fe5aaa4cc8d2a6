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
// the subject `seed` and one of another file or three more, fails otherwise in no subject, and has
// no case fail that passed. This is stricter than for an error without a condition, since there are
// many conditions. The condition has to be needed, too: without it something would be wrong that
// the device drew right. And no subject may be wrong as the error has it where the condition does
// not hold. Of those of one kind the narrowest is kept. What is drawn is added to `work`
// (diagnosis/work.hpp).
std::vector<Tally> partial_tallies(const Hypothesis& hypothesis, size_t number,
                                   std::span<const Subject> subjects, size_t seed,
                                   std::span<const Subject* const> passed, uint64_t& work);

// Whether some of these failed cases are wrong as the error has it, though the condition holds
// nowhere in them.
bool is_contradicted(const Hypothesis& hypothesis, const Condition& condition,
                     std::span<const Subject> failed);

}  // namespace diagnosis
