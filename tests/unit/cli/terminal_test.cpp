// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "cli/commands.hpp"
#include "cli/options/command_table.hpp"
#include "cli/prepare/outputs.hpp"
#include "run/expected/expectation_update.hpp"

namespace cli {
namespace {

TEST(Progress, RateAndTimeLeft) {
    EXPECT_EQ(progress_line(0, 200, 0, 0, 80), "[0/200] 0%  0 unexpected");
    EXPECT_EQ(progress_line(50, 200, 2, 5, 80), "[50/200] 25%  2 unexpected  10/s  16 s left");
    EXPECT_EQ(progress_line(10, 10000, 0, 4, 80),
              "[10/10000] 0%  0 unexpected  2.5/s  67 min left");
    EXPECT_EQ(progress_line(50, 200, 2, 5, 20), "[50/200] 25%  2 unex");
    EXPECT_EQ(progress_line(0, 0, 0, 1, 80), "[0/0] 100%  0 unexpected");
}

TEST(Update, HeadersOfNewFilesFitOnlyTheirDevice) {
    report::Run drawn;
    drawn.device.name = "GPU [x] (1*)";
    drawn.device.driver_name = "a+b (c)";
    drawn.device.driver_info = "Mesa 22.3.6 (LLVM 15)";
    const auto file = run::parse_expectations(run::new_expectation_file(drawn), "f", "2026-01-01");
    ASSERT_TRUE(file);
    EXPECT_EQ(run::mismatch(*file, drawn.device, cases::Profile::direct3d), "");
    EXPECT_NE(run::mismatch(*file, drawn.device, cases::Profile::vulkan), "");
    capture::DeviceInfo other = drawn.device;
    other.name = "GPU x (12)";
    EXPECT_NE(run::mismatch(*file, other, cases::Profile::direct3d), "");
    other = drawn.device;
    other.driver_info = "Mesa 22.4.0";
    EXPECT_NE(run::mismatch(*file, other, cases::Profile::direct3d), "");
}

TEST(CommandTable, EveryCommandAndOptionIsDescribed) {
    const CommandTable table = command_table(all_commands());
    EXPECT_GE(table.commands.size(), 13U);
    for (const CommandEntry& command : table.commands) {
        EXPECT_FALSE(command.text.empty()) << command.name;
        EXPECT_FALSE(command.group.empty()) << command.name;
        for (const OptionEntry& option : command.options) {
            EXPECT_FALSE(option.text.empty()) << command.name << " " << option.names.front();
        }
    }
}

}  // namespace
}  // namespace cli
