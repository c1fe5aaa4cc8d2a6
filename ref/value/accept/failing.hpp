// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which quantities fail of judge_candidates(), in less time: the ratios are left out.
#pragma once

#include <optional>
#include <vector>

#include "ref/value/accept/judge_candidates.hpp"

namespace ref::value {

// The failing quantities of judge_candidates() alone, for a set with any_of_all: without the ratios
// most values are accepted by the first candidate. Nothing if only ratios tell which evaluation is
// best, or T does not know.
template <class T>
std::optional<std::vector<size_t>> failing_separately(const CandidateSet<T>& set,
                                                      const std::vector<Evaluation<T>>& evaluations,
                                                      const Asked& asked);

// The same for a set where one candidate has to explain all values, and without probes: where what
// fails under one candidate fails under another, too, that one is no better, whatever else is.
// Nothing if only ratios tell which candidate is best, or T does not know.
template <class T>
std::optional<std::vector<size_t>> failing_together(const CandidateSet<T>& set,
                                                    const std::vector<Evaluation<T>>& evaluations,
                                                    const Asked& asked);

}  // namespace ref::value
