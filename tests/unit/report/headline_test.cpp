// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/headline.hpp"

#include <gtest/gtest.h>

#include "report/text/levels_text.hpp"
#include "sample_run.hpp"

namespace report {

namespace {

using test::run_of;

using enum Status;

TEST(headline, tells_what_is_unexpected_before_all_else) {
    EXPECT_EQ(headline(run_of({pass, fail, fail, crash, xfail})), "2 of 5 cases fail, 1 crashes");
    EXPECT_EQ(headline(run_of({flake})), "1 of 1 case differs from run to run");
    EXPECT_EQ(headline(run_of({xpass, not_run, not_run})),
              "2 of 3 cases were not run, 1 passes unexpectedly");
}

// What was not asked of the device is no case of which so many fail: the levels leave it out, too.
TEST(headline, counts_of_what_was_judged) {
    report::Run run = run_of({fail, pass, pass, unsupported, skip});
    EXPECT_EQ(headline(run), "1 of 3 judged cases fails");
    run.cases[0].outcome.counts.at(0) = 1;
    EXPECT_TRUE(levels_line(run).find("in 3 cases") != std::string::npos) << levels_line(run);
    // A crash is no judgement.
    EXPECT_EQ(headline(run_of({fail, crash, unsupported})), "1 of 2 cases fails, 1 crashes");
}

TEST(headline, never_says_that_what_was_not_judged_passes) {
    EXPECT_EQ(headline(run_of({})), "No case was judged");
    EXPECT_EQ(headline(run_of({unsupported, skip})), "No case was judged");
    EXPECT_EQ(headline(run_of({pass, pass, unsupported})), "All 2 judged cases pass");
    EXPECT_EQ(headline(run_of({pass, pass})), "All 2 cases pass");
    EXPECT_EQ(headline(run_of({pass})), "The one case passes");
    EXPECT_EQ(headline(run_of({pass, xfail, skip})),
              "All as expected: 1 of 2 judged cases fails, as is known");
}

TEST(headline, has_words_for_every_status) {
    for (size_t k = 0; k < kStatuses; ++k) {
        const auto status = static_cast<Status>(k);
        const std::string text = headline(run_of({status, pass}));
        EXPECT_EQ(text.starts_with("1 of 2 cases "), !is_expected(status)) << text;
    }
}

TEST(headline, tells_apart_what_fails_only_beyond_the_level_of_the_run) {
    report::Run run = run_of({fail, fail, pass});
    for (CaseRecord& record : run.cases) {
        record.outcome.counts.at(0) = record.status == fail ? 1 : 0;
        record.outcome.level = cases::Profile::direct3d;
    }
    EXPECT_EQ(headline(run), "2 of 3 cases fail");
    run.fail_at = cases::Profile::practice;
    EXPECT_EQ(headline(run), "2 of 3 cases fail only beyond practice");
    run.cases[0].outcome.level = cases::Profile::vulkan;
    EXPECT_EQ(headline(run), "1 of 3 cases fails, 1 fails only beyond practice");
}

}  // namespace

}  // namespace report
