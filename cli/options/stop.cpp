// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/stop.hpp"

#include <cstdio>
#include <map>
#include <string>

#include "cases/base/printable.hpp"
#include "report/record/run.hpp"

namespace cli {

Stop invalid_files(const cases::Errors& errors) {
    constexpr size_t kMostOfAFile = 20;  // who mends twenty of one file runs the program again
    Stop stop{report::kExitInvalidFile, {}};
    std::map<std::string, size_t> count;
    for (const cases::Error& error : errors) {
        if (++count[error.where.file] <= kMostOfAFile) {
            stop.lines.push_back(cases::to_string(error));
        }
    }
    for (const auto& [file, errors_of_file] : count) {
        if (errors_of_file > kMostOfAFile) {
            stop.lines.push_back(file + ": and " + std::to_string(errors_of_file - kMostOfAFile) +
                                 " more errors");
        }
    }
    return stop;
}

int report_stop(const Stop& stop) {
    for (const std::string& line : stop.lines) {
        complain(line);
    }
    return stop.exit_code;
}

void complain(std::string_view text) {
    std::string line = cases::printable(text);
    for (size_t at = line.find('\n'); at != line.npos; at = line.find('\n', at)) {
        line.replace(at, 1, "\\x0a");  // a name that is made to look like a line of ours
    }
    std::fprintf(stderr, "edgecase: %s\n", line.c_str());
}

void say(std::string_view text) {
    std::fputs(cases::printable(text).c_str(), stdout);
}

}  // namespace cli
