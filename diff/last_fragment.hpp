// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The fragment that a sample holds: which triangle it says it is of, and whether that one may have
// been the last and gives its values.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "cases/model/sample.hpp"
#include "diff/attribution.hpp"
#include "diff/delivery.hpp"
#include "diff/sample/fragment_part.hpp"
#include "diff/verdict.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"

namespace diff {

// What a capture with instruments holds at a sample; depth 0 if it has none.
ref::FragmentValues values_at(const capture::CaptureView& capture, size_t index);

class LastFragment {
  public:
    // All must outlive this object; `values` judges what was delivered.
    LastFragment(const cases::Case& c, const ref::Expectation& expectation,
                 const capture::CaptureView& capture, const Delivery& delivery,
                 Attribution& attribution, ref::ValueReference& values)
        : case_(c),
          expectation_(expectation),
          capture_(capture),
          selection_(delivery.values),
          has_writers_(delivery.has_writers),
          attribution_(attribution),
          values_(values) {}

    struct Outcome {
        std::optional<uint32_t> triangle;  // none: none of those that may be last wrote it
        // Without a triangle: what is said of the writer. Else of depth that the triangle did not
        // write.
        std::optional<Finding> finding;
        std::vector<Finding> values;  // that the triangle does not give
        bool is_depth_wrong = false;  // it is one of them
        bool are_others_wrong = false;
        double worst_ratio = 0;                         // largest error of the values, in budgets
        std::optional<ref::QuantityId> worst_quantity;  // whose
        uint64_t compared_values = 0;                   // numbers
    };

    // Whose hit the sample says was the last.
    LastHit last_hit(size_t index) const;

    // Judges a sample that was hit as often as it may be; `index` is that of `id`.
    Outcome judge(size_t index, cases::SampleId id);

    // Judges the depth of a sample of which no fragment is asked: none hits it, or nothing is known
    // of that.
    std::optional<Finding> judge_depth_alone(size_t index, cases::SampleId id);

    // True while it judges a value whose texts go into a finding of another rule.
    bool needs_texts() const { return judges_older_depth_; }
    // Whether anybody will read how large errors are; otherwise they are told only where they
    // choose between triangles.
    void need_ratios(bool are_needed) { needs_ratios_ = are_needed; }
    // How many numbers of a fragment of triangle t are compared.
    uint64_t values_of(uint32_t t) const;

    // Whether a sample's writer, if that was delivered, is a triangle.
    bool wrote(size_t index, uint32_t t) const {
        return !has_writers_ || wrote(capture_.writers[index], expectation_.triangles[t]);
    }

  private:
    bool wrote(const capture::Writer& writer, const cases::Triangle& t) const;
    bool is_provoking(const capture::Writer& writer) const;
    bool provokes_by_last(uint32_t draw) const;
    Finding value_finding(cases::SampleId id, ref::ValueMismatch mismatch, uint32_t t) const;
    std::optional<Finding> judge_older_depth(cases::SampleId id,
                                             const ref::SampleExpectation& expected,
                                             const ref::FragmentValues& device);
    Finding writer_finding(cases::SampleId id, const capture::Writer& writer,
                           const ref::SampleExpectation& expected);

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::CaptureView& capture_;
    const ref::ValueSelection& selection_;
    const bool has_writers_;  // else any of the triangles may be the one
    Attribution& attribution_;
    ref::ValueReference& values_;
    bool needs_ratios_ = true;
    bool judges_older_depth_ = false;
};

}  // namespace diff
