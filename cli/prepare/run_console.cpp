// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/run_console.hpp"

#include "cli/options/program.hpp"

namespace cli {

namespace {

report::ConsoleStyle style_of(const RunOptions& options, const std::filesystem::path& folder,
                              std::FILE* file) {
    report::ConsoleStyle style = console_style(file, options.color, options.verbose);
    style.folder = shell_quote(folder.string());
    style.quiet = options.quiet;
    return style;
}

}  // namespace

RunConsole::RunConsole(const RunOptions& options, const std::filesystem::path& folder,
                       const std::vector<std::string>& ids, size_t total, bool is_silent)
    : nowhere_(is_silent ? std::fopen("/dev/null", "w") : nullptr, &std::fclose),
      file_(nowhere_ ? nowhere_.get() : console_beside(options.json, options.junit, options.html)),
      style_(style_of(options, folder, file_)),
      progress_(options.quiet || !options.debugger.empty() ? ProgressStyle::none : options.progress,
                total),
      unexpected_(ids, style_) {}

void RunConsole::begin(const report::Run& header, const std::string& more) {
    if (!style_.quiet) {
        print(report::console_header(header, style_) + more);
    }
}

void RunConsole::end() {
    progress_.clear();
    print(unexpected_.rest());
}

void RunConsole::print(const std::string& text) {
    if (!text.empty()) {
        progress_.clear();
        std::fputs(text.c_str(), file_);
        std::fflush(file_);
    }
}

}  // namespace cli
