// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/commands.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/text/causes.hpp"
#include "report/text/console.hpp"
#include "report/text/wrap.hpp"
#include "sample_run.hpp"

namespace report {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(commands, settings_are_the_words_before_the_program) {
    EXPECT_EQ(settings_of("edgecase run x"), "");
    EXPECT_EQ(settings_of("VK_DRIVER_FILES=a.json edgecase run x"), "VK_DRIVER_FILES=a.json ");
    EXPECT_EQ(settings_of("A=1 B_2='x y' C= edgecase run x=y"), "A=1 B_2='x y' C= ");
    EXPECT_EQ(settings_of("A='it'\\''s here' edgecase"), "A='it'\\''s here' ");
    // No settings: a path with a sign, a word alone, a value without an end.
    EXPECT_EQ(settings_of("./a=b/edgecase run"), "");
    EXPECT_EQ(settings_of("=1 edgecase"), "");
    EXPECT_EQ(settings_of("A=1"), "");
    EXPECT_EQ(settings_of("A='1 edgecase"), "");
    EXPECT_EQ(settings_of(""), "");
}

TEST(commands, a_debugger_is_for_what_died) {
    CaseRecord record;
    record.rerun = "A=1 edgecase run x";
    for (size_t k = 0; k < kStatuses; ++k) {
        record.status = static_cast<Status>(k);
        const bool died = record.status == Status::crash || record.status == Status::timeout;
        EXPECT_EQ(debug_line(record), died ? "A=1 edgecase run x --debugger gdb" : "");
    }
}

TEST(commands, a_cause_is_repeated_by_its_own_door) {
    CaseRecord record;
    const auto line = [&](const std::string& rerun, const std::string& door) {
        record.rerun = rerun;
        Cause cause;
        cause.door = door;
        cause.cases = {&record};
        return rerun_of(cause);
    };
    EXPECT_EQ(line("A=1 edgecase run x", ""), "A=1 edgecase run x");
    EXPECT_EQ(line("edgecase run x --doors one", ""), "edgecase run x --doors one");
    EXPECT_EQ(line("edgecase run x --device y", "two"), "edgecase run x --device y --doors two");
    EXPECT_EQ(line("edgecase run x --doors one,two --no-expect", "two"),
              "edgecase run x --no-expect --doors two");
    EXPECT_EQ(line("edgecase run x --doors one", "two"), "edgecase run x --doors two");
    EXPECT_EQ(line("", "two"), "");
}

TEST(commands, the_terminal_tells_shared_settings_once) {
    report::Run run = test::sample_run();
    const std::string settings = "VK_DRIVER_FILES='/a long/path' LP_NUM_THREADS=1 ";
    for (CaseRecord& r : run.cases) {
        r.rerun = settings + r.rerun;
    }
    const std::string text = console_summary(run, "", {});
    EXPECT_THAT(text,
                HasSubstr("causes, the worst first; put the settings in front of each rerun:\n"
                          "  settings: VK_DRIVER_FILES='/a long/path' LP_NUM_THREADS=1\n"));
    // And once more in the line that repeats the smallest case, which is copied by itself.
    const size_t smallest = text.find("smallest case: ");
    EXPECT_EQ(text.find("VK_DRIVER_FILES"), text.rfind("VK_DRIVER_FILES", smallest));
    EXPECT_THAT(text.substr(smallest), HasSubstr("rerun: " + settings));
    for (const Cause& cause : causes(run)) {
        if (cause.status != Status::not_run) {
            EXPECT_THAT(text, HasSubstr("rerun: edgecase run '" + smallest_case(cause).id + "'\n"));
        }
    }
    // A command is never broken in two, so that it can be copied; the settings are part of it.
    EXPECT_THAT(wrapped(text, 40), HasSubstr("\n  settings: VK_DRIVER_FILES='/a long/path' "
                                             "LP_NUM_THREADS=1\n"));
    // What is not the same of all is told of each.
    for (CaseRecord& r : run.cases) {
        if (r.status == Status::crash) {
            r.rerun = "X=1 edgecase run y";
        }
    }
    const std::string each = console_summary(run, "", {});
    EXPECT_THAT(each, Not(HasSubstr("settings:")));
    EXPECT_THAT(each, HasSubstr("rerun: X=1 edgecase run y\n"));
    EXPECT_THAT(each, HasSubstr("rerun: " + settings + "edgecase run"));
}

TEST(commands, known_failures_have_causes_of_their_own) {
    report::Run run = test::sample_run();
    const auto known = [&] { return known_causes(run); };
    ASSERT_EQ(known().size(), 1U);
    EXPECT_EQ(cause_title(known()[0]), "xfail in clip, 1 case");
    for (const Cause& cause : causes(run)) {
        EXPECT_NE(cause.status, Status::xfail);
    }
    // In order of their levels, whatever the order of the run: the first one is of vulkan.
    CaseRecord ties = run.cases[4], diagonal = run.cases[3];
    ASSERT_EQ(ties.outcome.level, cases::Profile::direct3d);
    ASSERT_EQ(diagonal.outcome.level, cases::Profile::vulkan);
    ties.status = diagonal.status = Status::xfail;
    run.cases = {ties, diagonal};
    ASSERT_EQ(known().size(), 2U);
    EXPECT_EQ(known()[0].rule, "cover.shared-edge");
    EXPECT_EQ(known()[1].rule, "tie.top-left");
    EXPECT_TRUE(causes(run).empty());
}

}  // namespace
}  // namespace report
