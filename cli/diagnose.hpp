// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What commands that judge have in common with the command "diagnose".
#pragma once

#include <functional>

#include "cases/model/case.hpp"
#include "cli/options/program.hpp"
#include "report/journal/journal.hpp"
#include "report/record/run.hpp"

namespace cli {

// Calls a visitor with every case that is at hand.
using EachCase = std::function<void(const std::function<void(const cases::Case&)>&)>;

// Diagnoses a run whose records are all there, or that goes on: then few cases are looked at, since
// the answer is waited for.
void diagnose(report::Run& run, const EachCase& each_case, bool goes_on = false);

// The same of a run that was put together of several: its cases are read again. If they are not at
// hand as they were, there is no diagnosis.
void diagnose_again(const Program& program, report::Run& run);

// Writes what was found into the run's journal, of which all reports are made.
void keep_diagnoses(const report::Run& run, report::Journal& journal);

}  // namespace cli
