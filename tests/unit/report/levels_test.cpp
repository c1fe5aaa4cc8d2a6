// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/record/levels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "report/files/ci.hpp"
#include "report/files/json.hpp"
#include "report/files/junit.hpp"
#include "report/page/html.hpp"
#include "report/text/causes.hpp"
#include "report/text/levels_text.hpp"
#include "report/text/sentences.hpp"

namespace report {

namespace {

using cases::Profile;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct Wrong {
    Profile level;
    uint64_t count = 1, known = 0;
};

// A case with a finding of each group; of a status that judge_expected() would give it.
CaseRecord a_case(const std::string& id, Status status, const std::vector<Wrong>& groups = {}) {
    CaseRecord record;
    record.id = id;
    record.status = status;
    record.outcome.compared_samples = 64;
    for (const Wrong& wrong : groups) {
        diff::Finding finding;
        finding.kind = diff::FindingKind::missing;
        finding.rule = wrong.level == Profile::direct3d ? "tie.top-left" : "cover.inside";
        finding.level = wrong.level;
        record.outcome.level = record.outcome.findings.empty()
                                   ? wrong.level
                                   : std::min(record.outcome.level, wrong.level);
        record.outcome.counts.at(0) += wrong.count;
        record.outcome.groups.push_back(
            {finding.kind, finding.rule, wrong.level, wrong.count, wrong.known});
        record.outcome.findings.push_back(finding);
    }
    return record;
}

report::Run run_of(std::vector<CaseRecord> cases, Profile profile = Profile::direct3d) {
    report::Run run;
    run.profile = profile;
    run.cases = std::move(cases);
    run.ended = "2026-11-25T00:00:00Z";
    return run;
}

// What is known at `vulkan` stands beside a new difference in a tie.
CaseRecord with_news_at_direct3d() {
    return a_case("ties/a", Status::fail, {{Profile::vulkan, 3, 3}, {Profile::direct3d, 2, 1}});
}

TEST(levels, of_a_cause_are_those_of_what_is_new_in_it) {
    report::Run run = run_of({with_news_at_direct3d()});
    ASSERT_EQ(causes(run).size(), 1U);
    EXPECT_EQ(causes(run)[0].level, Profile::direct3d);
    EXPECT_EQ(causes(run)[0].rule, "tie.top-left");
    EXPECT_FALSE(causes(run)[0].is_known);
    // Another level is another cause, the gravest first.
    run.cases.push_back(a_case("ties/b", Status::fail, {{Profile::vulkan}}));
    run.cases.back().outcome.findings[0].rule = run.cases.back().outcome.groups[0].rule =
        "tie.top-left";
    ASSERT_EQ(causes(run).size(), 2U);
    EXPECT_EQ(causes(run)[0].level, Profile::vulkan);
    EXPECT_EQ(causes(run)[1].level, Profile::direct3d);
}

TEST(levels, every_report_tells_the_level_of_what_is_new) {
    const report::Run run = run_of({with_news_at_direct3d()});
    const std::string line = levels_line(run);
    EXPECT_EQ(
        line,
        "vulkan: nothing new in 1 case, 1 is wrong as expected - practice: nothing - direct3d: "
        "1 case differs (ties)");
    EXPECT_THAT(to_github_summary(run), HasSubstr("| fail: tie.top-left missing in ties, 1 case | "
                                                  "direct3d |"));
    EXPECT_THAT(to_gitlab(run, "/"), HasSubstr("\"severity\": \"minor\""));
    EXPECT_THAT(to_junit(run),
                AllOf(HasSubstr("tie.top-left [direct3d"), Not(HasSubstr("[vulkan:"))));
    const std::string page = to_html(run);
    EXPECT_THAT(page, HasSubstr("<strong>vulkan: nothing new in 1 case, 1 is wrong as expected"));
    EXPECT_THAT(page, HasSubstr("<strong class=\"level level-direct3d\">direct3d: 1 case differs "
                                "(ties)</strong> differs from top-left hardware"));
}

TEST(levels, a_cause_whose_findings_are_all_expected_says_so) {
    // Its picture is new, or the way in which the driver died.
    const report::Run run = run_of({a_case("ties/a", Status::fail, {{Profile::vulkan, 3, 3}})});
    ASSERT_EQ(causes(run).size(), 1U);
    EXPECT_EQ(causes(run)[0].level, std::nullopt);
    EXPECT_TRUE(causes(run)[0].is_known);
    EXPECT_EQ(cause_level(causes(run)[0]), "all expected");
    EXPECT_THAT(to_github_summary(run), HasSubstr("| all expected |"));
    EXPECT_THAT(to_json(run), HasSubstr("\"known\": true"));
    EXPECT_THAT(to_html(run), HasSubstr("\"known\":true"));
    EXPECT_EQ(exit_code(run), kExitUnexpected);
    // Known failures have the level of all that is known of them.
    const report::Run known = run_of({a_case("ties/a", Status::xfail, {{Profile::vulkan, 3, 3}})});
    ASSERT_EQ(known_causes(known).size(), 1U);
    EXPECT_EQ(known_causes(known)[0].level, Profile::vulkan);
}

TEST(levels, news_beyond_the_findings_that_are_kept_lead) {
    CaseRecord record = a_case("ties/a", Status::fail, {{Profile::direct3d, 2, 2}});
    record.outcome.groups.push_back({diff::FindingKind::double_hit, "", Profile::vulkan, 1, 0});
    const report::Run run = run_of({record});
    EXPECT_EQ(cause_title(causes(run)[0]) + " " + cause_level(causes(run)[0]),
              "fail: double in ties, 1 case vulkan");
    EXPECT_THAT(what_happened(record), HasSubstr("no told rule [vulkan: not conformant]"));
    EXPECT_THAT(to_gitlab(run, "/"), HasSubstr("\"severity\": \"critical\""));
}

TEST(levels, what_could_not_be_judged_has_none) {
    // An error after findings: the rest of the picture was not copied.
    for (const Status status : {Status::error, Status::crash, Status::timeout, Status::device_lost,
                                Status::not_run, Status::unsupported, Status::skip}) {
        const report::Run run =
            run_of({a_case("ties/a", status, {{Profile::vulkan}}), a_case("ties/b", Status::pass)});
        const std::string name(to_string(status));
        EXPECT_EQ(level_of(run.cases[0], Of::all), std::nullopt) << name;
        EXPECT_EQ(levels(run).judged, 1U) << name;
        const bool is_told = status != Status::unsupported && status != Status::skip;
        EXPECT_EQ(levels_line(run),
                  std::string("vulkan: nothing wrong in 1 case - practice: nothing - direct3d: "
                              "nothing") +
                      (is_told ? " - without a level: 1 case" : ""));
        for (const Cause& cause : causes(run)) {
            EXPECT_EQ(cause_level(cause), "") << name;
        }
        EXPECT_THAT(what_happened(run.cases[0]), Not(HasSubstr("[vulkan"))) << name;
        EXPECT_THAT(to_html(run), Not(HasSubstr("level level-vulkan\">vulkan:"))) << name;
    }
    // --require-support makes a failure of it, which has no findings.
    CaseRecord lacking = a_case("ties/a", Status::fail);
    lacking.known.actual = Status::unsupported;
    const report::Run run =
        run_of({lacking, a_case("ties/b", Status::fail, {{Profile::direct3d}})});
    EXPECT_EQ(levels(run).judged, 1U);
    EXPECT_EQ(levels(run).unjudged, 0U);
    EXPECT_THAT(to_gitlab(run, "/"), HasSubstr("\"severity\": \"major\""));
    // What breaks a level is told before what has none.
    EXPECT_EQ(causes(run)[0].rule, "tie.top-left");
}

TEST(levels, count_cases_at_each_level_of_which_they_have_findings) {
    const report::Run run = run_of({
        a_case("ties/a", Status::fail, {{Profile::vulkan}, {Profile::direct3d}}),
        a_case("clip/b", Status::fail, {{Profile::direct3d}}),
        a_case("clip/c", Status::xfail, {{Profile::direct3d, 1, 1}, {Profile::practice, 2, 2}}),
        a_case("clip/d", Status::flake, {{Profile::direct3d}}),
        a_case("depth/e", Status::pass),
        a_case("depth/f", Status::flake),
        a_case("depth/g", Status::unsupported),
    });
    const Levels found = levels(run);
    EXPECT_EQ(found.judged, 5U);
    EXPECT_EQ(found.unjudged, 1U);
    EXPECT_EQ(
        levels_line(run),
        "vulkan: 1 of 5 cases is wrong (ties) - practice: nothing new, 1 case is suspicious as "
        "expected - direct3d: 3 cases differ (clip, ties), 1 more as expected - without a "
        "level: 1 case");
}

TEST(levels, a_level_that_the_profile_leaves_out_is_not_judged) {
    EXPECT_EQ(levels_line(run_of({a_case("ties/a", Status::pass)}, Profile::vulkan)),
              "vulkan: nothing wrong in 1 case - practice: not judged - direct3d: not judged");
    EXPECT_EQ(levels_line(run_of({a_case("ties/a", Status::unsupported)})),
              "vulkan: not judged - practice: not judged - direct3d: not judged");
}

TEST(levels, choose_what_makes_the_run_fail) {
    report::Run run =
        run_of({a_case("ties/a", Status::fail, {{Profile::direct3d}}),
                a_case("ties/b", Status::fail, {{Profile::vulkan, 1, 1}, {Profile::direct3d}})});
    EXPECT_EQ(exit_code(run), kExitUnexpected);
    run.fail_at = Profile::practice;
    EXPECT_EQ(exit_code(run), kExitOk);
    EXPECT_EQ(exit_text(run), "exit 0: all as expected at practice; 2 cases fail only beyond it");
    EXPECT_THAT(to_junit(run), AllOf(HasSubstr("failures=\"0\""), HasSubstr("skipped=\"2\""),
                                     HasSubstr("fails only beyond --fail-at practice: ")));
    EXPECT_THAT(to_github_annotations(run, "/"),
                AllOf(HasSubstr("::notice "), Not(HasSubstr("::error "))));
    EXPECT_THAT(to_gitlab(run, "/"), AllOf(HasSubstr("\"info\""), Not(HasSubstr("\"minor\""))));
    // A level at which it is wrong, a death, a flake and an outdated expectation still count.
    run.cases.push_back(a_case("ties/c", Status::fail, {{Profile::direct3d}, {Profile::practice}}));
    EXPECT_EQ(exit_code(run), kExitUnexpected);
    for (const Status status : {Status::crash, Status::flake, Status::xpass, Status::improved}) {
        run.cases.back() = a_case("ties/c", status);
        EXPECT_EQ(exit_code(run), kExitUnexpected) << to_string(status);
    }
    run.cases.back() = a_case("ties/c", Status::error);
    EXPECT_EQ(exit_code(run), kExitInternal);
}

}  // namespace

}  // namespace report
