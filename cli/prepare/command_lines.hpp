// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command lines that a record names, quoted for a shell: they repeat how a run was set up.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/model/case.hpp"
#include "cli/options/options.hpp"
#include "cli/options/program.hpp"
#include "report/record/run.hpp"

namespace cli {

// How a command line names a selected case: by its id, or by its file, and a leaf of it, if it is
// none of the suite's.
std::string selector_of(const RunOptions& options, const std::string& id);

// How a rerun differs from its run.
struct Rerun {
    std::string doors = {};              // --doors; empty: the case goes through none
    uint32_t repeats = 0;                // drawings, if the run has fewer
    std::vector<std::string> with = {};  // ids of cases that are drawn with it
};
std::string rerun_line(const Program& program, const RunOptions& options, const std::string& id,
                       const Rerun& rerun = {});
std::string diff_line(const Program& program, const DiffOptions& options, const std::string& id);
// Explains the first wrong sample of a record; empty if it has none.
std::string explain_line(const Program& program, const RunOptions& options,
                         const JudgedDevice& device, const cases::Case& c,
                         const report::CaseRecord& record);

// Gives a final record its lines: to draw it again, to explain it, to reproduce it. A wrong picture
// is drawn through the one door that its leading finding takes, or through none; deaths, flakes and
// what ended better than expected keep all doors.
void add_command_lines(const Program& program, const RunOptions& options,
                       const JudgedDevice& device, const cases::Case& c,
                       report::CaseRecord& record);

// The level of --fail-at, unless it is the profile anyway.
std::optional<cases::Profile> own_fail_level(const RunOptions& options);
// The options that change what counts as expected, as they would be given: RunHeader::settings.
std::string settings_of(const RunOptions& options);

// What was set of the variables that choose or change drivers, and PWD.
std::vector<std::pair<std::string, std::string>> recorded_environment();

}  // namespace cli
