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

struct Merged {
    Run run;                               // cases in the order of their ids
    std::vector<uint32_t> missing_shards;  // of --shard I/N: those that no part holds
};

// Error, one sentence: a case in two parts; parts with different devices, drivers, profiles,
// suites, numbers of shards or versions of the program.
cases::Expected<Merged> merge_runs(std::vector<Part> parts);

}  // namespace report
