// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The commands "report" and "version".
#include <cstdio>

#include "cli/commands.hpp"
#include "cli/outputs.hpp"
#include "cli/suite.hpp"
#include "report/journal.hpp"

namespace cli {

int report_command(const Program&, const ReportOptions& options) {
    const cases::Expected<report::Run> run = report::load_journal(options.directory);
    if (!run) {
        return report_stop({report::kExitInvalidFile, {cases::to_string(run.error())}});
    }
    const ReportFiles files{options.directory, options.json, options.junit, options.html};
    const cases::Errors errors = write_reports(*run, files);
    const bool stdout_taken = options.json == "-" || options.junit == "-" || options.html == "-";
    std::FILE* console = stdout_taken ? stderr : stdout;
    const report::ConsoleStyle style = console_style(console, options.color, options.verbose);
    if (!options.quiet) {
        std::fputs(report::console_header(*run, style).c_str(), console);
    }
    for (const report::CaseRecord& record : run->cases) {
        if (!report::is_expected(record.status) && record.status != report::Status::not_run) {
            std::fputs(report::console_case(record, style).c_str(), console);
        }
    }
    if (!options.quiet) {
        const std::string html = (files.folder / "report.html").string();
        std::fputs(report::console_summary(*run, html, style).c_str(), console);
    }
    for (const cases::Error& error : errors) {
        std::fprintf(stderr, "edgecase: %s\n", cases::to_string(error).c_str());
    }
    return errors.empty() ? report::kExitOk : report::kExitInternal;
}

int version_command() {
    std::printf("edgecase %s\ncase format 1, results schema 1, expectation format 1\n", kVersion);
    return report::kExitOk;
}

}  // namespace cli
