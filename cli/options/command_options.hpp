// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The option table of every command. Only this, shared_options and command_line.cpp know CLI11.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/options/options.hpp"

namespace cli {

struct AllOptions {
    RunOptions run;
    GtestOptions gtest;
    ListOptions list;
    LintOptions lint;
    ExplainOptions explain;
    RenderOptions render;
    ExportOptions export_cases;
    DiffOptions diff;
    DoctorOptions doctor;
    BenchOptions bench;
    ReportOptions report;
    FuzzOptions fuzz;
    ReduceOptions reduce;
    DiagnoseOptions diagnose;
    ProbeOptions probe;
    ExpectOptions expect;
    CompareOptions compare;
    std::string shell;  // of completion
    bool version = false;
};

// Declares all commands and options; parsing fills `all`.
void define(CLI::App& app, AllOptions& all);

}  // namespace cli
