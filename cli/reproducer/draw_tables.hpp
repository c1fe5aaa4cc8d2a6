// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a reproducer draws, as C tables (program/types.c tells what they hold).
#pragma once

#include <string>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"

namespace cli {

// The SPIR-V, the vertices and the state of all draws, and how often they are drawn. The case has
// no undrawable_part().
std::string draw_tables(const cases::Case& c, cases::Profile profile);

}  // namespace cli
