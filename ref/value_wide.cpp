// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value_wide.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ref/one_point.hpp"
#include "ref/value_probe.hpp"
#include "ref/value_reach_of.hpp"

namespace ref::value {

namespace {

// What is kept of one round of candidates.
template <class T>
struct Round {
    std::vector<Reach<T>> reaches;
    WideVerdict probes;
};

// The numeric inputs that are evaluated at one place with each other.
std::vector<size_t> inputs_at(std::span<const Quantity> quantities, std::span<const size_t> only,
                              bool at_centroid) {
    std::vector<size_t> out;
    for (size_t i = 0; i < quantities.size(); ++i) {
        const Quantity& q = quantities[i];
        if (is_judged(q, i, only) && q.attribute >= 0 && !q.at_sample &&
            q.at_centroid == at_centroid) {
            out.push_back(i);
        }
    }
    return out;
}

// Whether one place explains all inputs that are decorated alike. Each of them alone has been
// found to fit somewhere; with a single one that is enough.
Answer has_one_point(const WideSet<Ball>&, const Candidate<Ball>&, std::span<const Quantity> all,
                     const Evaluation<Ball>&, const FragmentValues&, std::span<const size_t> only,
                     size_t&) {
    const bool is_single =
        inputs_at(all, only, false).size() < 2 && inputs_at(all, only, true).size() < 2;
    return is_single ? Answer::yes : Answer::unknown;  // polygons are cut in rationals
}

Answer has_one_point(const WideSet<mpq_class>& set, const Candidate<mpq_class>& candidate,
                     std::span<const Quantity> all, const Evaluation<mpq_class>& where,
                     const FragmentValues& device, std::span<const size_t> only, size_t& blamed) {
    if (candidate.bases.size() != 1 || candidate.is_unbounded) {
        return Answer::yes;  // anywhere between several planes: each value alone
    }
    for (const bool at_centroid : {false, true}) {
        const std::vector<size_t> which = inputs_at(all, only, at_centroid);
        if (which.size() < 2) {
            continue;
        }
        const auto wrong =
            first_unexplained(candidate.bases.front(), set.factor,
                              at_centroid ? where.centroid : where.attributes, all, which, device);
        if (wrong) {
            blamed = *wrong;
            return Answer::no;
        }
    }
    return Answer::yes;
}

// Keeps the verdict with fewer failing values, then with the smaller ratio.
void keep_better(WideVerdict& best, WideVerdict&& next, bool is_first) {
    const bool better =
        is_first || next.failing.size() < best.failing.size() ||
        (next.failing.size() == best.failing.size() && next.worst_ratio < best.worst_ratio);
    if (better) {
        best = std::move(next);
    }
}

template <class T>
void judge_value(const Reach<T>& reach, size_t index, double device, const Store& store,
                 WideVerdict& verdict) {
    const Fit f = fit(reach, device, store);
    if (f.answer == Answer::unknown) {
        verdict.is_known = false;
        return;
    }
    verdict.worst_ratio = std::max(verdict.worst_ratio, f.ratio);
    if (f.answer == Answer::no) {
        verdict.failing.push_back(index);
        verdict.ratios.push_back(f.ratio);
    }
}

// Adds what the probes fail.
void append(const WideVerdict& probes, WideVerdict& verdict) {
    verdict.is_known = verdict.is_known && probes.is_known;
    verdict.failing.insert(verdict.failing.end(), probes.failing.begin(), probes.failing.end());
    verdict.ratios.insert(verdict.ratios.end(), probes.ratios.begin(), probes.ratios.end());
    verdict.worst_ratio = std::max(verdict.worst_ratio, probes.worst_ratio);
}

}  // namespace

template <class T>
WideVerdict judge_wide(const WideSet<T>& set, std::span<const Quantity> quantities,
                       bool is_projectable, const std::vector<Evaluation<T>>& evaluations,
                       const ProbePlace& place, const FragmentValues& device,
                       std::span<const size_t> only) {
    const bool has_probes = std::any_of(quantities.begin(), quantities.end(),
                                        [](const Quantity& q) { return q.kind == Kind::probe; });
    WideVerdict best;
    bool is_first = true;
    const size_t rounds = set.any_of_all ? 1 : set.candidates.size();
    std::vector<Round<T>> kept(rounds);
    const Evaluation<T>* before = nullptr;
    for (const Evaluation<T>& where : evaluations) {
        const Shared<T> shared(quantities, only, std::exchange(before, &where), where);
        for (size_t c = 0; c < rounds; ++c) {
            WideVerdict verdict;
            verdict.basis = set.candidates[c].name;
            if (set.candidates[c].is_piece) {
                const Answer near =
                    is_near(set.candidates[c].bases.front(), where.sample, set.margin);
                if (near == Answer::unknown) {
                    return {false, false, verdict.basis, 0, {}, {}};
                }
                if (near == Answer::no) {
                    continue;
                }
            }
            std::vector<Reach<T>>& reaches = kept[c].reaches;
            reaches.resize(quantities.size());
            for (const size_t i : shared.fresh) {
                reaches[i] = {};
            }
            const size_t first = set.any_of_all ? 0 : c;
            const size_t last = set.any_of_all ? set.candidates.size() : c + 1;
            for (size_t k = first; k < last && !shared.fresh.empty(); ++k) {
                add_candidate(set, set.candidates[k], quantities, is_projectable, where,
                              std::span<const size_t>(shared.fresh), device, reaches);
            }
            for (size_t i = 0; i < quantities.size(); ++i) {
                if (!is_judged(quantities[i], i, only)) {
                    continue;
                }
                judge_value(reaches[i], i, static_cast<double>(quantities[i].get(device)),
                            store_of(set, quantities[i]), verdict);
                if (!verdict.is_known) {
                    return verdict;
                }
            }
            if (has_probes) {
                WideVerdict& probes = kept[c].probes;
                if (shared.has_fresh_probes) {
                    probes = {};
                    judge_probes(set, std::span(set.candidates).subspan(first, last - first),
                                 quantities, is_projectable, where, place, device, only, probes);
                }
                append(probes, verdict);
                if (!verdict.is_known) {
                    return verdict;
                }
            }
            verdict.ok = verdict.failing.empty();
            if (verdict.ok && where.is_one_point) {
                size_t blamed = 0;
                switch (has_one_point(set, set.candidates[c], quantities, where, device, only,
                                      blamed)) {
                    case Answer::unknown:
                        return {false, false, verdict.basis, 0, {}, {}};
                    case Answer::no:
                        verdict.ok = false;
                        verdict.failing.push_back(blamed);
                        verdict.ratios.push_back(std::numeric_limits<double>::infinity());
                        verdict.worst_ratio = std::numeric_limits<double>::infinity();
                        break;
                    case Answer::yes:
                        break;
                }
            }
            if (verdict.ok && verdict.worst_ratio <= 1) {
                return verdict;
            }
            keep_better(best, std::move(verdict), is_first);
            is_first = false;
        }
    }
    return best;
}

template <class T>
DepthReach<T> reach_of_depth(const WideSet<T>& set, const Quantity& depth, bool is_projectable,
                             const Point<T>& sample) {
    DepthReach<T> out;
    const Evaluation<T> where{{sample}, {}, sample, {sample}, false};
    const FragmentValues none;
    std::vector<Reach<T>> reaches(1);
    for (const Candidate<T>& candidate : set.candidates) {
        if (candidate.is_piece) {
            const Answer near = is_near(candidate.bases.front(), sample, set.margin);
            if (near == Answer::unknown) {
                out.is_known = false;
                return out;
            }
            if (near == Answer::no) {
                continue;
            }
        }
        add_candidate(set, candidate, {&depth, 1}, is_projectable, where, {}, none, reaches);
    }
    const Reach<T>& reach = reaches.front();
    out.is_known = reach.is_known;
    out.is_free = reach.is_free || reach.is_undefined || reach.is_first;
    out.range = reach.range;
    if (out.is_free) {
        return out;
    }
    const Range<T> inside = clamped(reach.range, set.depth.viewport);
    if (set.depth.is_clamped) {
        out.range = inside;
    } else if (set.any_of_all) {
        // Undefined as soon as a device's value may lie outside of the viewport's range.
        const Answer low = is_at_most(T(set.depth.viewport.low), reach.range.low);
        const Answer high = is_at_most(reach.range.high, T(set.depth.viewport.high));
        out.is_known = low != Answer::unknown && high != Answer::unknown;
        out.is_free = low != Answer::yes || high != Answer::yes;
    } else {
        out.range = {smaller(inside.low, reach.range.low), larger(inside.high, reach.range.high)};
    }
    return out;
}

template DepthReach<Ball> reach_of_depth<Ball>(const WideSet<Ball>&, const Quantity&, bool,
                                               const Point<Ball>&);
template DepthReach<mpq_class> reach_of_depth<mpq_class>(const WideSet<mpq_class>&, const Quantity&,
                                                         bool, const Point<mpq_class>&);
template <class T>
std::vector<WideRange<T>> ranges_wide(const WideSet<T>& set, std::span<const Quantity> quantities,
                                      bool is_projectable,
                                      const std::vector<Evaluation<T>>& evaluations,
                                      std::span<const size_t> only) {
    std::vector<Reach<T>> reaches(quantities.size());
    const FragmentValues nothing;  // only reports ask for the device's values
    for (const Evaluation<T>& where : evaluations) {
        for (const Candidate<T>& candidate : set.candidates) {
            // A piece that may be near counts: the range is an upper bound.
            if (!candidate.is_piece ||
                is_near(candidate.bases.front(), where.sample, set.margin) != Answer::no) {
                add_candidate(set, candidate, quantities, is_projectable, where, only, nothing,
                              reaches);
            }
        }
    }
    std::vector<WideRange<T>> out;
    for (const size_t index : only) {
        const Reach<T>& reach = reaches[index];
        out.push_back(
            {reach.is_known, reach.is_free || reach.is_undefined || reach.is_first, reach.range});
    }
    return out;
}

template std::vector<WideRange<Ball>> ranges_wide<Ball>(const WideSet<Ball>&,
                                                        std::span<const Quantity>, bool,
                                                        const std::vector<Evaluation<Ball>>&,
                                                        std::span<const size_t>);
template std::vector<WideRange<mpq_class>> ranges_wide<mpq_class>(
    const WideSet<mpq_class>&, std::span<const Quantity>, bool,
    const std::vector<Evaluation<mpq_class>>&, std::span<const size_t>);
template WideVerdict judge_wide<Ball>(const WideSet<Ball>&, std::span<const Quantity>, bool,
                                      const std::vector<Evaluation<Ball>>&, const ProbePlace&,
                                      const FragmentValues&, std::span<const size_t>);
template WideVerdict judge_wide<mpq_class>(const WideSet<mpq_class>&, std::span<const Quantity>,
                                           bool, const std::vector<Evaluation<mpq_class>>&,
                                           const ProbePlace&, const FragmentValues&,
                                           std::span<const size_t>);

}  // namespace ref::value
