// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What "run" knows before it asks the device: the cases, what is expected of them, and what an
// interrupted run has left.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/options/program.hpp"
#include "cli/prepare/run_plan.hpp"
#include "report/journal/journal.hpp"
#include "report/record/run.hpp"
#include "run/run_loop.hpp"

namespace cli {

// Everything that is known when drawing begins.
struct Prepared {
    RunOptions options;
    Selection selection;
    std::vector<run::Task> plan;  // the cases still to be run
    std::filesystem::path folder;
    report::Run header;
    bool is_resumed = false;
    std::optional<run::ExpectationLine> of_limits;  // what is expected of cases::kLimitsCase
};

Prepared prepare(const Program& program, const RunOptions& options);
// A run that goes on from its journal.
Prepared prepare_resume(const Program& program, const RunOptions& now);
// The options by which a run reaches out of its folder (" --json FILE"), which go beside --resume.
std::string words_to_agree(const RunOptions& options);

// The folder with its journal, begun with the header or, of a resumed run, gone on with.
report::Journal open_journal(const std::filesystem::path& folder, const report::Run& header,
                             bool resumed);

// The same of a prepared run, in a new folder if none was named; of reports of an earlier run in it
// nothing stays.
report::Journal begin_journal(Prepared& p, bool resumed);

// Finds the expectation files for the device of the header and what they say of the planned cases.
void apply_expectations(Prepared& p);

// The final record of cases::kLimitsCase, if the run has to tell of it and has not yet: where a
// limit is wrong, where it is selected, or where an expectation file names it.
std::optional<report::CaseRecord> limits_record(const Program& program, const Prepared& p,
                                                const capture::DeviceInfo& device);

}  // namespace cli
