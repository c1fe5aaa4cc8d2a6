// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/files/ci.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "cases/base/printable.hpp"
#include "report/text/causes.hpp"
#include "report/text/commands.hpp"
#include "report/text/diagnosis_text.hpp"
#include "report/text/levels_text.hpp"
#include "report/text/sentences.hpp"

namespace report {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr size_t kMaxSummary = 900 * 1024;  // bytes; GitHub refuses more than 1 MiB a step
constexpr size_t kMaxCommands = 10;         // causes whose commands are told

// A file as the CI's pages name it: relative to the checkout, '/' between parts. Empty if it lies
// elsewhere.
std::string file_in(const fs::path& base, const Run& run, const std::string& file) {
    fs::path path = file;
    for (const auto& [name, value] : run.environment) {
        if (name == "PWD" && path.is_relative()) {
            path = fs::path(value) / path;
        }
    }
    const fs::path relative = path.lexically_normal().lexically_relative(base.lexically_normal());
    const bool inside = !relative.empty() && *relative.begin() != "..";
    return inside ? relative.generic_string() : std::string();
}

// docs.github.com, "Workflow commands for GitHub Actions": data escapes % CR LF, properties also
// ':' and ','.
std::string command_text(std::string_view bytes, bool is_property) {
    std::string text;
    for (const char c : cases::printable(bytes)) {
        if (c == '%' || c == '\r' || c == '\n' || (is_property && (c == ':' || c == ','))) {
            text += fmt::format("%{:02X}", static_cast<unsigned char>(c));
        } else {
            text += c;
        }
    }
    return text;
}

// Text in a cell of a Markdown table.
std::string cell(std::string_view bytes) {
    std::string text;
    for (const char c : cases::markup(bytes)) {
        if (std::string_view("|`*_[]\\").find(c) != std::string_view::npos) {
            text += '\\';
        }
        text += c == '\n' || c == '\t' ? ' ' : c;
    }
    return text;
}

// A command in an indented block, where Markdown changes nothing.
std::string command_block(const Cause& cause) {
    std::string text = "    " + one_line(rerun_of(cause)) + "\n";
    if (const std::string& explain = smallest_case(cause).commands.explain; !explain.empty()) {
        text += "    " + one_line(explain) + "\n";
    }
    return text;
}

std::string severity_of(const Run& run, const CaseRecord& record) {
    constexpr std::array kOfFailures = {"critical", "major", "minor"};  // by profile
    if (record.status == Status::fail) {
        const auto level = level_of(record, Of::news);
        return !makes_fail(run, record) ? "info"
               : level                  ? kOfFailures.at(static_cast<size_t>(*level))
                                        : "major";  // unsupported, or another picture
    }
    return record.status == Status::flake                                     ? "major"
           : record.status > Status::fail && record.status != Status::not_run ? "blocker"
                                                                              : "info";
}

// 128 bits of FNV-1a in two halves; a name, not a secret.
std::string fingerprint(const std::string& text) {
    uint64_t low = 0xcbf29ce484222325U;
    uint64_t high = 0x84222325cbf29ce4U;
    for (const char c : text) {
        low = (low ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
        high = (high + static_cast<unsigned char>(c)) * 0x9e3779b97f4a7c15U;
    }
    return fmt::format("{:016x}{:016x}", low, high ^ (high >> 29));
}

}  // namespace

std::string to_github_annotations(const Run& run, const fs::path& base) {
    const std::vector<Cause> list = causes(run);
    const bool is_whole = run.missing_shards.empty();
    std::string text = is_whole ? "" : to_github_annotation({missing_shards_sentence(run)});
    const size_t told = is_whole ? kMaxAnnotations : kMaxAnnotations - 1;
    for (size_t k = 0; k < std::min(list.size(), told); ++k) {
        const CaseRecord& first = smallest_case(list[k]);
        const std::string others = other_relations_text(first);
        const std::string body = fmt::format(
            "{}   {}\n{}{}\nrerun: {}{}", first.id, what_happened(first), why_it_happened(list[k]),
            others.empty() ? "" : "\nalso: " + others, rerun_of(list[k]),
            first.commands.explain.empty() ? "" : "\nexplain: " + first.commands.explain);
        const std::string file = file_in(base, run, first.file);
        const std::string place = file.empty()
                                      ? ""
                                      : fmt::format("file={},line={},", command_text(file, true),
                                                    std::max(first.line, 1U));
        const bool is_error =
            list[k].status != Status::fail || !list[k].level || *list[k].level <= fail_level(run);
        text += fmt::format("::{} {}title={}::{}\n", is_error ? "error" : "notice", place,
                            command_text(cause_title(list[k]), true), command_text(body, false));
    }
    if (list.size() > told) {
        const size_t more = list.size() - told;
        text += fmt::format("+{} more {} of unexpected results: see the summary of the step\n",
                            more, more == 1 ? "cause" : "causes");
    }
    return text;
}

std::string to_github_annotation(const std::vector<std::string>& sentences) {
    return fmt::format("::error title=edgecase::{}\n",
                       command_text(fmt::format("{}", fmt::join(sentences, "\n")), false));
}

std::string to_github_summary(const Run& run) {
    const capture::DeviceInfo& d = run.device;
    std::string text = fmt::format("## Edgecase: {}\n\n", exit_text(run));
    text += fmt::format(
        "{}, {}{}{}{}, {} subpixel bits{}, profile {}, seed {}, {}\n\n", cell(d.name),
        cell(d.driver_name), d.driver_info.empty() ? "" : " ", cell(d.driver_info),
        d.api_version.empty() ? "" : ", Vulkan " + cell(d.api_version), d.subpixel_bits,
        judged_bits_note(d), cases::to_string(run.profile), run.seed, seconds_text(run.seconds));
    if (!run.missing_shards.empty()) {
        text += fmt::format("**{}.**\n\n", cell(missing_shards_sentence(run)));
    }
    text += "| level | what was found |\n| --- | --- |\n";
    const Levels found = levels(run);
    for (const LevelCount& row : found.rows) {
        text +=
            fmt::format("| {} | {} |\n", cases::to_string(row.level), cell(level_text(found, row)));
    }
    if (const std::string unjudged = unjudged_text(found); !unjudged.empty()) {
        text += fmt::format("| none | {} |\n", unjudged);
    }
    text += "\n| status | cases |\n| --- | ---: |\n";
    const auto count = totals(run);
    for (size_t k = 0; k < kStatuses; ++k) {
        if (count.at(k) > 0) {
            text +=
                fmt::format("| {} | {} |\n", cell(to_string(static_cast<Status>(k))), count.at(k));
        }
    }
    text += fmt::format("| all | {} |\n", run.cases.size());
    const Repeated repeated(run);
    for (size_t k = 0; k < run.diagnoses.size(); ++k) {
        const Diagnosis& diagnosis = run.diagnoses[k];
        if (!repeated.is_partial(k)) {
            text += fmt::format("\n**Diagnosis: {}.** {}.\n", cell(what_it_does(diagnosis)),
                                cell(evidence_for(diagnosis)));
        }
    }
    const std::vector<Cause> list = causes(run);
    if (list.empty()) {
        return text;
    }
    text +=
        "\n### Causes of unexpected results\n\n"
        "| | cause | breaks | smallest case |\n"
        "| ---: | --- | --- | --- |\n";
    size_t told = 0;
    for (const Cause& cause : list) {
        const std::string row =
            fmt::format("| {} | {} | {} | {} |\n", told + 1, cell(cause_title(cause)),
                        cause_level(cause), cell(smallest_case(cause).id));
        if (text.size() + row.size() > kMaxSummary / 2) {
            break;
        }
        text += row;
        ++told;
    }
    if (told < list.size()) {
        text += fmt::format("\n+{} more causes, see the report.\n", list.size() - told);
    }
    for (size_t k = 0; k < run.diagnoses.size(); ++k) {
        const Diagnosis& diagnosis = run.diagnoses[k];
        if (repeated.is_partial(k)) {
            text += fmt::format("\nSome cases look as if: {}. It {}; it {}.\n",
                                cell(what_it_does(diagnosis)), cell(limits_of(diagnosis)),
                                cell(evidence_for(diagnosis)));
        }
    }
    text += "\n### What shows and repeats them\n";
    for (size_t k = 0; k < std::min(told, kMaxCommands); ++k) {
        const CaseRecord& first = smallest_case(list[k]);
        const std::string block =
            fmt::format("\n**{}. {}**: {}\n\n{}", k + 1, cell(cause_title(list[k])),
                        cell(fmt::format("{}; {}", what_happened(first), why_it_happened(list[k]))),
                        command_block(list[k]));
        if (text.size() + block.size() <= kMaxSummary) {
            text += block;
        }
    }
    if (told > kMaxCommands) {
        text +=
            fmt::format("\nThe commands of the other {} are in the report.\n", told - kMaxCommands);
    }
    return text;
}

std::string to_gitlab(const Run& run, const fs::path& base) {
    Json issues = Json::array();
    if (!run.missing_shards.empty()) {  // no file is to blame; GitLab wants one all the same
        issues.push_back(
            Json{{"description", missing_shards_sentence(run)},
                 {"check_name", "missing_shards"},
                 {"fingerprint", fingerprint("missing_shards\n" + missing_shards_text(run))},
                 {"severity", "blocker"},
                 {"location", Json{{"path", "."}, {"lines", Json{{"begin", 1}}}}}});
    }
    for (const CaseRecord& record : run.cases) {
        if (is_expected(record.status)) {
            continue;
        }
        std::string rule(to_string(record.status)), kind = record.death.signal;
        if (const auto news = leading_news(record)) {
            rule = news->rule.empty() ? rule : news->rule;
            kind = diff::to_string(news->kind);
        } else if (!record.outcome.findings.empty()) {
            rule = leading_finding(record).rule;
            kind = diff::to_string(leading_finding(record).kind);
        }
        // GitLab wants a path below the checkout: that of an installed case in its suite.
        std::string path = file_in(base, run, record.file);
        if (path.empty()) {
            path = record.id.substr(0, record.id.find(':')) + ".toml";
        }
        issues.push_back(Json{
            {"description", cases::printable(record.id + ": " + what_happened(record) + ". " +
                                             why_it_happened(record))},
            {"check_name", cases::printable(rule)},
            {"fingerprint", fingerprint(record.id + '\n' + std::string(to_string(record.status)) +
                                        '\n' + rule + '\n' + kind)},
            {"severity", severity_of(run, record)},
            {"location", Json{{"path", cases::printable(path)},
                              {"lines", Json{{"begin", std::max(record.line, 1U)}}}}},
        });
    }
    return issues.dump(1) + '\n';
}

}  // namespace report
