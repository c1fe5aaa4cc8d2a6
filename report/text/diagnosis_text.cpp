// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/diagnosis_text.hpp"

#include <fmt/format.h>

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
    text += fmt::format("; {} that passed {}", cases::counted(d.passed_tried, "case"),
                        d.passed_tried == 1 ? "agrees" : "agree");
    return text;
}

}  // namespace report
