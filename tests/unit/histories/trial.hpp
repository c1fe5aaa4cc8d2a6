// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Right and wrong pictures of random scenes, before the judge.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace histories {

struct Tally {
    // Pictures judged, by profile.
    std::array<uint64_t, 3> right{}, wrong{};
    // Seeds of which no picture was found; seeds that made a case.
    uint64_t none = 0, scenes = 0;
    std::vector<std::string> errors;  // neither pass nor fail: an empty picture would pass, too
    std::vector<std::string> contradictions;
    bool shrinks = false;  // and tells a smaller scene of each
};

// A picture of the seed's scene that a device of a random profile draws: passes there and at looser
// ones.
void try_right(uint64_t seed, bool every_subset, Tally& tally);
// One with a sample that no history shows: fails, and is told at the loosest profile where it does.
void try_wrong(uint64_t seed, Tally& tally);
// One that passes, whatever it is: passes with fewer planes.
void try_fewer(uint64_t seed, Tally& tally);

}  // namespace histories
