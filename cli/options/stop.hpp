// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <variant>
#include <vector>

#include "cases/base/error.hpp"

namespace cli {

// Why a command cannot go on: lines for stderr and its exit code.
struct Stop {
    int exit_code = 0;
    std::vector<std::string> lines;
};
template <class T>
using OrStop = tl::expected<T, Stop>;
using Done = OrStop<std::monostate>;

inline Stop stop_with(int exit_code, const std::string& line) {
    return {exit_code, {line}};
}

// Mistakes in files, a line each.
Stop invalid_files(const cases::Errors& errors);

// Prints the lines, each after "edgecase: ", and returns the exit code.
int report_stop(const Stop& stop);

// Prints "edgecase: TEXT" as a line of stderr, safe for a terminal whatever files and arguments put
// into it.
void complain(std::string_view text);

// Prints text to stdout, made safe likewise.
void say(std::string_view text);

}  // namespace cli
