// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/command_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cli {
namespace {

using report::Status;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

report::CaseRecord record_of(Status status) {
    report::CaseRecord record;
    record.id = "a/one";
    record.doors = {"index-16"};
    record.status = status;
    return record;
}

report::CaseRecord wrong_by(const std::vector<std::string>& doors) {
    report::CaseRecord record = record_of(Status::fail);
    record.outcome.findings.resize(1);
    for (const std::string& door : doors) {
        record.outcome.groups.emplace_back().door = door;
    }
    return record;
}

report::CaseRecord with_lines(report::CaseRecord record, const RunOptions& options = {}) {
    cases::Case c;
    c.draws.resize(1);
    add_command_lines({{"edgecase"}, "/bin/edgecase"}, options, {}, c, record);
    return record;
}

TEST(CommandLines, WhatDoorsDoNotShowIsDrawnWithoutThem) {
    EXPECT_THAT(with_lines(wrong_by({""})).rerun, Not(HasSubstr("--doors")));
    EXPECT_THAT(with_lines(wrong_by({"", "index-16"})).rerun, HasSubstr(" --doors index-16"));
    EXPECT_THAT(with_lines(record_of(Status::crash)).rerun, HasSubstr(" --doors index-16"));
}

TEST(CommandLines, NoProgramShowsWhatDoorsAloneDo) {
    const report::CaseRecord plain = with_lines(wrong_by({"", "index-16"}));
    EXPECT_THAT(plain.commands.reproducer, EndsWith("export --reproducer a/one -o repro.c"));
    EXPECT_THAT(plain.commands.explain, EndsWith("explain a/one --pixel 0,0"));
    const report::CaseRecord of_doors = with_lines(wrong_by({"index-16"}));
    EXPECT_EQ(of_doors.commands.reproducer, "");
    EXPECT_EQ(of_doors.commands.no_reproducer, report::kDoorsAlone);
    EXPECT_EQ(with_lines(record_of(Status::pass)).commands.reproducer, "");
}

TEST(CommandLines, AFlakeIsRepeatedAsOftenAsItTakes) {
    report::CaseRecord flake = record_of(Status::flake);
    flake.drawn.attempts = 2;
    EXPECT_THAT(with_lines(flake).rerun, EndsWith(" --repeat 2"));
    RunOptions often;
    often.repeat = 3;
    EXPECT_THAT(with_lines(flake, often).rerun, EndsWith(" --repeat 3"));
    flake.known.actual = Status::flake;
    flake.status = Status::xfail;
    EXPECT_THAT(with_lines(flake).rerun, EndsWith(" --repeat 2"));
    // A death is another one's doing, perhaps.
    flake.death.suspects = {"a/one", "a/two"};
    EXPECT_THAT(with_lines(flake).rerun, EndsWith(" --repeat 10 a/two"));
    EXPECT_THAT(with_lines(record_of(Status::crash), often).rerun, EndsWith(" --repeat 3"));
}

}  // namespace
}  // namespace cli
