// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The judge against a plain enumerator of histories, which is written apart from it: what a history
// shows passes at its profile and looser ones, whatever is delivered of it, and what none shows
// fails. EDGECASE_HISTORIES_SEED=N tries one seed alone, in each test, and tells a smaller
// scene; EDGECASE_HISTORIES_OFFSET=N moves the seeds of each test by N; EDGECASE_HISTORIES_TELL
// tells all that is found, not only the shortest.
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <optional>
#include <string_view>

#include "share.hpp"
#include "trial.hpp"

namespace {

using histories::Tally;

constexpr uint64_t kQuick = 300, kExhaustive = 20000, kEverySubset = 200;

// What a variable of the environment asks for; nothing if it is no number.
std::optional<uint64_t> asked(const char* name) {
    const char* given = std::getenv(name);
    const std::string_view text(given != nullptr ? given : "");
    uint64_t number = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    EXPECT_TRUE(given == nullptr || read.ec == std::errc{}) << name;
    return read.ec == std::errc{} ? std::optional(number) : std::nullopt;
}

// Tries seeds, those from `first` on, and tells the shortest contradictions.
void try_seeds(uint64_t first, uint64_t count, const std::function<void(uint64_t, Tally&)>& one) {
    first += asked("EDGECASE_HISTORIES_OFFSET").value_or(0);
    if (const auto seed = asked("EDGECASE_HISTORIES_SEED")) {
        first = *seed;
        count = 1;
    }
    Tally tally;
    tally.shrinks = count == 1;
    for (uint64_t seed = first; seed < first + count; ++seed) {
        one(seed, tally);
    }
    std::cout << count << " seeds, " << tally.scenes
              << " scenes; right at vulkan, practice, direct3d: " << tally.right[0] << ' '
              << tally.right[1] << ' ' << tally.right[2] << "; wrong: " << tally.wrong[0] << ' '
              << tally.wrong[1] << ' ' << tally.wrong[2] << "; errors " << tally.errors.size()
              << "; none " << tally.none << "; contradictions " << tally.contradictions.size()
              << '\n';
    std::sort(tally.contradictions.begin(), tally.contradictions.end(),
              [](const auto& a, const auto& b) { return a.size() < b.size(); });
    if (!tally.errors.empty()) {
        std::cout << "  an error: " << tally.errors[0] << '\n';
    }
    const size_t told = std::getenv("EDGECASE_HISTORIES_TELL") != nullptr ? 100000 : 3;
    for (size_t i = 0; i < std::min<size_t>(tally.contradictions.size(), told); ++i) {
        ADD_FAILURE() << tally.contradictions[i];
    }
    EXPECT_TRUE(tally.contradictions.empty());
    EXPECT_LE(tally.errors.size(), 1 + count / 100) << tally.errors.back();
}

void right(uint64_t seed, Tally& tally) {
    histories::try_right(seed, false, tally);
}
void every_subset(uint64_t seed, Tally& tally) {
    histories::try_right(seed, true, tally);
}

TEST(Histories, WhatOneShowsPasses) {
    try_seeds(1, kQuick, right);
}
TEST(Histories, WhatNoneShowsFails) {
    try_seeds(1, kQuick, histories::try_wrong);
}
TEST(Histories, WhatPassesDoesWithFewerPlanes) {
    try_seeds(1, kQuick, histories::try_fewer);
}

TEST(ExhaustiveHistories, WhatOneShowsPasses) {
    try_seeds(1, kExhaustive, right);
}
TEST(ExhaustiveHistories, EverySubsetOfPlanesPasses) {
    try_seeds(1, kEverySubset, every_subset);
}
TEST(ExhaustiveHistories, WhatNoneShowsFails) {
    try_seeds(1, kExhaustive + kExhaustive / 8, histories::try_wrong);
}
TEST(ExhaustiveHistories, WhatPassesDoesWithFewerPlanes) {
    try_seeds(1, kExhaustive / 2, histories::try_fewer);
}

}  // namespace
