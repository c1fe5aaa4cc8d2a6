// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "capture/runs.hpp"
#include "cases/base/counted.hpp"
#include "cases/model/derive.hpp"
#include "diff/delivery.hpp"
#include "diff/fragment_check.hpp"
#include "diff/pixel_check.hpp"
#include "diff/resolve.hpp"
#include "diff/sample/run_judge.hpp"
#include "diff/sample_judge.hpp"
#include "diff/shared_decisions.hpp"
#include "diff/verdict.hpp"
#include "diff/whole_case.hpp"

namespace diff {

namespace {

using Detail = ref::path::SeenHits::Detail;

// One comparison's state: samples one by one, or runs of them.
class Comparison {
  public:
    Comparison(const cases::Case& c, const ref::Expectation& expectation,
               const capture::CaptureView& capture, const Delivery& delivery, bool is_by_sample,
               Wanted wanted = Wanted::all)
        : case_(c),
          expectation_(expectation),
          capture_(capture),
          delivery_(delivery),
          samples_(c, expectation, capture_, delivery_, wanted,
                   [this](const ref::ValueMismatch& m) {
                       return verdict_.keeps(FindingKind::value, m.rule, m.level);
                   }),
          color_(samples_.color()),
          decisions_(c, expectation, capture_, samples_.observers()),
          has_decisions_(SharedDecisions::are_in(c, expectation.profile)),
          has_pixel_rules_(delivery.has_all_fragments() && has_pixel_rules(c)),
          stops_at_first_(wanted == Wanted::first_finding),
          has_runs_(!is_by_sample && !has_pixel_rules_ && !has_decisions_ &&
                    !cases::stores_discarded(c) &&
                    (delivery.has_instruments || delivery.has_color_alone())),
          run_judge_(c, expectation, capture_, samples_.values()) {
        verdict_.is_brief = wanted == Wanted::brief;
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
                verdict_.has_unmarked = true;
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
            if (id.sample + 1 == target.samples) {
                judge_pixel({id.x, id.y, 0, id.layer});
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
                case_, capture_, samples_.attribution(),
                [this](cases::Profile profile) {
                    return [this, profile](size_t index) { return shown_at(profile, index); };
                },
                verdict_);
        }
        return std::move(verdict_);
    }

  private:
    bool is_enough() const {
        const uint64_t enough =
            verdict_.level == cases::Profile::vulkan ? kBriefEnough : kBriefMost;
        return (stops_at_first_ && !verdict_.findings.empty()) ||
               (verdict_.is_brief && verdict_.finding_total() >= enough);
    }

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
        const SampleOutcome& first =
            samples_.judge_color_alone(index, cases::sample_at(case_.target, index));
        const bool is_right = first.findings.empty();
        take(first);
        if (!is_right || !color_->is_uniform()) {
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
            const SampleOutcome& outcome = samples_.judge_stencil_alone(k, id);
            if (outcome.is_missing) {
                verdict_.error = not_copied(id);
                return;
            }
            take(outcome);
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
        verdict_.compared_values +=
            right.count * samples_.last_fragment().values_of(*right.triangle);
        size_t worst = 0;
        for (size_t k = 0; k < right.count; ++k) {
            verdict_.raise_error(index + k, right.ratios[k]);
            worst = right.ratios[k] > right.ratios[worst] ? k : worst;
        }
        if (right.ratios[worst] > verdict_.worst_ratio) {
            const cases::SampleId id = cases::sample_at(case_.target, index + worst);
            const ref::FragmentVerdict v =
                samples_.values().judge(*right.triangle, id, values_at(capture_, index + worst));
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
        const bool is_clear = delivery_.has_instruments && !delivery_.has_stencil && !color_ &&
                              !stores_discarded_ && !has_decisions_ &&
                              expectation_.samples[index].hits == ref::HitBounds{} &&
                              capture::sample_state(capture_, index) == capture::SampleState::clear;
        ++verdict_.compared_samples;
        if (is_clear) {
            return;  // marks and hits are zero already
        }
        note_expected(index, 1);
        const SampleOutcome& outcome = samples_.judge(index, id);
        if (outcome.is_missing) {
            verdict_.error = not_copied(id);
            return;
        }
        const ref::path::SeenHits& hits = outcome.right.hits;
        verdict_.device_hits[index] = outcome.is_contradicted ? uint8_t{255}
                                      : hits.detail == Detail::none && color_
                                          ? color_->hits_for_pictures(index)
                                          : static_cast<uint8_t>(std::min(hits.total(), 255U));
        if (outcome.has_fragment) {
            note_worst(outcome.worst_ratio, outcome.worst_quantity, id);
            verdict_.raise_error(index, outcome.worst_ratio);
        }
        if (has_decisions_) {
            const bool is_right = outcome.findings.empty() && outcome.stencils.empty();
            of_pixel_.push_back(is_right ? std::optional(outcome.right) : std::nullopt);
        }
        take(outcome);
    }

    // What the samples of a pixel have to agree on, when all of them are judged.
    void judge_pixel(const cases::SampleId& pixel) {
        if (has_decisions_) {
            const size_t first = cases::index_of(case_.target, pixel);
            if (std::optional<Finding> finding = decisions_.judge(
                    pixel, of_pixel_,
                    color_ != nullptr ? &color_->reference(expectation_.profile, first)
                                      : nullptr)) {
                add(std::move(*finding));
            }
            of_pixel_.clear();
        }
        if (has_pixel_rules_) {
            for (Finding& finding : check_pixel(case_, expectation_, capture_, pixel)) {
                add(std::move(finding));
            }
        }
    }

    // What the planes of a sample show its queries.
    ref::ShownSample shown_at(cases::Profile profile, size_t index) {
        if (capture::sample_state(capture_, index) == capture::SampleState::inconsistent) {
            return {false, {}, {}};
        }
        SeenPlanes seen = samples_.all_of(index);
        const ref::SampleExpectation& expected =
            samples_.attribution().at(profile, index).samples[index];
        const bool is_right = expected.hits.allows(seen.hits);
        ref::ShownSample out{is_right, {}, seen.hits.total()};
        if (is_right && expected.is_open) {
            // What is wrong is a finding of its own, and values cost too much to be asked again.
            const bool has_finding = verdict_.marks[index] > SampleMark::either;
            seen.writer = seen.writer && !has_finding;
            seen.depth = seen.depth && !has_finding;
            seen.values = false;
            seen.stencil = seen.stencil && !has_finding && ref::stencil::is_needed(case_);
            const cases::SampleId id = cases::sample_at(case_.target, index);
            const ref::ColorWitness told = samples_.observers().witness(profile, index, id, seen);
            out.paths = told.paths;
            if (color_ != nullptr && !has_finding) {
                out.has_color = [=, this](const ref::path::Observed& paths) {
                    ref::ColorWitness witness = told;
                    witness.paths = paths;
                    return color_->reference(profile, index)
                        .explains(index, id, capture_.color[index], witness);
                };
            }
        }
        return out;
    }

    void take(const SampleOutcome& outcome) {
        verdict_.compared_values += outcome.compared_values;
        for (const Finding& finding : outcome.findings) {
            add(finding);
        }
        stencils_.insert(stencils_.end(), outcome.stencils.begin(), outcome.stencils.end());
        if (stencils_.size() > kMostStencils) {
            add_stencils();
        }
    }
    void add_stencils() {
        for (Finding& finding : std::exchange(stencils_, {})) {
            add(std::move(finding));
        }
    }
    void add(Finding finding) { verdict_.add(std::move(finding), case_.target); }

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::CaptureView& capture_;
    const Delivery delivery_;
    SampleJudge samples_;
    ColorComparison* const color_;  // null: no colour was delivered
    SharedDecisions decisions_;
    const bool has_decisions_;
    const bool has_pixel_rules_;
    const bool stops_at_first_;
    const bool has_runs_;  // what is plainly right is judged by runs of samples
    const bool stores_discarded_ = cases::stores_discarded(case_);
    RunJudge run_judge_;
    Verdict verdict_;
    std::vector<std::optional<SeenPlanes>> of_pixel_;  // of its samples so far, if they are right
    std::vector<Finding> stencils_;  // that are still to be told; of too many they are told at once
    static constexpr size_t kMostStencils = 4096;
};

}  // namespace

Verdict compare(const cases::Case& c, const ref::Expectation& expectation,
                const capture::CaptureView& capture, Wanted wanted) {
    return Comparison(c, expectation, capture, delivery_of(c), false, wanted).run();
}

Verdict compare_by_sample(const cases::Case& c, const ref::Expectation& expectation,
                          const capture::CaptureView& capture) {
    return Comparison(c, expectation, capture, delivery_of(c), true).run();
}

Verdict compare_planes(const cases::Case& c, const ref::Expectation& expectation,
                       const capture::CaptureView& capture, const Delivery& delivery,
                       Wanted wanted) {
    return Comparison(c, expectation, capture, delivery, false, wanted).run();
}

}  // namespace diff
