// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/sentences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cases/base/counted.hpp"
#include "cases/base/number_text.hpp"
#include "cases/base/printable.hpp"
#include "cases/model/device.hpp"
#include "ref/number/plane_budget.hpp"
#include "report/record/levels.hpp"

namespace report {

namespace {

std::string last_line(const std::string& bytes) {
    const std::string text = cases::printable(bytes);
    const size_t end = text.find_last_not_of("\n\t ");
    if (end == std::string::npos) {
        return {};
    }
    const size_t begin = text.rfind('\n', end);
    return text.substr(begin == std::string::npos ? 0 : begin + 1,
                       end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

// "2 missing", "1 wrong value"; "3 values" where wrong samples are told beside them.
std::string counted_findings(diff::FindingKind kind, uint64_t count, bool is_beside_wrong) {
    switch (kind) {
        case diff::FindingKind::value:
            return cases::counted(count, is_beside_wrong ? "value" : "wrong value");
        case diff::FindingKind::order:
            return std::to_string(count) + " out of order";
        default:
            return fmt::format("{} {}", count, diff::to_string(kind));
    }
}

// Whether an expectation speaks of all findings of its group.
bool is_known(const CaseRecord& record, const diff::Finding& f) {
    return std::ranges::any_of(record.outcome.groups, [&](const auto& group) {
        return group.kind == f.kind && group.rule == f.rule && group.level == f.level &&
               group.door == f.door && group.count == group.known;
    });
}

// "rule [level: what it means]" of what a case is known by; no level if it could not be judged.
std::string rule_and_level(const CaseRecord& record) {
    std::string rule;
    cases::Profile level = record.outcome.level;
    if (const auto news = leading_news(record)) {
        rule = news->rule.empty() ? "no told rule" : rule_and_door(news->rule, news->door);
        level = news->level;
    } else if (!record.outcome.findings.empty()) {
        const diff::Finding& leading = leading_finding(record);
        rule = rule_and_door(leading.rule, leading.door);
        level = leading.level;
    }
    if (rule.empty() || !is_judged(record)) {
        return rule.empty() ? rule : "   " + one_line(rule);
    }
    return fmt::format("   {} [{}: {}]", one_line(rule), cases::to_string(level), meaning(level));
}

}  // namespace

std::string one_line(std::string_view bytes) {
    std::string text = cases::printable(bytes);
    std::ranges::replace(text, '\n', ' ');
    std::ranges::replace(text, '\t', ' ');
    return text;
}

const diff::Finding& leading_finding(const CaseRecord& record) {
    return *std::ranges::min_element(record.outcome.findings, [&](const diff::Finding& a,
                                                                  const diff::Finding& b) {
        return std::pair(is_known(record, a), a.level) < std::pair(is_known(record, b), b.level);
    });
}

std::optional<diff::FindingGroup> leading_news(const CaseRecord& record) {
    const auto level = level_of(record, Of::news);
    if (!level ||
        (!record.outcome.findings.empty() && !is_known(record, leading_finding(record)))) {
        return std::nullopt;
    }
    const auto found =
        std::ranges::find_if(record.outcome.groups, [&](const diff::FindingGroup& group) {
            return group.level == *level && group.known < group.count;
        });
    return found == record.outcome.groups.end() ? std::nullopt : std::optional(*found);
}

bool is_relation(std::string_view rule) {
    return rule.starts_with("door.") || rule.starts_with("repeat.");
}

std::vector<diff::FindingGroup> other_relations(const CaseRecord& record, Of which) {
    const bool has_news = !is_expected(record.status);
    if (!is_judged(record) || (which == Of::news && !has_news)) {
        return {};
    }
    std::optional<diff::FindingGroup> leading = leading_news(record);
    if (!leading && !record.outcome.findings.empty()) {
        const diff::Finding& f = leading_finding(record);
        leading = {f.kind, f.rule, f.level, 0, 0, f.door};
    }
    std::vector<diff::FindingGroup> list;
    for (const diff::FindingGroup& group : record.outcome.groups) {
        const bool leads = leading && leading->kind == group.kind && leading->rule == group.rule &&
                           leading->level == group.level && leading->door == group.door;
        if (is_relation(group.rule) && !leads && (which == Of::all || group.known < group.count)) {
            list.push_back(group);
        }
    }
    return list;
}

std::string other_relations_text(const CaseRecord& record) {
    std::string text;
    for (const diff::FindingGroup& group :
         other_relations(record, is_expected(record.status) ? Of::all : Of::news)) {
        text += fmt::format("{}{} [{}], {}", text.empty() ? "" : "; ",
                            rule_and_door(group.rule, group.door), cases::to_string(group.level),
                            counted_findings(group.kind, group.count, false));
    }
    return text;
}

std::string rule_and_door(const std::string& rule, const std::string& door) {
    return one_line(door.empty() ? rule : rule + "=" + door);
}

std::string seconds_text(double seconds) {
    if (!std::isfinite(seconds)) {
        return "?";
    }
    if (seconds < 0.01) {
        return fmt::format("{:.2f} ms", seconds * 1000);
    }
    return seconds < 1 ? fmt::format("{:.2f} s", seconds) : fmt::format("{:.1f} s", seconds);
}

std::string ratio_text(double ratio) {
    return cases::number_text(ratio, 3);
}

std::string judged_bits_note(const capture::DeviceInfo& device) {
    return !device.api_version.empty() && device.subpixel_bits < cases::kLeastSubpixelBits
               ? fmt::format(" (judged as {})", cases::kLeastSubpixelBits)
               : "";
}

std::string_view meaning(cases::Profile level) {
    constexpr std::array kMeanings = {"not conformant", "very suspicious",
                                      "differs from top-left hardware"};  // by profile
    return kMeanings.at(static_cast<size_t>(level));
}

std::string head_and_tail(const std::string& bytes, size_t most) {
    return bytes.size() <= most
               ? bytes
               : bytes.substr(0, most / 2) + "\n[...]\n" + bytes.substr(bytes.size() - most / 2);
}

std::string sample_text(const diff::Finding& finding) {
    if (finding.of_case) {
        return "the case";
    }
    const std::string layer = finding.layer ? fmt::format("layer {} ", *finding.layer) : "";
    const std::string pixel = fmt::format("{}({},{})", layer, finding.x, finding.y);
    return finding.sample == 0 ? pixel : fmt::format("{} sample {}", pixel, finding.sample);
}

std::string sample_options(const diff::Finding& finding, const cases::Target& target) {
    if (finding.of_case) {
        return {};
    }
    std::string text = fmt::format(" --pixel {},{}", finding.x, finding.y);
    if (target.samples > 1) {
        text += fmt::format(" --sample {}", finding.sample);
    }
    if (target.layers > 1) {
        text += fmt::format(" --layer {}", finding.layer.value_or(0));
    }
    return text;
}

std::string accepted_text(const Run& run, const CaseRecord& record) {
    return fmt::format("{} of {:.4g} allowed budgets", ratio_text(record.outcome.worst_ratio),
                       ref::budget_factor(run.profile));
}

std::string counts_text(const CaseRecord& record) {
    // Several numbers of a sample may be wrong: then the samples are told, too.
    // Of a count that belongs to no sample no sample is wrong.
    const bool is_of_case = record.outcome.wrong_samples == 0;
    const bool has_more = !is_of_case && record.outcome.wrong_samples &&
                          record.outcome.finding_total() > *record.outcome.wrong_samples;
    std::string text;
    for (size_t k = 0; k < diff::kFindingKinds; ++k) {
        const auto kind = static_cast<diff::FindingKind>(k);
        const uint64_t count = record.outcome.counts.at(k);
        if (count > 0) {
            text += (text.empty() ? "" : ", ") + counted_findings(kind, count, has_more);
        }
    }
    if (record.drawn.is_brief && record.outcome.finding_total() >= diff::kBriefEnough) {
        return "at least " + text;
    }
    if (has_more) {
        return fmt::format("{} of {} wrong ({})", *record.outcome.wrong_samples,
                           cases::counted(record.outcome.compared_samples, "sample"), text);
    }
    return text.empty() || is_of_case
               ? text
               : fmt::format("{} of {}", text,
                             cases::counted(record.outcome.compared_samples, "sample"));
}

std::string what_happened(const CaseRecord& record) {
    const std::string step =
        record.death.step.empty() ? "" : " during " + one_line(record.death.step);
    const std::string signal =
        record.death.signal.empty() ? "the worker ended" : one_line(record.death.signal);
    const std::string bug =
        record.known.bug.empty() ? "" : fmt::format(" ({})", one_line(record.known.bug));
    std::string expected;
    if (record.known.expected && !record.known.expired.empty()) {
        expected =
            fmt::format("the expectation of {}{} ended on {}: re-check it, or extend the date",
                        to_string(*record.known.expected), bug, one_line(record.known.expired));
    } else if (!record.known.unlike.empty()) {
        expected = fmt::format("not as {} says{}: {}", one_line(record.known.place), bug,
                               one_line(record.known.unlike));
    } else if (record.known.expected) {
        expected = fmt::format("expected {}{}", to_string(*record.known.expected), bug);
    }
    std::string text;
    switch (record.status) {
        case Status::crash:
            text = fmt::format("{}{} after {}", signal, step, seconds_text(record.drawn.seconds));
            break;
        case Status::timeout:
            text = fmt::format("no answer{} for {}", step, seconds_text(record.drawn.seconds));
            break;
        case Status::device_lost:
            text = "device lost" + step;
            break;
        case Status::xpass:
            return record.known.expired.empty() ? expected + ", but it passes"
                                                : "passes; " + expected;
        case Status::improved:
            return expected + ", but it got better";
        case Status::not_run:
            text = "was not run";
            break;
        case Status::error:
            text = "cannot be judged";
            break;
        case Status::flake:
            text = fmt::format("differs from run to run ({} attempts)", record.drawn.attempts);
            break;
        case Status::pass:
        case Status::unsupported:
        case Status::skip:
        case Status::xfail:
        case Status::fail:
            // --require-support makes a failure of it, which has no findings.
            if (record.status == Status::fail && record.known.actual == Status::unsupported) {
                text = "unsupported";
            }
            break;
    }
    const std::string counts = counts_text(record);
    if (!counts.empty()) {
        text += (text.empty() ? "" : ", ") + counts;
    }
    text += rule_and_level(record);
    if (!expected.empty()) {
        text += (text.empty() ? "" : ", ") + expected;
    }
    return text;
}

std::string finding_text(const diff::Finding& f) {
    std::string text = f.of_case ? "" : sample_text(f) + ": ";
    if (!f.quantity.empty()) {
        text += one_line(f.quantity) + ": ";
    }
    text += fmt::format("expected {}, got {}", one_line(f.expected), one_line(f.got));
    // Exact ones have no budget, and NaN has no distance.
    if (f.kind == diff::FindingKind::value && f.ratio > 0 && std::isfinite(f.ratio)) {
        text += fmt::format(", {} budgets off", ratio_text(f.ratio));
    }
    return f.why.empty() ? text : text + "; " + one_line(f.why);
}

std::string why_it_happened(const CaseRecord& record) {
    if (!record.outcome.findings.empty()) {
        return finding_text(leading_finding(record));
    }
    if (!record.reason.empty()) {
        return one_line(record.reason);
    }
    if (record.status == Status::xpass || record.status == Status::improved) {
        return record.known.place.empty() ? "bring the expectation file up to date"
                                          : "bring " + one_line(record.known.place) + " up to date";
    }
    const std::string words = last_line(record.death.output);
    return words.empty() ? "no reason was given" : "the driver's last words: " + words;
}

std::string shortened_text(const Run& run) {
    const auto brief = std::ranges::count_if(
        run.cases, [](const CaseRecord& record) { return record.drawn.is_brief; });
    if (brief > 0) {
        return fmt::format(
            "{} {} kept in brief: level, rules and one finding; run --tell all keeps all",
            cases::counted(static_cast<uint64_t>(brief), "failure"), brief == 1 ? "is" : "are");
    }
    return run.shortened_cases == 0
               ? std::string()
               : fmt::format(
                     "pictures, numbers of samples and further findings of {} are in "
                     "journal.jsonl alone; the reports have those of the first",
                     cases::counted(run.shortened_cases, "case"));
}

std::string missing_shards_text(const Run& run) {
    const bool is_one = run.missing_shards.size() == 1;
    return fmt::format("shard{} {} {}", is_one ? "" : "s", fmt::join(run.missing_shards, ", "),
                       is_one ? "is" : "are");
}

std::string missing_shards_sentence(const Run& run) {
    return fmt::format(
        "{} not among the folders, so not every case of the run is here; name the folders of all "
        "shards",
        missing_shards_text(run));
}

std::string exit_text(const Run& run) {
    const int code = exit_code(run);
    std::string why;
    if (code == kExitInternal) {
        const auto count = totals(run);
        const auto add = [&](Status status, std::string_view what, std::string_view what_of_all) {
            const size_t n = count.at(static_cast<size_t>(status));
            if (n > 0) {
                why +=
                    fmt::format("{}{} {}", why.empty() ? "" : ", ", n, n == 1 ? what : what_of_all);
            }
        };
        if (!run.missing_shards.empty()) {
            why = missing_shards_text(run) + " missing";
        }
        add(Status::not_run, "case was not run", "cases were not run");
        add(Status::error, "case could not be judged", "cases could not be judged");
    } else if (code == kExitOk) {
        const auto beyond = static_cast<size_t>(std::ranges::count_if(
            run.cases, [](const CaseRecord& record) { return !is_expected(record.status); }));
        if (beyond > 0) {
            why = fmt::format("all as expected at {}; {} only beyond it",
                              cases::to_string(fail_level(run)),
                              beyond == 1 ? "1 case fails" : fmt::format("{} cases fail", beyond));
        }
    }
    return exit_text(code, why);
}

std::string exit_text(int code, const std::string& why) {
    if (!why.empty()) {
        return fmt::format("exit {}: {}", code, why);
    }
    constexpr std::array<std::pair<int, std::string_view>, 8> kTexts = {
        {{kExitOk, "all as expected"},
         {kExitUnexpected, "unexpected results"},
         {kExitUsage, "usage error"},
         {kExitInvalidFile, "invalid case or suite file"},
         {kExitNothingSelected, "nothing selected"},
         {kExitDevice, "no device, or the wrong one"},
         {kExitAllSkipped, "everything was skipped or unsupported"},
         {kExitInterrupted, "interrupted"}}};
    const auto row =
        std::ranges::find_if(kTexts, [code](const auto& known) { return known.first == code; });
    const std::string_view text =
        row != kTexts.end() ? row->second
                            : "internal error, or cases were not run or could not be judged";
    return fmt::format("exit {}: {}", code, text);
}

const CaseRecord* worst_case(const Run& run) {
    const CaseRecord* worst = nullptr;
    for (const CaseRecord& record : run.cases) {
        if (record.outcome.finding_total() == 0 && record.outcome.compared_values > 0 &&
            (worst == nullptr || record.outcome.worst_ratio > worst->outcome.worst_ratio)) {
            worst = &record;
        }
    }
    return worst;
}

}  // namespace report
