// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Parses the command line. CLI11's errors are caught and told in our own words.
#pragma once

#include <string>
#include <vector>

#include "cli/options/command_options.hpp"
#include "cli/options/options.hpp"
#include "cli/options/stop.hpp"

namespace cli {

// Parses everything into `all`; the chosen command's name, "" for none, or why not. Help is printed
// here.
OrStop<std::string> parse(CLI::App& app, AllOptions& all, std::vector<std::string> words);

// The options of `edgecase run` from the words of a command line (program and "run" included), as a
// journal keeps them.
OrStop<RunOptions> parse_run_arguments(const std::vector<std::string>& arguments);

}  // namespace cli
