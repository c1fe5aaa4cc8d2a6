// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which failures are of one cause.
#pragma once

#include "fuzz/cause.hpp"
#include "fuzz/entry.hpp"

namespace fuzz {

// Whether an entry explains that a case of these facts shows a symptom.
bool explains(const Entry& entry, const Symptom& symptom, const Facts& facts);

// Whether a fresh entry tells the cause of an earlier one again: if it needs the same to show a
// like failure. A known cause that turns out graver is news.
bool is_same_cause(const Entry& earlier, const Entry& fresh);
// Adds a fresh entry to an earlier one of the same cause, of which the graver case is kept.
void merge(Entry& earlier, Entry fresh);

}  // namespace fuzz
