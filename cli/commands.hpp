// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// One function a command; each returns an exit code of report/record/run.hpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/options/options.hpp"
#include "cli/options/program.hpp"
#include "report/record/run.hpp"

namespace cli {

int run_command(const Program& program, const RunOptions& options);
// A run that tells its results in words of its own: nothing else goes to standard output.
struct RunTeller {
    std::function<bool(const std::string& id)> takes;  // which of the selected cases are run
    std::function<void(const std::vector<std::string>& ids)> begin;  // drawing begins
    std::function<bool(const report::CaseRecord&)> end;  // of one case; false ends the run
};
int run_with(const Program& program, const RunOptions& options, const RunTeller& teller);
int gtest_command(const Program& program, const GtestOptions& options);
int fuzz_command(const Program& program, const FuzzOptions& options);
int reduce_command(const Program& program, const ReduceOptions& options);
int diagnose_command(const Program& program, const DiagnoseOptions& options);
int probe_command(const Program& program, const ProbeOptions& options);
int doors_command();
int list_command(const Program& program, const ListOptions& options);
int lint_command(const Program& program, const LintOptions& options);
int explain_command(const Program& program, const ExplainOptions& options);
int render_command(const Program& program, const RenderOptions& options);
int export_command(const Program& program, const ExportOptions& options);
int diff_command(const Program& program, const DiffOptions& options);
int doctor_command(const Program& program, const DoctorOptions& options);
int bench_command(const Program& program, const BenchOptions& options);
int report_command(const Program& program, const ReportOptions& options);
int expect_command(const Program& program, const ExpectOptions& options);
int compare_command(const Program& program, const CompareOptions& options);
int completion_command(const std::string& shell);
int man_command();
int version_command();

// Parses the command line and carries it out.
int edgecase_main(int argc, const char* const* argv);

}  // namespace cli
