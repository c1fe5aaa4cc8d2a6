// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a run prints on the terminal, a pure function of a Run.
#pragma once

#include <cstdint>
#include <string>

#include "report/record/run.hpp"

namespace report {

struct ConsoleStyle {
    bool color = false;
    bool verbose = false;     // adds an ASCII picture of each unexpected case
    uint32_t width = 100;     // columns
    bool wrap = false;        // lines are broken to fit the width
    std::string folder = {};  // of the run, for commands that take it; empty: they are left out
    bool totals_are_told = false;  // before the summary: it leaves them out
    bool quiet = false;            // nothing follows the unexpected cases
};
// First line of a run: tool version, device, driver, Vulkan version, subpixel bits, profile, seed.
std::string console_header(const Run& run, const ConsoleStyle& style);
// What is printed for an unexpected result: three lines (what, why, how to repeat it), and a fourth
// with the command that explains its first wrong sample, if there is one, or that brings the
// expectation file up to date. Of a crash or a hang the driver's last lines follow, and the command
// that runs it under a debugger.
std::string console_case(const CaseRecord& record, const ConsoleStyle& style);
// "1493 cases  1040 pass  453 fail   12.3 s   seed 0".
// What over half of the cases fail by that a run has looked at first: the diagnosis, and the
// smallest case with its picture. Empty if fewer do.
std::string first_look_text(const Run& run, const ConsoleStyle& style);
std::string console_totals(const Run& run, const ConsoleStyle& style);
// Last lines: the causes of unexpected results, if they are more than a handful (kHandful) or
// style.verbose, one line each with the smallest case and how to repeat it; totals (unless they are
// told), worst error in budgets, where the report lies, exit code with its meaning
// (`exit_words`, or, if empty, those of the run).
std::string console_summary(const Run& run, const std::string& report_path,
                            const ConsoleStyle& style, const std::string& exit_words = {});

}  // namespace report
