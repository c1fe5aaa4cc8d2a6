// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which samples of a case exercise a rule: there a device that breaks the rule draws something else
// than it must. A case that claims a rule which none of its samples exercises tests nothing of it.
// What it takes is told rule by rule in one table (exercise_table.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "ref/position/limits.hpp"

namespace ref {

// What can be seen of a draw in a target without instruments.
enum class Sight : uint8_t {
    covers_nothing,  // no decided sample
    nothing,  // with or without it, once or twice, in whatever order and with whatever blending and
              // mask, the attachments hold the same
    something
};

// Which samples exercise a rule, in words: "that a triangle covers wherever its vertices may lie".
// Every rule has such a row.
std::string_view exercise_of(std::string_view rule);

struct RuleShare {
    std::string_view rule;
    uint64_t samples = 0;   // that exercise it; where only `some` are asked for, 1 or none
    bool is_least = false;  // not all were looked at: there may be more
};

struct Exercise {
    std::vector<RuleShare> rules;  // those asked for that are rules, in that order
    uint64_t samples = 0;          // of the target; texels of a blit
    uint64_t free_samples = 0;     // more than one number of hits is right, at profile direct3d
    // Samples that must be covered, by profile; 0 of a blit, whose texels are all decided.
    std::array<uint64_t, std::size(cases::kProfiles)> must_samples{};
    std::vector<Sight> draws;  // by draw, of a target without instruments; else empty
};

// Whether all samples that exercise a rule are counted, or one is looked for, which is faster.
enum class Count : uint8_t { some, all };

// Looks for samples of a case that exercise these rules.
Exercise exercise(const cases::Case& c, const Limits& limits, std::span<const std::string> rules,
                  Count count);

}  // namespace ref
