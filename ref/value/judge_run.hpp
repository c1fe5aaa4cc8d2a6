// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The verdict on neighbouring fragments of one triangle, as far as the first stage alone (binary64
// against the unsnapped and the snapped basis) tells that they are right.
#pragma once

#include <span>
#include <vector>

#include "ref/value/accept/filter_run.hpp"
#include "ref/value/reference.hpp"
#include "ref/value/set_ups.hpp"

namespace ref::value {

class RunJudge {
  public:
    // As ValueReference::judge_run(), of the selected quantities.
    size_t judge(SetUps& set_ups, std::span<const Quantity> selected, uint32_t t,
                 const FragmentRun& run, std::span<double> ratios);

  private:
    std::vector<RunValue> values_;  // of the run that is being judged
};

}  // namespace ref::value
