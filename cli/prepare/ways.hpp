// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which ways (cases/model/way.hpp) the cases of a run are drawn by, too.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "cli/options/options.hpp"
#include "cli/options/stop.hpp"
#include "cli/prepare/suite.hpp"

namespace cli {

// What ways make of the selected cases. `words` is "none", "all", "default" or globs of ways
// separated by commas. "default" gives each case file kWaysOfFile ways, or all that take it where
// they are fewer, each with another of its cases where it has several; its id chooses which, so
// that each way comes to as many files; those of cases that an expectation file knows go again
// (apply_expectations). Errors: a glob that no way has (2), one that takes no case
// (4).
inline constexpr size_t kWaysOfFile = 3;
std::vector<cases::Case> choose_ways(const std::string& words,
                                     std::span<cases::Case* const> selected);

// The words that are given, or what a run takes without them: as doors_of().
std::string ways_of(const RunOptions& options);

// Adds the cases that a run drew by ways.
void add_drawn(LoadedSuite& suite, const report::Run& run);

}  // namespace cli
