// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a sample may show in a case that follows courses: the question that ref/stencil answers, and
// its answer as bounds and lists.
#include <algorithm>
#include <map>
#include <optional>

#include "ref/expectation/narrowing.hpp"

namespace ref {

namespace {

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

stencil::Question Narrowing::stencil_question(const FixedPoint& p, std::span<const Hit> hits,
                                              const std::vector<Fixed>& sets,
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
                                              const std::vector<Fixed>& sets,
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
