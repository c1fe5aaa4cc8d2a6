// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which doors (cases/model/door.hpp) the cases of a run go through.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "cli/options/options.hpp"
#include "cli/options/stop.hpp"

namespace cli {

// By the id of a case: the doors that were asked for and that it cannot take.
using LeftOutDoors = std::map<std::string, std::vector<std::string>>;

// Gives each selected case its doors. `words` is "none", "all", "default" or names separated by
// commas; behind "all" and "default" may stand "-NAME", which leaves a door out. "default" covers:
// each door has one case of each family that has one which can take it, the cheapest to draw, and
// those with fewer doors first. Errors: an unknown name, or words that make no sense together (2),
// a name that no case can take (4).
LeftOutDoors choose_doors(const std::string& words, std::span<cases::Case* const> selected);

// Whether a run draws the whole suite that comes with the program on a driver, so that it takes
// "default" where nothing is said, else "none".
bool takes_default(const RunOptions& options);

// The words that are given, or what a run takes without them.
std::string doors_of(const RunOptions& options);

// Whether `words` ask for a set of doors, of which an expectation file may leave some out.
bool asks_for_set(const std::string& words);

// The words that give one case the same doors; empty if there are none.
std::string doors_words(const std::string& words, const std::vector<std::string>& doors);

}  // namespace cli
