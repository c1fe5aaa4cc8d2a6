// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/compare/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cases/base/utf8.hpp"
#include "report/text/wrap.hpp"
#include "sample_run.hpp"

namespace report {
namespace {

// What becomes of one case that has these statuses in two runs.
Change change_between(Status a, Status b) {
    std::vector<NamedRun> runs = {{"a", test::sample_run()}, {"b", test::sample_run()}};
    for (size_t k = 0; k < 2; ++k) {
        runs[k].run.cases.resize(1);
        runs[k].run.cases[0].status = k == 0 ? a : b;
    }
    return compare_runs(runs)->cases.at(0).change;
}

TEST(comparison, every_pair_of_statuses) {
    const Status order[] = {Status::pass,        Status::flake,   Status::fail,
                            Status::device_lost, Status::timeout, Status::crash};
    for (const Status a : order) {
        for (const Status b : order) {
            const Change expected = a < b               ? Change::regression
                                    : a > b             ? Change::fix
                                    : a == Status::pass ? Change::same
                                                        : Change::fails_alike;
            EXPECT_EQ(change_between(a, b), expected) << to_string(a) << " " << to_string(b);
        }
        for (const Status b : {Status::unsupported, Status::skip, Status::error, Status::not_run}) {
            EXPECT_EQ(change_between(a, b), b == Status::unsupported || b == Status::skip
                                                ? Change::vanished
                                                : Change::only_in_some);
            EXPECT_EQ(change_between(b, a), Change::only_in_some);
            EXPECT_EQ(change_between(b, b), Change::judged_in_none);
        }
    }
    // Expectations do not count: an expected failure has failed, an unexpected pass has passed.
    EXPECT_EQ(change_between(Status::pass, Status::xpass), Change::same);
    EXPECT_EQ(change_between(Status::xfail, Status::xpass), Change::fix);
}

TEST(comparison, bits_tell_what_statuses_do_not) {
    std::vector<NamedRun> runs = {{"a", test::sample_run()}, {"b", test::sample_run()}};
    CaseRecord& b = runs[1].run.cases[0];
    b.drawn.bits = "1";
    EXPECT_EQ(compare_runs(runs)->cases[0].change, Change::other_values);
    b.drawn.hit_bits = "2";
    EXPECT_EQ(compare_runs(runs)->cases[0].change, Change::other_coverage);
    EXPECT_EQ(compare_runs(runs)->cases[0].detail,
              "8 of 64 samples are free in A, 8 of 64 samples are free in B");
    runs[1].run.cases[3].outcome.counts[0] += 1;
    EXPECT_EQ(compare_runs(runs)->cases[3].change, Change::fails_otherwise);
    EXPECT_EQ(exit_code(*compare_runs(runs)), kExitInternal);  // the sample run is not whole
}

TEST(comparison, the_headline_says_what_counts) {
    const auto headline_of = [](std::initializer_list<std::pair<Change, size_t>> counts) {
        Comparison comparison;
        for (const auto& [change, count] : counts) {
            comparison.counts.at(static_cast<size_t>(change)) = count;
            comparison.cases.resize(comparison.cases.size() + count);
        }
        return comparison_headline(comparison);
    };
    using enum Change;
    EXPECT_EQ(headline_of({{regression, 3}, {fix, 1}, {same, 9}}),
              "3 cases got worse, 1 got better");
    EXPECT_EQ(headline_of({{regression, 1}, {vanished, 2}}), "1 case got worse, 2 vanished");
    EXPECT_EQ(headline_of({{vanished, 49}}), "No case got worse, 49 vanished");
    EXPECT_EQ(headline_of({{fails_otherwise, 1}}), "No case got worse, 1 fails in another way");
    EXPECT_EQ(headline_of({{fails_otherwise, 2}, {fix, 1}}),
              "No case got worse, 1 got better, 2 fail in other ways");
    EXPECT_EQ(headline_of({{other_values, 5}, {same, 1}}), "No case got worse");
    EXPECT_EQ(headline_of({{same, 12}}), "All 12 cases are the same bit for bit");
    EXPECT_EQ(headline_of({{same, 1}}), "The one case is the same bit for bit");
}

TEST(comparison, more_findings_of_a_cause_are_worse) {
    std::vector<NamedRun> runs = {{"a", test::sample_run()}, {"b", test::sample_run()}};
    for (NamedRun& run : runs) {
        CaseRecord& c = run.run.cases[3];
        c.outcome.groups = {
            {diff::FindingKind::value, "interp.linear", cases::Profile::vulkan, 127, 0}};
    }
    EXPECT_EQ(compare_runs(runs)->cases[3].change, Change::fails_alike);
    runs[1].run.cases[3].outcome.groups[0].count = 128;
    const auto worse = compare_runs(runs);
    EXPECT_EQ(worse->cases[3].change, Change::regression);
    EXPECT_THAT(worse->cases[3].detail,
                testing::HasSubstr("128 value of interp.linear [vulkan] instead of 127"));
    runs[1].run.cases[3].outcome.groups[0].count = 126;
    EXPECT_NE(compare_runs(runs)->cases[3].change, Change::regression);
}

TEST(comparison, hostile_bytes_are_inert) {
    std::vector<NamedRun> runs = {{"a", test::hostile_run()}, {"b", test::sample_run()}};
    runs[1].run.suite_hash.clear();
    const auto comparison = compare_runs(runs);
    ASSERT_TRUE(comparison);
    const std::string text = comparison_text(runs, *comparison, {false, true, 100});
    EXPECT_TRUE(cases::is_utf8(text));
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
    EXPECT_TRUE(cases::is_utf8(comparison_json(runs, *comparison)));
    EXPECT_FALSE(nlohmann::json::parse(comparison_json(runs, *comparison)).empty());
}

TEST(wrap, breaks_at_spaces_and_indents_what_follows) {
    EXPECT_EQ(wrapped("one two three four\n", 9), "one two\n  three\n  four\n");
    EXPECT_EQ(wrapped("  - alpha beta gamma", 13), "  - alpha\n    beta\n    gamma");
    EXPECT_EQ(wrapped("short\n\nlines\n", 40), "short\n\nlines\n");
    EXPECT_EQ(wrapped("averyverylongword b", 8), "averyverylongword\n  b");
    EXPECT_EQ(wrapped("      rerun: edgecase run 'a b c' --x y", 20),
              "      rerun: edgecase run 'a b c' --x y");
    // Escape sequences take no room, a character of several bytes takes one column.
    EXPECT_EQ(wrapped("\x1b[1;31mab cd\x1b[0m ef", 8), "\x1b[1;31mab cd\x1b[0m ef");
    EXPECT_EQ(wrapped("\xc3\xa4\xc3\xa4 \xc3\xa4\xc3\xa4", 5), "\xc3\xa4\xc3\xa4 \xc3\xa4\xc3\xa4");
}

TEST(wrap, forty_columns_hold_every_line_of_prose) {
    ConsoleStyle style;
    style.width = 40;
    style.wrap = true;
    const report::Run run = test::sample_run();
    std::string text = console_header(run, style) + console_summary(run, "out/report.html", style);
    for (const CaseRecord& r : run.cases) {
        text += console_case(r, style);
    }
    size_t begin = 0;
    while (begin < text.size()) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        const std::string line = text.substr(begin, end - begin);
        const size_t word = line.find_first_not_of(' ');
        const bool whole = line.find("rerun: ") != std::string::npos ||
                           line.find("explain: ") != std::string::npos ||
                           line.find("debug: ") != std::string::npos ||
                           line.find(' ', word) == std::string::npos;
        EXPECT_TRUE(whole || line.size() <= 40) << line;
        begin = end + 1;
    }
}

}  // namespace
}  // namespace report
