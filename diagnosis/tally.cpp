// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/tally.hpp"

#include <algorithm>

#include "diff/verdict.hpp"
#include "rasterizers/strength/strength.hpp"

namespace diagnosis {

Answer answer_of(const Subject& subject, const std::optional<capture::Capture>& drawn) {
    if (!drawn || software::same_bits(*drawn, subject.right)) {
        return {};
    }
    const diff::Verdict verdict = verdict_of(subject, *drawn);
    if (verdict.ok()) {
        return {};
    }
    const Match m = match(*subject.record, verdict);
    return {m.explains() ? Says::explains : Says::otherwise, m};
}

bool is_against(const Subject& passed, const capture::Capture& drawn) {
    return !software::same_bits(drawn, passed.right) && !verdict_of(passed, drawn).ok();
}

size_t Tally::count(Says what) const {
    return static_cast<size_t>(std::ranges::count(answers, what, &Answer::says));
}

bool Tally::is_alike(const Tally& other) const {
    return std::ranges::equal(answers, other.answers,
                              [](const Answer& a, const Answer& b) { return a.says == b.says; });
}

}  // namespace diagnosis
