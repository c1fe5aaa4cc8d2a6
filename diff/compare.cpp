// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "capture/runs.hpp"
#include "cases/base/counted.hpp"
#include "cases/model/derive.hpp"
#include "diff/attribution.hpp"
#include "diff/color.hpp"
#include "diff/fragment_check.hpp"
#include "diff/last_fragment.hpp"
#include "diff/pixel_check.hpp"
#include "diff/resolve.hpp"
#include "diff/sample/contradiction.hpp"
#include "diff/sample/run_judge.hpp"
#include "diff/stencil.hpp"
#include "diff/verdict.hpp"
#include "diff/whole_case.hpp"

namespace diff {

namespace {

// One comparison's state; the phases of a sample stand in judge_sample().
class Comparison {
  public:
    Comparison(const cases::Case& c, const ref::Expectation& expectation,
               const capture::CaptureView& capture, const ref::ValueSelection& selection,
               bool is_by_sample, std::span<const SampleMark> marks = {},
               std::span<const ref::ColorWitness> witnesses = {}, Wanted wanted = Wanted::all)
        : case_(c),
          expectation_(expectation),
          capture_(capture),
          attribution_(c, expectation),
          values_(c, expectation.limits, expectation.profile),
          selection_(selection),
          marks_(marks),
          last_fragment_(c, expectation, capture_, selection_, attribution_, values_),
          has_pixel_rules_(selection.is_all() && c.target.has_instruments && has_pixel_rules(c)),
          has_discards_(std::ranges::any_of(
              c.draws,
              [](const cases::Draw& draw) { return draw.discard != cases::Discard::none; })),
          stores_discarded_(cases::stores_discarded(c)),
          stops_at_first_(wanted == Wanted::first_finding),
          has_runs_(!is_by_sample && !has_pixel_rules_ && selection.is_all() && !stores_discarded_),
          run_judge_(c, expectation, capture_, values_) {
        values_.judge_only(selection);
        last_fragment_.need_ratios(wanted == Wanted::all);
        if (wanted == Wanted::symptoms) {
            values_.tell_loosest_levels();
        }
        values_.tell_only(
            [this](const ref::ValueMismatch& m) { return last_fragment_.is_told(m, verdict_); });
        if (c.target.color) {
            color_.emplace(c, expectation, capture_, attribution_, witnesses);
        }
        if (ref::stencil::is_needed(c)) {
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
        verdict_.has_counted = case_.target.has_instruments;
        verdict_.marks.assign(count, SampleMark::ok);
        if (case_.target.has_instruments) {
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
                index += judged;
                continue;
            }
            const cases::SampleId id = cases::sample_at(target, index);
            judge_sample(index, id);
            if (!verdict_.error.empty()) {
                return std::move(verdict_);
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
        verdict_.error = is_enough()
                             ? judge_dependent_planes(
                                   capture_, expectation_.profile, [](const Finding&) {}, nullptr)
                             : judge_dependent_planes(
                                   capture_, expectation_.profile,
                                   [this](Finding finding) { add(std::move(finding)); },
                                   stencil_ ? &*stencil_ : nullptr);
        if (!is_enough() && selection_.is_all() && has_fragment_rules(case_, expectation_)) {
            check_fragments(case_, expectation_, capture_,
                            [this](Finding finding) { add(std::move(finding)); });
        }
        if (!is_enough()) {
            judge_queries(case_, capture_, attribution_, verdict_);
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
        const bool is_colour_alone = !case_.target.has_instruments && color_;
        if (!has_runs_ || (is_colour_alone && (case_.target.has_depth || !color_->is_uniform()))) {
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
        judge_color(index, cases::sample_at(case_.target, index), right.triangle);
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
        if (!case_.target.has_instruments) {
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
        const ref::HitBounds& bounds = expected.hits;
        const capture::SampleState state = capture::sample_state(capture_, index);
        if (state == capture::SampleState::clear && bounds == ref::HitBounds{} && !color_ &&
            !stores_discarded_) {
            ++verdict_.compared_samples;  // marks and hits are zero already
            return;
        }
        note_expected(index, 1);
        ++verdict_.compared_samples;

        if (!case_.target.has_instruments && state == capture::SampleState::drawn) {
            verdict_.device_hits[index] = color_->hits_for_pictures(index);
            judge_color(index, id, std::nullopt);
            return;
        }
        switch (state) {
            case capture::SampleState::not_copied:
                verdict_.error = not_copied(id);
                return;
            case capture::SampleState::inconsistent:
                add_contradiction(index, id, ref::ReasonKind::planes_contradict);
                return;
            case capture::SampleState::depth_only:
                if (!stores_discarded_ || expected.depth_count == 0) {
                    add_contradiction(index, id,
                                      has_discards_ ? ref::ReasonKind::depth_of_taken
                                      : cases::tests_bounds(case_) && expected.depth_may_be_clear
                                          ? ref::ReasonKind::depth_of_bounded
                                          : ref::ReasonKind::planes_contradict);
                    return;
                }
                break;
            case capture::SampleState::clear:
            case capture::SampleState::drawn:
                break;
        }

        const auto front = static_cast<uint32_t>(capture_.hits[index].x);
        const auto back = static_cast<uint32_t>(capture_.hits[index].y);
        verdict_.device_hits[index] = static_cast<uint8_t>(std::min(front + back, 255U));
        if (!bounds.allows(front, back)) {
            Finding finding = finding_at(kind_of(bounds, front, back), case_.target, id);
            attribution_.attribute_hits(finding, front, back, last_fragment_.last_hit(index));
            add(std::move(finding));
            return;
        }
        if (front + back > 0) {
            judge_fragment(index, id);
        } else {
            judge_color(index, id, std::nullopt);
            if (std::optional<Finding> finding =
                    stores_discarded_ ? last_fragment_.judge_unhit(index, id) : std::nullopt) {
                add(std::move(*finding));
            }
        }
    }

    void add_contradiction(size_t index, cases::SampleId id, ref::ReasonKind why) {
        Finding finding = finding_at(FindingKind::value, case_.target, id);
        tell(finding, why);
        finding.level = cases::Profile::vulkan;
        finding.quantity = "attachments";
        finding.expected = "all attachments written by the same fragments";
        finding.got = contradiction_text(capture_, index);
        verdict_.device_hits[index] = 255;
        add(std::move(finding));
    }

    void judge_fragment(size_t index, cases::SampleId id) {
        LastFragment::Outcome outcome = last_fragment_.judge(index, id);
        if (outcome.finding) {
            add(std::move(*outcome.finding));
        }
        if (!outcome.triangle) {
            return;
        }
        verdict_.compared_values += outcome.compared_values;
        note_worst(outcome.worst_ratio, outcome.worst_quantity, id);
        verdict_.raise_error(index, outcome.worst_ratio);
        judge_color(index, id, outcome.triangle);
        for (Finding& finding : outcome.values) {
            add(std::move(finding));
        }
    }

    void judge_color(size_t index, cases::SampleId id, std::optional<uint32_t> writer) {
        if (!color_ || has_wrong_hits(index)) {
            return;
        }
        ++verdict_.compared_values;
        if (std::optional<Finding> finding = color_->judge(index, id, writer)) {
            add(std::move(*finding));
        }
    }

    // By the marks of the verdict on other planes.
    bool has_wrong_hits(size_t index) const {
        return index < marks_.size() && marks_[index] > SampleMark::either &&
               marks_[index] != SampleMark::value;
    }

    static FindingKind kind_of(const ref::HitBounds& bounds, uint32_t front, uint32_t back) {
        const uint32_t total = front + back;
        const int32_t sign = static_cast<int32_t>(front) - static_cast<int32_t>(back);
        if (total < bounds.total_min) {
            return FindingKind::missing;
        }
        if (total > bounds.total_max) {
            return bounds.total_max == 0 ? FindingKind::extra : FindingKind::double_hit;
        }
        const bool too_few_front = front < bounds.front_min, too_few_back = back < bounds.back_min;
        const bool too_many_front = front > bounds.front_max,
                   too_many_back = back > bounds.back_max;
        if ((too_few_front && too_many_back) || (too_few_back && too_many_front)) {
            return FindingKind::value;  // the right number of hits, by the wrong face
        }
        if (too_few_front || too_few_back) {
            return FindingKind::missing;
        }
        if (too_many_front || too_many_back) {
            return FindingKind::double_hit;
        }
        // Only the signed sum of a closed mesh is wrong: a gap pulls it towards zero.
        return std::abs(sign) < std::abs(bounds.signed_min) ? FindingKind::missing
                                                            : FindingKind::double_hit;
    }

    void add(Finding finding) { verdict_.add(std::move(finding), case_.target); }

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::CaptureView& capture_;
    Attribution attribution_;
    ref::ValueReference values_;
    ref::ValueSelection selection_;
    std::span<const SampleMark> marks_;
    LastFragment last_fragment_;
    bool has_pixel_rules_ = false;
    bool has_discards_ = false;
    bool stores_discarded_ = false;
    bool stops_at_first_ = false;
    bool has_runs_ = false;  // what is plainly right is judged by runs of samples
    RunJudge run_judge_;
    std::optional<ColorComparison> color_;
    std::optional<StencilComparison> stencil_;
    Verdict verdict_;
};

}  // namespace

Verdict compare(const cases::Case& c, const ref::Expectation& expectation,
                const capture::CaptureView& capture, Wanted wanted,
                const ref::ValueSelection& selection) {
    return Comparison(c, expectation, capture, selection, false, {}, {}, wanted).run();
}

Verdict compare_colors(const cases::Case& c, const ref::Expectation& expectation,
                       const capture::CaptureView& capture, std::span<const SampleMark> marks,
                       std::span<const ref::ColorWitness> witnesses) {
    const bool has_wrong = std::ranges::any_of(
        marks, [](SampleMark mark) { return mark > SampleMark::either; });  // in no run of samples
    return Comparison(c, expectation, capture, {}, has_wrong || !witnesses.empty(), marks,
                      witnesses)
        .run();
}

Verdict compare_by_sample(const cases::Case& c, const ref::Expectation& expectation,
                          const capture::CaptureView& capture) {
    return Comparison(c, expectation, capture, {}, true).run();
}

}  // namespace diff
