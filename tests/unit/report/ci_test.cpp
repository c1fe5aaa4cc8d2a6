// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/files/ci.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "cases/base/utf8.hpp"
#include "report/files/json.hpp"
#include "report/files/junit.hpp"
#include "report/journal/merge.hpp"
#include "report/text/causes.hpp"
#include "report/text/console.hpp"
#include "report/text/headline.hpp"
#include "report/text/sentences.hpp"
#include "sample_run.hpp"

namespace report {
namespace {

size_t lines_with(const std::string& text, const std::string& start) {
    size_t count = text.starts_with(start) ? 1 : 0;
    for (size_t at = 0; (at = text.find("\n" + start, at)) != std::string::npos; ++at) {
        ++count;
    }
    return count;
}

TEST(causes, group_by_status_rule_kind_and_family) {
    report::Run run = test::sample_run();
    CaseRecord again = run.cases[4];
    again.id = "ties/right";
    run.cases.push_back(again);
    again.id = "other/right";
    run.cases.push_back(again);
    const std::vector<Cause> list = causes(run);
    size_t cases = 0;
    for (const Cause& cause : list) {
        cases += cause.cases.size();
    }
    EXPECT_EQ(cases, static_cast<size_t>(std::count_if(
                         run.cases.begin(), run.cases.end(),
                         [](const CaseRecord& r) { return !is_expected(r.status); })));
    const auto ties = std::ranges::find(list, "tie.top-left", &Cause::rule);
    ASSERT_NE(ties, list.end());
    EXPECT_EQ(cause_title(*ties), "fail: tie.top-left missing in ties, other, 3 cases");
    // Deaths before failures, what breaks Vulkan before what breaks Direct3D, not run at last.
    EXPECT_EQ(list.front().status, Status::error);
    EXPECT_EQ(list[1].status, Status::crash);
    EXPECT_EQ(cause_title(list[1]), "crash: SIGSEGV during pipeline in large, 1 case");
    EXPECT_EQ(families_text(list[4].cases), "shared-edge");
    EXPECT_EQ(list[5].rule, "tie.top-left");
    EXPECT_EQ(list.back().status, Status::not_run);
}

// A failed case whose one finding breaks `rule` at `level`.
CaseRecord failed(const std::string& id, const std::string& rule, cases::Profile level) {
    CaseRecord record;
    record.id = id;
    record.status = Status::fail;
    record.outcome.level = level;
    diff::Finding finding;
    finding.rule = rule;
    finding.level = level;
    record.outcome.findings = {finding};
    return record;
}

// A case that breaks these doors, the first of which leads; `known` of their findings are expected.
CaseRecord by_doors(const std::string& id, const std::vector<std::string>& doors,
                    uint64_t known_of_first) {
    CaseRecord record = failed(id, "door.state", cases::Profile::vulkan);
    record.outcome.findings.clear();
    for (const std::string& door : doors) {
        diff::Finding finding;
        finding.kind = diff::FindingKind::value;
        finding.rule = "door.state";
        finding.level = cases::Profile::vulkan;
        finding.door = door;
        record.outcome.findings.push_back(finding);
        record.outcome.groups.push_back({finding.kind, finding.rule, finding.level, 4, 0, door});
        record.outcome.counts.at(static_cast<size_t>(finding.kind)) += 4;
    }
    record.outcome.groups.front().known = known_of_first;
    return record;
}

// Titles of the causes with their levels.
std::vector<std::string> titles(const std::vector<Cause>& list) {
    std::vector<std::string> out;
    for (const Cause& cause : list) {
        out.push_back(cause_title(cause) + " " + cause_level(cause));
    }
    return out;
}

TEST(causes, of_a_broken_door_do_not_hide_another) {
    report::Run run;
    run.cases = {by_doors("ties/a", {"state-first", "state-static"}, 0),
                 by_doors("ties/b", {"state-first"}, 0)};
    EXPECT_EQ(titles(causes(run)), (std::vector<std::string>{
                                       "fail: door.state=state-first value in ties, 2 cases vulkan",
                                       "fail: door.state=state-static value in ties, 1 case vulkan",
                                   }));
    EXPECT_NE(to_json(run).find("\"door\": \"state-static\""), std::string::npos);
    EXPECT_NE(to_github_summary(run).find("door.state=state-static"), std::string::npos);
    // What is told of the case tells both, once.
    const std::string told = console_case(run.cases[0], {});
    EXPECT_NE(told.find("door.state=state-first [vulkan: not conformant]"), std::string::npos);
    EXPECT_NE(told.find("also: door.state=state-static [vulkan], 4 wrong values\n"),
              std::string::npos);
    EXPECT_EQ(console_case(run.cases[1], {}).find("also:"), std::string::npos);
    // Known of one door says nothing of another, though rule, kind and level are the same.
    run.cases = {by_doors("ties/a", {"state-first", "state-static"}, 4)};
    EXPECT_EQ(titles(causes(run)), (std::vector<std::string>{
                                       "fail: door.state=state-static value in ties, 1 case vulkan",
                                   }));
    EXPECT_NE(what_happened(run.cases[0]).find("door.state=state-static ["), std::string::npos);
    // Of what is known, each has a cause, too.
    run.cases[0].status = Status::xfail;
    run.cases[0].outcome.groups[1].known = 4;
    EXPECT_TRUE(causes(run).empty());
    EXPECT_EQ(titles(known_causes(run)),
              (std::vector<std::string>{
                  "xfail: door.state=state-first value in ties, 1 case vulkan",
                  "xfail: door.state=state-static value in ties, 1 case vulkan",
              }));
}

TEST(causes, of_a_wrong_picture_do_not_hide_a_relation) {
    report::Run run;
    CaseRecord record = by_doors("ties/a", {"state-first"}, 0);
    record.outcome.groups.push_back(
        {diff::FindingKind::value, "repeat.same", cases::Profile::vulkan, 1});
    diff::Finding missing;
    missing.rule = "cover.inside";
    missing.level = cases::Profile::vulkan;
    record.outcome.findings.insert(record.outcome.findings.begin(), missing);
    // A second rule of the picture itself follows from the first as a rule, and has no line.
    record.outcome.groups.push_back(
        {diff::FindingKind::extra, "cover.outside", cases::Profile::vulkan, 1});
    run.cases = {record};
    EXPECT_EQ(titles(causes(run)), (std::vector<std::string>{
                                       "fail: cover.inside missing in ties, 1 case vulkan",
                                       "fail: repeat.same value in ties, 1 case vulkan",
                                       // Beside a wrong picture the door may be right.
                                       "fail: door.state value in ties, 1 case vulkan",
                                   }));
    // Neither says more than the level of its own.
    run.cases[0].outcome.groups[1].level = cases::Profile::practice;
    EXPECT_EQ(titles(causes(run)).back(), "fail: repeat.same value in ties, 1 case practice");
}

TEST(causes, begin_with_the_rule_that_is_broken_everywhere) {
    using cases::Profile;
    report::Run run;
    // One family full of a consequence, three families with what causes it, and ties all over.
    for (int k = 0; k < 5; ++k) {
        run.cases.push_back(
            failed("order/a:" + std::to_string(k), "order.primitive", Profile::vulkan));
        run.cases.push_back(
            failed("ties/a:" + std::to_string(k), "tie.top-left", Profile::direct3d));
        run.cases.push_back(
            failed("thin/a:" + std::to_string(k), "tie.top-left", Profile::direct3d));
    }
    for (const char* id : {"mesh/a", "mesh/b", "clip/a", "depth/a"}) {
        run.cases.push_back(failed(id, "cover.inside", Profile::vulkan));
    }
    std::string order;
    for (const Cause& cause : causes(run)) {
        order += cause.rule + " " + families_text(cause.cases) + "; ";
    }
    EXPECT_EQ(order,
              "cover.inside mesh, clip, depth; order.primitive order; tie.top-left thin, ties; ");
}

TEST(causes, of_equal_reach_are_in_the_order_of_the_rules) {
    report::Run run;
    run.cases = {failed("a/a", "interp.linear", cases::Profile::vulkan),
                 failed("b/b", "cover.inside", cases::Profile::vulkan)};
    EXPECT_EQ(causes(run).front().rule, "cover.inside");
    std::swap(run.cases[0], run.cases[1]);
    EXPECT_EQ(causes(run).front().rule, "cover.inside");
}

TEST(github, at_most_ten_and_the_rest_is_counted) {
    report::Run run = test::sample_run();
    EXPECT_EQ(lines_with(to_github_annotations(run, "/x"), "::error "), 10U);
    EXPECT_EQ(to_github_annotations(run, "/x").find("more cause"), std::string::npos);
    const CaseRecord fail = run.cases[4];
    for (const char* rule : {"a", "b"}) {
        run.cases.push_back(fail);
        run.cases.back().id = std::string(rule) + "/x";
        run.cases.back().outcome.findings.front().rule = rule;
    }
    const std::string text = to_github_annotations(run, "/x");
    EXPECT_EQ(lines_with(text, "::error "), 10U);
    EXPECT_TRUE(
        text.ends_with("+2 more causes of unexpected results: see the summary of the step\n"));
}

// A case may fail by two causes: each is told by a finding of its own.
TEST(github, a_cause_tells_its_own_finding) {
    report::Run run = test::sample_run();
    run.cases = {run.cases[3]};
    CaseRecord& record = run.cases[0];
    ASSERT_GE(record.outcome.findings.size(), 2U);
    record.outcome.findings.resize(2);
    record.outcome.findings[0].rule = "scissor.half-open";
    record.outcome.findings[0].kind = diff::FindingKind::extra;
    record.outcome.findings[0].why = "the first";
    record.outcome.findings[1] = record.outcome.findings[0];
    record.outcome.findings[1].rule = "repeat.scissor";
    record.outcome.findings[1].kind = diff::FindingKind::value;
    record.outcome.findings[1].why = "the second";
    record.outcome.groups = {
        {diff::FindingKind::extra, "scissor.half-open", cases::Profile::vulkan, 1, 0},
        {diff::FindingKind::value, "repeat.scissor", cases::Profile::vulkan, 1, 0}};
    const std::string text = to_github_annotations(run, "/x");
    ASSERT_EQ(lines_with(text, "::error "), 2U);
    for (const std::string& line :
         {std::string("scissor.half-open extra"), std::string("repeat.scissor value")}) {
        const size_t at = text.find(line);
        ASSERT_NE(at, std::string::npos) << text;
        const std::string body = text.substr(at, text.find('\n', at) - at);
        EXPECT_EQ(body.find("the first") != std::string::npos, line[0] == 's') << body;
        EXPECT_EQ(body.find("the second") != std::string::npos, line[0] == 'r') << body;
    }
}

TEST(github, paths_are_those_of_the_checkout) {
    report::Run run = test::sample_run();
    run.environment.emplace_back("PWD", "/srv/builds/tree");
    run.cases = {run.cases[4]};
    run.cases[0].file = "cases/suite/../suite/a.toml";
    EXPECT_TRUE(to_github_annotations(run, "/srv/builds")
                    .starts_with("::error file=tree/cases/suite/a.toml,line=1,title=fail%3A "
                                 "tie.top-left missing in ties%2C 1 "
                                 "case::ties/left   1 missing of 64 samples"));
    // What lies elsewhere cannot be shown by the CI's pages.
    EXPECT_TRUE(to_github_annotations(run, "/other").starts_with("::error title=fail%3A "));
    EXPECT_NE(to_gitlab(run, "/srv/builds").find("\"path\": \"tree/cases/suite/a.toml\""),
              std::string::npos);
    EXPECT_NE(to_gitlab(run, "/other").find("\"path\": \"ties/left.toml\""), std::string::npos);
}

TEST(github, bytes_of_drivers_cannot_make_commands_or_markup) {
    report::Run run = test::hostile_run();
    for (CaseRecord& r : run.cases) {
        r.reason += "\n::error::injected\r\n| a | <script> `x` 100%";
        r.rerun += "\n::warning::x";
    }
    const std::string text = to_github_annotations(run, "/x");
    EXPECT_TRUE(cases::is_utf8(text));
    EXPECT_EQ(lines_with(text, "::error::"), 0U);
    EXPECT_EQ(lines_with(text, "::"), lines_with(text, "::error title="));
    const std::string summary = to_github_summary(run);
    EXPECT_TRUE(cases::is_utf8(summary));
    std::istringstream lines(summary);
    for (std::string line; std::getline(lines, line);) {
        // Markdown shows an indented block as it is.
        EXPECT_TRUE(line.starts_with("    ") || line.find('<') == std::string::npos) << line;
    }
    EXPECT_EQ(lines_with(summary, "::"), 0U);
    EXPECT_EQ(summary.find('\x1b'), std::string::npos);
}

// A table is read at a glance, and a command next to what it repeats.
TEST(github, the_summary_has_short_cells_and_commands_under_their_cause) {
    report::Run run = test::sample_run();
    for (CaseRecord& r : run.cases) {
        r.reason += std::string(400, 'x');
    }
    const std::string summary = to_github_summary(run);
    std::istringstream lines(summary);
    size_t rows = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with('|')) {
            ++rows;
            EXPECT_LT(line.size(), 200U) << line;
        }
    }
    EXPECT_GT(rows, 4U);
    const std::vector<Cause> list = causes(run);
    for (size_t k = 0; k < list.size(); ++k) {
        const size_t head = summary.find(fmt::format("\n**{}. ", k + 1));
        ASSERT_NE(head, std::string::npos) << k;
        const size_t command = summary.find("\n    ", head);
        EXPECT_EQ(summary.find(smallest_case(list[k]).rerun, head), command + 5) << k;
        EXPECT_GT(summary.find(fmt::format("\n**{}. ", k + 2)), command) << k;
    }
}

TEST(github, the_summary_stays_below_the_limit) {
    report::Run run = test::sample_run();
    const CaseRecord fail = run.cases[4];
    for (size_t k = 0; k < 20000; ++k) {
        run.cases.push_back(fail);
        run.cases.back().id = "family" + std::to_string(k) + "/x";
        run.cases.back().outcome.findings.front().rule = "rule" + std::to_string(k);
    }
    const std::string text = to_github_summary(run);
    EXPECT_LT(text.size(), size_t{1} << 20);
    EXPECT_NE(text.find(" more causes, see the report.\n"), std::string::npos);
}

TEST(gitlab, is_an_issue_a_case_with_a_fingerprint_of_its_own) {
    const report::Run run = test::hostile_run();
    const auto json = nlohmann::json::parse(to_gitlab(run, "/x"));
    ASSERT_EQ(json.size(), 10U);
    std::set<std::string> fingerprints;
    for (const auto& issue : json) {
        fingerprints.insert(issue.at("fingerprint").get<std::string>());
    }
    EXPECT_EQ(fingerprints.size(), json.size());
    report::Run later = run;
    later.cases[3].drawn.seconds = 99;
    later.cases[3].outcome.findings[0].x += 1;
    EXPECT_EQ(nlohmann::json::parse(to_gitlab(later, "/x"))[0].at("fingerprint"),
              json[0].at("fingerprint"));
    later.cases[3].status = Status::crash;
    EXPECT_NE(nlohmann::json::parse(to_gitlab(later, "/x"))[0].at("fingerprint"),
              json[0].at("fingerprint"));
}

TEST(merge, puts_parts_together_or_says_why_not) {
    report::Run whole = test::sample_run();
    std::vector<Part> parts = {{"a", whole}, {"b", whole}};
    for (size_t k = 0; k < 2; ++k) {
        report::Run& run = parts[k].run;
        run.shard = static_cast<uint32_t>(k) + 1;
        run.shards = 2;
        run.cases.clear();
        for (size_t c = k; c < whole.cases.size(); c += 2) {
            run.cases.push_back(whole.cases[c]);
        }
    }
    const auto merged = merge_runs(parts);
    ASSERT_TRUE(merged);
    EXPECT_TRUE(merged->missing_shards.empty());
    EXPECT_EQ(merged->cases.size(), whole.cases.size());
    EXPECT_EQ(totals(*merged), totals(whole));
    EXPECT_EQ(exit_code(*merged), exit_code(whole));
    EXPECT_DOUBLE_EQ(merged->seconds, 2 * whole.seconds);

    const auto one = merge_runs({parts[1]});
    ASSERT_TRUE(one);
    EXPECT_EQ(one->missing_shards, (std::vector<uint32_t>{1}));
    // Whatever its cases came to, and whoever asks.
    report::Run passes = *one;
    std::erase_if(passes.cases, [](const CaseRecord& r) { return r.status != Status::pass; });
    EXPECT_EQ(exit_code(passes), kExitInternal);
    EXPECT_EQ(exit_text(passes), "exit 7: shard 1 is missing");
    EXPECT_TRUE(headline(passes).starts_with("Not the whole run: shard 1 is missing"));
    EXPECT_NE(to_junit(passes).find("errors=\"1\""), std::string::npos);
    EXPECT_TRUE(to_github_annotations(passes, "/x").starts_with("::error title=edgecase::shard 1"));
    EXPECT_NE(to_github_summary(passes).find("## Edgecase: exit 7: shard 1 is missing"),
              std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(to_gitlab(passes, "/x"))[0].at("severity"), "blocker");

    auto wrong = parts;
    wrong[1].run.interrupted = true;
    EXPECT_EQ(exit_code(*merge_runs(wrong)), kExitInterrupted);
    wrong = parts;
    wrong[1].run.ended.clear();
    EXPECT_EQ(merge_runs(wrong)->ended, "");
    wrong = parts;
    wrong[1].run.device.subpixel_bits = 4;
    EXPECT_FALSE(merge_runs(wrong));
    wrong = parts;
    wrong[1].run.device.driver_info += "x";
    EXPECT_FALSE(merge_runs(wrong));
    wrong = parts;
    wrong[1].run.tool_version = "9";
    ASSERT_FALSE(merge_runs(wrong));
    EXPECT_EQ(merge_runs(wrong).error().message,
              "the version of edgecase is '0.2.0' in a and '9' in b; only parts of one run can be "
              "merged, use 'edgecase compare' for different ones");
    EXPECT_FALSE(merge_runs({}));
}

}  // namespace
}  // namespace report
