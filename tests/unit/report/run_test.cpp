// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/record/run.hpp"

#include <gtest/gtest.h>

#include "sample_run.hpp"

namespace report {

namespace {

using test::run_of;

TEST(status, names_are_those_of_the_design) {
    const char* names[] = {"pass", "unsupported", "skip",    "xfail", "xpass", "improved", "flake",
                           "fail", "device_lost", "timeout", "crash", "error", "not_run"};
    for (size_t k = 0; k < kStatuses; ++k) {
        EXPECT_EQ(to_string(static_cast<Status>(k)), names[k]);
        EXPECT_EQ(parse_status(names[k]), static_cast<Status>(k));
    }
    EXPECT_FALSE(parse_status("passed"));
    EXPECT_FALSE(parse_status(""));
}

TEST(status, only_four_are_expected) {
    for (size_t k = 0; k < kStatuses; ++k) {
        const auto status = static_cast<Status>(k);
        const bool expected = status == Status::pass || status == Status::unsupported ||
                              status == Status::skip || status == Status::xfail;
        EXPECT_EQ(is_expected(status), expected) << to_string(status);
    }
}

TEST(exit_code, of_one_more_case_beside_a_pass) {
    const int codes[kStatuses] = {0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 7, 7};
    for (size_t k = 0; k < kStatuses; ++k) {
        const auto status = static_cast<Status>(k);
        EXPECT_EQ(exit_code(run_of({Status::pass, status})), codes[k]) << to_string(status);
    }
}

TEST(exit_code, of_a_run_that_judged_nothing) {
    EXPECT_EQ(exit_code(run_of({})), kExitAllSkipped);
    EXPECT_EQ(exit_code(run_of({Status::skip, Status::unsupported})), kExitAllSkipped);
    EXPECT_EQ(exit_code(run_of({Status::skip, Status::xfail})), kExitOk);
}

TEST(exit_code, worst_wins) {
    EXPECT_EQ(exit_code(run_of({Status::fail, Status::not_run})), kExitInternal);
    EXPECT_EQ(exit_code(run_of({Status::skip, Status::fail})), kExitUnexpected);
    report::Run run = run_of({Status::pass});
    run.interrupted = true;
    EXPECT_EQ(exit_code(run), kExitInterrupted);
}

TEST(totals, count_every_status) {
    const auto count = totals(run_of({Status::pass, Status::fail, Status::pass}));
    EXPECT_EQ(count[static_cast<size_t>(Status::pass)], 2U);
    EXPECT_EQ(count[static_cast<size_t>(Status::fail)], 1U);
    EXPECT_EQ(count[static_cast<size_t>(Status::crash)], 0U);
}

}  // namespace

}  // namespace report
