// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/diagnosis_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "cases/base/counted.hpp"
#include "report/text/sentences.hpp"

namespace report {

std::string what_it_does(const Diagnosis& diagnosis) {
    std::string text = diagnosis.what.size() > 1 ? "one of: " : "";
    for (size_t k = 0; k < diagnosis.what.size(); ++k) {
        text += (k > 0 ? "; " : "") + diagnosis.what[k];
    }
    return text;
}

std::string evidence_for(const Diagnosis& diagnosis) {
    const Diagnosis& d = diagnosis;
    std::string text =
        fmt::format("repeats {} of {}", d.same_samples, cases::counted(d.samples, "wrong sample"));
    if (d.values > 0) {
        text +=
            fmt::format(" and {} of {}", d.same_values, cases::counted(d.values, "told finding"));
    }
    text += fmt::format(" in {} of {} tried", d.cases, cases::counted(d.tried, "failed case"));
    if (d.failed > d.tried) {
        text += fmt::format(", {} failed in all", d.failed);
    }
    if (d.against > 0) {
        text += fmt::format("; {} otherwise",
                            d.against == 1 ? "1 fails" : fmt::format("{} fail", d.against));
    }
    if (d.passed_against > 0) {
        text += fmt::format("; {} of {} that passed would fail", d.passed_against,
                            cases::counted(d.passed_tried, "case"));
    } else {
        text += fmt::format("; {} that passed {}", cases::counted(d.passed_tried, "case"),
                            d.passed_tried == 1 ? "agrees" : "agree");
    }
    return text;
}

std::string limits_of(const Diagnosis& diagnosis) {
    return fmt::format("explains {} of {} only", diagnosis.cases,
                       cases::counted(diagnosis.tried, "failed case") + " tried");
}

Repeated::Repeated(const Run& run) {
    std::set<std::string> tried, explained;
    for (const Diagnosis& diagnosis : run.diagnoses) {
        tried.insert(diagnosis.explained.begin(), diagnosis.explained.end());
        tried.insert(diagnosis.unexplained.begin(), diagnosis.unexplained.end());
        explained.insert(diagnosis.explained.begin(), diagnosis.explained.end());
        explained_.emplace_back(diagnosis.explained.begin(), diagnosis.explained.end());
    }
    tried_ = std::move(tried);
    const bool explain_most = 2 * explained.size() >= tried_.size();
    std::set<size_t> with_a_cause;
    for (const Cause& cause : causes_by_family(run)) {
        Tried of_cause;
        add(of_cause, cause);
        if (const auto number = of_most(of_cause, 4); number && !is_relation(cause.rule)) {
            with_a_cause.insert(*number);
        }
    }
    for (size_t k = 0; k < explained_.size(); ++k) {
        const bool explains_most = 2 * explained_[k].size() >= tried_.size();
        is_partial_.push_back(!explains_most && !(explain_most && with_a_cause.contains(k)));
    }
}

bool Repeated::is_partial(size_t number) const {
    return is_partial_.at(number);
}

std::optional<size_t> Repeated::by(const std::string& id) const {
    for (size_t k = 0; k < explained_.size(); ++k) {
        if (explained_[k].contains(id)) {
            return k;
        }
    }
    return std::nullopt;
}

void Repeated::add(Tried& tried, const Cause& cause) const {
    tried.repeated.resize(explained_.size());
    for (const CaseRecord* record : cause.cases) {
        if (!tried_.contains(record->id)) {
            continue;
        }
        ++tried.cases;
        for (size_t k = 0; k < explained_.size(); ++k) {
            tried.repeated[k] += explained_[k].contains(record->id) ? 1U : 0U;
        }
    }
}

std::optional<size_t> Repeated::of_most(const Tried& tried, size_t quarters) const {
    for (size_t k = 0; tried.cases > 0 && k < explained_.size(); ++k) {
        if (4 * tried.repeated[k] >= quarters * tried.cases) {
            return k;
        }
    }
    return std::nullopt;
}

std::vector<std::optional<size_t>> Repeated::of(const std::vector<Cause>& list) const {
    const auto kind_of = [](const Cause& cause) {
        return std::tuple(cause.status, cause.rule, cause.kind, cause.level);
    };
    std::map<decltype(kind_of(list.front())), Tried> of_kind;
    for (const Cause& cause : list) {
        add(of_kind[kind_of(cause)], cause);
    }
    std::vector<std::optional<size_t>> numbers(list.size());
    std::map<const CaseRecord*, size_t> by_picture;  // what says the same of a plain picture
    for (size_t k = 0; k < list.size(); ++k) {
        // What is drawn is one picture of a case, so it says nothing of relations between several.
        if (is_relation(list[k].rule)) {
            continue;
        }
        Tried tried;
        add(tried, list[k]);
        numbers[k] = tried.cases > 0 ? of_most(tried, 4) : of_most(of_kind[kind_of(list[k])], 3);
        if (numbers[k] && is_partial(*numbers[k])) {
            numbers[k].reset();
        }
        for (const CaseRecord* record : list[k].cases) {
            if (numbers[k]) {
                by_picture.emplace(record, *numbers[k]);
            }
        }
    }
    for (size_t k = 0; k < list.size(); ++k) {
        const Cause& cause = list[k];
        if (!is_relation(cause.rule) || !cause.door.empty()) {
            continue;
        }
        const auto first = by_picture.find(cause.cases.front());
        if (first != by_picture.end() &&
            std::ranges::all_of(cause.cases, [&](const CaseRecord* record) {
                const auto found = by_picture.find(record);
                return found != by_picture.end() && found->second == first->second;
            })) {
            numbers[k] = first->second;
        }
    }
    return numbers;
}

}  // namespace report
