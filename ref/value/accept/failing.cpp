// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/accept/failing.hpp"

#include <algorithm>
#include <utility>

#include "ref/value/accept/candidate_reach.hpp"
#include "ref/value/accept/one_point.hpp"

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

namespace {

// What fails under one candidate or another, as long as T can tell.
template <class T>
class Together {
  public:
    Together(const CandidateSet<T>& set, const Asked& asked, std::vector<size_t> judged)
        : set_(set),
          asked_(asked),
          judged_(std::move(judged)),
          is_known_(set.candidates.size(), false),
          reaches_(asked.quantities.size()) {}

    std::optional<std::vector<size_t>> run(const std::vector<Evaluation<T>>& evaluations) {
        const Evaluation<T>* before = nullptr;
        for (const Evaluation<T>& where : evaluations) {
            const Shared<T> shared(asked_, std::exchange(before, &where), where);
            for (size_t c = 0; c < set_.candidates.size(); ++c) {
                const Answer near = is_near(set_, set_.candidates[c], where.sample);
                if (near == Answer::unknown ||
                    (near == Answer::yes && !take(c, where, shared.fresh))) {
                    return std::nullopt;
                }
                if (is_explained_) {
                    return std::vector<size_t>();
                }
            }
        }
        return is_tie_ ? std::nullopt : std::optional(best_);
    }

  private:
    // What fails of `which` under a candidate.
    std::optional<std::vector<size_t>> failing_of(const Candidate<T>& candidate,
                                                  const Evaluation<T>& where,
                                                  std::span<const size_t> which) {
        for (const size_t i : which) {
            reaches_[i] = {};
        }
        add_candidate(set_, candidate, where, asked_.of(which), scratch_, reaches_);
        std::vector<size_t> failing;
        for (const size_t i : which) {
            const Store store = store_of(set_, asked_.quantities[i]);
            const Answer answer = fit(reaches_[i], asked_.got(i), store).answer;
            if (answer == Answer::unknown) {
                return std::nullopt;
            }
            if (answer == Answer::no) {
                failing.push_back(i);
            }
        }
        return failing;
    }

    // False if T cannot tell. `fresh`: what is evaluated elsewhere than at the last evaluation.
    bool take(size_t c, const Evaluation<T>& where, const std::vector<size_t>& fresh) {
        const Candidate<T>& candidate = set_.candidates[c];
        if (!best_.empty()) {
            const bool is_moved = std::ranges::any_of(
                best_, [&](size_t i) { return std::ranges::find(fresh, i) != fresh.end(); });
            if (is_moved || !is_known_[c]) {
                const auto still = failing_of(candidate, where, best_);
                if (!still) {
                    return false;
                }
                is_known_[c] = still->size() == best_.size();
            }
            if (is_known_[c]) {
                return true;
            }
        }
        std::optional<std::vector<size_t>> failing = failing_of(candidate, where, judged_);
        if (!failing) {
            return false;
        }
        const bool is_each_explained = failing->empty();
        if (is_each_explained && where.one_point) {
            size_t blamed = 0;
            const Answer one = has_one_point(set_, c, *where.one_point, asked_, blamed);
            if (one == Answer::unknown) {
                return false;
            }
            if (one == Answer::no) {
                failing->push_back(blamed);
            }
        }
        is_explained_ = failing->empty();
        if (best_.empty() || failing->size() < best_.size()) {
            best_ = *std::move(failing);
            is_tie_ = false;
            is_known_.assign(is_known_.size(), false);
            is_known_[c] = !is_each_explained;
        } else if (failing->size() == best_.size()) {
            is_tie_ = is_tie_ || *failing != best_;
        }
        return true;
    }

    const CandidateSet<T>& set_;
    Asked asked_;
    std::vector<size_t> judged_;
    std::vector<size_t> best_;  // fails under a candidate; of all that fail under one, the fewest
    bool is_tie_ = false;
    bool is_explained_ = false;  // one candidate explains everything
    // Whether all of the best has failed under a candidate where the last evaluation has it.
    std::vector<bool> is_known_;
    CandidateScratch<T> scratch_;
    std::vector<Reach<T>> reaches_;
};

}  // namespace

template <class T>
std::optional<std::vector<size_t>> failing_together(const CandidateSet<T>& set,
                                                    const std::vector<Evaluation<T>>& evaluations,
                                                    const Asked& asked) {
    std::vector<size_t> judged;
    for (size_t i = 0; i < asked.quantities.size(); ++i) {
        if (asked.quantities[i].kind == Kind::probe || set.any_of_all) {
            return std::nullopt;
        }
        if (is_judged(asked, i)) {
            judged.push_back(i);
        }
    }
    return judged.empty() ? judged : Together<T>(set, asked, judged).run(evaluations);
}

template std::optional<std::vector<size_t>> failing_separately<Ball>(
    const CandidateSet<Ball>&, const std::vector<Evaluation<Ball>>&, const Asked&);
template std::optional<std::vector<size_t>> failing_separately<mpq_class>(
    const CandidateSet<mpq_class>&, const std::vector<Evaluation<mpq_class>>&, const Asked&);

template std::optional<std::vector<size_t>> failing_together<Ball>(
    const CandidateSet<Ball>&, const std::vector<Evaluation<Ball>>&, const Asked&);
template std::optional<std::vector<size_t>> failing_together<mpq_class>(
    const CandidateSet<mpq_class>&, const std::vector<Evaluation<mpq_class>>&, const Asked&);

}  // namespace ref::value
