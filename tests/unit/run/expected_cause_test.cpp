// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/expected/expected_cause.hpp"

#include <gtest/gtest.h>

#include "run/expected/expectation_file.hpp"
#include "run/expected/glob_cover.hpp"

namespace run {
namespace {

using cases::Profile;
using diff::FindingKind;

ExpectedCause parsed(std::initializer_list<const char*> words) {
    ExpectedCause cause;
    for (const char* word : words) {
        EXPECT_TRUE(is_cause_word(word)) << word;
        const auto added = add_cause_word(cause, word);
        EXPECT_TRUE(added) << word << ": " << (added ? "" : added.error().message);
    }
    return cause;
}

report::CaseRecord failed(uint64_t extra, uint64_t values) {
    report::CaseRecord record;
    record.status = report::Status::fail;
    record.outcome.groups = {{FindingKind::extra, "cover.outside", Profile::vulkan, extra, 0},
                             {FindingKind::value, "interp.linear", Profile::practice, values, 0}};
    record.drawn.bits = "0123456789abcdef";
    return record;
}

TEST(ExpectedCause, WordsAreReadAndWritten) {
    const ExpectedCause cause = parsed({"value:interp.linear@practice<=3,direct3d<=40",
                                        "extra:cover.outside@vulkan<=9", "value:-@vulkan<=7"});
    EXPECT_EQ(to_text(cause),
              "extra:cover.outside@vulkan<=9 value:-@vulkan<=7 "
              "value:interp.linear@practice<=3,direct3d<=40");
    EXPECT_EQ(parsed({"signal=SIGSEGV", "step=submit"}).signal, "SIGSEGV");
    EXPECT_FALSE(is_cause_word("until=2026-01-01"));
}

TEST(ExpectedCause, ACountIsABound) {
    const ExpectedCause cause =
        parsed({"extra:cover.outside@vulkan<=9", "value:interp.linear@practice<=3"});
    EXPECT_EQ(what_is_new(cause, failed(9, 3)), "");
    EXPECT_EQ(what_is_new(cause, failed(1, 1)), "");
    EXPECT_EQ(what_is_new(cause, failed(10, 4)),
              "10 extra of cover.outside [vulkan] where 9 are known; "
              "4 value of interp.linear [practice] where 3 are known");
    EXPECT_EQ(what_is_new(parsed({"extra:cover.outside@vulkan<=9"}), failed(9, 2)),
              "2 value of interp.linear [practice] are new");
    EXPECT_EQ(what_is_new(parsed({"bits=0123456789abcdee,f123456789abcdef"}), failed(1, 1)),
              "the bits are '0123456789abcdef' and not '0123456789abcdee' or 'f123456789abcdef'");
    EXPECT_EQ(what_is_new(parsed({"bits=0123456789abcdef"}), failed(1, 1)), "");
}

TEST(ExpectedCause, WhatIsKnownIsMarked) {
    report::CaseRecord record = failed(10, 4);
    mark_known(parsed({"extra:cover.outside@vulkan<=9"}), record);
    EXPECT_EQ(record.outcome.groups[0].known, 9U);
    EXPECT_EQ(record.outcome.groups[1].known, 0U);
    mark_known(parsed({"bits=0123456789abcdef"}), record);
    EXPECT_EQ(record.outcome.groups[1].known, 4U);
}

TEST(ExpectedCause, BitsSayNothingOfWhatIsNotInThePicture) {
    report::CaseRecord record = failed(1, 1);
    const ExpectedCause bits = parsed({"bits=0123456789abcdef"});
    for (const char* rule : {"write.outside", "repeat.same", "repeat.scissor", "repeat.clears",
                             "repeat.write-masks", "repeat.attachments"}) {
        record.outcome.groups.push_back({FindingKind::value, rule, Profile::vulkan, 2, 0});
        EXPECT_EQ(what_is_new(bits, record),
                  std::string("2 value of ") + rule + " [vulkan] are new");
        mark_known(bits, record);
        EXPECT_EQ(record.outcome.groups[0].known, 1U);
        EXPECT_EQ(record.outcome.groups.back().known, 0U);
        record.outcome.groups.pop_back();
    }
}

TEST(ExpectedCause, ADoorIsItsOwnCause) {
    report::CaseRecord record = failed(1, 1);
    const auto add = [&](const char* door, uint64_t count) {
        record.outcome.groups.push_back(
            {FindingKind::value, "door.state", Profile::vulkan, count, 0, door});
    };
    add("state-static", 36);
    const std::vector<const char*> plain = {"extra:cover.outside@vulkan<=1",
                                            "value:interp.linear@practice<=1"};
    EXPECT_EQ(what_is_new(parsed({plain[0], plain[1]}), record),
              "36 value of door.state by door state-static [vulkan] are new");
    // Bits are the plain picture's.
    EXPECT_EQ(what_is_new(parsed({"bits=0123456789abcdef"}), record),
              "36 value of door.state by door state-static [vulkan] are new");
    const ExpectedCause known =
        parsed({plain[0], plain[1], "value:door.state=state-static@vulkan<=36"});
    EXPECT_EQ(what_is_new(known, record), "");
    add("state-first", 1);
    EXPECT_EQ(what_is_new(known, record),
              "1 value of door.state by door state-first [vulkan] is new");
    mark_known(known, record);
    EXPECT_EQ(record.outcome.groups[2].known, 36U);
    EXPECT_EQ(record.outcome.groups[3].known, 0U);
    EXPECT_EQ(to_text(cause_of(record)),
              "extra:cover.outside@vulkan<=1 value:door.state=state-first@vulkan<=1 "
              "value:door.state=state-static@vulkan<=36 value:interp.linear@practice<=1");
}

TEST(ExpectedCause, ADoorThatWasNotDrawnIsNotSpokenOf) {
    const ExpectedCause door = parsed({"value:door.state=state-static@vulkan<=36"});
    EXPECT_TRUE(is_of_other_doors(door, {}));
    EXPECT_TRUE(is_of_other_doors(door, {"state-first"}));
    EXPECT_FALSE(is_of_other_doors(door, {"state-first", "state-static"}));
    EXPECT_FALSE(is_of_other_doors(
        parsed({"extra:cover.outside@vulkan<=1", "value:door.state=state-static@vulkan<=36"}), {}));
    EXPECT_FALSE(is_of_other_doors({}, {}));
    ExpectationLine line;
    line.status = report::Status::fail;
    line.cause = door;
    report::CaseRecord record;
    record.status = report::Status::pass;
    apply(line, record);
    EXPECT_EQ(record.status, report::Status::pass);
    record.drawn.doors = {"state-static"};
    apply(line, record);
    EXPECT_EQ(record.status, report::Status::xpass);
}

TEST(ExpectedCause, WrongDoorsAreRefused) {
    const auto refused = [](const char* word) {
        ExpectedCause cause;
        const auto added = add_cause_word(cause, word);
        return added ? std::string() : added.error().message;
    };
    EXPECT_EQ(refused("value:door.state@vulkan<=1"),
              "'door.state' does not say of which door; write 'door.state=DOOR'");
    EXPECT_EQ(refused("value:door.state=state-statik@vulkan<=1"),
              "'state-statik' is no door; did you mean 'state-static'?");
    EXPECT_EQ(refused("value:cover.inside=state-static@vulkan<=1"),
              "'cover.inside' is no rule of doors, so that no '=DOOR' follows it");
    EXPECT_EQ(refused("value:door.index=state-static@vulkan<=1"),
              "'state-static' is a door of 'door.state' and not of 'door.index'");
}

TEST(ExpectedCause, AFlakeThatWasADeathIsKnownByItsDeathAlone) {
    report::CaseRecord record = failed(0, 0);
    record.outcome.groups.clear();
    record.status = report::Status::flake;
    EXPECT_EQ(what_is_new({}, record), "");  // the first drawing was right
    record.death.suspects = {"a"};
    record.death.signal = "SIGSEGV";
    EXPECT_NE(what_is_new({}, record), "");
    EXPECT_NE(what_is_new(parsed({"extra:cover.outside@vulkan<=9"}), record), "");
    EXPECT_NE(what_is_new(parsed({"bits=0123456789abcdef"}), record), "");
    EXPECT_NE(what_is_new(parsed({"signal=SIGABRT"}), record), "");
    EXPECT_EQ(what_is_new(parsed({"signal=SIGSEGV"}), record), "");
    record.death.suspects = {"a", "b"};
    EXPECT_NE(what_is_new(parsed({"signal=SIGSEGV"}), record), "");
}

// A line may know a death and findings; a failure is no death, and its findings are asked alone.
TEST(ExpectedCause, AFailureIsNotAskedForADeath) {
    const report::CaseRecord record = failed(2, 1);
    const char* const findings = "extra:cover.outside@vulkan<=2";
    EXPECT_EQ(what_is_new(parsed({"signal=SIGSEGV", findings, "value:interp.linear@practice<=1"}),
                          record),
              "");
    EXPECT_NE(what_is_new(parsed({"signal=SIGSEGV", findings}), record), "");
    EXPECT_NE(what_is_new(parsed({"signal=SIGSEGV"}), record), "");
}

TEST(ExpectedCause, GrowsToTheLargestCount) {
    ExpectedCause cause = cause_of(failed(9, 3));
    widen(cause, cause_of(failed(2, 5)));
    EXPECT_EQ(to_text(cause), "extra:cover.outside@vulkan<=9 value:interp.linear@practice<=5");
    report::CaseRecord crash;
    crash.death.signal = "SIGSEGV";
    crash.death.step = "submit";
    EXPECT_EQ(to_text(cause_of(crash)), "signal=SIGSEGV");
    add_up(cause, cause_of(crash));
    EXPECT_EQ(cause.signal, "SIGSEGV");
}

TEST(GlobCover, MatchesWhatIsWantedAndNothingElse) {
    std::vector<std::string> all;
    for (const char* a : {"1", "2", "3"}) {
        for (const char* b : {"x", "y"}) {
            all.push_back(std::string("f/m:a=") + a + ",b=" + b);
        }
    }
    all.emplace_back("f/single");
    EXPECT_EQ(cover_by_globs(all, all), (std::vector<std::string>{"f/m:*", "f/single"}));
    EXPECT_EQ(cover_by_globs({all[0], all[1], all[4]}, all),
              (std::vector<std::string>{"f/m:a=1,*", "f/m:a=3,b=x"}));
    EXPECT_EQ(cover_by_globs({all[1], all[3], all[5]}, all),
              (std::vector<std::string>{"f/m:*,b=y"}));
    EXPECT_EQ(cover_by_globs({all[2]}, all), (std::vector<std::string>{all[2]}));
    EXPECT_TRUE(cover_by_globs({}, all).empty());
}

}  // namespace
}  // namespace run
