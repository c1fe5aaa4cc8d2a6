// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/sample_judge.hpp"

#include <algorithm>
#include <utility>

#include "cases/model/rule.hpp"
#include "cases/model/rule_ids.hpp"
#include "diff/resolve.hpp"
#include "diff/sample/contradiction.hpp"

namespace diff {

using Detail = ref::path::SeenHits::Detail;

SampleJudge::SampleJudge(const cases::Case& c, const ref::Expectation& expectation,
                         const capture::CaptureView& capture, const Delivery& delivery,
                         Wanted wanted, IsTold is_told)
    : case_(c),
      expectation_(expectation),
      capture_(capture),
      delivery_(delivery),
      attribution_(c, expectation,
                   wanted == Wanted::brief ? Attribution::kBrief : Attribution::kExplained),
      values_(c, expectation.limits, expectation.profile),
      last_fragment_(c, expectation, capture_, delivery_, attribution_, values_),
      observers_(c, expectation, capture_, delivery_, last_fragment_, attribution_, values_),
      has_discards_(std::ranges::any_of(
          c.draws, [](const cases::Draw& draw) { return draw.discard != cases::Discard::none; })),
      stores_discarded_(cases::stores_discarded(c)) {
    values_.judge_only(delivery.values);
    last_fragment_.need_ratios(wanted == Wanted::all);
    if (wanted == Wanted::symptoms || wanted == Wanted::brief) {
        values_.tell_loosest_levels();
    }
    values_.tell_only([this, is_told = std::move(is_told)](const ref::ValueMismatch& m) {
        return !observers_.is_asking() && (last_fragment_.needs_texts() || !is_told || is_told(m));
    });
    if (delivery.has_color) {
        color_.emplace(c, expectation, capture_, attribution_);
    }
    if (delivery.has_stencil && ref::stencil::is_needed(c)) {
        stencil_.emplace(c, expectation, capture_, attribution_);
    }
}

SeenPlanes SampleJudge::all_of(size_t index) {
    return {observers_.hits_at(index), delivery_.has_writers, delivery_.has_values(),
            delivery_.values.depth, delivery_.has_stencil};
}

void SampleJudge::begin(size_t index, cases::SampleId id) {
    index_ = index;
    id_ = id;
    seen_ = all_of(index);
    out_ = {};
    const bool has_stencil = delivery_.has_stencil && capture_.stencil[index] != capture::kPoison;
    out_.is_missing = delivery_.has_stencil && !has_stencil;
}

const SampleOutcome& SampleJudge::judge(size_t index, cases::SampleId id) {
    begin(index, id);
    judge_all();
    out_.right = seen_;
    return out_;
}

const SampleOutcome& SampleJudge::judge_color_alone(size_t index, cases::SampleId id) {
    begin(index, id);
    if (std::optional<Finding> finding = judge_color(seen_)) {
        add(std::move(*finding));
    }
    return out_;
}

const SampleOutcome& SampleJudge::judge_stencil_alone(size_t index, cases::SampleId id) {
    begin(index, id);
    if (!out_.is_missing) {
        judge_stencil();
    }
    return out_;
}

void SampleJudge::judge_all() {
    const capture::SampleState state = delivery_.is_of_planes
                                           ? capture::SampleState::drawn
                                           : capture::sample_state(capture_, index_);
    out_.is_missing = out_.is_missing || state == capture::SampleState::not_copied;
    if (out_.is_missing) {
        return;
    }
    const bool is_hit = seen_.hits.total() > 0;
    const bool is_inconsistent =
        state == capture::SampleState::inconsistent ||
        (seen_.writer && is_hit == (capture_.writers[index_].draw == capture::kClearId));
    if (is_inconsistent) {
        add_contradiction(ref::ReasonKind::planes_contradict);
    } else if (state == capture::SampleState::depth_only && !may_store_unhit()) {
        add_stray_depth();
    } else if (!expectation_.samples[index_].hits.allows(seen_.hits)) {
        judge_hits();
    } else {
        judge_planes();
    }
}

void SampleJudge::judge_hits() {
    Finding finding =
        finding_at(kind_of(expectation_.samples[index_].hits, seen_.hits), case_.target, id_);
    attribution_.attribute_hits(finding, seen_.hits, last_fragment_.last_hit(index_));
    add_of_sample(std::move(finding), out_.findings);
    judge_stencil();
}

// What the planes of a sample say of its fragments, whose hits may be as they are.
void SampleJudge::judge_planes() {
    const bool is_known = seen_.hits.detail != Detail::none;
    const bool is_hit = is_known && seen_.hits.total() > 0;
    if (is_hit && delivery_.has_fragments()) {
        judge_fragment();
    } else if (!is_known && color_ && seen_.depth) {
        judge_bare();
    } else if (!seen_.depth || judge_depth_alone(is_known)) {
        judge_together();
    }
}

void SampleJudge::judge_fragment() {
    LastFragment::Outcome outcome = last_fragment_.judge(index_, id_);
    if (!outcome.triangle) {
        add_of_sample(std::move(*outcome.finding), out_.findings);
        judge_stencil();
        return;
    }
    if (outcome.finding) {
        seen_.depth = false;
        add(std::move(*outcome.finding));
    }
    out_.has_fragment = true;
    out_.compared_values += outcome.compared_values;
    out_.worst_ratio = outcome.worst_ratio;
    out_.worst_quantity = outcome.worst_quantity;
    seen_.depth = seen_.depth && !outcome.is_depth_wrong;
    seen_.values = seen_.values && !outcome.are_others_wrong;
    judge_together();
    for (Finding& finding : outcome.values) {
        if (delivery_.has_instruments) {  // the writer says whose they are
            add(std::move(finding));
        } else {
            add_of_sample(std::move(finding), out_.findings);
        }
    }
}

// Colour and depth alone: a colour that no path has tells more than the depth beside it.
void SampleJudge::judge_bare() {
    SeenPlanes others = seen_;
    others.depth = others.stencil = false;
    if (std::optional<Finding> finding = judge_color(others)) {
        add_of_sample(std::move(*finding), out_.findings);
        judge_stencil();
        return;
    }
    judge_depth_alone(false);
    judge_together(true);
}

// Whether a fragment may store its depth at the sample and show nowhere.
bool SampleJudge::may_store_unhit() const {
    return stores_discarded_ && expectation_.samples[index_].depth_count > 0;
}

void SampleJudge::add_stray_depth() {
    add_contradiction(has_discards_ ? ref::ReasonKind::depth_of_taken
                      : cases::tests_bounds(case_) &&
                              expectation_.samples[index_].depth_may_be_clear
                          ? ref::ReasonKind::depth_of_bounded
                          : ref::ReasonKind::planes_contradict);
}

// The depth of a sample of which no fragment is known; false if nothing more is asked of it.
bool SampleJudge::judge_depth_alone(bool is_unhit) {
    const bool is_clear = capture::is_clear_depth(case_.target, capture_.depth[index_]);
    if (is_unhit && !is_clear && !may_store_unhit()) {
        add_stray_depth();
        return false;
    }
    if (std::optional<Finding> finding = !is_unhit || may_store_unhit()
                                             ? last_fragment_.judge_depth_alone(index_, id_)
                                             : std::nullopt) {
        if (!is_unhit) {
            tell(*finding, ref::ReasonKind::depth_of_none);
        }
        add(std::move(*finding));
        seen_.depth = false;
    }
    return true;
}

// Whether the planes that are right one by one are so together, and then the colour.
// `is_color_right`: it is by itself.
void SampleJudge::judge_together(bool is_color_right) {
    judge_stencil();
    if (std::optional<Finding> finding = observers_.judge(index_, id_, seen_)) {
        add_of_sample(std::move(*finding), out_.findings);
    }
    if (is_color_right && !expectation_.samples[index_].is_open) {
        return;
    }
    if (std::optional<Finding> finding = judge_color(seen_)) {
        add(std::move(*finding));
    }
    out_.compared_values -= is_color_right ? 1 : 0;  // it is compared already
}

// The stencil alone: what draws test, or a count of the hits, if their faces are known.
void SampleJudge::judge_stencil() {
    if (!seen_.stencil) {
        return;
    }
    const ref::HitBounds& bounds = expectation_.samples[index_].hits;
    const bool is_counted = seen_.hits.detail == Detail::faces;
    const ref::path::SeenHits hits =
        is_counted || !bounds.is_decided()
            ? seen_.hits
            : ref::path::SeenHits{Detail::faces, bounds.front_min, bounds.back_min};
    if (std::optional<Finding> finding = stencil_ ? stencil_->judge(index_, id_, seen_.hits)
                                                  : judge_count(capture_, index_, hits)) {
        add_of_sample(std::move(*finding), out_.stencils);
        seen_.stencil = false;
    }
    // A count follows from the hits.
    seen_.stencil = seen_.stencil && (stencil_ || !is_counted);
}

std::optional<Finding> SampleJudge::judge_color(const SeenPlanes& seen) {
    if (!color_) {
        return std::nullopt;
    }
    ++out_.compared_values;
    return color_->judge(index_, id_, [&](cases::Profile profile) {
        return observers_.witness(profile, index_, id_, seen);
    });
}

void SampleJudge::add_contradiction(ref::ReasonKind why) {
    Finding finding = finding_at(FindingKind::value, case_.target, id_);
    tell(finding, why);
    finding.level = cases::Profile::vulkan;
    finding.quantity = "attachments";
    finding.expected = "all attachments written by the same fragments";
    finding.got = delivery_.has_instruments ? contradiction_text(capture_, index_)
                                            : observers_.text_of(index_, seen_);
    out_.is_contradicted = true;
    add(std::move(finding));
}

void SampleJudge::add_of_sample(Finding finding, std::vector<Finding>& to) {
    for (const cases::Profile profile : cases::kProfiles) {
        if (profile >= finding.level) {
            break;
        }
        const std::vector<Finding>& found = found_at(profile);
        if (found.empty()) {
            continue;
        }
        // The first plane that is wrong is told; by the others, if that profile has not its rule,
        // or if it is one of several that contradict each other, which are others there.
        const cases::Rule* const rule = cases::find_rule(finding.rule);
        if (rule == nullptr || rule->profile > profile ||
            finding.rule == cases::rule::write_consistent) {
            to.insert(to.end(), found.begin(), found.end());
            return;
        }
        finding.level = profile;
    }
    to.push_back(std::move(finding));
}

// What is wrong with the sample at a looser profile.
const std::vector<Finding>& SampleJudge::found_at(cases::Profile profile) {
    const ref::Expectation& expectation = attribution_.at(profile, index_);
    std::unique_ptr<SampleJudge>& looser = looser_.at(static_cast<size_t>(profile));
    if (!looser) {
        looser = std::make_unique<SampleJudge>(case_, expectation, capture_, delivery_,
                                               Wanted::findings_without_ratios);
    }
    looser->judge(index_, id_);
    std::vector<Finding>& found = looser->out_.findings;
    found.insert(found.end(), looser->out_.stencils.begin(), looser->out_.stencils.end());
    return found;
}

}  // namespace diff
