// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// One sample at one profile: its planes one by one, since a plane that no path allows by itself has
// a rule and a reason of its own, and then together (observers.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "cases/model/sample.hpp"
#include "diff/attribution.hpp"
#include "diff/color.hpp"
#include "diff/delivery.hpp"
#include "diff/last_fragment.hpp"
#include "diff/observers.hpp"
#include "diff/stencil.hpp"
#include "diff/verdict.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"

namespace diff {

// What is found at a sample.
struct SampleOutcome {
    std::vector<Finding> findings;
    std::vector<Finding> stencils;  // told after those of all samples, which say more of a device
    SeenPlanes right;               // the planes that were not found wrong
    bool is_missing = false;        // it was not copied from the device: nothing is judged
    bool is_contradicted = false;   // its attachments contradict each other: nothing more is judged
    bool has_fragment = false;      // the values of its last fragment were judged:
    double worst_ratio = 0;         // their largest error, in budgets
    std::optional<ref::QuantityId> worst_quantity;
    uint64_t compared_values = 0;  // numbers, and one for a colour
};

class SampleJudge {
  public:
    // All must outlive this object. `is_told`: whether anybody will read the texts of a wrong value
    // that is judged now.
    using IsTold = std::function<bool(const ref::ValueMismatch&)>;
    SampleJudge(const cases::Case& c, const ref::Expectation& expectation,
                const capture::CaptureView& capture, const Delivery& delivery, Wanted wanted,
                IsTold is_told = {});
    SampleJudge(const SampleJudge&) = delete;  // its parts refer to each other
    SampleJudge& operator=(const SampleJudge&) = delete;

    // Judges a sample; `index` is that of `id`. The outcome holds until the next call.
    const SampleOutcome& judge(size_t index, cases::SampleId id);
    // The same of one plane, where the others are right.
    const SampleOutcome& judge_color_alone(size_t index, cases::SampleId id);
    const SampleOutcome& judge_stencil_alone(size_t index, cases::SampleId id);

    // All planes that were delivered of a sample.
    SeenPlanes all_of(size_t index);

    Attribution& attribution() { return attribution_; }
    ref::ValueReference& values() { return values_; }
    const LastFragment& last_fragment() const { return last_fragment_; }
    Observers& observers() { return observers_; }
    ColorComparison* color() { return color_ ? &*color_ : nullptr; }  // null: none was delivered

  private:
    void begin(size_t index, cases::SampleId id);
    void judge_all();
    void judge_hits();
    void judge_planes();
    void judge_fragment();
    void judge_bare();
    bool judge_depth_alone(bool is_unhit);
    bool may_store_unhit() const;
    void add_stray_depth();
    void judge_together(bool is_color_right = false);
    void judge_stencil();
    std::optional<Finding> judge_color(const SeenPlanes& seen);
    void add_contradiction(ref::ReasonKind why);
    void add(Finding finding) { out_.findings.push_back(std::move(finding)); }
    // Adds a finding of planes that are not asked together with all others. Where looser profiles
    // allow what it tells, they may deny the planes together: then that is its level.
    void add_of_sample(Finding finding, std::vector<Finding>& to);
    const std::vector<Finding>& found_at(cases::Profile profile);

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::CaptureView& capture_;
    const Delivery& delivery_;
    Attribution attribution_;
    ref::ValueReference values_;
    LastFragment last_fragment_;
    Observers observers_;
    std::optional<ColorComparison> color_;
    std::optional<StencilComparison> stencil_;  // if draws test it; else it counts hits
    const bool has_discards_;
    const bool stores_discarded_;
    std::array<std::unique_ptr<SampleJudge>, 3> looser_;  // by profile, made when first asked

    // The sample at hand.
    size_t index_ = 0;
    cases::SampleId id_;
    SeenPlanes seen_;  // that are not found wrong
    SampleOutcome out_;
};

}  // namespace diff
