// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/options/options.hpp"
#include "cli/prepare/suite.hpp"

namespace cli {

// The options of `edgecase run` from the words of a command line (program and "run" included), as a
// journal keeps them.
OrStop<RunOptions> parse_run_arguments(const std::vector<std::string>& arguments);

}  // namespace cli
