// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "cases/base/counted.hpp"
#include "cases/model/derive.hpp"
#include "diff/attribution.hpp"
#include "diff/color.hpp"
#include "diff/contradiction.hpp"
#include "diff/last_fragment.hpp"
#include "diff/pixel_check.hpp"
#include "diff/resolve.hpp"
#include "diff/verdict.hpp"

namespace diff {

namespace {

// With so many findings a case that breaks profile vulkan, the loosest, has wrong values counted
// only: they are known to break the asked profile, and count with the rule that the same quantity
// broke before.
constexpr uint64_t kMaxReasoned = 1000;

// One comparison's state; the phases of a sample stand in judge_sample().
class Comparison {
  public:
    Comparison(const cases::Case& c, const ref::Expectation& expectation,
               const capture::CaptureView& capture, const ref::ValueSelection& selection)
        : case_(c),
          expectation_(expectation),
          capture_(capture),
          attribution_(c, expectation),
          values_(c, expectation.limits, expectation.profile),
          selection_(selection),
          last_fragment_(c, expectation, capture_, selection_, attribution_, values_),
          has_pixel_rules_(selection.is_all() && c.target.has_instruments && has_pixel_rules(c)) {
        values_.judge_only(selection);
        if (c.target.color) {
            color_.emplace(c, expectation, capture_, attribution_);
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
        const size_t count = capture_.sample_count();
        verdict_.expected_hits.resize(count);
        verdict_.device_hits.resize(count);
        verdict_.marks.assign(count, SampleMark::ok);
        if (case_.target.has_instruments) {
            verdict_.error_ratios.assign(count, -1.0F);
        }
        const cases::Target& target = case_.target;
        size_t index = 0;
        for (uint32_t row = 0; row < target.rows(); ++row) {
            const uint32_t y = row % target.height;
            const uint32_t layer = row / target.height;
            for (uint32_t x = 0; x < target.width; ++x) {
                for (uint32_t s = 0; s < target.samples; ++s, ++index) {
                    judge_sample(index, {x, y, s, layer});
                    if (!verdict_.error.empty()) {
                        return std::move(verdict_);
                    }
                }
                if (has_pixel_rules_) {
                    for (Finding& finding :
                         check_pixel(case_, expectation_, capture_, {x, y, 0, layer})) {
                        add(std::move(finding));
                    }
                }
            }
        }
        verdict_.error = judge_dependent_planes(
            capture_, expectation_.profile, [this](Finding finding) { add(std::move(finding)); });
        return std::move(verdict_);
    }

  private:
    // Why there is nothing to judge; empty if there is.
    std::string unusable() const {
        if (capture_.target != case_.target || !capture::has_all_planes(capture_)) {
            return fmt::format(
                "the capture has another size than the case's {}x{} target with {}{}",
                case_.target.width, case_.target.height,
                cases::counted(case_.target.samples, "sample"),
                case_.target.layers > 1 ? fmt::format(" and {} layers", case_.target.layers) : "");
        }
        const size_t attributes = cases::attributes_of(case_);
        for (size_t a = 0; a < attributes; ++a) {
            if (case_.target.has_instruments && capture_.attribute_count <= a) {
                return fmt::format("the capture lacks attribute {} of the case", a);
            }
        }
        if (expectation_.must_samples == 0) {
            return "the case has no sample that must be covered, so a black picture would pass; "
                   "add a control triangle";
        }
        return {};
    }

    void judge_sample(size_t index, cases::SampleId id) {
        const ref::SampleExpectation& expected = expectation_.samples[index];
        const ref::HitBounds& bounds = expected.hits;
        const capture::SampleState state = capture::sample_state(capture_, index);
        if (state == capture::SampleState::clear && bounds == ref::HitBounds{} && !color_) {
            ++verdict_.compared_samples;  // marks and hits are zero already
            return;
        }
        verdict_.expected_hits[index] = bounds.total_min == bounds.total_max
                                            ? static_cast<uint8_t>(std::min(bounds.total_min, 254U))
                                            : uint8_t{255};
        if (!bounds.is_decided()) {
            verdict_.marks[index] = SampleMark::either;
        }
        ++verdict_.compared_samples;

        if (!case_.target.has_instruments && state == capture::SampleState::drawn) {
            verdict_.device_hits[index] = color_->hits_for_pictures(index);
            judge_color(index, id, std::nullopt);
            return;
        }
        switch (state) {
            case capture::SampleState::not_copied:
                verdict_.error = fmt::format(
                    "sample {} of {} was not copied from the device: it still holds the read-back "
                    "memory's fill pattern",
                    id.sample, cases::pixel_text(case_.target, id));
                return;
            case capture::SampleState::inconsistent: {
                Finding finding = finding_at(FindingKind::value, case_.target, id);
                tell(finding, ref::ReasonKind::planes_contradict);
                finding.level = cases::Profile::vulkan;
                finding.quantity = "attachments";
                finding.expected = "all attachments written by the same fragments";
                finding.got = contradiction_text(capture_, index);
                verdict_.device_hits[index] = 255;
                add(std::move(finding));
                return;
            }
            case capture::SampleState::clear:
            case capture::SampleState::drawn:
                break;
        }

        const auto front = static_cast<uint32_t>(capture_.hits[index].x);
        const auto back = static_cast<uint32_t>(capture_.hits[index].y);
        verdict_.device_hits[index] = static_cast<uint8_t>(std::min(front + back, 255U));
        if (!bounds.allows(front, back)) {
            Finding finding = finding_at(kind_of(bounds, front, back), case_.target, id);
            attribution_.attribute_hits(finding, front, back);
            add(std::move(finding));
            return;
        }
        if (front + back > 0) {
            judge_fragment(index, id);
        } else {
            judge_color(index, id, std::nullopt);
        }
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
        if (outcome.worst_ratio > verdict_.worst_ratio) {
            verdict_.worst_ratio = outcome.worst_ratio;
            verdict_.worst_quantity = fmt::format(
                "{} at {}", outcome.worst_quantity ? to_text(*outcome.worst_quantity) : "",
                cases::sample_text(case_.target, id));
        }
        verdict_.raise_error(index, outcome.worst_ratio);
        judge_color(index, id, outcome.triangle);
        for (Finding& finding : outcome.values) {
            add(std::move(finding));
        }
    }

    void judge_color(size_t index, cases::SampleId id, std::optional<uint32_t> writer) {
        if (!color_) {
            return;
        }
        ++verdict_.compared_values;
        if (std::optional<Finding> finding = color_->judge(index, id, writer)) {
            add(std::move(*finding));
        }
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

    void add(Finding finding) {
        const bool is_told = finding.kind != FindingKind::value || !finding.got.empty();
        if (finding.kind == FindingKind::value) {
            std::string& rule = value_rules_[finding.quantity];
            if (is_told || rule.empty()) {
                rule = finding.rule;
            }
            finding.rule = rule;  // if it is not told, taken to be wrong as the last one that was
        }
        verdict_.add(std::move(finding), case_.target, is_told);
        if (!is_brief_ && verdict_.finding_total() >= kMaxReasoned &&
            verdict_.level == cases::Profile::vulkan) {
            is_brief_ = true;
            values_.judge_briefly();
        }
    }

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::CaptureView& capture_;
    Attribution attribution_;
    ref::ValueReference values_;
    ref::ValueSelection selection_;
    LastFragment last_fragment_;
    bool has_pixel_rules_ = false;
    std::optional<ColorComparison> color_;
    bool is_brief_ = false;                           // of values
    std::map<std::string, std::string> value_rules_;  // that was broken last, by quantity
    Verdict verdict_;
};

}  // namespace

Verdict compare(const cases::Case& c, const ref::Expectation& expectation,
                const capture::CaptureView& capture, const ref::ValueSelection& selection) {
    return Comparison(c, expectation, capture, selection).run();
}

}  // namespace diff
