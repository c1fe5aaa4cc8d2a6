// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs of samples that are plainly right: those that nothing may hit and that are clear, and those
// that one triangle must cover and that hold its fragment. Nearly all samples of nearly all cases
// are of these kinds; whatever is not proven right here is judged sample by sample.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"

namespace diff {

class RunJudge {
  public:
    // All must outlive this object; the capture has the planes of a case with instruments.
    RunJudge(const cases::Case& c, const ref::Expectation& expectation,
             const capture::CaptureView& capture, ref::ValueReference& values)
        : case_(c), expectation_(expectation), capture_(capture), values_(values) {}

    struct Right {
        size_t count = 0;
        std::optional<uint32_t> triangle;  // that wrote them; none: they are clear
        std::span<const double> ratios;    // largest error of each fragment in budgets, at most 1
    };
    // How many samples from `index` on, of `count` in one row with the same expectation, are right
    // but for their colour. The ratios hold until the next call.
    Right judge(size_t index, size_t count);

  private:
    std::optional<uint32_t> only_writer(const ref::SampleExpectation& expected) const;

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::CaptureView& capture_;
    ref::ValueReference& values_;
    std::vector<double> ratios_;
};

}  // namespace diff
