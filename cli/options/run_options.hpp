// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of "run", which a journal keeps as they were given.
#pragma once

#include "cli/options/command.hpp"

namespace cli {

void declare_run(CLI::App& app, RunOptions& o);
void check_run(const CLI::App& run, const RunOptions& o, const Words& words);

// The options of `edgecase run` from the words of a command line (program and "run" included), as a
// journal keeps them.
RunOptions parse_run_arguments(const Words& arguments);

}  // namespace cli
