// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a run has seen so far of its cases, as far as a diagnosis asks for it, and which of them it
// looks at first.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "report/record/run.hpp"
#include "run/run_loop.hpp"

namespace cli {

// Records without what no diagnosis reads. It needs pictures, whether or not the reports keep them,
// and before these are made.
class SeenResults {
  public:
    void add(const report::CaseRecord& record);
    // A run with `header` that has the records of these cases alone, or of all.
    report::Run of(const report::RunHeader& header, const capture::DeviceInfo& device,
                   const std::set<std::string>* ids = nullptr) const;

  private:
    // A diagnosis looks at 64 failures, and at 192 more now and then: of so many the records are
    // kept as they are.
    static constexpr size_t kMostFailures = 2048;
    std::map<std::string, report::CaseRecord> records_;  // by id
    size_t failures_ = 0;
};

// Marks the plainest case that claims each rule, and of each way, as told: whatever else fails.
void choose_told(std::vector<run::Task>& plan);

// A run of many cases begins with the plainest ones of each family: where over half of them fail,
// that is told at once, and why.
class FirstLook {
  public:
    // Moves those that are looked at to the front of the plan, in the order of families' turns, and
    // marks them as told; none where the plan is short, since its end comes as soon.
    explicit FirstLook(std::vector<run::Task>& plan);
    bool holds(const report::CaseRecord& record) const { return ids_.contains(record.id); }
    // Whether with this record, judged for the first time or at its end, all of them have one; true
    // once.
    bool ends_with(const report::CaseRecord& record);
    const std::set<std::string>& ids() const { return ids_; }

    static constexpr size_t kMost = 64;
    static constexpr size_t kLeastPlan = 4 * kMost;

  private:
    std::set<std::string> ids_;
    std::set<std::string> open_;  // of them: not ended
};

}  // namespace cli
