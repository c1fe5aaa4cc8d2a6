// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "cli/commands.hpp"
#include "cli/options/command_table.hpp"
#include "cli/options/parse.hpp"
#include "report/record/run.hpp"

namespace cli {
namespace {

// What the words are refused with; empty if they are not.
std::string refusal(const std::vector<std::string>& words, int code = report::kExitUsage) {
    try {
        parse(all_commands(), words);
        return "";
    } catch (const Stop& stop) {
        EXPECT_EQ(stop.exit_code, code);
        return stop.lines.front();
    }
}

TEST(Options, NoneTakesAnEmptyValue) {
    size_t seen = 0;
    for (const CommandEntry& command : command_table(all_commands()).commands) {
        for (const OptionEntry& option : command.options) {
            if (option.type.empty() || option.is_positional) {
                continue;
            }
            for (const std::string& name : option.names) {
                ++seen;
                const std::string& last = option.names.back();
                std::vector<std::vector<std::string>> ways = {
                    {"edgecase", command.name, name, ""},
                    // What stands behind it must not be taken for its value.
                    {"edgecase", command.name, name, "", "fam/c1"}};
                if (name.starts_with("--")) {
                    ways.push_back({"edgecase", command.name, name + "="});
                    ways.push_back({"edgecase", command.name, name + "=", "fam/c1"});
                }
                for (const std::vector<std::string>& words : ways) {
                    const std::string why = refusal(words);
                    EXPECT_TRUE(why.starts_with(last + ": ")) << command.name << ": " << why;
                }
            }
        }
    }
    EXPECT_GT(seen, 100U);
}

TEST(Options, NoFileOrFolderHasAnEmptyName) {
    for (const CommandEntry& command : command_table(all_commands()).commands) {
        for (const OptionEntry& option : command.options) {
            const std::string name = option.names.front();
            if (option.is_positional && (name == "DIR" || name == "FILE")) {
                EXPECT_TRUE(refusal({"edgecase", command.name, ""})
                                .starts_with(name + ": the value is empty"))
                    << command.name;
            }
        }
    }
}

TEST(Options, ValuesThatLookEmptyAreTaken) {
    EXPECT_EQ(refusal({"edgecase", "run", "--device", " "}), "");
    EXPECT_EQ(refusal({"edgecase", "run", "--", "--icd="}), "");
    EXPECT_EQ(refusal({"edgecase", "run", "--icd==x"}), "");
}

}  // namespace
}  // namespace cli
