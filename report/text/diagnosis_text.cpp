// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/diagnosis_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/base/counted.hpp"

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

Repeated::Repeated(const Run& run) {
    for (size_t k = 0; k < run.diagnoses.size(); ++k) {
        for (const std::string& id : run.diagnoses[k].explained) {
            diagnosis_of_.emplace(id, k);
        }
        others_.insert(run.diagnoses[k].unexplained.begin(), run.diagnoses[k].unexplained.end());
    }
    for (const auto& [id, number] : diagnosis_of_) {
        others_.erase(id);
    }
}

std::optional<size_t> Repeated::by(const std::string& id) const {
    const auto found = diagnosis_of_.find(id);
    return found == diagnosis_of_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<size_t> Repeated::by(const Cause& cause) const {
    std::map<size_t, size_t> counts;  // of cases, by diagnosis
    for (const CaseRecord* record : cause.cases) {
        if (others_.contains(record->id)) {
            return std::nullopt;
        }
        if (const auto number = by(record->id)) {
            ++counts[*number];
        }
    }
    const auto most =
        std::max_element(counts.begin(), counts.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == counts.end() ? std::nullopt : std::optional(most->first);
}

}  // namespace report
