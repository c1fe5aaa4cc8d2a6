// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The option table as plain data: what help, completion and the manual page are made of.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace cli {

struct Command;

struct OptionEntry {
    std::vector<std::string> names;  // "-o", "--output"; for a positional its name, "SELECTOR"
    std::string type;                // "DIR", "auto|github|none"; empty for flags
    std::string text, group;
    std::vector<std::string> choices;  // if the value is one of a few words
    bool is_positional = false;
};

struct CommandEntry {
    std::string name, text, group;
    std::string footer;  // examples and what else its help ends with
    std::vector<OptionEntry> options;
    bool takes_cases() const;
};

struct CommandTable {
    std::string text, footer;
    std::vector<CommandEntry> commands;
};

CommandTable command_table(std::span<const Command> commands);

}  // namespace cli
