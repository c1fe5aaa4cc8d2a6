// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/outputs.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <future>

#include "cases/base/heap.hpp"
#include "cases/base/output_file.hpp"
#include "cases/base/parallel.hpp"
#include "cli/options/stop.hpp"
#include "cli/prepare/ci.hpp"
#include "report/files/json.hpp"
#include "report/files/junit.hpp"
#include "report/journal/journal.hpp"
#include "report/page/html.hpp"
#include "report/text/sentences.hpp"
#include "report/text/wrap.hpp"

namespace cli {

namespace {

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

cases::Expected<void> told_of(const std::string& name, const cases::Expected<void>& written) {
    return written ? written
                   : cases::failure("'{}' cannot be written: {}", name, written.error().message);
}

}  // namespace

cases::Expected<void> write_pieces(const std::string& file, const cases::Tell& tell) {
    if (file == "-") {
        std::fflush(stdout);
        return told_of("standard output", cases::write_to(STDOUT_FILENO, tell));
    }
    return told_of(file, cases::write_file(file, cases::Link::followed, tell));
}

cases::Expected<void> write_text(const std::string& file, const std::string& text) {
    return write_pieces(file, [&text](const cases::Put& put) { put(text); });
}

void write_asked(const std::string& file, cases::Errors& errors,
                 const std::function<std::string()>& text) {
    if (const auto written = file.empty() ? cases::Expected<void>() : write_text(file, text());
        !written) {
        errors.push_back(written.error());
    }
}

namespace {

cases::Expected<void> replace_pieces(const std::filesystem::path& file, const cases::Tell& tell) {
    return told_of(file.string(), cases::write_file(file, cases::Link::replaced, tell));
}

}  // namespace

cases::Expected<void> replace_text(const std::filesystem::path& file, const std::string& text) {
    return replace_pieces(file, [&text](const cases::Put& put) { put(text); });
}

namespace {

// FILE of part k of the report, from 2 on: FILE-k.html beside FILE.html.
std::string part_file(const std::string& file, size_t part) {
    const std::filesystem::path path(file);
    return (path.parent_path() /
            (path.stem().string() + "-" + std::to_string(part) + path.extension().string()))
        .string();
}

// A report in the folder, where it takes the place of what has its name, and in the file that was
// named. False: none is in the folder.
bool write_report(const std::filesystem::path& in_folder, const std::string& named,
                  const cases::Tell& tell, cases::Errors& errors) {
    const auto check = [&](const cases::Expected<void>& written) {
        if (!written) {
            errors.push_back(written.error());
        }
        return written.has_value();
    };
    const bool is_there = !in_folder.empty() && check(replace_pieces(in_folder, tell));
    if (!named.empty()) {
        check(write_pieces(named, tell));
    }
    return is_there;
}

void write_pages(const report::Run& run, const ReportFiles& files, Progress& progress,
                 Written& written) {
    const std::string in_folder = files.in_folder("report.html").string();
    if (in_folder.empty() && files.html.empty()) {
        return;
    }
    report::for_each_page(run, [&](size_t part, const std::string& page) {
        progress.show_words(fmt::format("writing part {} of the page", part));
        const auto of_part = [part](const std::string& file) {
            return part == 1 || file.empty() ? file : file == "-" ? "" : part_file(file, part);
        };
        if (write_report(
                of_part(in_folder), of_part(files.html),
                [&page](const cases::Put& put) { put(page); }, written.errors) &&
            part == 1) {
            written.page = in_folder;
        }
    });
}

}  // namespace

std::filesystem::path ReportFiles::in_folder(const char* name) const {
    return folder.empty() ? folder : folder / name;
}

Written write_reports(const report::Run& run, const ReportFiles& files, Progress& progress) {
    Written written;
    cases::Errors errors;
    const auto tell_pages = [&] { write_pages(run, files, progress, written); };
    const bool is_beside = files.html != "-";  // on standard output one comes after the other
    std::future<void> pages = is_beside ? cases::beside(tell_pages) : std::future<void>();
    write_report(
        files.in_folder("results.json"), files.json,
        [&run](const cases::Put& put) { report::tell_json(run, put); }, errors);
    write_report(
        files.in_folder("junit.xml"), files.junit,
        [&run](const cases::Put& put) { put(report::to_junit(run)); }, errors);
    is_beside ? pages.get() : tell_pages();
    written.errors.insert(written.errors.begin(), errors.begin(), errors.end());
    return written;
}

void remove_reports(const ReportFiles& files) {
    const auto remove = [](const std::filesystem::path& file) {
        std::error_code error;  // what cannot be removed cannot be written either, which is told
        return std::filesystem::is_regular_file(std::filesystem::symlink_status(file, error)) &&
               std::filesystem::remove(file, error);
    };
    if (!files.folder.empty()) {
        for (const char* name : {"results.json", "junit.xml", "gl-code-quality.json"}) {
            remove(files.folder / name);
        }
        const std::string page = (files.folder / "report.html").string();
        remove(page);
        for (size_t part = 2; remove(part_file(page, part)); ++part) {
        }
    }
    for (const std::string& file : {files.json, files.junit, files.html}) {
        if (file != "-") {
            remove(file);  // without its parts: FILE-2.html may be somebody else's
        }
    }
}

void remove_reports_of_last_run(const ReportFiles& files) {
    std::error_code none;
    if (files.folder.empty() || !std::filesystem::exists(files.folder / "journal.jsonl", none) ||
        report::put_aside_journal(files.folder)) {
        remove_reports(files);
    }
}

void remove_reports_of_last_run(const RunOptions& options) {
    std::error_code none;
    if (!options.resume.empty() ||
        std::filesystem::equivalent(options.output, options.failed_in, none)) {
        return;
    }
    remove_reports_of_last_run(
        ReportFiles{options.output, options.json, options.junit, options.html});
}

std::FILE* console_beside(const std::string& json, const std::string& junit,
                          const std::string& html) {
    return json == "-" || junit == "-" || html == "-" ? stderr : stdout;
}

void print_errors(const cases::Errors& errors) {
    for (const cases::Error& error : errors) {
        complain(cases::to_string(error));
    }
}

bool has_failed(const report::Run& run) {
    return std::ranges::any_of(
        run.cases, [](const auto& record) { return record.status == report::Status::fail; });
}

int conclude(const std::filesystem::path& folder, const RunOptions& options, Ci ci,
             std::FILE* console, report::ConsoleStyle style, const Ending& ending) {
    cases::give_back_memory();
    cases::Expected<report::Run> run = report::load_for_reports(folder);
    if (!run) {
        print_errors({run.error()});
        return report::kExitInternal;
    }
    cases::give_back_memory();
    if (ending.complete) {
        if (!options.quiet && has_failed(*run)) {
            style.totals_are_told = true;
            std::fputs(report::console_totals(*run, style).c_str(), console);
            std::fflush(console);
        }
        ending.complete(*run);
        cases::give_back_memory();
    }
    const ReportFiles files{folder, options.json, options.junit, options.html};
    Progress progress(options.quiet ? ProgressStyle::none : options.progress, 0);
    auto [errors, page] = write_reports(*run, files, progress);
    progress.clear();
    const cases::Errors of_ci = write_ci(*run, ci, folder, console);
    errors.insert(errors.end(), of_ci.begin(), of_ci.end());
    const bool failed = !errors.empty() || !ending.failure.empty();
    const int code = report::exit_code(*run);
    const bool overrides = failed && code != report::kExitInterrupted;
    if (!options.quiet) {
        const std::string why =
            ending.failure.empty() ? "a report could not be written" : ending.stopped;
        std::fputs(ending.summary.c_str(), console);
        std::fputs(report::console_summary(
                       *run, page, style,
                       overrides ? report::exit_text(report::kExitInternal, why) : std::string())
                       .c_str(),
                   console);
    }
    print_errors(errors);
    if (!ending.failure.empty()) {
        complain(ending.failure);
    }
    if (run->interrupted && !ending.interrupted.empty()) {
        std::fflush(console);
        complain(ending.interrupted);
    }
    return overrides ? report::kExitInternal : code;
}

int finish_output(int code) {
    const bool flushed = std::fflush(stdout) == 0;
    const int reason = flushed ? 0 : errno;
    if (flushed && std::ferror(stdout) == 0) {
        return code;
    }
    pollfd out{STDOUT_FILENO, POLLOUT, 0};
    if (reason == EPIPE || (::poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0)) {
        return code;
    }
    std::fprintf(stderr, "edgecase: standard output cannot be written%s%s\n",
                 reason == 0 ? "" : ": ", reason == 0 ? "" : std::strerror(reason));
    return code == report::kExitInterrupted ? code : report::kExitInternal;
}

report::ConsoleStyle console_style(std::FILE* stream, When when, bool verbose) {
    report::ConsoleStyle style;
    style.verbose = verbose;
    const bool terminal = ::isatty(::fileno(stream)) == 1;
    const char* no_color = std::getenv("NO_COLOR");
    const bool plain = no_color != nullptr && *no_color != '\0';
    style.color = when == When::always || (when == When::automatic && terminal && !plain);
    winsize size{};
    if (terminal && ::ioctl(::fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col >= 20) {
        style.width = size.ws_col;
        style.wrap = true;
    }
    return style;
}

void say_wrapped(const std::string& text) {
    const report::ConsoleStyle style = console_style(stdout, When::never, false);
    say(style.wrap ? report::wrapped(text, style.width) : text);
}

std::string progress_line(size_t done, size_t total, std::optional<size_t> unexpected,
                          double seconds, size_t width) {
    const size_t percent = total == 0 ? 100 : done * 100 / total;
    std::string text = "[" + std::to_string(done) + "/" + std::to_string(total) + "] " +
                       std::to_string(percent) + "%";
    if (unexpected) {
        text += "  " + std::to_string(*unexpected) + " unexpected";
    }
    if (done > 0 && seconds > 0) {
        const double rate = static_cast<double>(done) / seconds;
        const auto left = static_cast<uint64_t>(static_cast<double>(total - done) / rate) + 1;
        const std::string time =
            left >= 120 ? std::to_string((left + 59) / 60) + " min" : std::to_string(left) + " s";
        std::array<char, 32> number{};
        std::snprintf(number.data(), number.size(), rate < 10 ? "%.1f/s" : "%.0f/s", rate);
        text += "  " + std::string(number.data()) + "  " + time + " left";
    }
    return text.substr(0, width);
}

Progress::Progress(ProgressStyle style, size_t total, std::string_view what)
    : total_(total), what_(what), begin_(steady_seconds()), last_(begin_) {
    if (style == ProgressStyle::automatic && is_ci()) {
        kind_ = Kind::none;
    } else if (style == ProgressStyle::automatic) {
        const char* terminal = std::getenv("TERM");
        const bool dumb = terminal != nullptr && std::strcmp(terminal, "dumb") == 0;
        kind_ = ::isatty(STDERR_FILENO) == 1 && !dumb ? Kind::line : Kind::plain;
    } else if (style == ProgressStyle::plain) {
        kind_ = Kind::plain;
    }
}

bool Progress::is_due() {
    const double now = steady_seconds();
    const double interval = kind_ == Kind::line ? 0.2 : std::clamp((now - begin_) / 4, 2.0, 10.0);
    if (kind_ == Kind::none || now - last_ < interval) {
        return false;
    }
    last_ = now;
    return true;
}

void Progress::show_line(const std::string& text) {
    std::fprintf(stderr, kind_ == Kind::line ? "\r\x1b[K%s" : "%s\n", text.c_str());
    std::fflush(stderr);
    shown_ = kind_ == Kind::line;
}

void Progress::show(size_t done, std::optional<size_t> unexpected) {
    if (!is_due()) {
        return;
    }
    if (kind_ == Kind::line) {
        winsize size{};
        const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
        show_line(progress_line(done, total_, unexpected, last_ - begin_,
                                known ? size.ws_col - 1U : 79U));
    } else {
        show_line(fmt::format("{} of {} {} ({}%){}", done, total_, what_,
                              total_ == 0 ? 100 : done * 100 / total_,
                              unexpected ? fmt::format(", {} unexpected", *unexpected) : ""));
    }
}

void Progress::show_words(const std::string& words) {
    if (is_due()) {
        show_line(fmt::format("{}, {:.0f} s", words, last_ - begin_));
    }
}

void Progress::clear() {
    if (shown_) {
        std::fputs("\r\x1b[K", stderr);
        std::fflush(stderr);
        shown_ = false;
    }
}

}  // namespace cli
