// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/command_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "cases/model/rule_ids.hpp"

namespace cli {
namespace {

using report::Status;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

report::CaseRecord record_of(Status status) {
    report::CaseRecord record;
    record.id = "a/one";
    record.doors = {"index-16", "secondary"};
    record.status = status;
    return record;
}

report::CaseRecord wrong_by(const std::vector<std::string>& doors) {
    report::CaseRecord record = record_of(Status::fail);
    for (const std::string& door : doors) {
        record.outcome.findings.emplace_back().door = door;
        record.outcome.groups.emplace_back().door = door;
    }
    return record;
}

report::CaseRecord with_lines(report::CaseRecord record, const RunOptions& options = {}) {
    cases::Case c;
    c.draws.resize(1);
    add_command_lines({{}, "/bin/edgecase", "edgecase"}, options, {}, c, record);
    return record;
}

// The name stands for --doors.
TEST(CommandLines, TheLeadingFindingSaysThroughWhichDoorACaseIsDrawnAgain) {
    EXPECT_THAT(with_lines(wrong_by({""})).rerun, Not(HasSubstr("--doors")));
    EXPECT_THAT(with_lines(wrong_by({"", "secondary"})).rerun, Not(HasSubstr("--doors")));
    RunOptions options;
    options.doors = "all";
    EXPECT_THAT(with_lines(wrong_by({"secondary"}), options).rerun, EndsWith(" --doors secondary"));
    EXPECT_THAT(with_lines(wrong_by({"secondary", "index-16"})).rerun,
                EndsWith(" --doors secondary"));
    // The case's file asks for it.
    EXPECT_THAT(with_lines(wrong_by({"pass-split"})).rerun, Not(HasSubstr("--doors")));
    // A finding of the loosest level leads, whether it is the door's or the plain picture's.
    report::CaseRecord tie = wrong_by({"", "secondary"});
    tie.outcome.findings[0].level = cases::Profile::direct3d;
    tie.outcome.findings[1].level = cases::Profile::vulkan;
    EXPECT_THAT(with_lines(tie).rerun, EndsWith(" --doors secondary"));
    // What is written beside an attachment names its door in the finding alone.
    report::CaseRecord beside = wrong_by({""});
    diff::Finding& finding = beside.outcome.findings.front();
    finding.rule = beside.outcome.groups.front().rule = cases::rule::write_outside;
    finding.quantity = "memory after depth";
    EXPECT_THAT(with_lines(beside).rerun, Not(HasSubstr("--doors")));
    EXPECT_THAT(with_lines(beside).commands.reproducer, HasSubstr("export --reproducer"));
    finding.quantity = "memory after depth, door secondary";
    EXPECT_THAT(with_lines(beside).rerun, EndsWith(" --doors secondary"));
    EXPECT_EQ(with_lines(beside).commands.no_reproducer, report::kDoorsAlone);
}

TEST(CommandLines, DeathsFlakesAndImprovementsKeepTheirDoors) {
    EXPECT_THAT(with_lines(record_of(Status::crash)).rerun,
                EndsWith(" --doors index-16,secondary"));
    EXPECT_THAT(with_lines(record_of(Status::xpass)).rerun,
                EndsWith(" --doors index-16,secondary"));
    report::CaseRecord record = wrong_by({"secondary"});
    for (const Status status : {Status::flake, Status::improved}) {
        record.status = status;
        EXPECT_THAT(with_lines(record).rerun, HasSubstr(" --doors index-16,secondary"));
    }
    RunOptions options;
    options.doors = "all,-geometry";
    EXPECT_THAT(with_lines(record, options).rerun, HasSubstr(" --doors all,-geometry"));
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

// A variable for one test.
class Variable {
  public:
    Variable(const char* name, const char* value) : name_(name) { ::setenv(name, value, 1); }
    ~Variable() { ::unsetenv(name_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    const char* name_;
};

TEST(CommandLines, WhatChangesPicturesStandsInFront) {
    const auto settings = [] {
        const std::string line = with_lines(record_of(Status::fail)).rerun;
        return line.substr(0, line.find("edgecase run"));
    };
    const std::string usual = settings();
    const auto has = [&](const char* name) {
        const Variable set(name, "a b");
        return settings().find(std::string(name) + "='a b' ") != std::string::npos;
    };
    for (const char* name :
         {"EDGECASE_BREAK", "EDGECASE_FAULT", "EDGECASE_SELF_PREFIX", "EDGECASE_DEVICE_CLASS",
          "EDGECASE_PRETENDED_LIMITS", "EDGECASE_HOSTILE_SEED", "VK_LAYER_PATH", "LP_NUM_THREADS",
          "LVP_X", "MESA_X", "GALLIUM_DRIVER", "LIBGL_X", "SWIFTSHADER_X", "LD_PRELOAD",
          "LD_LIBRARY_PATH", "ENABLE_X", "DISABLE_X", "NODEVICE_SELECT"}) {
        EXPECT_TRUE(has(name)) << name;
    }
    for (const char* name : {"EDGECASE_BREAK_COUNT", "EDGECASE_JOBS", "EDGECASE_IMAGE_IO",
                             "EDGECASE_UNITY", "XDG_DATA_DIRS", "PWD", "SOURCE_DATE_EPOCH"}) {
        EXPECT_FALSE(has(name)) << name;
    }
    const Variable suite("EDGECASE_SUITE", "a/suite");
    EXPECT_EQ(settings(), usual);
    EXPECT_THAT(with_lines(record_of(Status::fail)).rerun,
                HasSubstr("edgecase run a/one --suite a/suite"));
    RunOptions named;
    named.suite.suite = "b/suite";
    EXPECT_THAT(with_lines(wrong_by({""}), named).commands.explain,
                HasSubstr("edgecase explain a/one --suite b/suite"));
}

}  // namespace
}  // namespace cli
