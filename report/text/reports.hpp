// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Every report is a pure function of a Run.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/record/run.hpp"

namespace report {

// results.json, schema docs/schema/results-1.json. Floats never appear as NaN or infinity.
std::string to_json(const Run& run);

// junit.xml: valid XML 1.0 and UTF-8 whatever bytes a driver printed.
std::string to_junit(const Run& run);

// report.html: one file that opens by double click and loads nothing.
std::string to_html(const Run& run);
// The same, and further pages with the cases whose pictures would make it larger than 8 MB: part k
// (from 2 on) belongs beside the first in a file with "-k" before ".html".
std::vector<std::string> to_html_parts(const Run& run);

struct ConsoleStyle {
    bool color = false;
    bool verbose = false;     // adds an ASCII picture of each unexpected case
    uint32_t width = 100;     // columns
    bool wrap = false;        // lines are broken to fit the width
    std::string folder = {};  // of the run, for commands that take it; empty: they are left out
};
// First line of a run: tool version, device, driver, Vulkan version, subpixel bits, profile, seed.
std::string console_header(const Run& run, const ConsoleStyle& style);
// What is printed at once for an unexpected result: three lines (what, why, how to repeat it), and
// a fourth with the command that explains its first wrong sample, if there is one, or that brings
// the expectation file up to date.
std::string console_case(const CaseRecord& record, const ConsoleStyle& style);
// Last lines: totals, worst error in budgets, where the report lies, exit code with its meaning
// (`exit_words`, or, if empty, those of the run).
std::string console_summary(const Run& run, const std::string& report_path,
                            const ConsoleStyle& style, const std::string& exit_words = {});

// Text that a driver or file may have filled with anything, made safe for a terminal or XML:
// valid UTF-8, no control characters but newline and tab (shown as \xNN).
std::string printable(std::string_view bytes);
// The same as text or an attribute value in double quotes of HTML and XML: printable() leaves only
// what XML 1.0 allows (section 2.2); ">" is escaped too, so that "]]>" never appears.
std::string markup(std::string_view bytes);

}  // namespace report
