// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a run found at each level, so that a conformant device is told that it is. Everything
// returned is printable ASCII.
#pragma once

#include <string>

#include "report/record/levels.hpp"

namespace report {

// Of one level, without its name: "nothing wrong in 3174 cases" (of the first one; "nothing" of the
// others), "13 cases differ (ties)", "nothing new, 92 cases are wrong as expected", "not judged".
std::string level_text(const Levels& levels, const LevelCount& row);
// "4 cases": selected ones that have no level; empty if there are none.
std::string unjudged_text(const Levels& levels);
// All levels in a line: "vulkan: nothing wrong in 3174 cases - practice: nothing - direct3d: 13
// cases differ (ties)", and how many cases have no level.
std::string levels_line(const Run& run);

}  // namespace report
