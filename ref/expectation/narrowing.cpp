// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/narrowing.hpp"

#include <algorithm>
#include <map>
#include <optional>

namespace ref {

namespace {

// The bounds of what the paths end in.
HitBounds bounds_of(const path::Resolution& resolution) {
    HitBounds out;
    bool is_first = true;
    for (const path::Outcome& o : resolution.outcomes) {
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
HitBounds any_of(const std::vector<path::Fragment>& fragments) {
    HitBounds out;
    for (const path::Fragment& f : fragments) {
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
    return stored == path::kClearDepth ? std::nullopt
                                       : std::optional(hits[static_cast<size_t>(stored)].triangle);
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
      stores_discarded_(stores_discarded(c)),
      fixed_sets_(c, profile, triangles, setups, predicates, discards,
                  depth != nullptr || follows_paths(c)) {}

bool Narrowing::is_anywhere(std::span<const Hit> hits) const {
    const auto open = std::count_if(hits.begin(), hits.end(),
                                    [](const Hit& h) { return h.coverage == Coverage::either; });
    // Alone, an open triangle can only be settled by partners that are decided.
    const auto least =
        profile_ == cases::Profile::direct3d || fixed_sets_.has_complements() ? 1 : 2;
    return depth_ == nullptr && open < least && !stores_discarded_;
}

SampleExpectation Narrowing::judge(const FixedPoint& p, uint32_t s, std::span<const Hit> hits,
                                   Lists& lists, JudgeReasons* reasons) {
    sample_ = s;
    fates_.clear();
    std::vector<FixedHits> sets;
    if (!is_anywhere(hits)) {
        sets = fixed_sets_.of(p, s, hits);
        for (size_t k = 0; reasons != nullptr && k < sets.size(); ++k) {
            reasons->sets.push_back(fixed_sets_.told(p, hits, sets[k]));
        }
    }
    return hits.empty() ? SampleExpectation() : judge_by_paths(p, hits, sets, lists, reasons);
}

path::Question Narrowing::question(const FixedPoint& p, std::span<const Hit> hits,
                                   const std::vector<FixedHits>& sets) {
    path::Question out;
    out.clear = case_.target.stencil_clear;
    out.is_unknown = case_.target.stencil_load == cases::LoadOp::dont_care;
    for (size_t m = 0; m < hits.size(); ++m) {
        const uint32_t t = hits[m].triangle;
        const cases::Draw& draw = case_.draws[triangles_[t].draw];
        const TriangleSetup::Faces faces = setups_[t].faces(is_further(hits, m));
        path::Fragment fragment{case_.target.has_stencil ? &draw.stencil : &path::kKeepStencil,
                                hits[m].coverage == Coverage::must, faces.front, faces.back,
                                draw.depth.write};
        fragment.triangle = t;
        fragment.is_value_open = hits[m].is_value_open;
        fragment.is_sure_but_for_value = hits[m].is_sure_but_for_value;
        fragment.is_in_pieces = setups_[t].is_clipped || draw.distances.clip_count > 0;
        if (draw.clear) {
            fragment.is_discarded_front = true;
            fragment.is_clear = draw.clear->color.has_value();
        } else if (stores_discarded(draw)) {
            const auto x = static_cast<uint32_t>(p.x >> kFixedBits);
            const auto y = static_cast<uint32_t>(p.y >> kFixedBits);
            const Sign sign = discards_by_value(draw) ? discards_.at(t, {x, y, sample_, draw.layer})
                                                      : Sign::not_negative;
            const bool is_discarded = discards_pixel(draw.discard, x, y) || sign == Sign::negative;
            fragment.is_discard_open = fragment.is_value_open = sign == Sign::open;
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
    return out;
}

void Narrowing::add_tests(path::Question& question, const FixedPoint& p,
                          std::span<const Hit> hits) {
    tests_.clear();
    depth_reasons_.assign(hits.size(), ReasonKind::depth_ranges);
    if (depth_ == nullptr) {
        return;
    }
    const auto tested = [this, p, hits, has_bounds = tests_bounds(case_)](
                            int stored, uint32_t m) -> const TestedDepth& {
        const auto [at, is_new] = tests_.try_emplace({m, stored}, TestedDepth{m, stored});
        if (is_new) {
            const std::optional<uint32_t> t = triangle_of(hits, stored);
            at->second.bounds =
                has_bounds ? depth_->bounds(t, hits[m].triangle, p) : DepthOutcome::passes;
            at->second.depth = depth_->outcome(t, hits[m].triangle, p, depth_reasons_[m]);
        }
        return at->second;
    };
    if (tests_bounds(case_)) {
        question.bounds = [tested](int stored, uint32_t m) { return tested(stored, m).bounds; };
    }
    question.depth = [tested](int stored, uint32_t m) { return tested(stored, m).depth; };
}

// Neighbours that the same triangles touch ask the same, unless depths are compared.
path::Resolution Narrowing::resolution_of(const path::Question& question) {
    if (question.depth) {
        return predicates_.resolve_paths(question);
    }
    if (!last_ || last_->fragments != question.fragments || last_->sets != question.sets) {
        last_ = {question.fragments, question.sets, predicates_.resolve_paths(question)};
    }
    return last_->resolution;
}

SampleExpectation Narrowing::judge_by_paths(const FixedPoint& p, std::span<const Hit> hits,
                                            const std::vector<FixedHits>& sets, Lists& lists,
                                            JudgeReasons* reasons) {
    SampleExpectation out;
    path::Question asked = question(p, hits, sets);
    add_tests(asked, p, hits);
    path::Resolution resolution = resolution_of(asked);
    out.is_free = resolution.is_free;
    if (resolution.is_free) {
        out.hits = any_of(asked.fragments);
        resolution.is_last.assign(hits.size(), true);
        resolution.is_stored.assign(hits.size(), true);
        resolution.may_be_clear = true;
        resolution.fates.assign(hits.size(), {true, true, true, true, true, tests_bounds(case_)});
        resolution.outcomes.clear();
    } else {
        out.hits = bounds_of(resolution);
    }
    if (follows_paths(case_)) {
        out.stencils_begin = static_cast<uint32_t>(lists.stencils.size());
        out.stencils_count = static_cast<uint32_t>(resolution.outcomes.size());
        lists.stencils.insert(lists.stencils.end(), resolution.outcomes.begin(),
                              resolution.outcomes.end());
    }
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
    out.depth_may_be_clear = depth_ != nullptr && resolution.may_be_clear;
    out.is_open = asked.is_unknown;
    fates_ = std::move(resolution.fates);
    for (size_t m = 0; m < hits.size(); ++m) {
        const path::Fragment& f = asked.fragments[m];
        out.is_open = out.is_open || !fates_[m].is_certain() ||
                      (!fates_[m].is_absent && f.can_be_front && f.can_be_back);
    }
    if (out.is_open) {
        keep_paths(asked, out, lists);
    } else if (!case_.target.has_instruments || case_.target.color || counts_fragments(case_)) {
        keep_passed(asked, out, lists);
    }
    if (reasons != nullptr) {
        reasons->fates = fates_;
        reasons->depth_reasons = depth_reasons_;
    }
    return out;
}

void Narrowing::keep_paths(const path::Question& question, SampleExpectation& out,
                           Lists& lists) const {
    out.fragments_begin = static_cast<uint32_t>(lists.fragments.size());
    out.fragments_count = static_cast<uint32_t>(question.fragments.size());
    for (path::Fragment f : question.fragments) {
        f.state = nullptr;  // an expectation outlives the case
        lists.fragments.push_back(f);
    }
    out.sets_begin = static_cast<uint32_t>(lists.sets.size());
    out.sets_count = static_cast<uint32_t>(question.sets.size());
    lists.sets.insert(lists.sets.end(), question.sets.begin(), question.sets.end());
    out.tests_begin = static_cast<uint32_t>(lists.tests.size());
    if (question.depth) {
        for (const auto& [key, test] : tests_) {
            lists.tests.push_back(test);
        }
    }
    out.tests_count = static_cast<uint32_t>(lists.tests.size()) - out.tests_begin;
}

void Narrowing::keep_passed(const path::Question& question, SampleExpectation& out,
                            Lists& lists) const {
    out.fragments_begin = static_cast<uint32_t>(lists.fragments.size());
    for (size_t m = 0; m < question.fragments.size(); ++m) {
        const path::Fate& fate = fates_[m];
        if (fate.passes || fate.is_discarded) {
            path::Fragment& passed = lists.fragments.emplace_back(nullptr, true);
            passed.triangle = question.fragments[m].triangle;
            passed.is_clear = question.fragments[m].is_clear;
            passed.is_discarded_front = passed.is_discarded_back = fate.is_discarded;
        }
    }
    out.fragments_count = static_cast<uint32_t>(lists.fragments.size()) - out.fragments_begin;
}

}  // namespace ref
