// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cases/base/printable.hpp"
#include "cases/base/utf8.hpp"
#include "folders.hpp"
#include "report/files/json.hpp"
#include "report/files/junit.hpp"
#include "report/page/html.hpp"
#include "report/text/causes.hpp"
#include "report/text/console.hpp"
#include "report/text/sentences.hpp"
#include "report/text/unexpected.hpp"
#include "sample_run.hpp"

namespace report {

namespace fs = std::filesystem;

namespace {

// Compares with tests/unit/report/golden/NAME; EDGECASE_APPROVE=1 writes it instead.
void expect_golden(const std::string& name, const std::string& text) {
    const fs::path file = fs::path(test_support::source_dir()) / "tests/unit/report/golden" / name;
    if (std::getenv("EDGECASE_APPROVE") != nullptr) {
        std::ofstream(file, std::ios::binary) << text;
    }
    std::ifstream stream(file, std::ios::binary);
    ASSERT_TRUE(stream) << file << " is missing; approve it with EDGECASE_APPROVE=1";
    std::ostringstream golden;
    golden << stream.rdbuf();
    EXPECT_EQ(golden.str(), text) << "approve with EDGECASE_APPROVE=1 if this is meant";
}

// Runs a program of the machine on a text; its exit status.
int pass_through(const std::string& command, const std::string& text) {
    std::string name = (fs::temp_directory_path() / "edgecase-report-XXXXXX").string();
    const int fd = ::mkstemp(name.data());
    EXPECT_GE(fd, 0);
    std::ofstream(name, std::ios::binary) << text;
    const int status = std::system((command + " '" + name + "'").c_str());
    fs::remove(name);
    return status;
}

std::string console_of(const Run& run, const ConsoleStyle& style) {
    std::string text = console_header(run, style);
    for (const CaseRecord& r : run.cases) {
        text += is_expected(r.status) ? "" : console_case(r, style);
    }
    return text + console_summary(run, "out/report.html", style);
}

void expect_clean(const std::string& text) {
    EXPECT_TRUE(cases::is_utf8(text));
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
    EXPECT_EQ(text.find('\0'), std::string::npos);
    EXPECT_EQ(text.find("\xe2\x80\xa8"), std::string::npos);
}

TEST(printable, shows_what_a_terminal_would_obey) {
    EXPECT_EQ(cases::printable("plain \xc3\xa4\n\tx"), "plain \xc3\xa4\n\tx");
    EXPECT_EQ(cases::printable("\x1b[31m"), "\\x1b[31m");
    EXPECT_EQ(cases::printable(std::string("\0", 1)), "\\x00");
    EXPECT_EQ(cases::printable("\xff"), "\\xff");
    EXPECT_EQ(cases::printable("\xc0\xaf"), "\\xc0\\xaf");
    EXPECT_EQ(cases::printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");
    EXPECT_EQ(cases::printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
    EXPECT_EQ(cases::printable("\xc2\x9b"), "\\xc2\\x9b");           // CSI in one character
    EXPECT_EQ(cases::printable("\xe2\x80\xae"), "\\xe2\\x80\\xae");  // right-to-left override
    EXPECT_EQ(cases::printable("\xef\xbf\xbf"), "\\xef\\xbf\\xbf");
    EXPECT_EQ(cases::printable("\xf0\x9f\x98\x80"), "\xf0\x9f\x98\x80");
    EXPECT_EQ(cases::printable("\xf0\x9f\x98"), "\\xf0\\x9f\\x98");
    EXPECT_EQ(cases::printable("\r\n"), "\\x0d\n");
}

TEST(printable, of_every_byte_pair_is_clean) {
    for (unsigned a = 0; a < 256; ++a) {
        for (unsigned b = 0; b < 256; ++b) {
            const std::string bytes{static_cast<char>(a), static_cast<char>(b)};
            const std::string text = cases::printable(bytes);
            ASSERT_TRUE(cases::is_utf8(text)) << a << " " << b;
            ASSERT_EQ(cases::printable(text), text);
        }
    }
}

TEST(console, golden) {
    ConsoleStyle style;
    style.verbose = true;
    expect_golden("console.txt", console_of(test::sample_run(), style));
}

TEST(console, golden_at_forty_columns) {
    ConsoleStyle style;
    style.width = 40;
    style.wrap = true;
    style.verbose = true;
    expect_golden("console-40.txt", console_of(test::sample_run(), style));
}

TEST(console, captures_say_where_they_come_from) {
    report::Run run;
    run.tool_version = "1.2.3";
    run.device.name = "mine";
    run.device.type = "other";
    run.device.driver_name = "files";
    run.device.driver_info = "in out/captures";
    run.device.subpixel_bits = 8;
    EXPECT_EQ(console_header(run, {}),
              "edgecase 1.2.3  mine  files in out/captures  8 subpixel "
              "bits  profile direct3d  seed 0\n");
    run.device = {};
    EXPECT_NE(console_header(run, {}).find("Vulkan unknown"), std::string::npos);
}

TEST(console, color_is_only_escape_sequences) {
    const ConsoleStyle plain, colored{true, false, 100};
    std::string text = console_of(test::sample_run(), colored);
    EXPECT_NE(text.find("\x1b[1;31mFAIL\x1b[0m"), std::string::npos);
    for (size_t at = 0; (at = text.find('\x1b', at)) != std::string::npos;) {
        text.erase(at, text.find('m', at) - at + 1);
    }
    EXPECT_EQ(text, console_of(test::sample_run(), plain));
}

TEST(console, three_lines_and_the_explain_command) {
    const report::Run run = test::sample_run();
    for (const CaseRecord& r : run.cases) {
        const std::string text = console_case(r, {});
        const auto lines = std::count(text.begin(), text.end(), '\n');
        const bool died = r.status == Status::crash || r.status == Status::timeout;
        EXPECT_EQ(lines, r.commands.explain.empty() && !died ? 3
                         : r.status == Status::crash         ? 7
                                                             : 4)
            << text;
        EXPECT_NE(text.find(r.id), std::string::npos);
        EXPECT_NE(text.find("rerun: " + r.rerun), std::string::npos);
    }
}

TEST(console, verbose_results_come_in_the_order_of_the_selection) {
    const report::Run run = test::sample_run();
    ConsoleStyle style;
    style.verbose = true;
    std::vector<std::string> ids;
    std::string in_order;
    size_t unexpected = 0;
    for (const CaseRecord& r : run.cases) {
        ids.push_back(r.id);
        if (!is_expected(r.status) && r.status != Status::not_run) {
            ++unexpected;
            in_order += console_case(r, style);
        }
    }
    ASSERT_GT(unexpected, kHandful);
    UnexpectedResults backwards(ids, style);
    std::string text;
    for (auto r = run.cases.rbegin(); r != run.cases.rend(); ++r) {
        EXPECT_EQ(text, "");
        text += backwards.add(*r);
    }
    EXPECT_EQ(text, in_order);
    EXPECT_EQ(backwards.count(), unexpected);
    EXPECT_EQ(backwards.rest(), "");
    UnexpectedResults cut_off(ids, style);  // the first case never ends
    for (auto r = run.cases.rbegin(); std::next(r) != run.cases.rend(); ++r) {
        EXPECT_EQ(cut_off.add(*r), "");
    }
    EXPECT_EQ(cut_off.rest(), in_order);
}

// The first that are told are what the causes begin with, however they came in.
TEST(console, the_worst_results_are_told_in_the_order_of_the_causes) {
    report::Run run = test::sample_run();
    std::erase_if(run.cases, [](const CaseRecord& r) { return r.status == Status::not_run; });
    std::vector<std::string> ids;
    for (const CaseRecord& r : run.cases) {
        ids.push_back(r.id);
    }
    std::string expected;
    const std::vector<Cause> list = causes(run);
    ASSERT_GT(list.size(), kHandful);
    for (size_t k = 0; k < kHandful; ++k) {
        expected += console_case(smallest_case(list[k]), {});
    }
    expected += "more unexpected results: their causes follow; -v tells each\n";
    UnexpectedResults forwards(ids, {}), backwards(ids, {});
    for (size_t k = 0; k < run.cases.size(); ++k) {
        EXPECT_EQ(forwards.add(run.cases[k]), "");
        EXPECT_EQ(backwards.add(run.cases[run.cases.size() - 1 - k]), "");
    }
    EXPECT_EQ(forwards.rest(), expected);
    ConsoleStyle quiet;
    quiet.quiet = true;
    UnexpectedResults alone(ids, quiet);
    for (const CaseRecord& record : run.cases) {
        alone.add(record);
    }
    EXPECT_TRUE(alone.rest().ends_with(
        "more unexpected results: the report and a run without -q tell them\n"));
    EXPECT_EQ(backwards.rest(), expected);
    EXPECT_EQ(backwards.rest(), "");
    // A handful is told whole.
    UnexpectedResults few(ids, {});
    report::Run worst;
    for (const CaseRecord& r : run.cases) {
        if (!is_expected(r.status) && worst.cases.size() < kHandful) {
            worst.cases.push_back(r);
            few.add(r);
        }
    }
    std::string each;
    for (const Cause& cause : causes(worst)) {
        for (const CaseRecord* r : cause.cases) {
            each += console_case(*r, {});
        }
    }
    EXPECT_EQ(few.rest(), each);
}

TEST(causes, files_of_one_folder_are_one_family) {
    report::Run run = test::sample_run();
    const CaseRecord failed = *std::find_if(run.cases.begin(), run.cases.end(),
                                            [](const auto& r) { return r.status == Status::fail; });
    run.cases.clear();
    for (const char* name : {"a", "b:seed=1/2", "c"}) {
        run.cases.push_back(failed);
        run.cases.back().id = name;
        run.cases.back().file = "/home/me/mine/" + std::string(name, 1) + ".toml";
    }
    run.cases.push_back(failed);
    run.cases.back().id = "mine/d";
    const std::vector<Cause> list = causes_by_family(run);
    ASSERT_EQ(list.size(), 2U);
    EXPECT_EQ(families_text(list[0].cases), "mine/");
    EXPECT_EQ(list[0].cases.size(), 3U);
    EXPECT_EQ(families_text(list[1].cases), "mine");
    // They break one rule alike.
    ASSERT_EQ(causes(run).size(), 1U);
    EXPECT_EQ(families_text(causes(run)[0].cases), "mine/, mine");
    run.cases.resize(1);
    run.cases[0].file = "a.toml";
    EXPECT_EQ(families_text(causes(run)[0].cases), "a");
}

TEST(console, the_end_tells_the_causes) {
    const report::Run run = test::sample_run();
    const std::string text = console_summary(run, "", {});
    const std::vector<Cause> list = causes(run);
    ASSERT_GT(list.size(), 3U);
    size_t at = text.find("causes, the worst first:\n");
    for (const Cause& cause : list) {
        if (cause.status != Status::not_run) {
            ASSERT_NE(at, std::string::npos);
            at = text.find("  " + cause_title(cause), at);
            EXPECT_NE(text.find("rerun: " + smallest_case(cause).rerun + "\n", at),
                      std::string::npos);
        }
    }
    EXPECT_LT(at, text.find("14 cases  1 pass"));
    report::Run few = run;
    few.cases.resize(4);  // one failure, which has been told
    EXPECT_EQ(console_summary(few, "", {}).find("causes"), std::string::npos);
}

TEST(console, the_loosest_level_leads) {
    CaseRecord r = test::sample_run().cases[3];
    std::rotate(r.outcome.findings.begin(), r.outcome.findings.begin() + 1,
                r.outcome.findings.end());
    ASSERT_EQ(r.outcome.findings[0].level, cases::Profile::direct3d);
    EXPECT_NE(console_case(r, {}).find("[vulkan: not conformant]"), std::string::npos);
    EXPECT_NE(console_case(r, {}).find("(1,1): expected 1, got 2"), std::string::npos);
}

TEST(console, hostile_bytes_are_shown_inert) {
    expect_clean(console_of(test::hostile_run(), {false, true, 100}));
}

TEST(console, pictures_that_do_not_fit_together_are_left_out) {
    CaseRecord r = test::sample_run().cases[3];
    r.evidence.pictures.marks.pop_back();
    EXPECT_EQ(console_case(r, {false, true, 100}), console_case(r, {}));
}

// The 8 x 8 picture as two layers of four rows.
TEST(console, layers_are_named) {
    CaseRecord r = test::sample_run().cases[3];
    r.evidence.pictures.layer_height = 4;
    for (diff::Finding& f : r.outcome.findings) {
        f.layer = f.y / 4;
        f.y %= 4;
    }
    const std::string text = console_case(r, {false, true, 100});
    EXPECT_NE(text.find("layer 0 (3,2): expected 1, got 0"), std::string::npos) << text;
    EXPECT_NE(text.find("      layer 0, from row 0\n      #####O#"), std::string::npos) << text;
    EXPECT_NE(text.find("      layer 1, from row 0\n"), std::string::npos) << text;
    EXPECT_LT(text.find("layer 0, from row 0"), text.find("layer 1, from row 0"));
}

TEST(json, layers_are_written_where_there_are_several) {
    report::Run run = test::sample_run();
    run.cases[3].evidence.pictures.layer_height = 4;
    run.cases[3].outcome.findings[1].layer = 1;
    const auto json = nlohmann::ordered_json::parse(to_json(run));
    const auto& fail = json.at("cases").at(3);
    EXPECT_EQ(fail.at("findings").at(1).at("sample").at("layer"), 1);
    EXPECT_FALSE(fail.at("findings").at(0).at("sample").contains("layer"));
    EXPECT_EQ(fail.at("pictures").at("layer_height"), 4);
}

TEST(sentences, samples_are_told_where_they_are_fewer_than_findings) {
    CaseRecord record;
    record.outcome.compared_samples = 256;
    record.outcome.counts = {0, 0, 0, 376, 0};
    EXPECT_EQ(report::counts_text(record),
              "376 wrong values of 256 samples");  // of an older journal
    record.outcome.wrong_samples = 188;
    EXPECT_EQ(report::counts_text(record), "188 of 256 samples wrong (376 values)");
    record.outcome.counts = {2, 0, 0, 376, 0};
    record.outcome.wrong_samples = 190;
    EXPECT_EQ(report::counts_text(record), "190 of 256 samples wrong (2 missing, 376 values)");
    record.outcome.counts = {2, 0, 0, 188, 0};
    EXPECT_EQ(report::counts_text(record), "2 missing, 188 wrong values of 256 samples");
}

TEST(sentences, what_the_whole_case_gave_has_no_sample) {
    CaseRecord record;
    record.outcome.compared_samples = 256;
    record.outcome.counts = {0, 0, 0, 3, 0};
    record.outcome.wrong_samples = 0;
    EXPECT_EQ(report::counts_text(record), "3 wrong values");
    diff::Finding finding = diff::finding_of_case(diff::FindingKind::value);
    finding.quantity = "occlusion query of draw 1";
    finding.expected = "28";
    finding.got = "14";
    record.outcome.findings = {finding};
    EXPECT_EQ(why_it_happened(record), "occlusion query of draw 1: expected 28, got 14");
    EXPECT_EQ(report::sample_text(finding), "the case");
}

TEST(sentences, explain_is_led_to_the_sample) {
    cases::Target target;
    diff::Finding finding;
    finding.x = 3;
    finding.y = 4;
    finding.sample = 2;
    EXPECT_EQ(report::sample_options(finding, target), " --pixel 3,4");
    target.samples = 4;
    EXPECT_EQ(report::sample_options(finding, target), " --pixel 3,4 --sample 2");
    target.layers = 2;
    finding.layer = 1;
    EXPECT_EQ(report::sample_options(finding, target), " --pixel 3,4 --sample 2 --layer 1");
    finding.of_case = true;
    EXPECT_EQ(report::sample_options(finding, target), "");
}

TEST(json, a_finding_of_the_whole_case_has_no_sample_and_no_box) {
    report::Run run = test::sample_run();
    CaseRecord& fail = run.cases[3];
    for (diff::Finding& finding : fail.outcome.findings) {
        finding.of_case = true;
    }
    fail.outcome.wrong_samples = 0;
    const std::string text = to_json(run);
    const auto json = nlohmann::ordered_json::parse(text).at("cases").at(3);
    EXPECT_TRUE(json.at("findings").at(0).at("sample").is_null());
    EXPECT_TRUE(json.at("bounding_box").is_null());
    const std::string check = "python3 '" + test_support::source_dir() +
                              "/tests/unit/report/check_schema.py' '" + test_support::source_dir() +
                              "/docs/schema/results-1.json'";
    EXPECT_EQ(pass_through(check, text), 0);
}

TEST(json, golden) {
    expect_golden("results.json", to_json(test::sample_run()));
}

TEST(json, every_run_keeps_to_the_schema) {
    const std::string check = "python3 '" + test_support::source_dir() +
                              "/tests/unit/report/check_schema.py' '" + test_support::source_dir() +
                              "/docs/schema/results-1.json'";
    EXPECT_EQ(pass_through(check, to_json(test::sample_run())), 0);
    EXPECT_EQ(pass_through(check, to_json(test::hostile_run())), 0);
    EXPECT_EQ(pass_through(check, to_json({})), 0);
    auto json = nlohmann::ordered_json::parse(to_json(test::sample_run()));
    json["cases"][3].erase("status");
    EXPECT_NE(pass_through(check + " 2>/dev/null", json.dump()), 0);
}

TEST(json, what_others_rely_on) {
    const auto json = nlohmann::ordered_json::parse(to_json(test::sample_run()));
    const auto& fail = json.at("cases").at(3);
    EXPECT_EQ(fail.at("status"), "fail");
    EXPECT_EQ(fail.at("findings").at(2).at("kind"), "double");
    EXPECT_EQ(fail.at("findings").at(3).at("ratio"), 2.0e6);
    EXPECT_EQ(fail.at("worst_ratio"), "inf");
    // The largest accepted error: a case with findings does not count, however far off it is.
    EXPECT_NE(json.at("worst").at("case"), fail.at("id"));
    EXPECT_EQ(json.at("worst").at("case"), "coverage/half-square");
    EXPECT_EQ(json.at("totals").at("fail"), 2);
    EXPECT_EQ(json.at("device").at("subpixel_bits"), 8);
    EXPECT_EQ(json.at("run").at("exit_code"), kExitInternal);
    expect_clean(to_json(test::hostile_run()));
}

TEST(junit, golden) {
    expect_golden("junit.xml", to_junit(test::sample_run()));
}

TEST(junit, every_run_is_well_formed) {
    const std::string check =
        "python3 '" + test_support::source_dir() + "/tests/unit/report/check_junit.py'";
    EXPECT_EQ(pass_through(check, to_junit(test::sample_run())), 0);
    EXPECT_EQ(pass_through(check, to_junit(test::hostile_run())), 0);
    EXPECT_EQ(pass_through(check, to_junit({})), 0);
    EXPECT_NE(pass_through(check + " 2>/dev/null", "<testsuites>\x1b</testsuites>"), 0);
    expect_clean(to_junit(test::hostile_run()));
    EXPECT_EQ(to_junit(test::hostile_run()).find("]]>"), std::string::npos);
}

size_t count_of(const std::string& text, const std::string& part) {
    size_t count = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++count;
    }
    return count;
}

TEST(html, is_one_page_that_loads_nothing) {
    const std::string page = to_html(test::sample_run());
    EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0U);
    EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
    EXPECT_EQ(page.find("{{"), std::string::npos);
    for (const char* part : {" src=", "<link", "@import", "url(", "fetch(", "XMLHttpRequest",
                             "import(", "<iframe", "<img"}) {
        EXPECT_EQ(page.find(part), std::string::npos) << part;
    }
    EXPECT_EQ(count_of(page, "<script"), 3U);
    EXPECT_EQ(count_of(page, "</script"), 3U);
    EXPECT_NE(page.find("<noscript>"), std::string::npos);
}

TEST(html, hostile_bytes_stay_text) {
    const std::string page = to_html(test::hostile_run());
    expect_clean(page);
    EXPECT_EQ(count_of(page, "<script"), 3U);
    EXPECT_EQ(count_of(page, "</script"), 3U);
    EXPECT_EQ(count_of(page, "<!--"), 1U);  // the licence
}

TEST(html, its_data_is_json_with_every_case) {
    const report::Run run = test::hostile_run();
    const std::string page = to_html(run);
    const std::string open = "<script type=\"application/json\" id=\"data\">";
    const size_t begin = page.find(open) + open.size();
    const auto json =
        nlohmann::ordered_json::parse(page.substr(begin, page.find("</script>", begin) - begin));
    ASSERT_EQ(json.at("cases").size(), run.cases.size());
    EXPECT_EQ(json.at("cases").at(3).at("findings").size(), 5U);
    EXPECT_EQ(json.at("cases").at(3).at("id"), cases::printable(run.cases[3].id));
}

TEST(ExhaustiveHtml, thousands_of_failures_stay_small) {
    report::Run run = test::sample_run();
    const CaseRecord fail = run.cases[3];
    run.cases.assign(2000, fail);
    for (size_t k = 0; k < run.cases.size(); ++k) {
        run.cases[k].id += std::to_string(k);
        run.cases[k].outcome.findings.assign(1000, fail.outcome.findings[0]);
    }
    EXPECT_LT(to_html(run).size(), size_t{8} << 20);
}

std::vector<std::string> pages_of(const report::Run& run) {
    std::vector<std::string> pages;
    for_each_page(run, [&](size_t part, const std::string& page) {
        pages.push_back(page);
        EXPECT_EQ(part, pages.size());
    });
    return pages;
}

TEST(ExhaustiveHtml, every_picture_stands_in_one_part) {
    report::Run run = test::sample_run();
    const CaseRecord fail = run.cases[3];
    run.cases.assign(300, fail);
    uint32_t noise = 1;
    for (size_t k = 0; k < run.cases.size(); ++k) {
        CaseRecord& r = run.cases[k];
        r.id += std::to_string(k);
        r.outcome.findings.assign(1000, fail.outcome.findings[0]);
        r.evidence.pictures.width = r.evidence.pictures.height = 64;
        for (std::vector<uint8_t>* plane :
             {&r.evidence.pictures.expected_hits, &r.evidence.pictures.device_hits,
              &r.evidence.pictures.marks}) {
            plane->clear();
            for (size_t at = 0; at < 64 * 64; ++at) {
                noise = noise * 1664525U + 1013904223U;
                plane->push_back(static_cast<uint8_t>(noise >> 30U));
            }
        }
    }
    const std::vector<std::string> parts = pages_of(run);
    EXPECT_GT(parts.size(), 1U);
    EXPECT_EQ(parts.front(), to_html(run));
    size_t pictures = 0;
    for (const std::string& part : parts) {
        EXPECT_LT(part.size(), size_t{8} << 20);
        pictures += count_of(part, "\"expected_hits\":");
    }
    EXPECT_EQ(pictures, run.cases.size());
    // A run that fits has one part.
    EXPECT_EQ(pages_of(test::sample_run()).size(), 1U);
}

TEST(html, a_picture_larger_than_a_page_may_be_is_shown_all_the_same) {
    report::Run run = test::sample_run();
    run.cases = {run.cases[3]};
    run.cases[0].evidence.pictures.expected_colors.clear();
    for (size_t k = 0; k < (size_t{3} << 20); ++k) {
        run.cases[0].evidence.pictures.expected_colors.push_back(static_cast<uint8_t>(k));
    }
    const std::vector<std::string> parts = pages_of(run);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(count_of(parts[0], "\"expected_hits\":"), 1U);
}

TEST(reports, never_blame_vulkan_for_what_only_breaks_direct3d) {
    report::Run run = test::sample_run();
    run.cases = {run.cases[4]};
    for (const std::string& text : {console_of(run, {}), to_junit(run), to_html(run)}) {
        EXPECT_EQ(text.find("violates"), std::string::npos);
        EXPECT_NE(text.find("differs from top-left hardware"), std::string::npos);
    }
    EXPECT_EQ(console_of(run, {}).find("not conformant"), std::string::npos);
    EXPECT_EQ(to_junit(run).find("not conformant"), std::string::npos);
}

}  // namespace

}  // namespace report
