// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Writing reports and talking to the terminal.
#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "cases/base/error.hpp"
#include "cases/base/output_file.hpp"
#include "cli/options/options.hpp"
#include "report/record/run.hpp"
#include "report/text/console.hpp"

namespace cli {

// Where the reports go besides a folder; "-" is standard output, "" is none.
struct ReportFiles {
    std::filesystem::path folder;  // results.json, junit.xml, report.html
    std::string json, junit, html;
    std::filesystem::path in_folder(const char* name) const;  // empty without a folder
};

// Writes text to a file that the user named, or "-": all of it, or the file stays as it was. Error:
// one sentence with the file and errno's reason, also for a full disk.
cases::Expected<void> write_text(const std::string& file, const std::string& text);
// The same of a file that may be none, "": no text is made for it. An error joins the others.
void write_asked(const std::string& file, cases::Errors& errors,
                 const std::function<std::string()>& text);
// The same of a text that is too long to be held at once.
cases::Expected<void> write_pieces(const std::string& file, const cases::Tell& tell);
// The same of a file in a folder of ours: where a link has its name, the file takes its place.
cases::Expected<void> replace_text(const std::filesystem::path& file, const std::string& text);

// Writes all reports of a run. Progress tells what is being written, where that takes long.
class Progress;
struct Written {
    cases::Errors errors;  // what could not be written
    std::string page;      // report.html in the folder, as the summary names it, if it was
};
Written write_reports(const report::Run& run, const ReportFiles& files, Progress& progress);
// Takes away what write_reports() and write_ci() wrote of an earlier run, so that a run that ends
// before it reports leaves nothing that looks like its result.
void remove_reports(const ReportFiles& files);
// The same for a run that cannot begin; the journal of the earlier run is kept as
// journal.jsonl.old. A folder that another run is writing stays as it is, and so does one that is
// read (--failed-in).
void remove_reports_of_last_run(const ReportFiles& files);
void remove_reports_of_last_run(const RunOptions& options);

// Where the summary goes: standard output, unless a report goes there.
std::FILE* console_beside(const std::string& json, const std::string& junit,
                          const std::string& html);

// Tells mistakes on standard error, a line each.
void print_errors(const cases::Errors& errors);

// Whether a case failed that was not to.
bool has_failed(const report::Run& run);

// What a command says at its end besides the summary.
struct Ending {
    std::string failure;      // why not all was done, and what to do; empty: all was
    std::string stopped;      // that in few words, for the summary
    std::string summary;      // printed before the summary
    std::string interrupted;  // printed if the run was interrupted
    // What is found out of the records when all are there, and kept in the journal. It may take a
    // while, so the totals are printed before it.
    std::function<void(report::Run&)> complete = {};
};
// Writes reports from the journal alone, prints the summary, and returns the exit code.
int conclude(const std::filesystem::path& folder, const RunOptions& options, Ci ci,
             std::FILE* console, report::ConsoleStyle style, const Ending& ending);

// The exit code of a command that ends with `code`: what standard output did not take (a full disk)
// is told and makes it kExitInternal; a reader that has read enough is no error.
int finish_output(int code);

// Console style for a stream: colour by `when`, NO_COLOR and whether it is a terminal.
report::ConsoleStyle console_style(std::FILE* stream, When when, bool verbose);
// Says a text to people: on a terminal no word is broken at its last column; elsewhere a line stays
// whole, for programs that search.
void say_wrapped(const std::string& text);

// Progress as one line: "[120/3538] 3%  2 unexpected  410/s  8 s left", cut to `width` columns.
// `seconds` is how long the run has lasted.
std::string progress_line(size_t done, size_t total, std::optional<size_t> unexpected,
                          double seconds, size_t width);

// One line on a terminal at most five times a second; elsewhere one every two seconds, and of a
// long run every ten; nothing in continuous integration.
class Progress {
  public:
    // `what` is counted: "cases".
    Progress(ProgressStyle style, size_t total, std::string_view what = "cases");
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress() { clear(); }
    void show(size_t done, std::optional<size_t> unexpected);
    // The same of what has no total: "312 cases drawn". The seconds so far follow.
    void show_words(const std::string& words);
    // Removes the line, so that something else can be printed.
    void clear();

  private:
    bool is_due();
    void show_line(const std::string& text);
    enum class Kind { none, line, plain } kind_ = Kind::none;
    size_t total_ = 0;
    std::string what_;
    double begin_ = 0, last_ = 0;  // seconds of the steady clock
    bool shown_ = false;
};

}  // namespace cli
