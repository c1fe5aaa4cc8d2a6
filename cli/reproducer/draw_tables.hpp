// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a reproducer draws, as C tables (program/types.c tells what they hold).
#pragma once

#include <string>

#include "cases/base/error.hpp"
#include "cases/model/case.hpp"

namespace cli {

// The SPIR-V, the vertices and the state of all draws. The case has passed missing_of().
std::string draw_tables(const cases::Case& c);

}  // namespace cli
