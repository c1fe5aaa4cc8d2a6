// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/model/rule_hint.hpp"

#include <fmt/format.h>

#include <vector>

#include "cases/model/rule.hpp"
#include "cases/model/selector.hpp"

namespace cases {

std::string rule_hint(std::string_view word, char quote) {
    const std::string_view family = word.substr(0, word.find('.') + 1);  // "depth."
    std::vector<std::string> all, endings;
    std::string list;
    for (const Rule& rule : all_rules()) {
        all.emplace_back(rule.id);
        if (!family.empty() && rule.id.starts_with(family)) {
            endings.emplace_back(rule.id.substr(family.size()));
            list += (list.empty() ? "" : ", ") + all.back();
        }
    }
    std::string nearest = nearest_name(word, all);
    if (!endings.empty()) {
        const std::string ending =
            nearest_name(word.substr(family.size()), endings);
        nearest = ending.empty() ? "" : std::string(family) + ending;
    }
    if (!nearest.empty()) {
        return fmt::format("did you mean {}{}{}?", quote, nearest, quote);
    }
    return list.empty() ? "docs/rules.md lists all" : "there are " + list;
}

}  // namespace cases
