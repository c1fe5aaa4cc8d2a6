// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/headline.hpp"

#include <gtest/gtest.h>

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

TEST(headline, never_says_that_what_was_not_judged_passes) {
    EXPECT_EQ(headline(run_of({})), "No case was judged");
    EXPECT_EQ(headline(run_of({unsupported, skip})), "No case was judged");
    EXPECT_EQ(headline(run_of({pass, pass, unsupported})), "All 2 judged cases pass");
    EXPECT_EQ(headline(run_of({pass, pass})), "All 2 cases pass");
    EXPECT_EQ(headline(run_of({pass})), "The one case passes");
    EXPECT_EQ(headline(run_of({pass, xfail, skip})),
              "All as expected: 1 of 2 judged cases fail, as is known");
}

TEST(headline, has_words_for_every_status) {
    for (size_t k = 0; k < kStatuses; ++k) {
        const auto status = static_cast<Status>(k);
        const std::string text = headline(run_of({status, pass}));
        EXPECT_EQ(text.starts_with("1 of 2 cases "), !is_expected(status)) << text;
    }
}

TEST(headline, counts_a_case_at_its_loosest_level) {
    report::Run run = run_of({fail, fail, xfail, pass, crash});
    for (CaseRecord& record : run.cases) {
        record.findings.resize(1);
        record.level = cases::Profile::vulkan;
    }
    run.cases[1].level = cases::Profile::direct3d;
    run.cases[4].findings.clear();
    EXPECT_EQ(unexpected_by_level(run), (std::array<size_t, 3>{1, 0, 1}));
}

}  // namespace

}  // namespace report
