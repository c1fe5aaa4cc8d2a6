// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "cli/commands.hpp"
#include "cli/diagnose.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/prepare/ci.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/suite.hpp"
#include "report/journal/journal.hpp"
#include "report/journal/merge.hpp"
#include "report/text/sentences.hpp"
#include "report/text/unexpected.hpp"

namespace cli {

namespace fs = std::filesystem;

namespace {

struct ReportOptions {
    std::vector<std::string> directories;  // one, several with --merge
    bool merge = false;
    std::string output;
    Ci ci = Ci::automatic;
    std::string json, junit, html;
    bool quiet = false, verbose = false;
    When color = When::automatic;
};

// The merged run as a folder of its own, so that every command that takes a run takes it.
cases::Expected<void> write_merged(const report::Run& run, const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        return cases::failure("the folder '" + folder.string() +
                              "' cannot be made: " + error.message());
    }
    cases::Expected<report::Journal> journal = report::Journal::open(folder, false);
    if (!journal) {
        return tl::unexpected(journal.error());
    }
    remove_reports({folder, {}, {}, {}});
    cases::Expected<void> written = journal->write_run(run);
    if (written) {
        written = journal->write_device(run.device);
    }
    for (const report::CaseRecord& record : run.cases) {
        if (written && record.status != report::Status::not_run) {
            written = journal->write_end(record);
        }
    }
    return written ? journal->write_stop(run) : written;
}

// What is to be reported, and where.
struct Source {
    report::Run run;
    fs::path folder;
};

Source load_one(const ReportOptions& options) {
    if (options.directories.size() != 1) {
        throw Stop{report::kExitUsage,
                   {"several folders need --merge; 'edgecase compare' sets runs side by side"}};
    }
    report::Run run = must_read(report::load_for_reports(options.directories.front()));
    const fs::path folder = options.output.empty() ? options.directories.front() : options.output;
    std::error_code error;
    fs::create_directories(folder, error);
    return Source{std::move(run), folder};
}

fs::path merged_folder(const ReportOptions& options) {
    return options.output.empty() ? "out/merged" : options.output;
}

Source load_merged(const Program& program, const ReportOptions& options) {
    Source source;
    source.folder = merged_folder(options);
    std::vector<report::Part> parts;
    bool is_diagnosed = false;
    for (const std::string& directory : options.directories) {
        std::error_code none;
        if (fs::equivalent(directory, source.folder, none)) {
            throw Stop{report::kExitUsage,
                       {"the merged run would overwrite '" + directory +
                        "', which is one of its parts; choose another folder with -o"}};
        }
        parts.push_back({directory, must_read(report::load_journal(directory))});
        is_diagnosed = is_diagnosed || !parts.back().run.diagnoses.empty();
    }
    report::Run merged = must(report::merge_runs(std::move(parts)), report::kExitInvalidFile);
    source.run = std::move(merged);
    if (is_diagnosed) {
        diagnose_again(program, source.run);
    }
    must(write_merged(source.run, source.folder), report::kExitInternal);
    return source;
}

// A merge that fails leaves nothing that looks like its result.
void forsake_merged(const ReportOptions& options) {
    const fs::path folder = merged_folder(options);
    const bool is_part =
        std::ranges::any_of(options.directories, [&](const std::string& directory) {
            std::error_code none;
            return fs::equivalent(directory, folder, none);
        });
    if (!is_part) {
        remove_reports_of_last_run(ReportFiles{folder, options.json, options.junit, options.html});
    }
}

Source load(const Program& program, const ReportOptions& options) {
    try {
        return options.merge ? load_merged(program, options) : load_one(options);
    } catch (const Stop& stop) {
        if (options.merge && stop.exit_code == report::kExitInvalidFile) {
            forsake_merged(options);
        }
        throw;
    }
}

int carry_out(const Program& program, const ReportOptions& options) {
    const Source source = load(program, options);
    const report::Run& run = source.run;
    const ReportFiles files{source.folder, options.json, options.junit, options.html};
    Progress progress(options.quiet ? ProgressStyle::none : ProgressStyle::automatic, 0);
    auto [errors, page] = write_reports(run, files, progress);
    progress.clear();
    std::FILE* console = console_beside(options.json, options.junit, options.html);
    report::ConsoleStyle style = console_style(console, options.color, options.verbose);
    style.folder =
        shell_quote(options.merge ? source.folder.string() : options.directories.front());
    if (!options.quiet) {
        std::fputs(report::console_header(run, style).c_str(), console);
    }
    std::vector<std::string> ids;
    for (const report::CaseRecord& record : run.cases) {
        ids.push_back(record.id);
    }
    report::UnexpectedResults unexpected(ids, style);
    for (const report::CaseRecord& record : run.cases) {
        std::fputs(unexpected.add(record).c_str(), console);
    }
    std::fputs(unexpected.rest().c_str(), console);
    std::fflush(console);
    const cases::Errors ci = write_ci(run, chosen_ci(options.ci), files.folder, console);
    errors.insert(errors.end(), ci.begin(), ci.end());
    const bool failed = !errors.empty();
    if (!options.quiet) {
        // What the run came to is not this command's end.
        std::string exit =
            options.merge ? report::exit_text(run) : "the run ended with " + report::exit_text(run);
        if (failed) {
            exit = report::exit_text(report::kExitInternal, "a report could not be written");
        }
        std::fputs(report::console_summary(run, page, style, exit).c_str(), console);
        std::fflush(console);
    }
    print_errors(errors);
    if (!run.missing_shards.empty()) {
        complain(report::missing_shards_sentence(run));
    }
    return failed          ? report::kExitInternal
           : options.merge ? report::exit_code(run)
                           : report::kExitOk;
}

void declare(CLI::App& app, ReportOptions& o) {
    app.add_option("DIR", o.directories, "the folder of the run")->required()->type_name("");
    app.add_flag("--merge", o.merge, "several folders, the shards of one run, become one");
    add_value(&app, "-o,--output", o.output, "where the reports go [DIR, with --merge out/merged]",
              "DIR", "Output");
    add_ci(&app, o.ci);
    add_report_files(&app, o.json, o.junit, o.html);
    add_terminal(&app, o.quiet, o.verbose, o.color);
}

}  // namespace

Command report_command() {
    return make_command<ReportOptions>(
        {"report", kChecking, "rebuild the reports of a run from its journal",
         "  edgecase report out/mine                  write the reports of a run again\n"
         "  edgecase report --merge out/shard-* -o out/all\n"},
        declare, carry_out);
}

}  // namespace cli
