// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/diagnosis_text.hpp"

#include <fmt/format.h>

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
    for (const auto& list : {causes(run), known_causes(run)}) {
        for (const Cause& cause : list) {
            if (const auto number = whole(cause)) {
                with_a_cause.insert(*number);
            }
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

std::optional<size_t> Repeated::by(const Cause& cause) const {
    const std::optional<size_t> number = whole(cause);
    return number && !is_partial(*number) ? number : std::nullopt;
}

std::optional<size_t> Repeated::whole(const Cause& cause) const {
    // What is drawn is one picture of a case, so it says nothing of relations between several.
    if (is_relation(cause.rule)) {
        return std::nullopt;
    }
    for (size_t k = 0; k < explained_.size(); ++k) {
        bool was_tried = false, explains_all = true;
        for (const CaseRecord* record : cause.cases) {
            was_tried = was_tried || tried_.contains(record->id);
            explains_all = explains_all &&
                           (!tried_.contains(record->id) || explained_[k].contains(record->id));
        }
        if (was_tried && explains_all) {
            return k;
        }
    }
    return std::nullopt;
}

}  // namespace report
