// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/stop.hpp"

#include <cstdio>

#include "cases/base/printable.hpp"
#include "report/record/run.hpp"

namespace cli {

Stop invalid_files(const cases::Errors& errors) {
    Stop stop{report::kExitInvalidFile, {}};
    for (const cases::Error& error : errors) {
        stop.lines.push_back(cases::to_string(error));
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
    std::fprintf(stderr, "edgecase: %s\n", cases::printable(text).c_str());
}

void say(std::string_view text) {
    std::fputs(cases::printable(text).c_str(), stdout);
}

}  // namespace cli
