// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "cases/base/error.hpp"
#include "report/record/run.hpp"

namespace cli {

// Why a command cannot go on: lines for stderr and its exit code. It is thrown, and edgecase_main
// tells it.
struct Stop {
    int exit_code = 0;
    std::vector<std::string> lines;
};

inline Stop stop_with(int exit_code, const std::string& line) {
    return {exit_code, {line}};
}

// Mistakes in files, a line each.
Stop invalid_files(const cases::Errors& errors);
template <class T>
T must(cases::ExpectedAll<T> value) {
    if (!value) {
        throw invalid_files(value.error());
    }
    return *std::move(value);
}

// The value, or the end with that code and what is wrong, behind these words.
template <class T>
T must(cases::Expected<T> value, int exit_code, const std::string& words = "") {
    if (!value) {
        throw stop_with(exit_code, words + value.error().message);
    }
    if constexpr (!std::is_void_v<T>) {
        return *std::move(value);
    }
}

// What a file holds, or the end with what is wrong with it and where, behind these words.
template <class T>
T must_read(cases::Expected<T> value, const std::string& words = "") {
    if (!value) {
        throw stop_with(report::kExitInvalidFile, words + cases::to_string(value.error()));
    }
    return *std::move(value);
}

// Prints the lines, each after "edgecase: ", and returns the exit code.
int report_stop(const Stop& stop);

// Prints "edgecase: TEXT" as a line of stderr, safe for a terminal whatever files and arguments put
// into it.
void complain(std::string_view text);

// Prints text to stdout, made safe likewise.
void say(std::string_view text);

}  // namespace cli
