// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "probe/base/vote.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cases/base/counted.hpp"

namespace probe {

Vote::Vote(std::vector<std::string> candidates)
    : candidates_(std::move(candidates)), explained_(candidates_.size()) {}

void Vote::add(const std::function<bool(size_t)>& explains) {
    std::vector<bool> answers(candidates_.size());
    size_t count = 0;
    for (size_t k = 0; k < answers.size(); ++k) {
        answers[k] = explains(k);
        count += answers[k] ? 1U : 0U;
    }
    if (count == answers.size()) {
        return;
    }
    ++decisive_;
    for (size_t k = 0; k < answers.size(); ++k) {
        explained_[k] += answers[k] ? 1U : 0U;
    }
}

size_t Vote::best() const {
    return static_cast<size_t>(std::ranges::max_element(explained_) - explained_.begin());
}

void Vote::settle(Property& property, const std::function<std::string(size_t)>& label) const {
    const auto name = [&](size_t k) { return label ? label(k) : candidates_[k]; };
    if (decisive_ == 0) {
        if (property.why.empty()) {
            property.why = "no observation told the possible answers apart";
        }
        return;
    }
    property.why.clear();
    const size_t first = best();
    property.agree = explained_[first];
    property.contradict = decisive_ - explained_[first];
    uint64_t rival = 0;
    std::string rival_name;
    for (size_t k = 0; k < candidates_.size(); ++k) {
        if (name(k) != name(first) && (rival_name.empty() || explained_[k] > rival)) {
            rival = explained_[k];
            rival_name = name(k);
        }
    }
    const uint64_t margin = explained_[first] - rival;
    if (!rival_name.empty() && margin == 0) {
        property.why =
            fmt::format("'{}' and '{}' explain alike what was drawn", name(first), rival_name);
    } else if (64 * property.contradict > decisive_ || 4 * property.contradict > margin) {
        property.why = fmt::format(
            "no possible answer explains it: '{}' is contradicted by {} of {}", name(first),
            property.contradict, cases::counted(decisive_, "decisive observation"));
    } else {
        property.answer = name(first);
    }
}

}  // namespace probe
