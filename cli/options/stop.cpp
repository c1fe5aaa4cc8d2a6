// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/stop.hpp"

#include <cstdio>

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
        std::fprintf(stderr, "edgecase: %s\n", line.c_str());
    }
    return stop.exit_code;
}

}  // namespace cli
