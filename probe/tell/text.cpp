// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "probe/tell/text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace probe {

std::string sureness(const Property& p) {
    const uint64_t all = p.agree + p.contradict;
    return all == 0 ? std::string() : fmt::format("{} of {}", p.agree, all);
}

std::string figures_text(const Property& p) {
    std::string out;
    for (const Figure& f : p.figures) {
        out += fmt::format("{}{} {:.4g}{}{}", out.empty() ? "" : ", ", f.name, f.value,
                           f.unit.empty() ? "" : " ", f.unit);
    }
    return out;
}

std::string how_many_are_known(const Datasheet& sheet) {
    const auto known = std::ranges::count_if(sheet.properties, &Property::is_known);
    return fmt::format("{} of {} properties could be told", known, sheet.properties.size());
}

std::string to_text(const Datasheet& sheet, bool is_long) {
    std::string out;
    size_t width = 0;
    for (const auto& [name, value] : sheet.device) {
        width = std::max(width, name.size());
    }
    for (const auto& [name, value] : sheet.device) {
        out += fmt::format("{:<{}}  {}\n", name, width, value);
    }
    size_t question = 0;
    for (const Property& p : sheet.properties) {
        question = std::max(question, p.question.size());
    }
    for (const Section& section : kSections) {
        bool is_begun = false;
        for (const Property& p : sheet.properties) {
            if (p.section() != section.name) {
                continue;
            }
            if (!is_begun) {
                out += fmt::format("\n{}\n", section.title);
                is_begun = true;
            }
            const std::string sure = p.is_known() ? sureness(p) : "";
            out += fmt::format("  {:<{}}  {}{}\n", p.question, question, p.answer,
                               sure.empty() ? "" : fmt::format("  ({})", sure));
            if (!p.why.empty()) {
                out += fmt::format("      {}\n", p.why);
            }
            if (const std::string figures = figures_text(p); !figures.empty()) {
                out += fmt::format("      {}\n", figures);
            }
            if (is_long && !p.experiment.empty()) {
                out += fmt::format("      {}: {}\n", p.id, p.experiment);
            }
        }
    }
    return out + "\n" + how_many_are_known(sheet) +
           "; in parentheses: decisive observations that agree\n";
}

}  // namespace probe
