// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Parses the command line. CLI11's errors are caught and told in our own words.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "cli/options/command.hpp"
#include "cli/options/stop.hpp"

namespace cli {

// Declares all commands with their options, and returns what is left to be done for each.
std::vector<Action> declare(CLI::App& app, std::span<const Command> commands);

using CarryOut = std::function<int(const Program&)>;
// What the words ask for. Throws the Stop of what cannot be done. Help is printed here.
CarryOut parse(std::span<const Command> commands, const Words& words);

}  // namespace cli
