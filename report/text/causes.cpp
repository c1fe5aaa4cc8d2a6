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
#include "report/text/diagnosis_text.hpp"
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

// Where a rule stands in the list of rules: what is decided earlier in the pipeline comes first.
std::ptrdiff_t number_of(std::string_view rule) {
    const auto all = cases::all_rules();
    return std::ranges::find(all, rule, &cases::Rule::id) - all.begin();
}

// Every result that `is_meant` picks by its status, in the causes that it stands in, by all its
// findings or by those that are new. A cause holds the cases of one family.
std::vector<Cause> fine_causes(const Run& run, bool (*is_meant)(Status), Of which) {
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
                list.push_back({record.status, s.rule, s.kind, s.door, s.level, is_known, {}, {}});
            }
            list[at->second].cases.push_back(&record);
        };
        const Signature leading = signature_of(record, which);
        add(leading);
        std::set<Signature> others;
        for (diff::FindingGroup& group : other_relations(record, which)) {
            if (!is_relation(leading.rule)) {
                group.door.clear();  // the door may be right, and differ from a wrong picture
            }
            others.insert(signature_of(group));
        }
        std::ranges::for_each(others, add);
    }
    return list;
}

// The gravest first; among equals those of the rule that reaches farthest.
void sort_causes(std::vector<Cause>& list) {
    struct Reach {
        std::set<std::string> families;
        size_t cases = 0;
    };
    std::map<std::tuple<int, std::string, std::optional<size_t>>, Reach> reaches;
    for (const Cause& cause : list) {
        Reach& reach = reaches[{rank(cause), cause.rule, cause.diagnosis}];
        reach.cases += cause.cases.size();
        for (const CaseRecord* record : cause.cases) {
            reach.families.insert(family_of(*record));
        }
    }
    const auto order = [&](const Cause& a) {
        const Reach& reach = reaches.at({rank(a), a.rule, a.diagnosis});
        return std::tuple(-rank(a), reach.families.size(), reach.cases, -number_of(a.rule),
                          a.cases.size());
    };
    std::ranges::stable_sort(list,
                             [&](const Cause& a, const Cause& b) { return order(b) < order(a); });
}

std::vector<Cause> joined_causes(const Run& run, bool (*is_meant)(Status), Of which) {
    const std::vector<Cause> fine = fine_causes(run, is_meant, which);
    const std::vector<std::optional<size_t>> diagnoses =
        run.diagnoses.empty() ? std::vector<std::optional<size_t>>(fine.size())
                              : Repeated(run).of(fine);
    std::vector<Cause> list;
    std::map<std::tuple<Status, Signature, bool, std::optional<size_t>>, size_t> index;
    for (size_t k = 0; k < fine.size(); ++k) {
        const Cause& cause = fine[k];
        const auto [at, is_fresh] = index.emplace(
            std::tuple(cause.status, Signature{cause.rule, cause.kind, cause.door, cause.level},
                       cause.is_known, diagnoses[k]),
            list.size());
        if (is_fresh) {
            list.push_back(cause);
            list.back().diagnosis = diagnoses[k];
            continue;
        }
        std::vector<const CaseRecord*>& cases = list[at->second].cases;
        cases.insert(cases.end(), cause.cases.begin(), cause.cases.end());
    }
    for (Cause& cause : list) {
        std::ranges::sort(cause.cases);  // in the order of the run
    }
    sort_causes(list);
    return list;
}

bool is_unexpected(Status status) {
    return !is_expected(status);
}
bool is_known_failure(Status status) {
    return status == Status::xfail;
}

}  // namespace

std::vector<Cause> causes(const Run& run) {
    return joined_causes(run, is_unexpected, Of::news);
}

std::vector<Cause> known_causes(const Run& run) {
    return joined_causes(run, is_known_failure, Of::all);
}

std::vector<Cause> causes_by_family(const Run& run) {
    std::vector<Cause> list = fine_causes(run, is_unexpected, Of::news);
    for (Cause& cause : fine_causes(run, is_known_failure, Of::all)) {
        list.push_back(std::move(cause));
    }
    return list;
}

std::string families_text(const std::vector<const CaseRecord*>& of) {
    constexpr size_t kNamed = 3;
    std::map<std::string, size_t> count;
    for (const CaseRecord* record : of) {
        ++count[one_line(family_of(*record))];
    }
    std::vector<std::pair<std::string, size_t>> list(count.begin(), count.end());
    std::ranges::stable_sort(list,
                             [](const auto& a, const auto& b) { return a.second > b.second; });
    std::string text;
    for (size_t k = 0; k < std::min(list.size(), kNamed); ++k) {
        text += (k > 0 ? ", " : "") + list[k].first;
    }
    return list.size() > kNamed ? text + fmt::format(" and {} more", list.size() - kNamed) : text;
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
    text += fmt::format(" in {}, {}", families_text(cause.cases),
                        cases::counted(cause.cases.size(), "case"));
    return one_line(text);
}

}  // namespace report
