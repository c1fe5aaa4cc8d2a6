// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "compare": the folders of runs side by side.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "cli/commands.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/suite.hpp"
#include "report/compare/comparison.hpp"
#include "report/journal/journal.hpp"
#include "report/text/sentences.hpp"

namespace cli {

namespace {

namespace fs = std::filesystem;

struct CompareOptions {
    std::vector<std::string> directories;
    std::string json, html;
    bool verbose = false, common = false, strict = false;
    When color = When::automatic;
};

// The address of a run's page, seen from another page; empty if there is none.
std::string report_address(const std::string& page, const std::string& folder) {
    std::error_code error;
    const fs::path report = fs::path(folder) / "report.html";
    if (!fs::exists(report, error)) {
        return {};
    }
    const fs::path from = page == "-" ? fs::path() : fs::path(page).parent_path();
    const fs::path way = fs::proximate(report, from.empty() ? fs::path(".") : from, error);
    std::string address = way.is_absolute() ? "file://" : "";
    for (const char c : way.generic_string()) {
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                              (c >= '0' && c <= '9') ||
                              std::string_view("/-._~").find(c) != std::string_view::npos;
        address +=
            is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return address;
}

int carry_out(const Program&, const CompareOptions& options) {
    std::vector<report::NamedRun> runs;
    for (const std::string& folder : options.directories) {
        runs.push_back({folder, must_read(report::load_journal(folder))});
    }
    const report::Comparison comparison =
        must(report::compare_runs(runs, {options.common, options.strict}), report::kExitUsage);
    std::FILE* console = console_beside(options.json, {}, options.html);
    const report::ConsoleStyle style = console_style(console, options.color, options.verbose);
    cases::Errors errors;
    write_asked(options.html, errors, [&] {
        std::vector<std::string> reports;
        for (const std::string& folder : options.directories) {
            reports.push_back(report_address(options.html, folder));
        }
        return report::comparison_html(runs, comparison, reports);
    });
    write_asked(options.json, errors, [&] { return report::comparison_json(runs, comparison); });
    const std::string exit =
        errors.empty() ? std::string()
                       : report::exit_text(report::kExitInternal, "a file could not be written");
    std::fputs(report::comparison_text(runs, comparison, style, exit).c_str(), console);
    std::fflush(console);
    for (const cases::Error& error : errors) {
        complain(error.message);
    }
    return errors.empty() ? report::exit_code(comparison) : report::kExitInternal;
}

void declare(CLI::App& app, CompareOptions& o) {
    app.add_option("DIR", o.directories, "the folders of runs, the first is the base")
        ->required()
        ->type_name("");
    app.add_option("--json", o.json, "write the comparison to FILE ('-': standard output)")
        ->type_name("FILE");
    app.add_option("--html", o.html, "write a page with both sides of each case to FILE")
        ->type_name("FILE");
    app.add_flag("-v,--verbose", o.verbose,
                 "list every difference, draw where kept pictures differ");
    app.add_flag("--common", o.common, "leave out cases that a run lacks");
    app.add_flag("--strict", o.strict, "exit 1 with any difference of bits");
    add_choice(&app, "--color", o.color, when_names(), "colours");
}

}  // namespace

Command compare_command() {
    return make_command<CompareOptions>(
        {"compare", kChecking, "set runs side by side",
         "  edgecase compare out/before out/after     regressions and fixes\n"
         "  edgecase compare out/lavapipe out/swiftshader -v --json differences.json\n"
         "  edgecase compare out/lavapipe out/swiftshader --html differences.html\n"},
        declare, carry_out);
}

}  // namespace cli
