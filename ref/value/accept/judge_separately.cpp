// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "ref/value/accept/candidate_reach.hpp"

namespace ref::value {

// A reach only grows with each candidate, and so does what it accepts: ranges are widened, and what
// is free or undefined stays so. (A free depth that has to be clamped accepts the viewport's range
// alone; what any reach of a clamped depth accepts lies in it, too.) What is accepted by some of
// the candidates is accepted by all together, whatever T can tell of the others.
template <class T>
std::optional<std::vector<size_t>> failing_separately(const CandidateSet<T>& set,
                                                      const std::vector<Evaluation<T>>& evaluations,
                                                      const Asked& asked) {
    const std::span<const Quantity> quantities = asked.quantities;
    const bool has_probes = std::any_of(quantities.begin(), quantities.end(),
                                        [](const Quantity& q) { return q.kind == Kind::probe; });
    const auto fit_of = [&](size_t i, const Reach<T>& reach) {
        return fit(reach, asked.got(i), store_of(set, quantities[i])).answer;
    };
    std::vector<bool> is_failing(quantities.size());  // of the quantities that have a plane
    CandidateVerdict probes;
    std::optional<std::vector<size_t>> best;
    bool is_tie = false;
    CandidateScratch<T> scratch;
    const Evaluation<T>* before = nullptr;
    for (const Evaluation<T>& where : evaluations) {
        if (where.one_point || !set.any_of_all) {
            return std::nullopt;
        }
        const Shared<T> shared(asked, std::exchange(before, &where), where);
        std::vector<size_t> open = shared.fresh;
        std::vector<Reach<T>> reaches(quantities.size());
        for (const Candidate<T>& candidate : set.candidates) {
            if (open.empty()) {
                break;
            }
            add_candidate(set, candidate, where, asked.of(open), scratch, reaches);
            std::erase_if(open, [&](size_t i) { return fit_of(i, reaches[i]) == Answer::yes; });
        }
        for (const size_t i : shared.fresh) {
            is_failing[i] = false;
        }
        for (const size_t i : open) {
            if (fit_of(i, reaches[i]) == Answer::unknown) {
                return std::nullopt;
            }
            is_failing[i] = true;
        }
        if (has_probes && shared.has_fresh_probes) {
            probes = {};
            judge_probes(set, std::span(set.candidates), where, asked, probes);
            if (!probes.is_known) {
                return std::nullopt;
            }
        }
        std::vector<size_t> failing;
        for (size_t i = 0; i < quantities.size(); ++i) {
            if (is_failing[i]) {
                failing.push_back(i);
            }
        }
        failing.insert(failing.end(), probes.failing.begin(), probes.failing.end());
        if (failing.empty()) {
            return failing;
        }
        if (!best || failing.size() < best->size()) {
            best = std::move(failing);
            is_tie = false;
        } else if (failing.size() == best->size()) {
            is_tie = is_tie || failing != *best;
        }
    }
    return is_tie ? std::nullopt : best;
}

template std::optional<std::vector<size_t>> failing_separately<Ball>(
    const CandidateSet<Ball>&, const std::vector<Evaluation<Ball>>&, const Asked&);
template std::optional<std::vector<size_t>> failing_separately<mpq_class>(
    const CandidateSet<mpq_class>&, const std::vector<Evaluation<mpq_class>>&, const Asked&);

}  // namespace ref::value
