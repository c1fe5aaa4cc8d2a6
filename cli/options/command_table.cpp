// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/command_table.hpp"

#include <algorithm>
#include <sstream>

#include "cli/options/parse.hpp"

namespace cli {

namespace {

OptionEntry describe(const CLI::Option& option) {
    OptionEntry entry;
    entry.is_positional = option.get_positional();
    for (const std::string& name : option.get_snames()) {
        entry.names.push_back("-" + name);
    }
    for (const std::string& name : option.get_lnames()) {
        entry.names.push_back("--" + name);
    }
    if (entry.is_positional) {
        entry.names = {option.get_name(true)};
    }
    if (option.get_items_expected_max() > 0) {
        entry.type = option.get_type_name();
    }
    entry.text = option.get_description();
    entry.group = option.get_group();
    if (entry.type.find('|') != std::string::npos) {
        std::istringstream in(entry.type);
        for (std::string word; std::getline(in, word, '|');) {
            entry.choices.push_back(word);
        }
    }
    return entry;
}

}  // namespace

bool CommandEntry::takes_cases() const {
    return std::ranges::any_of(options, [](const OptionEntry& o) {
        return o.is_positional && (o.names.front() == "SELECTOR" || o.names.front() == "CASE");
    });
}

CommandTable command_table(std::span<const Command> commands) {
    CLI::App app("", "edgecase");
    declare(app, commands);
    CommandTable table;
    table.text = "check triangle rasterization of Vulkan drivers against an exact reference";
    table.footer = app.get_footer();
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        CommandEntry entry{command->get_name(),
                           command->get_description(),
                           command->get_group(),
                           command->get_footer(),
                           {}};
        for (const CLI::Option* option : command->get_options()) {
            if (!option->get_group().empty()) {
                entry.options.push_back(describe(*option));
            }
        }
        table.commands.push_back(std::move(entry));
    }
    return table;
}

}  // namespace cli
