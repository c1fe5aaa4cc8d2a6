// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/stop.hpp"

#include <cstdio>

namespace cli {

int report_stop(const Stop& stop) {
    for (const std::string& line : stop.lines) {
        std::fprintf(stderr, "edgecase: %s\n", line.c_str());
    }
    return stop.exit_code;
}

}  // namespace cli
