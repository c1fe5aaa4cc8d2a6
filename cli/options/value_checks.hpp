// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Checks of given values that hold for all commands alike.
#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>
#include <vector>

#include "cli/options/stop.hpp"

namespace cli {

using Words = std::vector<std::string>;  // of a command line

// The sentence, and where to look.
Stop usage_error(const std::string& sentence, const std::string& command);

// Whether the words give the option; else its value, if any, is that of its variable.
bool is_given(const CLI::Option& option, const Words& words);
bool is_given(const CLI::App& command, const std::string& name, const Words& words);

// A value that is there and empty, most often that of a shell's variable that is not set, means
// nothing that an option asks for, and least of all "not given": another driver than the named one
// would be judged. Holds for every option and every named file or folder; selectors have their own
// error.
void check_empty_values(const CLI::App& command, const Words& words);

// Options of which one would be ignored beside each of the others.
void check_alternatives(const CLI::App& command, const char* one,
                        std::initializer_list<const char*> others);

// One report only can go to standard output, and what cannot be written is told before a run that
// may take long.
void check_files(const CLI::App& command);

}  // namespace cli
