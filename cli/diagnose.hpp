// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What commands that judge have in common with the command "diagnose".
#pragma once

#include <functional>
#include <string>

#include "cases/model/case.hpp"
#include "report/journal/journal.hpp"
#include "report/record/run.hpp"

namespace cli {

// Calls a visitor with every case that is at hand.
using EachCase = std::function<void(const std::function<void(const cases::Case&)>&)>;

// Diagnoses a run whose records are all there, and writes what was found into its journal.
void diagnose(report::Run& run, const EachCase& each_case, report::Journal& journal);

}  // namespace cli
