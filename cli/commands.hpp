// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The commands, each in a file with its name.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cli/options/command.hpp"
#include "cli/options/options.hpp"
#include "cli/options/program.hpp"
#include "report/record/run.hpp"

namespace cli {

Command run_command();
Command gtest_command();
Command fuzz_command();
Command reduce_command();
Command diagnose_command();
Command probe_command();
Command list_command();
Command doors_command();
Command lint_command();
Command explain_command();
Command render_command();
Command export_command();
Command diff_command();
Command doctor_command();
Command report_command();
Command expect_command();
Command compare_command();
Command bench_command();
Command completion_command();
Command man_command();
Command version_command();

// All of them, in the order in which help lists them.
std::span<const Command> all_commands();

// A run that tells its results in words of its own: nothing else goes to standard output.
struct RunTeller {
    std::function<bool(const std::string& id)> takes;  // which of the selected cases are run
    std::function<void(const std::vector<std::string>& ids)> begin;  // drawing begins
    std::function<bool(const report::CaseRecord&)> end;  // of one case; false ends the run
};
int run_with(const Program& program, const RunOptions& options, const RunTeller& teller);

// Parses the command line and carries it out.
int edgecase_main(int argc, const char* const* argv);

}  // namespace cli
