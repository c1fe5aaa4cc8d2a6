// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "capture/runs.hpp"
#include "cases/base/counted.hpp"
#include "cases/model/derive.hpp"
#include "cases/model/rule.hpp"
#include "diff/attribution.hpp"
#include "diff/color.hpp"
#include "diff/delivered.hpp"
#include "diff/delivery.hpp"
#include "diff/fragment_check.hpp"
#include "diff/last_fragment.hpp"
#include "diff/observers.hpp"
#include "diff/pixel_check.hpp"
#include "diff/resolve.hpp"
#include "diff/sample/contradiction.hpp"
#include "diff/sample/run_judge.hpp"
#include "diff/shared_decisions.hpp"
#include "diff/stencil.hpp"
#include "diff/verdict.hpp"
#include "diff/whole_case.hpp"

namespace diff {

namespace {

using Detail = ref::path::SeenHits::Detail;

// One comparison's state; the phases of a sample stand in judge_sample().
class Comparison {
  public:
    Comparison(const cases::Case& c, const ref::Expectation& expectation,
               const capture::CaptureView& capture, const Delivery& delivery, bool is_by_sample,
               Wanted wanted = Wanted::all)
        : case_(c),
          expectation_(expectation),
          capture_(capture),
          delivery_(delivery),
          attribution_(c, expectation),
          values_(c, expectation.limits, expectation.profile),
          last_fragment_(c, expectation, capture_, delivery_, attribution_, values_),
          observers_(c, expectation, capture_, delivery_, last_fragment_, attribution_, values_),
          decisions_(c, expectation, capture_, observers_),
          has_decisions_(SharedDecisions::are_in(c, expectation.profile)),
          has_pixel_rules_(delivery.has_all_fragments() && has_pixel_rules(c)),
          has_discards_(std::ranges::any_of(
              c.draws,
              [](const cases::Draw& draw) { return draw.discard != cases::Discard::none; })),
          stores_discarded_(cases::stores_discarded(c)),
          stops_at_first_(wanted == Wanted::first_finding),
          has_runs_(!is_by_sample && !has_pixel_rules_ && !has_decisions_ && !stores_discarded_ &&
                    (delivery.has_instruments || delivery.has_color_alone())),
          run_judge_(c, expectation, capture_, values_) {
        values_.judge_only(delivery.values);
        last_fragment_.need_ratios(wanted == Wanted::all);
        if (wanted == Wanted::symptoms) {
            values_.tell_loosest_levels();
        }
        values_.tell_only([this](const ref::ValueMismatch& m) {
            return !observers_.is_asking() && last_fragment_.is_told(m, verdict_);
        });
        if (delivery.has_color) {
            color_.emplace(c, expectation, capture_, attribution_);
        }
        if (delivery.has_stencil && ref::stencil::is_needed(c)) {
            stencil_.emplace(c, expectation, capture_, attribution_);
        }
        verdict_.profile = expectation.profile;
        verdict_.level = expectation.profile;
        verdict_.must_samples = expectation.must_samples;
        verdict_.either_samples = expectation.either_samples;
    }

    Verdict run() {
        if (const std::string error = unusable(); !error.empty()) {
            verdict_.error = error;
            return std::move(verdict_);
        }
        if (expectation_.must_samples == 0) {
            verdict_.shows_nothing = true;
            verdict_.error =
                "the case has no sample that must be covered, so a black picture would pass; add a "
                "control triangle";
            return std::move(verdict_);
        }
        const size_t count = capture_.sample_count();
        verdict_.expected_hits.resize(count);
        verdict_.device_hits.resize(count);
        verdict_.has_counted = delivery_.tells_hits();
        verdict_.marks.assign(count, SampleMark::ok);
        if (delivery_.has_instruments || delivery_.is_of_planes) {
            verdict_.error_ratios.assign(count, -1.0F);
        }
        const cases::Target& target = case_.target;
        const size_t row = size_t{target.width} * target.samples;
        for (size_t index = 0; index < count;) {
            if (is_enough()) {
                verdict_.error = not_copied_from(index);
                break;
            }
            if (const size_t judged = judge_run(index, index - index % row + row); judged > 0) {
                if (!verdict_.error.empty()) {
                    return std::move(verdict_);
                }
                index += judged;
                continue;
            }
            const cases::SampleId id = cases::sample_at(target, index);
            judge_sample(index, id);
            if (!verdict_.error.empty()) {
                return std::move(verdict_);
            }
            if (has_decisions_ && id.sample + 1 == target.samples) {
                judge_decisions(id);
            }
            if (has_pixel_rules_ && id.sample + 1 == target.samples) {
                for (Finding& finding :
                     check_pixel(case_, expectation_, capture_, {id.x, id.y, 0, id.layer})) {
                    add(std::move(finding));
                }
            }
            ++index;
        }
        if (!verdict_.error.empty()) {
            return std::move(verdict_);
        }
        if (!is_enough()) {
            add_stencils();
        }
        verdict_.error =
            judge_dependent_planes(capture_, expectation_.profile, [this](Finding finding) {
                if (!is_enough()) {
                    add(std::move(finding));
                }
            });
        if (!is_enough() && delivery_.has_all_fragments() &&
            has_fragment_rules(case_, expectation_)) {
            check_fragments(case_, expectation_, capture_,
                            [this](Finding finding) { add(std::move(finding)); });
        }
        if (!is_enough() && !delivery_.is_of_planes) {
            judge_queries(
                case_, capture_, attribution_,
                [this](cases::Profile profile) {
                    return [this, profile](size_t index) { return shown_at(profile, index); };
                },
                verdict_);
        }
        return std::move(verdict_);
    }

  private:
    bool is_enough() const { return stops_at_first_ && !verdict_.findings.empty(); }

    // What is said of a sample that was not copied, and of the first one from `index` on.
    std::string not_copied(cases::SampleId id) const {
        return fmt::format(
            "sample {} of {} was not copied from the device: it still holds the read-back "
            "memory's fill pattern",
            id.sample, cases::pixel_text(case_.target, id));
    }
    std::string not_copied_from(size_t index) const {
        for (; index < capture_.sample_count(); ++index) {
            if (capture::sample_state(capture_, index) == capture::SampleState::not_copied) {
                return not_copied(cases::sample_at(case_.target, index));
            }
        }
        return {};
    }

    // Why there is nothing to judge; empty if there is.
    std::string unusable() const {
        if (delivery_.is_of_planes) {
            return {};  // whoever read them has seen their sizes
        }
        if (capture_.target != case_.target || !capture::has_all_planes(capture_)) {
            return fmt::format(
                "the capture has another size than the case's {}x{} target with {}{}",
                case_.target.width, case_.target.height,
                cases::counted(case_.target.samples, "sample"),
                case_.target.layers > 1 ? fmt::format(" and {} layers", case_.target.layers) : "");
        }
        if (cases::asks_queries(case_) && capture_.counted.size() != case_.draws.size()) {
            return "the capture lacks what the case's queries counted";
        }
        const size_t attributes = cases::attributes_of(case_);
        for (size_t a = 0; a < attributes; ++a) {
            if (case_.target.has_instruments && capture_.attribute_count <= a) {
                return fmt::format("the capture lacks attribute {} of the case", a);
            }
        }
        return {};
    }

    // Judges the samples from `index` to `row_end` that share an expectation as long as they are
    // plainly right; returns how many they are.
    size_t judge_run(size_t index, size_t row_end) {
        const bool is_colour_alone = !delivery_.has_instruments;
        if (!has_runs_ || (is_colour_alone && !color_->is_uniform())) {
            return 0;
        }
        const uint32_t number = expectation_.samples.number(index);
        size_t count = 1;
        while (index + count < row_end && expectation_.samples.number(index + count) == number) {
            ++count;
        }
        RunJudge::Right right{count, std::nullopt, {}};
        if (!is_colour_alone) {
            right = run_judge_.judge(index, count);
        } else if (capture::sample_state(capture_, index) != capture::SampleState::drawn) {
            return 0;
        }
        if (right.count == 0) {
            return 0;
        }
        right.count = color_ ? judge_color_run(index, right) : right.count;
        note_run(index, right);
        return right.count;
    }

    // The colours of a run: those like the first one are what the first one is, if no sample has a
    // colour of its own.
    size_t judge_color_run(size_t index, const RunJudge::Right& right) {
        note_expected(index, 1);
        const uint64_t before = verdict_.finding_total();
        judge_color(index, cases::sample_at(case_.target, index), all_of(index));
        if (verdict_.finding_total() != before || !color_->is_uniform()) {
            return 1;
        }
        const size_t count = capture::count_same_color(capture_, index, right.count);
        verdict_.compared_values += count - 1;
        return count;
    }

    void note_run(size_t index, const RunJudge::Right& right) {
        note_expected(index, right.count);
        verdict_.compared_samples += right.count;
        for (size_t k = index; delivery_.has_stencil && k < index + right.count; ++k) {
            const cases::SampleId id = cases::sample_at(case_.target, k);
            if (is_stencil_missing(k)) {
                verdict_.error = not_copied(id);
                return;
            }
            SeenPlanes seen = all_of(k);
            judge_stencil(k, id, seen);
        }
        if (!delivery_.has_instruments) {
            std::fill_n(verdict_.device_hits.begin() + static_cast<std::ptrdiff_t>(index),
                        right.count, color_->hits_for_pictures(index));
        }
        if (!right.triangle) {
            return;
        }
        std::fill_n(verdict_.device_hits.begin() + static_cast<std::ptrdiff_t>(index), right.count,
                    uint8_t{1});
        verdict_.compared_values += right.count * last_fragment_.values_of(*right.triangle);
        size_t worst = 0;
        for (size_t k = 0; k < right.count; ++k) {
            verdict_.raise_error(index + k, right.ratios[k]);
            worst = right.ratios[k] > right.ratios[worst] ? k : worst;
        }
        if (right.ratios[worst] > verdict_.worst_ratio) {
            const cases::SampleId id = cases::sample_at(case_.target, index + worst);
            const ref::FragmentVerdict v =
                values_.judge(*right.triangle, id, values_at(capture_, index + worst));
            note_worst(v.worst_ratio, v.worst_quantity, id);
        }
    }

    // What pictures show of samples with one expectation, before anything is found there.
    void note_expected(size_t index, size_t count) {
        const ref::HitBounds& bounds = expectation_.samples[index].hits;
        const auto first = static_cast<std::ptrdiff_t>(index);
        std::fill_n(verdict_.expected_hits.begin() + first, count,
                    bounds.total_min == bounds.total_max
                        ? static_cast<uint8_t>(std::min(bounds.total_min, 254U))
                        : uint8_t{255});
        if (!bounds.is_decided()) {
            std::replace(verdict_.marks.begin() + first,
                         verdict_.marks.begin() + first + static_cast<std::ptrdiff_t>(count),
                         SampleMark::ok, SampleMark::either);
        }
    }

    void note_worst(double ratio, const std::optional<ref::QuantityId>& quantity,
                    cases::SampleId id) {
        if (ratio > verdict_.worst_ratio) {
            verdict_.worst_ratio = ratio;
            verdict_.worst_quantity = fmt::format("{} at {}", quantity ? to_text(*quantity) : "",
                                                  cases::sample_text(case_.target, id));
        }
    }

    void judge_sample(size_t index, cases::SampleId id) {
        const ref::SampleExpectation& expected = expectation_.samples[index];
        const capture::SampleState state = delivery_.is_of_planes
                                               ? capture::SampleState::drawn
                                               : capture::sample_state(capture_, index);
        if (state == capture::SampleState::clear && expected.hits == ref::HitBounds{} && !color_ &&
            !stores_discarded_ && !delivery_.has_stencil) {
            ++verdict_.compared_samples;  // marks and hits are zero already
            return;
        }
        note_expected(index, 1);
        ++verdict_.compared_samples;
        if (state == capture::SampleState::not_copied || is_stencil_missing(index)) {
            verdict_.error = not_copied(id);
            return;
        }
        SeenPlanes seen = all_of(index);
        if (state == capture::SampleState::inconsistent) {
            add_contradiction(index, id, seen, ref::ReasonKind::planes_contradict);
            return;
        }
        note_hits(index, seen.hits);
        const bool is_hit = seen.hits.total() > 0;
        if (seen.writer && is_hit == (capture_.writers[index].draw == capture::kClearId)) {
            add_contradiction(index, id, seen, ref::ReasonKind::planes_contradict);
            return;
        }
        if (!expected.hits.allows(seen.hits)) {
            Finding finding = finding_at(kind_of(expected.hits, seen.hits), case_.target, id);
            attribution_.attribute_hits(finding, seen.hits, last_fragment_.last_hit(index));
            add_last(std::move(finding), index, id);
            judge_stencil(index, id, seen);
            return;
        }
        judge_planes(index, id, seen);
    }

    SeenPlanes all_of(size_t index) {
        return {observers_.hits_at(index), delivery_.has_writers, delivery_.has_values(),
                delivery_.values.depth, delivery_.has_stencil};
    }

    // What the planes of a sample say of its fragments, whose hits may be as they are.
    void judge_planes(size_t index, cases::SampleId id, SeenPlanes seen) {
        const bool is_known = seen.hits.detail != Detail::none;
        const bool is_hit = is_known && seen.hits.total() > 0;
        if (is_hit && delivery_.has_fragments()) {
            judge_fragment(index, id, seen);
        } else if (!is_known && color_ && seen.depth) {
            judge_bare(index, id, seen);
        } else if (!seen.depth || judge_depth_alone(index, id, seen, is_known)) {
            judge_together(index, id, seen);
        }
    }

    // Colour and depth alone: a colour that no path has tells more than the depth beside it.
    void judge_bare(size_t index, cases::SampleId id, SeenPlanes& seen) {
        SeenPlanes others = seen;
        others.depth = others.stencil = false;
        std::vector<Finding> found;
        std::vector<Finding>* const sink = std::exchange(sink_, &found);
        const bool is_wrong = judge_color(index, id, others);
        sink_ = sink;
        for (Finding& finding : found) {
            add_last(std::move(finding), index, id);
        }
        if (is_wrong) {
            judge_stencil(index, id, seen);
            return;
        }
        judge_depth_alone(index, id, seen, false);
        judge_together(index, id, seen, true);
    }

    // The depth of a sample of which no fragment is known; false if nothing more is asked of it.
    bool judge_depth_alone(size_t index, cases::SampleId id, SeenPlanes& seen, bool is_unhit) {
        const ref::SampleExpectation& expected = expectation_.samples[index];
        const bool is_clear = capture::is_clear_depth(case_.target, capture_.depth[index]);
        if (is_unhit && !is_clear && (!stores_discarded_ || expected.depth_count == 0)) {
            add_contradiction(index, id, seen,
                              has_discards_ ? ref::ReasonKind::depth_of_taken
                              : cases::tests_bounds(case_) && expected.depth_may_be_clear
                                  ? ref::ReasonKind::depth_of_bounded
                                  : ref::ReasonKind::planes_contradict);
            return false;
        }
        const bool is_asked = is_unhit ? stores_discarded_ && expected.depth_count > 0 : true;
        if (std::optional<Finding> finding =
                is_asked ? last_fragment_.judge_depth_alone(index, id) : std::nullopt) {
            if (!is_unhit) {
                tell(*finding, ref::ReasonKind::depth_of_none);
            }
            add(std::move(*finding));
            seen.depth = false;
        }
        return true;
    }

    // Whether the planes that are right one by one are so together, and then the colour.
    // `is_color_right`: it is by itself.
    void judge_together(size_t index, cases::SampleId id, SeenPlanes& seen,
                        bool is_color_right = false) {
        judge_stencil(index, id, seen);
        if (std::optional<Finding> finding = observers_.judge(index, id, seen)) {
            add(std::move(*finding));
        }
        if (!is_color_right) {
            judge_color(index, id, seen);
        } else if (expectation_.samples[index].is_open) {
            --verdict_.compared_values;  // it is compared already
            judge_color(index, id, seen);
        }
    }

    // What the planes of a sample show its queries.
    ref::ShownSample shown_at(cases::Profile profile, size_t index) {
        if (capture::sample_state(capture_, index) == capture::SampleState::inconsistent) {
            return {false, {}, {}};
        }
        SeenPlanes seen = all_of(index);
        const ref::SampleExpectation& expected = attribution_.at(profile, index).samples[index];
        const bool is_right = expected.hits.allows(seen.hits);
        // What is wrong is a finding of its own, and values cost too much to be asked again.
        const bool has_finding = verdict_.marks[index] > SampleMark::either;
        seen.writer = seen.writer && !has_finding;
        seen.depth = seen.depth && !has_finding;
        seen.values = seen.stencil = false;
        ref::ShownSample out{is_right, {}, seen.hits.total()};
        out.paths.hits = seen.hits;
        // Where hits, writer and depth are one each, none of them tells more.
        const bool is_single = expected.hits.is_decided() && expected.writers_count <= 1 &&
                               expected.depth_count + (expected.depth_may_be_clear ? 1U : 0U) <= 1;
        if (is_right && expected.is_open && !is_single) {
            out.paths =
                observers_.observe(profile, index, cases::sample_at(case_.target, index), seen);
        }
        return out;
    }

    // The samples of a pixel together, as far as they are right.
    void judge_decisions(const cases::SampleId& pixel) {
        const auto seen = [this](size_t index) {
            const bool is_right = verdict_.marks[index] <= SampleMark::either;
            SeenPlanes all = all_of(index);
            all.stencil = all.stencil && (stencil_.has_value() || all.hits.detail != Detail::faces);
            return is_right ? std::optional(all) : std::nullopt;
        };
        const size_t index = cases::index_of(case_.target, pixel);
        if (std::optional<Finding> finding =
                decisions_.judge(pixel, seen, color_ ? &color_->reference(index) : nullptr)) {
            add(std::move(*finding));
        }
    }

    void note_hits(size_t index, const ref::path::SeenHits& hits) {
        verdict_.device_hits[index] = hits.detail == Detail::none && color_
                                          ? color_->hits_for_pictures(index)
                                          : static_cast<uint8_t>(std::min(hits.total(), 255U));
    }

    bool is_stencil_missing(size_t index) const {
        return delivery_.has_stencil && capture_.stencil[index] == capture::kPoison;
    }

    // The stencil alone: what draws test, or a count of the hits, if their faces are known.
    void judge_stencil(size_t index, cases::SampleId id, SeenPlanes& seen) {
        if (!seen.stencil) {
            return;
        }
        const ref::HitBounds& bounds = expectation_.samples[index].hits;
        const bool is_counted = seen.hits.detail == Detail::faces;
        const ref::path::SeenHits hits =
            is_counted || !bounds.is_decided()
                ? seen.hits
                : ref::path::SeenHits{Detail::faces, bounds.front_min, bounds.back_min};
        if (std::optional<Finding> finding = stencil_ ? stencil_->judge(index, id, seen.hits)
                                                      : judge_count(capture_, index, hits)) {
            add_stencil(std::move(*finding), index, id);
            seen.stencil = false;
        }
        // A count follows from the hits.
        seen.stencil = seen.stencil && (stencil_ || !is_counted);
    }

    // Stencils are told after all other planes, whose findings say more of a device.
    void add_stencil(Finding finding, size_t index, cases::SampleId id) {
        std::vector<Finding>* const sink = std::exchange(sink_, &stencils_);
        add_last(std::move(finding), index, id);
        sink_ = sink;
        if (sink_ != nullptr || stencils_.size() > kMostStencils) {
            add_stencils();
        }
    }
    void add_stencils() {
        for (Finding& finding : std::exchange(stencils_, {})) {
            add(std::move(finding));
        }
    }

    void add_contradiction(size_t index, cases::SampleId id, const SeenPlanes& seen,
                           ref::ReasonKind why) {
        Finding finding = finding_at(FindingKind::value, case_.target, id);
        tell(finding, why);
        finding.level = cases::Profile::vulkan;
        finding.quantity = "attachments";
        finding.expected = "all attachments written by the same fragments";
        finding.got = delivery_.has_instruments ? contradiction_text(capture_, index)
                                                : observers_.text_of(index, seen);
        verdict_.device_hits[index] = 255;
        add(std::move(finding));
    }

    void judge_fragment(size_t index, cases::SampleId id, SeenPlanes& seen) {
        LastFragment::Outcome outcome = last_fragment_.judge(index, id);
        if (!outcome.triangle) {
            add_last(std::move(*outcome.finding), index, id);
            judge_stencil(index, id, seen);
            return;
        }
        if (outcome.finding) {
            seen.depth = false;
            add(std::move(*outcome.finding));
        }
        verdict_.compared_values += outcome.compared_values;
        note_worst(outcome.worst_ratio, outcome.worst_quantity, id);
        verdict_.raise_error(index, outcome.worst_ratio);
        seen.depth = seen.depth && !outcome.is_depth_wrong;
        seen.values = seen.values && !outcome.are_others_wrong;
        judge_together(index, id, seen);
        for (Finding& finding : outcome.values) {
            if (delivery_.has_instruments) {  // the writer says whose they are
                add(std::move(finding));
            } else {
                add_last(std::move(finding), index, id);
            }
        }
    }

    // Whether it is wrong.
    bool judge_color(size_t index, cases::SampleId id, const SeenPlanes& seen) {
        if (!color_) {
            return false;
        }
        ++verdict_.compared_values;
        if (std::optional<Finding> finding = color_->judge(index, id, [&](cases::Profile profile) {
                return observers_.witness(profile, index, id, seen);
            })) {
            add(std::move(*finding));
            return true;
        }
        return false;
    }

    void add(Finding finding) {
        if (sink_ != nullptr) {
            sink_->push_back(std::move(finding));
        } else {
            verdict_.add(std::move(finding), case_.target);
        }
    }

    // Adds a finding of a plane that is not asked together with the others. Where looser profiles
    // allow what it tells, they may deny the planes together: then that is what is wrong.
    void add_last(Finding finding, size_t index, cases::SampleId id) {
        for (const cases::Profile profile : cases::kProfiles) {
            if (profile >= finding.level) {
                break;
            }
            std::vector<Finding> found = found_at(profile, index, id);
            if (found.empty()) {
                continue;
            }
            // The first plane that is wrong is told; by the others, if that profile has not its
            // rule.
            const cases::Rule* const rule = cases::find_rule(finding.rule);
            if (rule != nullptr && rule->profile <= profile) {
                finding.level = profile;
                break;
            }
            for (Finding& f : found) {
                add(std::move(f));
            }
            return;
        }
        add(std::move(finding));
    }

    // What is wrong with a sample at a looser profile.
    std::vector<Finding> found_at(cases::Profile profile, size_t index, cases::SampleId id) {
        const ref::Expectation& expectation = attribution_.at(profile, index);
        std::unique_ptr<Comparison>& looser = looser_.at(static_cast<size_t>(profile));
        if (!looser) {
            looser = std::make_unique<Comparison>(case_, expectation, capture_, delivery_, true,
                                                  Wanted::all);
            looser->verdict_.expected_hits.resize(capture_.sample_count());
            looser->verdict_.device_hits.resize(capture_.sample_count());
            looser->verdict_.marks.resize(capture_.sample_count());
            looser->verdict_.error_ratios.resize(capture_.sample_count());
        }
        std::vector<Finding> found;
        looser->sink_ = &found;
        looser->judge_sample(index, id);
        return found;
    }

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::CaptureView& capture_;
    const Delivery delivery_;
    Attribution attribution_;
    ref::ValueReference values_;
    LastFragment last_fragment_;
    Observers observers_;
    SharedDecisions decisions_;
    bool has_decisions_ = false;
    bool has_pixel_rules_ = false;
    bool has_discards_ = false;
    bool stores_discarded_ = false;
    bool stops_at_first_ = false;
    bool has_runs_ = false;  // what is plainly right is judged by runs of samples
    RunJudge run_judge_;
    std::optional<ColorComparison> color_;
    std::optional<StencilComparison> stencil_;
    Verdict verdict_;
    std::array<std::unique_ptr<Comparison>, 3> looser_;  // by profile
    // Of a looser one: takes findings instead of the verdict.
    std::vector<Finding>* sink_ = nullptr;
    std::vector<Finding> stencils_;  // that are still to be told; of too many they are told at once
    static constexpr size_t kMostStencils = 4096;
};

// The same planes of a picture in which nothing is drawn.
capture::Delivered cleared(const cases::Case& c, const capture::Delivered& planes) {
    capture::Delivered out = planes;
    std::ranges::fill(out.depth, cases::nearest_depth(c.target.depth_clear, c.target.depth_format));
    std::ranges::fill(out.frag_coord, glm::vec4(capture::kClearValue));
    for (auto& attribute : out.attributes) {
        std::ranges::fill(attribute, glm::vec4(capture::kClearValue));
    }
    std::ranges::fill(out.stencil, c.target.stencil_clear);
    if (!out.color.empty()) {
        const ref::color::Unit unit{c.target.color->format, cases::Profile::direct3d};
        std::ranges::fill(out.color, unit.codes_of(unit.cleared(*c.target.color)));
    }
    return out;
}

Verdict compare_planes(const cases::Case& c, const ref::Expectation& expectation,
                       const capture::Delivered& planes, Wanted wanted) {
    const capture::Capture capture = capture_of(c, expectation, planes);
    const capture::CaptureView view(capture);
    return Comparison(c, expectation, view, delivery_of(c, planes), false, wanted).run();
}

std::string names_of(const capture::Delivered& planes) {
    std::string names;
    const auto add = [&names](bool is_there, const std::string& name) {
        names += is_there ? (names.empty() ? "" : ", ") + name : "";
    };
    add(!planes.frag_coord.empty(), "fragcoord");
    add(!planes.depth.empty(), "depth");
    for (size_t a = 0; a < planes.attributes.size(); ++a) {
        add(!planes.attributes.at(a).empty(), fmt::format("attribute{}", a));
    }
    add(!planes.color.empty(), "color");
    add(!planes.stencil.empty(), "stencil");
    return names;
}

}  // namespace

Verdict compare(const cases::Case& c, const ref::Expectation& expectation,
                const capture::CaptureView& capture, Wanted wanted) {
    return Comparison(c, expectation, capture, delivery_of(c), false, wanted).run();
}

Verdict compare_by_sample(const cases::Case& c, const ref::Expectation& expectation,
                          const capture::CaptureView& capture) {
    return Comparison(c, expectation, capture, delivery_of(c), true).run();
}

Verdict compare_delivered(const cases::Case& c, const ref::Expectation& expectation,
                          const capture::Delivered& planes) {
    Verdict verdict = compare_planes(c, expectation, planes, Wanted::all);
    // Coverage, hits and writers say themselves what is covered.
    if (verdict.ok() && planes.detail == capture::HitDetail::none && planes.draws.empty() &&
        compare_planes(c, expectation, cleared(c, planes), Wanted::first_finding).ok()) {
        verdict.error = fmt::format(
            "of the delivered planes ({}) a picture in which nothing is drawn would pass too; "
            "deliver coverage or hits",
            names_of(planes));
    }
    return verdict;
}

}  // namespace diff
