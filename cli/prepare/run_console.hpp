// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the terminal is told while the cases of a run are judged.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/options/options.hpp"
#include "cli/prepare/outputs.hpp"
#include "report/text/unexpected.hpp"

namespace cli {

class RunConsole {
  public:
    // `ids`: of all cases, in the order in which they are told; `total`: that are to be judged; a
    // silent one tells progress alone.
    RunConsole(const RunOptions& options, const std::filesystem::path& folder,
               const std::vector<std::string>& ids, size_t total, bool is_silent = false);
    // The first line of a run, and what else is to be known; nothing of a quiet run.
    void begin(const report::Run& header, const std::string& more = {});
    // A case has ended.
    void add(const report::CaseRecord& record) { print(unexpected_.add(record)); }
    // So many cases have ended; `unconfirmed` failures besides are to be drawn again.
    void show(size_t done, size_t unconfirmed = 0) {
        progress_.show(done, unexpected_.count() + unconfirmed);
    }
    // No case will end any more.
    void end();
    void print(const std::string& text);

    std::FILE* file() const { return file_; }
    const report::ConsoleStyle& style() const { return style_; }

  private:
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> nowhere_;
    std::FILE* file_;
    report::ConsoleStyle style_;
    Progress progress_;
    report::UnexpectedResults unexpected_;
};

}  // namespace cli
