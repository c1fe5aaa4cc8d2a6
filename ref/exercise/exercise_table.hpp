// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The table of what exercises each rule.
#pragma once

#include <array>
#include <string_view>

#include "cases/fault/row.hpp"
#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "ref/exercise/difference.hpp"
#include "ref/exercise/tests.hpp"

namespace ref {

// One way to exercise a rule: by a test at the samples of a profile; by what a device with a
// fault that breaks the rule takes the case for (cases/fault/change.hpp); or, of a blit, in texels
// inside or outside its region.
struct Way {
    cases::Profile profile = cases::Profile::direct3d;
    ExerciseTest test = nullptr;
    cases::Fault fault = cases::kNoFault;
    Differ differ = Differ::hits;  // by what the fault shows
    enum class Texels : uint8_t { none, inside, outside } texels = Texels::none;
};

struct ExerciseRow {
    std::string_view rule;
    std::string_view how;  // as exercise_of
    std::array<Way, 3> ways{};
    // Texels of blits: whether the case's blit is one that the rule is about.
    bool (*is_about)(const cases::Blit& blit) = nullptr;
};

const ExerciseRow* find_exercise(std::string_view rule);

}  // namespace ref
