// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a terminal is told of unexpected results: in the end the worst few in full, in the order of
// their causes (causes.hpp); with -v each of them while they come in, in the order of the
// selection. The order of their arrival decides nothing, so that two identical runs print the same.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "report/record/run.hpp"
#include "report/text/console.hpp"

namespace report {

// Unexpected results that are told one by one; of more, console_summary() tells the causes, and
// here the smallest case of each of the first few.
inline constexpr size_t kHandful = 5;

class UnexpectedResults {
  public:
    // `ids`: of all cases that will come, in the order in which they are told.
    UnexpectedResults(const std::vector<std::string>& ids, ConsoleStyle style);
    // What to print now that a case has ended, expected or not: with -v it and what waited for it,
    // else nothing.
    std::string add(const CaseRecord& record);
    // What to print when no more will come.
    std::string rest();
    // Unexpected results that have come in, told or not.
    size_t count() const { return count_; }

  private:
    std::string worst() const;

    ConsoleStyle style_;
    std::unordered_map<std::string, size_t> place_;  // of each id in the order
    std::map<size_t, std::string> waiting_;          // texts by place; empty where all is expected
    size_t next_ = 0;                                // the first place that has not ended
    size_t count_ = 0;
    // Without -v: by place, what causes() asks of a record, and its text.
    std::map<size_t, std::pair<CaseRecord, std::string>> kept_;
};

}  // namespace report
