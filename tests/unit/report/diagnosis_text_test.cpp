// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/diagnosis_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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
    for (const Cause& cause : causes(run)) {
        const auto number = repeated.by(cause);
        out.emplace_back(cause.family, number ? static_cast<int>(*number) : -1);
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
}

TEST(Repeated, ACauseOfWhichEveryTriedCaseIs) {
    report::Run run = run_of({"a/1", "a/2", "a/3", "b/1", "b/2", "c/1", "d/1", "d/2", "d/3"});
    run.diagnoses = {tried({"a/1", "b/1", "d/1"}, {"b/2", "d/2", "d/3"}),
                     tried({"d/2", "d/3"}, {"a/1", "b/1", "b/2", "d/1"})};
    // Of b one is not repeated by any, of c none was tried; d has two errors, the second more
    // often.
    EXPECT_EQ(repeated_causes(run),
              (std::vector<std::pair<std::string, int>>{{"a", 0}, {"b", -1}, {"c", -1}, {"d", 1}}));
    const Repeated repeated(run);
    EXPECT_EQ(repeated.by("a/1"), 0U);
    EXPECT_EQ(repeated.by("a/2"), std::nullopt);
    EXPECT_EQ(repeated.by("d/2"), 1U);
    EXPECT_EQ(repeated.by("b/2"), std::nullopt);
    run.diagnoses.clear();
    EXPECT_EQ(repeated_causes(run), (std::vector<std::pair<std::string, int>>{
                                        {"a", -1}, {"b", -1}, {"c", -1}, {"d", -1}}));
}

}  // namespace report
