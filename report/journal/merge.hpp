// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The parts of one run, drawn by several jobs, put together again.
#pragma once

#include <string>
#include <vector>

#include "cases/base/error.hpp"
#include "report/record/run.hpp"

namespace report {

struct Part {
    std::string name;  // its folder, for sentences
    Run run;
};

// One run, its cases in the order of their ids; it knows which shards no part holds, and lacks them
// wherever it is looked at. Error, one sentence: a case in two parts; parts with different devices,
// drivers, profiles, suites, numbers of shards or versions of the program; parts of different
// selections, or judged by different expectation files or options.
cases::Expected<Run> merge_runs(std::vector<Part> parts);

}  // namespace report
