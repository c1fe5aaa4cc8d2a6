// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/narrowing.hpp"

#include <algorithm>
#include <map>
#include <optional>

namespace ref {

namespace {

void add_single(HitBounds& b, const TriangleSetup::Faces& can_be, bool is_must) {
    b.total_max += 1;
    b.front_max += can_be.front ? 1 : 0;
    b.back_max += can_be.back ? 1 : 0;
    b.signed_max += can_be.front ? 1 : 0;
    b.signed_min -= can_be.back ? 1 : 0;
    if (!is_must) {
        return;
    }
    b.total_min += 1;
    if (!can_be.back) {
        b.front_min += 1;
        b.signed_min += 1;
    }
    if (!can_be.front) {
        b.back_min += 1;
        b.signed_max -= 1;
    }
}

// From `least` to `most` of some triangles, at most `front` of them as front and `back` as back
// faces.
void add_set(HitBounds& b, uint32_t front, uint32_t back, uint32_t least, uint32_t most) {
    const auto beyond = [](uint32_t n, uint32_t others) { return n > others ? n - others : 0; };
    const uint32_t front_max = std::min(front, most);
    const uint32_t back_max = std::min(back, most);
    const uint32_t front_min = beyond(least, back);
    const uint32_t back_min = beyond(least, front);
    b.total_min += least;
    b.total_max += most;
    b.front_min += front_min;
    b.front_max += front_max;
    b.back_min += back_min;
    b.back_max += back_max;
    // The most of one kind, and of the other what is then missing from the least.
    b.signed_min += static_cast<int32_t>(beyond(least, back_max)) - static_cast<int32_t>(back_max);
    b.signed_max +=
        static_cast<int32_t>(front_max) - static_cast<int32_t>(beyond(least, front_max));
}

constexpr cases::StencilState kKeepStencil{{}, {}};  // where there is none

// The bounds of what the courses of events end in.
HitBounds bounds_of(const stencil::Resolution& resolution) {
    HitBounds out;
    bool is_first = true;
    for (const stencil::Outcome& o : resolution.outcomes) {
        const int32_t balance = static_cast<int32_t>(o.front) - static_cast<int32_t>(o.back);
        const uint32_t total = o.front + o.back;
        if (is_first) {
            out = {o.front, o.front, o.back, o.back, balance, balance, total, total};
            is_first = false;
            continue;
        }
        out.front_min = std::min(out.front_min, o.front);
        out.front_max = std::max(out.front_max, o.front);
        out.back_min = std::min(out.back_min, o.back);
        out.back_max = std::max(out.back_max, o.back);
        out.signed_min = std::min(out.signed_min, balance);
        out.signed_max = std::max(out.signed_max, balance);
        out.total_min = std::min(out.total_min, total);
        out.total_max = std::max(out.total_max, total);
    }
    return out;
}

// The same where nothing is claimed: any of the fragments.
HitBounds any_of(const std::vector<stencil::Fragment>& fragments) {
    HitBounds out;
    for (const stencil::Fragment& f : fragments) {
        out.front_max += f.can_be_front ? 1 : 0;
        out.back_max += f.can_be_back ? 1 : 0;
        out.total_max += 1;
    }
    out.signed_min = -static_cast<int32_t>(out.back_max);
    out.signed_max = static_cast<int32_t>(out.front_max);
    return out;
}

// The triangle whose depth is stored, or none: the clear value.
std::optional<uint32_t> triangle_of(std::span<const Hit> hits, int stored) {
    return stored == stencil::kClearDepth
               ? std::nullopt
               : std::optional(hits[static_cast<size_t>(stored)].triangle);
}

// What depth tests came to, where they were reached.
DepthOutcome depth_of(const stencil::Fate& fate) {
    const bool passes = fate.passes || fate.is_discarded;
    return passes == fate.fails_depth ? DepthOutcome::open
           : passes                   ? DepthOutcome::passes
                                      : DepthOutcome::fails;
}

}  // namespace

Narrowing::Narrowing(const cases::Case& c, cases::Profile profile,
                     const std::vector<cases::Triangle>& triangles, TriangleSetups& setups,
                     Predicates predicates, DepthTest* depth, ValueDiscards& discards)
    : case_(c),
      profile_(profile),
      triangles_(triangles),
      setups_(setups),
      predicates_(predicates),
      depth_(depth),
      discards_(discards),
      follows_courses_(follows_courses(c)),
      stores_discarded_(stores_discarded(c)),
      fixed_sets_(c, profile, triangles, setups, predicates, discards,
                  depth != nullptr || follows_courses_) {}

DepthResolution Narrowing::resolve_depth(const FixedPoint& p, std::span<const Hit> hits,
                                         const std::vector<FixedHits>& sets) {
    std::vector<DepthCandidate> candidates;
    for (const Hit& hit : hits) {
        candidates.push_back({hit.triangle, hit.coverage == Coverage::must});
    }
    for (size_t k = 0; k < sets.size(); ++k) {
        const FixedHits& set = sets[k];
        for (const uint32_t m : set.members) {
            candidates[m].is_absent = set.count == 0;
            candidates[m].is_sure = set.least == set.members.size();
            candidates[m].one_of = set.count == 1 ? static_cast<int>(k) : -1;
            candidates[m].is_one_sure = set.least == 1;
        }
    }
    return depth_->resolve(p, candidates);
}

void Narrowing::apply_depth(const FixedPoint& p, std::span<const Hit> hits,
                            std::vector<FixedHits>& sets, std::vector<Coverage>& coverage,
                            std::vector<uint32_t>& depth_writers, SampleExpectation& out,
                            JudgeReasons* reasons) {
    const DepthResolution depth = resolve_depth(p, hits, sets);
    if (reasons != nullptr) {
        reasons->depth = depth;
    }
    for (size_t m = 0; m < hits.size(); ++m) {
        if (depth.outcomes[m] == DepthOutcome::fails) {
            coverage[m] = Coverage::must_not;
        } else if (depth.outcomes[m] == DepthOutcome::open) {
            coverage[m] = Coverage::either;
        }
    }
    // A set of which some may fail the test no longer has a fixed number of hits.
    std::erase_if(sets, [&](const FixedHits& set) {
        const auto passes = [&](uint32_t m) { return depth.outcomes[m] == DepthOutcome::passes; };
        const bool is_whole =
            set.count == 0 || std::all_of(set.members.begin(), set.members.end(), passes);
        const bool is_sure = set.least == set.members.size();
        for (const uint32_t m : set.members) {
            if (!is_whole && passes(m)) {
                coverage[m] = is_sure ? Coverage::must : Coverage::either;
            }
        }
        return !is_whole;
    });
    out.depth_begin = static_cast<uint32_t>(depth_writers.size());
    for (const uint32_t m : depth.stored) {
        depth_writers.push_back(hits[m].triangle);
    }
    out.depth_count = static_cast<uint32_t>(depth.stored.size());
    out.depth_may_be_clear = depth.may_be_clear;
}

bool Narrowing::is_anywhere(std::span<const Hit> hits) const {
    const auto open = std::count_if(hits.begin(), hits.end(),
                                    [](const Hit& h) { return h.coverage == Coverage::either; });
    // Alone, an open triangle can only be settled by partners that are decided.
    const auto least =
        profile_ == cases::Profile::direct3d || fixed_sets_.has_complements() ? 1 : 2;
    return depth_ == nullptr && open < least && !stores_discarded_;
}

uint32_t Narrowing::add_hits(std::span<const Hit> hits, const std::vector<FixedHits>& sets,
                             std::vector<Coverage>& coverage, HitBounds& out) {
    std::vector<bool> is_counted(hits.size(), false);
    uint32_t first = 0;
    for (const FixedHits& set : sets) {
        uint32_t front = 0;
        uint32_t back = 0;
        for (const uint32_t m : set.members) {
            is_counted[m] = true;
            front += setups_[hits[m].triangle].can_be_front ? 1U : 0U;
            back += setups_[hits[m].triangle].can_be_back ? 1U : 0U;
            if (set.count == 0) {
                coverage[m] = Coverage::must_not;
            }
        }
        add_set(out, front, back, set.least, set.count);
        if (set.least > 0) {
            first = std::max(first, set.members[set.least - 1]);
        }
    }
    for (uint32_t m = 0; m < hits.size(); ++m) {
        if (!is_counted[m] && coverage[m] != Coverage::must_not) {
            add_single(out, setups_[hits[m].triangle].faces(is_further(hits, m)),
                       coverage[m] == Coverage::must);
            first = coverage[m] == Coverage::must ? std::max(first, m) : first;
        }
    }
    return first;
}

SampleExpectation Narrowing::judge(const FixedPoint& p, uint32_t s, std::span<const Hit> hits,
                                   const JudgedLists& lists, JudgeReasons* reasons) {
    SampleExpectation out;
    std::vector<uint32_t>& writers = lists.writers;
    sample_ = s;
    fates_.clear();
    if (follows_courses_ && !hits.empty() && is_anywhere(hits)) {
        return judge_by_stencil(p, hits, {}, lists, reasons);
    }
    out.writers_begin = static_cast<uint32_t>(writers.size());
    if (is_anywhere(hits)) {
        uint32_t first = 0;
        for (uint32_t m = 0; m < hits.size(); ++m) {
            const bool is_must = hits[m].coverage == Coverage::must;
            add_single(out.hits, setups_[hits[m].triangle].faces(is_further(hits, m)), is_must);
            first = is_must ? m : first;
        }
        for (uint32_t m = first; m < hits.size(); ++m) {
            writers.push_back(hits[m].triangle);
        }
        out.writers_count = static_cast<uint32_t>(writers.size()) - out.writers_begin;
        return out;
    }
    std::vector<FixedHits> sets = fixed_sets_.of(p, s, hits);
    for (size_t k = 0; reasons != nullptr && k < sets.size(); ++k) {
        reasons->sets.push_back(fixed_sets_.told(p, hits, sets[k]));
    }
    if (follows_courses_ && !hits.empty()) {
        return judge_by_stencil(p, hits, sets, lists, reasons);
    }
    std::vector<Coverage> coverage(hits.size());
    for (size_t m = 0; m < hits.size(); ++m) {
        coverage[m] = hits[m].coverage;
    }
    if (depth_ != nullptr && !hits.empty()) {
        apply_depth(p, hits, sets, coverage, lists.depth_writers, out, reasons);
    }
    const uint32_t first = add_hits(hits, sets, coverage, out.hits);
    for (uint32_t m = first; m < hits.size(); ++m) {
        if (coverage[m] != Coverage::must_not) {
            writers.push_back(hits[m].triangle);
        }
    }
    out.writers_count = static_cast<uint32_t>(writers.size()) - out.writers_begin;
    return out;
}

stencil::Question Narrowing::stencil_question(const FixedPoint& p, std::span<const Hit> hits,
                                              const std::vector<FixedHits>& sets,
                                              std::vector<ReasonKind>& depth_reasons) {
    stencil::Question out;
    out.clear = case_.target.stencil_clear;
    for (size_t m = 0; m < hits.size(); ++m) {
        const uint32_t t = hits[m].triangle;
        const cases::Draw& draw = case_.draws[triangles_[t].draw];
        const TriangleSetup::Faces faces = setups_[t].faces(is_further(hits, m));
        stencil::Fragment fragment{case_.target.has_stencil ? &draw.stencil : &kKeepStencil,
                                   hits[m].coverage == Coverage::must, faces.front, faces.back,
                                   draw.depth.write};
        if (stores_discarded(draw)) {
            const auto x = static_cast<uint32_t>(p.x >> kFixedBits);
            const auto y = static_cast<uint32_t>(p.y >> kFixedBits);
            const Sign sign = discards_by_value(draw) ? discards_.at(t, {x, y, sample_, draw.layer})
                                                      : Sign::not_negative;
            const bool is_discarded = discards_pixel(draw.discard, x, y) || sign == Sign::negative;
            fragment.is_discard_open = sign == Sign::open;
            fragment.is_discarded_front = is_discarded || discards_face(draw.discard, true);
            fragment.is_discarded_back = is_discarded || discards_face(draw.discard, false);
        }
        // Further pieces of a triangle are the device's choice.
        const bool has_twins = depth_ != nullptr && !is_further(hits, m);
        for (size_t k = 0; has_twins && k < m && fragment.twin < 0; ++k) {
            if (depth_->is_together(hits[k].triangle, t)) {
                fragment.twin = static_cast<int>(k);
            }
        }
        out.fragments.push_back(fragment);
    }
    for (size_t k = 0; k < sets.size(); ++k) {
        out.sets.push_back({sets[k].least, sets[k].count});
        for (const uint32_t m : sets[k].members) {
            out.fragments[m].set = static_cast<int>(k);
        }
    }
    depth_reasons.assign(hits.size(), ReasonKind::depth_ranges);
    if (depth_ != nullptr && tests_bounds(case_)) {
        out.bounds = [this, p, hits, known = std::map<std::pair<int, uint32_t>, DepthOutcome>()](
                         int stored, uint32_t m) mutable {
            const auto [at, is_new] = known.try_emplace({stored, m}, DepthOutcome::open);
            if (is_new) {
                at->second = depth_->bounds(triangle_of(hits, stored), hits[m].triangle, p);
            }
            return at->second;
        };
    }
    if (depth_ != nullptr) {
        out.depth = [this, p, hits, &depth_reasons,
                     known = std::map<std::pair<int, uint32_t>, DepthOutcome>()](
                        int stored, uint32_t m) mutable {
            const auto [at, is_new] = known.try_emplace({stored, m}, DepthOutcome::open);
            if (is_new) {
                at->second = depth_->outcome(triangle_of(hits, stored), hits[m].triangle, p,
                                             depth_reasons[m]);
            }
            return at->second;
        };
    }
    return out;
}

SampleExpectation Narrowing::judge_by_stencil(const FixedPoint& p, std::span<const Hit> hits,
                                              const std::vector<FixedHits>& sets,
                                              const JudgedLists& lists, JudgeReasons* reasons) {
    SampleExpectation out;
    std::vector<ReasonKind> depth_reasons;
    const stencil::Question question = stencil_question(p, hits, sets, depth_reasons);
    stencil::Resolution resolution = predicates_.resolve_stencil(question);
    out.is_stencil_free = resolution.is_free;
    if (resolution.is_free) {
        out.hits = any_of(question.fragments);
        resolution.is_last.assign(hits.size(), true);
        resolution.is_stored.assign(hits.size(), true);
        resolution.may_be_clear = true;
        resolution.fates.assign(hits.size(), {true, true, true, true, true, tests_bounds(case_)});
        resolution.outcomes.clear();
    } else {
        out.hits = bounds_of(resolution);
    }
    out.stencils_begin = static_cast<uint32_t>(lists.stencils.size());
    out.stencils_count = static_cast<uint32_t>(resolution.outcomes.size());
    lists.stencils.insert(lists.stencils.end(), resolution.outcomes.begin(),
                          resolution.outcomes.end());
    out.writers_begin = static_cast<uint32_t>(lists.writers.size());
    out.depth_begin = static_cast<uint32_t>(lists.depth_writers.size());
    for (size_t m = 0; m < hits.size(); ++m) {
        if (resolution.is_last[m]) {
            lists.writers.push_back(hits[m].triangle);
        }
        if (depth_ != nullptr && resolution.is_stored[m]) {
            lists.depth_writers.push_back(hits[m].triangle);
        }
    }
    out.writers_count = static_cast<uint32_t>(lists.writers.size()) - out.writers_begin;
    out.depth_count = static_cast<uint32_t>(lists.depth_writers.size()) - out.depth_begin;
    out.depth_may_be_clear = depth_ != nullptr && !hits.empty() && resolution.may_be_clear;
    fates_ = std::move(resolution.fates);
    if (reasons != nullptr) {
        reasons->fates = fates_;
        for (size_t m = 0; depth_ != nullptr && m < hits.size(); ++m) {
            const DepthOutcome outcome = depth_of(fates_[m]);
            reasons->depth.outcomes.push_back(outcome);
            reasons->depth.reasons.push_back(
                outcome == DepthOutcome::open ? ReasonKind::depth_ranges : depth_reasons[m]);
        }
    }
    return out;
}

}  // namespace ref
