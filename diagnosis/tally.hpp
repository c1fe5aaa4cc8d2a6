// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a hypothesis says of failed cases, and how often it is right.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "capture/capture.hpp"
#include "diagnosis/condition.hpp"
#include "diagnosis/match.hpp"

namespace diagnosis {

// What a hypothesis says of one failed case.
enum class Says : uint8_t { nothing, explains, otherwise };
struct Answer {
    Says says = Says::nothing;
    Match match;
};

// What is said by what a hypothesis draws of the case, if anything.
Answer answer_of(const Subject& subject, const std::optional<capture::Capture>& drawn);

// Whether a case that passed would have failed.
bool is_against(const Subject& passed, const capture::Capture& drawn);

struct Tally {
    size_t hypothesis = 0;          // index
    std::optional<Condition> only;  // where it holds; nothing: everywhere
    std::vector<Answer> answers;    // by subject
    uint64_t passed_against = 0, passed_tried = 0;

    size_t count(Says what) const;
    // A device may have other errors, too, and choices that the software device has not: of the
    // cases that a hypothesis speaks of a few may end otherwise. It stands while those are a half
    // of what it explains, and those that passed against it an eighth of what it would explain if
    // all failed cases were subjects, and a quarter of those tried, where these are many enough.
    bool is_plausible() const { return 2 * count(Says::otherwise) <= count(Says::explains); }
    bool stands(size_t failed) const {
        constexpr uint64_t kMany = 16;
        return 8 * passed_against * answers.size() <= count(Says::explains) * failed &&
               (passed_tried < kMany || 4 * passed_against <= passed_tried);
    }
    std::pair<size_t, int64_t> score() const {
        return {count(Says::explains), -static_cast<int64_t>(count(Says::otherwise))};
    }
    bool is_alike(const Tally& other) const;
};

}  // namespace diagnosis
