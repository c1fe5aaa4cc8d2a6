// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the failures of a fault lead with.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mutants/software.hpp"
#include "rasterizers/strength/recorded.hpp"

namespace mutants {

// The rule of the first cause that a report of the fault's failures tells (report/text/causes.hpp).
std::string top_rule(const std::vector<Kill>& kills);
// True if the fault breaks it (FaultRow::rules).
bool is_broken(const FaultRow& info, std::string_view rule);

}  // namespace mutants
