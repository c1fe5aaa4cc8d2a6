// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/accept/judge_candidates.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "ref/value/accept/candidate_reach.hpp"
#include "ref/value/accept/one_point.hpp"
#include "ref/value/accept/probe.hpp"

namespace ref::value {

namespace {

// What is kept of one round of candidates.
template <class T>
struct Round {
    std::vector<Reach<T>> reaches;
    std::vector<Fit> fits;
    CandidateVerdict probes;
};

// How many values do not fit, and the largest error in budgets.
struct Score {
    size_t failing = 0;
    WorstError worst;
};

Score score_of(std::span<const Quantity> quantities, std::span<const Fit> fits,
               std::span<const size_t> judged, const CandidateVerdict& probes) {
    Score out{probes.failing.size(), probes.worst};
    for (const size_t i : judged) {
        out.failing += fits[i].answer == Answer::no ? 1U : 0U;
        out.worst.raise(fits[i].ratio, quantities[i]);
    }
    return out;
}

// Fewer failing values, then the smaller ratio.
bool is_better(const Score& a, const CandidateVerdict& than) {
    return a.failing < than.failing.size() ||
           (a.failing == than.failing.size() && a.worst.ratio < than.worst.ratio);
}

CandidateVerdict verdict_of(std::span<const Fit> fits, std::span<const size_t> judged,
                            const CandidateVerdict& probes, const Score& score,
                            ref::BasisKind basis) {
    CandidateVerdict out;
    out.basis = basis;
    out.worst = score.worst;
    for (const size_t i : judged) {
        if (fits[i].answer == Answer::no) {
            out.failing.push_back(i);
            out.ratios.push_back(fits[i].ratio);
        }
    }
    out.failing.insert(out.failing.end(), probes.failing.begin(), probes.failing.end());
    out.ratios.insert(out.ratios.end(), probes.ratios.begin(), probes.ratios.end());
    out.ok = out.failing.empty();
    return out;
}

// The best candidate so far for some of the quantities.
class Best {
  public:
    explicit Best(const Asked& asked) : asked_(asked) {
        for (size_t i = 0; i < asked.quantities.size(); ++i) {
            if (is_judged(asked, i)) {
                judged_.push_back(i);
            }
        }
    }

    bool is_settled() const { return is_settled_; }  // no other candidate is asked any more
    const CandidateVerdict& verdict() const { return best_ ? *best_ : none_; }

    // How candidate `c` of a set fits at an evaluation.
    template <class T>
    void take(const CandidateSet<T>& set, size_t c, const Evaluation<T>& where,
              const Round<T>& round) {
        const auto& [reaches, fits, probes] = round;
        const Score score = score_of(asked_.quantities, fits, judged_, probes);
        if (best_ && score.failing > 0 && !is_better(score, *best_)) {
            return;
        }
        CandidateVerdict verdict = verdict_of(fits, judged_, probes, score, set.candidates[c].name);
        if (verdict.ok && where.one_point) {
            size_t blamed = 0;
            switch (has_one_point(set, c, *where.one_point, asked_, blamed)) {
                case Answer::unknown:
                    settle({false, false, ref::BasisKind::unsnapped, {}, {}, {}});
                    return;
                case Answer::no:
                    verdict.ok = false;
                    verdict.failing.push_back(blamed);
                    verdict.ratios.push_back(std::numeric_limits<double>::infinity());
                    verdict.worst = {std::numeric_limits<double>::infinity(),
                                     asked_.quantities[blamed].id};
                    break;
                case Answer::yes:
                    break;
            }
        }
        if (verdict.ok && verdict.worst.ratio <= 1) {
            settle(std::move(verdict));
        } else if (!best_ || is_better({verdict.failing.size(), verdict.worst}, *best_)) {
            best_ = std::move(verdict);
        }
    }

  private:
    void settle(CandidateVerdict verdict) {
        best_ = std::move(verdict);
        is_settled_ = true;
    }

    Asked asked_;
    std::vector<size_t> judged_;
    CandidateVerdict none_;
    std::optional<CandidateVerdict> best_;
    bool is_settled_ = false;
};

}  // namespace

namespace {

bool has_probes(const Asked& asked) {
    return std::ranges::any_of(asked.quantities,
                               [](const Quantity& q) { return q.kind == Kind::probe; });
}

// How candidate c fits at an evaluation, or all together where each value stands alone; what is not
// fresh stays as it is in the round. False if T cannot tell.
template <class T>
bool judge_round(const CandidateSet<T>& set, size_t c, const Evaluation<T>& where,
                 const Shared<T>& shared, const Asked& asked, CandidateScratch<T>& scratch,
                 Round<T>& round) {
    const std::span<const Quantity> quantities = asked.quantities;
    auto& [reaches, fits, probes] = round;
    reaches.resize(quantities.size());
    fits.resize(quantities.size());
    for (const size_t i : shared.fresh) {
        reaches[i] = {};
    }
    const size_t first = set.any_of_all ? 0 : c;
    const size_t last = set.any_of_all ? set.candidates.size() : c + 1;
    for (size_t k = first; k < last && !shared.fresh.empty(); ++k) {
        add_candidate(set, set.candidates[k], where, asked.of(shared.fresh), scratch, reaches);
    }
    for (const size_t i : shared.fresh) {
        fits[i] = fit(reaches[i], asked.got(i), store_of(set, quantities[i]));
        if (fits[i].answer == Answer::unknown) {
            return false;
        }
    }
    if (has_probes(asked) && shared.has_fresh_probes) {
        probes = {};
        judge_probes(set, std::span(set.candidates).subspan(first, last - first), where, asked,
                     probes);
        if (!probes.is_known) {
            return false;
        }
    }
    return true;
}

}  // namespace

template <class T>
CandidateVerdict judge_candidates(const CandidateSet<T>& set,
                                  const std::vector<Evaluation<T>>& evaluations, const Asked& asked,
                                  std::span<GroupVerdict> groups) {
    const CandidateVerdict unknown{false, false, ref::BasisKind::unsnapped, {}, {}, {}};
    Best all(asked);
    std::vector<Best> parts;
    for (const GroupVerdict& group : groups) {
        parts.emplace_back(asked.of(group.only));
    }
    const size_t rounds = set.any_of_all ? 1 : set.candidates.size();
    // The next evaluation wants what this one leaves.
    std::vector<Round<T>> kept(evaluations.size() > 1 ? rounds : 1);
    CandidateScratch<T> scratch;
    const Evaluation<T>* before = nullptr;
    for (const Evaluation<T>& where : evaluations) {
        const Shared<T> shared(asked, std::exchange(before, &where), where);
        for (size_t c = 0; c < rounds; ++c) {
            // All evaluations of a fragment have one sample: a piece is near in all or in none.
            const Answer near = is_near(set, set.candidates[c], where.sample);
            if (near == Answer::unknown) {
                return unknown;
            }
            if (near == Answer::no) {
                continue;
            }
            Round<T>& round = kept[kept.size() > 1 ? c : 0];
            if (!judge_round(set, c, where, shared, asked, scratch, round)) {
                return unknown;
            }
            all.take(set, c, where, round);
            if (all.is_settled()) {
                return all.verdict();
            }
            for (Best& part : parts) {
                if (!part.is_settled()) {
                    part.take(set, c, where, round);
                }
            }
        }
    }
    for (size_t k = 0; k < parts.size(); ++k) {
        groups[k].verdict = has_probes(asked) ? unknown : parts[k].verdict();
    }
    return all.verdict();
}

template <class T>
AcceptedRange<T> reach_of_depth(const CandidateSet<T>& set, const Quantity& depth,
                                bool is_projectable, const Point<T>& sample) {
    AcceptedRange<T> out;
    const Evaluation<T> where{{sample}, {}, sample, {sample}, {}};
    std::vector<Reach<T>> reaches(1);
    CandidateScratch<T> scratch;
    for (const Candidate<T>& candidate : set.candidates) {
        const Answer near = is_near(set, candidate, sample);
        if (near == Answer::unknown) {
            out.is_known = false;
            return out;
        }
        if (near == Answer::yes) {
            add_candidate(set, candidate, where, Asked{{&depth, 1}, is_projectable}, scratch,
                          reaches);
        }
    }
    const Reach<T>& reach = reaches.front();
    out.is_known = reach.is_known;
    const Range<T>& all = reach.all.range;
    out.is_free = reach.is_free || reach.is_undefined || reach.all.is_first;
    out.range = all;
    if (out.is_free) {
        return out;
    }
    const Range<T> inside = clamped(all, set.depth.viewport);
    if (set.depth.is_clamped) {
        out.range = inside;
    } else if (set.any_of_all) {
        // Undefined as soon as a device's value may lie outside of the viewport's range.
        const Answer low = is_at_most(T(set.depth.viewport.low), all.low);
        const Answer high = is_at_most(all.high, T(set.depth.viewport.high));
        out.is_known = low != Answer::unknown && high != Answer::unknown;
        out.is_free = low != Answer::yes || high != Answer::yes;
    } else {
        out.range = {smaller(inside.low, all.low), larger(inside.high, all.high)};
    }
    return out;
}

template AcceptedRange<Ball> reach_of_depth<Ball>(const CandidateSet<Ball>&, const Quantity&, bool,
                                                  const Point<Ball>&);
template AcceptedRange<mpq_class> reach_of_depth<mpq_class>(const CandidateSet<mpq_class>&,
                                                            const Quantity&, bool,
                                                            const Point<mpq_class>&);
template <class T>
std::vector<AcceptedRange<T>> accepted_ranges(const CandidateSet<T>& set,
                                              const std::vector<Evaluation<T>>& evaluations,
                                              const Asked& asked) {
    std::vector<Reach<T>> reaches(asked.quantities.size());
    bool is_outer = false;
    CandidateScratch<T> scratch;
    for (const Evaluation<T>& where : evaluations) {
        for (const Candidate<T>& candidate : set.candidates) {
            // A piece that may be near counts: the range is an upper bound.
            const Answer near = is_near(set, candidate, where.sample);
            is_outer = is_outer || near == Answer::unknown;
            if (near != Answer::no) {
                add_candidate(set, candidate, where, asked, scratch, reaches);
            }
        }
    }
    std::vector<AcceptedRange<T>> out;
    for (const size_t index : asked.only) {
        const Reach<T>& reach = reaches[index];
        out.push_back({reach.is_known, reach.is_free || reach.is_undefined || reach.all.is_first,
                       reach.all.range, std::nullopt, is_outer});
        if (!reach.biased.is_first) {
            out.back().biased = reach.biased.range;
        }
    }
    return out;
}

CandidateVerdict verdict_of_both(const CandidateVerdict& a, const CandidateVerdict& b) {
    CandidateVerdict both = a.worst.ratio > b.worst.ratio ? a : b;
    both.is_known = a.is_known && b.is_known;
    both.ok = a.ok && b.ok;
    both.basis = b.basis;
    std::vector<std::pair<size_t, double>> failing;
    for (const CandidateVerdict* part : {&a, &b}) {
        for (size_t k = 0; k < part->failing.size(); ++k) {
            failing.emplace_back(part->failing[k], part->ratios[k]);
        }
    }
    std::sort(failing.begin(), failing.end());
    both.failing.clear();
    both.ratios.clear();
    for (const auto& [index, ratio] : failing) {
        both.failing.push_back(index);
        both.ratios.push_back(ratio);
    }
    return both;
}

template std::vector<AcceptedRange<Ball>> accepted_ranges<Ball>(
    const CandidateSet<Ball>&, const std::vector<Evaluation<Ball>>&, const Asked&);
template std::vector<AcceptedRange<mpq_class>> accepted_ranges<mpq_class>(
    const CandidateSet<mpq_class>&, const std::vector<Evaluation<mpq_class>>&, const Asked&);
template CandidateVerdict judge_candidates<Ball>(const CandidateSet<Ball>&,
                                                 const std::vector<Evaluation<Ball>>&, const Asked&,
                                                 std::span<GroupVerdict>);
template CandidateVerdict judge_candidates<mpq_class>(const CandidateSet<mpq_class>&,
                                                      const std::vector<Evaluation<mpq_class>>&,
                                                      const Asked&, std::span<GroupVerdict>);

}  // namespace ref::value
