// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/diagnosis_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/files/ci.hpp"
#include "report/files/json.hpp"
#include "report/page/html.hpp"
#include "report/text/console.hpp"

namespace report {

namespace {

// A run whose failed cases have these ids, each of the same rule.
Run run_of(const std::vector<std::string>& ids) {
    Run run;
    for (const std::string& id : ids) {
        CaseRecord record;
        record.id = id;
        record.status = Status::fail;
        run.cases.push_back(record);
    }
    return run;
}

Diagnosis tried(std::vector<std::string> explained, std::vector<std::string> unexplained) {
    Diagnosis d;
    d.explained = std::move(explained);
    d.unexplained = std::move(unexplained);
    return d;
}

// By family, the diagnosis that repeats the cause; -1 if none does.
std::vector<std::pair<std::string, int>> repeated_causes(const Run& run) {
    const Repeated repeated(run);
    std::vector<std::pair<std::string, int>> out;
    const std::vector<Cause> list = causes_by_family(run);
    const std::vector<std::optional<size_t>> numbers = repeated.of(list);
    for (size_t k = 0; k < list.size(); ++k) {
        out.emplace_back(families_text(list[k].cases),
                         numbers[k] ? static_cast<int>(*numbers[k]) : -1);
    }
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace

// Cases that passed and would have failed are told, and are not among those that agree.
TEST(DiagnosisText, WhatSpeaksAgainstItIsTold) {
    Diagnosis d;
    d.samples = d.same_samples = 90;
    d.cases = 20;
    d.tried = 64;
    d.passed_tried = 300;
    EXPECT_EQ(evidence_for(d),
              "repeats 90 of 90 wrong samples in 20 of 64 failed cases tried; 300 cases that "
              "passed agree");
    d.passed_against = 2;
    d.against = 1;
    EXPECT_EQ(evidence_for(d),
              "repeats 90 of 90 wrong samples in 20 of 64 failed cases tried; 1 fails otherwise; "
              "2 of 300 cases that passed would fail");
    // Of those that were not tried nothing is known.
    d.failed = 796;
    d.passed_against = d.against = 0;
    EXPECT_EQ(evidence_for(d),
              "repeats 90 of 90 wrong samples in 20 of 64 failed cases tried, 796 failed in all; "
              "300 cases that passed agree");
}

TEST(Repeated, ACauseOfWhichEveryTriedCaseIs) {
    report::Run run = run_of({"a/1", "a/2", "a/3", "b/1", "b/2", "c/1", "d/1", "d/2", "d/3"});
    run.diagnoses = {tried({"a/1", "b/1", "d/1"}, {"b/2", "d/2", "d/3"}),
                     tried({"d/2", "d/3"}, {"a/1", "b/1", "b/2", "d/1"})};
    // Of b one is not repeated by any, of c none was tried; d has two errors, so neither alone is
    // the cause.
    EXPECT_EQ(repeated_causes(run), (std::vector<std::pair<std::string, int>>{
                                        {"a", 0}, {"b", -1}, {"c", -1}, {"d", -1}}));
    const Repeated repeated(run);
    EXPECT_EQ(repeated.by("a/1"), 0U);
    EXPECT_EQ(repeated.by("a/2"), std::nullopt);
    EXPECT_EQ(repeated.by("d/2"), 1U);
    EXPECT_EQ(repeated.by("b/2"), std::nullopt);
    // The first explains half of what was tried, the second less, and no cause.
    EXPECT_FALSE(repeated.is_partial(0));
    EXPECT_TRUE(repeated.is_partial(1));
    // Relations between drawings are of none, whatever the picture is like.
    diff::Finding finding;
    finding.rule = "repeat.same";
    run.cases[0].outcome.findings = {finding};
    run.cases[1].outcome.findings = run.cases[2].outcome.findings = run.cases[0].outcome.findings;
    EXPECT_EQ(repeated_causes(run)[0], (std::pair<std::string, int>{"a", -1}));
    run.diagnoses.clear();
    EXPECT_EQ(repeated_causes(run), (std::vector<std::pair<std::string, int>>{
                                        {"a", -1}, {"b", -1}, {"c", -1}, {"d", -1}}));
}

// A cause that was not tried goes with those that break its rule alike, where three quarters of
// what was tried of them are repeated; and the doors of a wrong picture with that picture.
TEST(Repeated, WhatWasNotTriedGoesWithItsRule) {
    report::Run run = run_of({"a/1", "b/1", "b/2", "b/3", "c/1", "d/1"});
    for (size_t k = 0; k < 5; ++k) {
        diff::Finding finding;
        finding.rule = "cover.inside";
        run.cases[k].outcome.findings = {finding};
        run.cases[k].outcome.groups = {{finding.kind, finding.rule, finding.level, 1, 0, ""}};
    }
    run.cases[4].outcome.groups.push_back(
        {diff::FindingKind::value, "door.index", cases::Profile::direct3d, 1, 0, "index-8"});
    run.diagnoses = {tried({"a/1", "b/1", "b/2"}, {"b/3"})};
    std::vector<std::string> told;
    const auto tell = [&] {
        told.clear();
        for (const Cause& cause : causes(run)) {
            told.push_back(cause_title(cause) + (cause.diagnosis ? " = diagnosis" : ""));
        }
        std::ranges::sort(told);
        return told;
    };
    EXPECT_EQ(tell(),
              (std::vector<std::string>{"fail in d, 1 case",
                                        "fail: cover.inside missing in a, c, 2 cases = diagnosis",
                                        "fail: cover.inside missing in b, 3 cases",
                                        "fail: door.index value in c, 1 case = diagnosis"}));
    run.diagnoses = {tried({"a/1", "b/1"}, {"b/2", "b/3"})};
    EXPECT_EQ(
        tell(),
        (std::vector<std::string>{
            "fail in d, 1 case", "fail: cover.inside missing in a, 1 case = diagnosis",
            "fail: cover.inside missing in b, c, 4 cases", "fail: door.index value in c, 1 case"}));
    // The door that alone shows a failure has a cause of its own.
    run.cases[4].outcome.findings[0].rule = "door.index";
    run.cases[4].outcome.findings[0].door = "index-8";
    run.cases[4].outcome.groups.erase(run.cases[4].outcome.groups.begin());
    EXPECT_EQ(tell().back(), "fail: door.index=index-8 value in c, 1 case");
}

TEST(Repeated, WhatExplainsAFewCasesTakesNoCauseAway) {
    // The only tried case of a is explained, but 7 of 9 are not: that says nothing of the device.
    report::Run run = run_of({"a/1", "b/1", "b/2", "b/3", "b/4", "b/5", "b/6", "b/7", "c/1"});
    run.diagnoses = {tried({"a/1"}, {"b/1", "b/2", "b/3", "b/4", "b/5", "b/6", "b/7", "c/1"}),
                     tried({"c/1"}, {"a/1", "b/1", "b/2", "b/3", "b/4", "b/5", "b/6", "b/7"})};
    run.diagnoses[0].what = {"First"};
    run.diagnoses[0].cases = 1;
    run.diagnoses[0].tried = 9;
    run.diagnoses[1].what = {"Second"};
    EXPECT_EQ(repeated_causes(run),
              (std::vector<std::pair<std::string, int>>{{"a", -1}, {"b", -1}, {"c", -1}}));
    EXPECT_TRUE(Repeated(run).is_partial(0));
    // It is told after the causes, in other words, everywhere.
    const std::string told = console_summary(run, "", {});
    EXPECT_EQ(told.find("diagnosis: "), std::string::npos);
    EXPECT_GT(
        told.find("some cases look as if: First\n      explains 1 of 9 failed cases tried only; "),
        told.find("causes, the worst first"));
    EXPECT_NE(told.find("some cases look as if: First"), std::string::npos);
    const std::string summary = to_github_summary(run);
    EXPECT_EQ(summary.find("**Diagnosis"), std::string::npos);
    EXPECT_GT(summary.find("Some cases look as if: First. It explains 1 of 9 failed"),
              summary.find("### Causes"));
    EXPECT_NE(to_json(run).find("\"partial\": true"), std::string::npos);
    EXPECT_NE(to_html(run).find("\"limits\":\"explains 1 of 9 failed cases tried only\""),
              std::string::npos);
    // Several errors that together explain most, each of them all of a cause, are at the head.
    run.diagnoses[0] = tried({"b/1", "b/2", "b/3"}, {"a/1", "b/4", "b/5", "b/6", "b/7", "c/1"});
    EXPECT_TRUE(Repeated(run).is_partial(0));
    EXPECT_TRUE(Repeated(run).is_partial(1));
    run.diagnoses[0] = tried({"b/1", "b/2", "b/3", "b/4", "b/5", "b/6", "b/7"}, {"a/1", "c/1"});
    EXPECT_FALSE(Repeated(run).is_partial(0));
    EXPECT_FALSE(Repeated(run).is_partial(1));
    EXPECT_EQ(repeated_causes(run),
              (std::vector<std::pair<std::string, int>>{{"a", -1}, {"b", 0}, {"c", 1}}));
}

}  // namespace report
