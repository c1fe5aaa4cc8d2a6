// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "compare": the folders of runs side by side.
#include <cstdio>

#include "cli/commands.hpp"
#include "cli/outputs.hpp"
#include "cli/suite.hpp"
#include "report/comparison.hpp"
#include "report/journal.hpp"

namespace cli {

int compare_command(const Program&, const CompareOptions& options) {
    std::vector<report::NamedRun> runs;
    for (const std::string& folder : options.directories) {
        cases::Expected<report::Run> run = report::load_journal(folder);
        if (!run) {
            return report_stop({report::kExitInvalidFile, {cases::to_string(run.error())}});
        }
        runs.push_back({folder, std::move(*run)});
    }
    const cases::Expected<report::Comparison> comparison = report::compare_runs(runs);
    if (!comparison) {
        return report_stop({report::kExitUsage, {comparison.error().message}});
    }
    std::FILE* console = options.json == "-" ? stderr : stdout;
    const report::ConsoleStyle style = console_style(console, options.color, options.verbose);
    std::fputs(report::comparison_text(runs, *comparison, style).c_str(), console);
    std::fflush(console);
    if (!options.json.empty()) {
        const std::string json = report::comparison_json(runs, *comparison);
        if (const auto written = write_text(options.json, json); !written) {
            return report_stop({report::kExitInternal, {written.error().message}});
        }
    }
    return report::exit_code(*comparison);
}

}  // namespace cli
