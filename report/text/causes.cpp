// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/causes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "cases/base/counted.hpp"
#include "cases/model/rule.hpp"
#include "report/record/levels.hpp"
#include "report/text/sentences.hpp"

namespace report {

namespace {

// What a case is grouped by, besides its status and family.
struct Signature {
    std::string rule, kind, door;
    std::optional<cases::Profile> level;
    friend auto operator<=>(const Signature&, const Signature&) = default;
};

Signature signature_of(const diff::FindingGroup& group) {
    return {group.rule, std::string(diff::to_string(group.kind)), group.door, group.level};
}

// Of what leads; its level is that of the case.
Signature signature_of(const CaseRecord& record, Of which) {
    const std::optional<cases::Profile> level = level_of(record, which);
    if (const auto news = leading_news(record)) {
        return {news->rule, std::string(diff::to_string(news->kind)), news->door, level};
    }
    if (!record.outcome.findings.empty()) {
        const diff::Finding& f = leading_finding(record);
        return {f.rule, std::string(diff::to_string(f.kind)), f.door, level};
    }
    std::string kind = record.death.signal;
    if (!record.death.step.empty()) {
        kind += (kind.empty() ? "during " : " during ") + record.death.step;
    }
    return {"", kind, "", level};
}

// What could not be judged and deaths come first, then failures by profile, then the rest.
int rank(const Cause& cause) {
    constexpr std::array kOrder = {Status::error,       Status::crash, Status::timeout,
                                   Status::device_lost, Status::fail,  Status::flake,
                                   Status::improved,    Status::xpass};
    const auto place = std::ranges::find(kOrder, cause.status) - kOrder.begin();
    // vulkan, practice, direct3d, and those of which no level is told
    const bool is_failure = cause.status == Status::fail || cause.status == Status::xfail;
    const int level = cause.level ? static_cast<int>(*cause.level) : 3;
    return static_cast<int>(4 * place) + (is_failure ? level : 0);
}

// How far a rule reaches: the families and cases in which it leads, with the same rank.
struct Reach {
    size_t families = 0, cases = 0;
};

// Where a rule stands in the list of rules: what is decided earlier in the pipeline comes first.
std::ptrdiff_t number_of(std::string_view rule) {
    const auto all = cases::all_rules();
    return std::ranges::find(all, rule, &cases::Rule::id) - all.begin();
}

// The causes of those results of a run that `is_meant` picks by their status, by all their findings
// or by those that are new.
std::vector<Cause> causes_of(const Run& run, bool (*is_meant)(Status), Of which) {
    std::vector<Cause> list;
    std::map<std::tuple<Status, std::string, Signature, bool>, size_t> index;
    for (const CaseRecord& record : run.cases) {
        if (!is_meant(record.status)) {
            continue;
        }
        const std::string family = family_of(record);
        const bool is_known = level_of(record, Of::all) && !level_of(record, Of::news);
        const auto add = [&](const Signature& s) {
            const auto [at, fresh] =
                index.emplace(std::tuple(record.status, family, s, is_known), list.size());
            if (fresh) {
                list.push_back(
                    {record.status, family, s.rule, s.kind, s.door, s.level, is_known, {}});
            }
            list[at->second].cases.push_back(&record);
        };
        add(signature_of(record, which));
        for (const diff::FindingGroup& group : other_relations(record, which)) {
            add(signature_of(group));
        }
    }
    std::map<std::pair<int, std::string>, Reach> reaches;
    std::set<std::tuple<int, std::string, std::string>> families;
    for (const Cause& cause : list) {
        Reach& reach = reaches[{rank(cause), cause.rule}];
        reach.cases += cause.cases.size();
        reach.families += families.emplace(rank(cause), cause.rule, cause.family).second ? 1U : 0U;
    }
    const auto order = [&](const Cause& a) {
        const Reach& reach = reaches.at({rank(a), a.rule});
        return std::tuple(-rank(a), reach.families, reach.cases, -number_of(a.rule),
                          a.cases.size());
    };
    std::ranges::stable_sort(list,
                             [&](const Cause& a, const Cause& b) { return order(b) < order(a); });
    return list;
}

}  // namespace

std::vector<Cause> causes(const Run& run) {
    return causes_of(
        run, [](Status status) { return !is_expected(status); }, Of::news);
}

std::vector<Cause> known_causes(const Run& run) {
    return causes_of(
        run, [](Status status) { return status == Status::xfail; }, Of::all);
}

// Files of one's own mostly lie in one folder, and each is no family: their causes would be as many
// as they. No family of the suite ends in '/'.
std::string family_of(const CaseRecord& record) {
    const std::string id = record.id.substr(0, record.id.find(':'));
    if (const size_t end = id.find('/'); end != std::string::npos) {
        return id.substr(0, end);
    }
    const std::string folder = std::filesystem::path(record.file).parent_path().filename().string();
    return folder.empty() || folder == "." || folder == ".." ? id : folder + "/";
}

std::string cause_level(const Cause& cause) {
    return cause.level      ? std::string(cases::to_string(*cause.level))
           : cause.is_known ? "all expected"
                            : "";
}

const CaseRecord& smallest_case(const Cause& cause) {
    const auto size = [](const CaseRecord* r) {
        return std::pair(r->outcome.compared_samples, r->outcome.finding_total());
    };
    return **std::ranges::min_element(
        cause.cases, [&](const CaseRecord* a, const CaseRecord* b) { return size(a) < size(b); });
}

std::string why_it_happened(const Cause& cause) {
    const CaseRecord& record = smallest_case(cause);
    const auto found = std::ranges::find_if(record.outcome.findings, [&](const diff::Finding& f) {
        return f.rule == cause.rule && f.door == cause.door &&
               diff::to_string(f.kind) == cause.kind;
    });
    return found == record.outcome.findings.end() ? why_it_happened(record) : finding_text(*found);
}

std::string cause_title(const Cause& cause) {
    std::string text(to_string(cause.status));
    std::ranges::replace(text, '_', ' ');
    if (!cause.rule.empty() || !cause.kind.empty()) {
        text += ": " + rule_and_door(cause.rule, cause.door) +
                (cause.rule.empty() || cause.kind.empty() ? "" : " ") + cause.kind;
    }
    text += fmt::format(" in {}, {}", cause.family, cases::counted(cause.cases.size(), "case"));
    return one_line(text);
}

}  // namespace report
