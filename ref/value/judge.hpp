// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The verdict on one fragment. Stages: binary64 against the unsnapped and the snapped basis
// (accepts only what is proven); all bases of the profile in Balls; the same in rationals.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "ref/value/mismatch.hpp"

namespace ref::value {

// What is judged and told (ValueReference).
struct JudgeSettings {
    ValueSelection selection;
    std::vector<std::vector<Quantity>> selected;        // the quantities of it, by draw
    std::function<bool(const ValueMismatch&)> is_told;  // empty: all
    bool tells_ratios = true;
    std::optional<LoosestLevels> loosest_levels;
};

// `exact_only`: the oracle, by rationals alone.
FragmentVerdict judge(const DrawnFragment& fragment, JudgeSettings& settings, bool exact_only);

}  // namespace ref::value
