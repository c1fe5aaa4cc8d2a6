// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/generator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "cases/base/checksum.hpp"
#include "cases/load/loader.hpp"

namespace fuzz {
namespace {

Pose next(Poses& poses, uint64_t seed) {
    const uint64_t number = poses.count();
    return poses.next([&](const Pose& pose) { return is_case(seed, pose, number); });
}

TEST(Generator, MakesTheSameCasesOnEveryMachine) {
    // A change of this number changes what every seed means: say so in the changelog. So many poses
    // draw every feature, whose dice another compiler could cast in another order.
    Poses poses(1);
    uint64_t hash = 0;
    for (uint64_t k = 0; k < 256; ++k) {
        const Pose pose = next(poses, 1);
        hash = cases::stable_hash(case_text(1, pose, k, k * 128 + 5), hash);
    }
    EXPECT_EQ(cases::hex(hash), "5f0b6a3efb6faf47");
}

TEST(Generator, SeedsDiffer) {
    Poses one(1), two(2);
    EXPECT_NE(next(one, 1).text(), next(two, 2).text());
    EXPECT_NE(case_text(1, Pose(), 0, 7), case_text(2, Pose(), 0, 7));
    EXPECT_NE(case_text(1, Pose(), 0, 7), case_text(1, Pose(), 0, 8));
}

// Random states that the loader refuses would be time lost, and a feature that it always refuses
// would be one that nobody misses.
TEST(Generator, EachFeatureIsDrawnAndItsCasesLoad) {
    constexpr uint64_t kPoses = 500;
    Poses poses(3);
    std::map<std::pair<size_t, size_t>, size_t> seen;
    size_t made = 0, loaded = 0;
    for (uint64_t k = 0; k < kPoses; ++k) {
        const Pose pose = next(poses, 3);
        for (const auto& value : pose.active()) {
            ++seen[value];
        }
        for (uint64_t number : {k * 128 + 1, k * 128 + 77}) {
            const auto c = cases::load_text(case_text(3, pose, k, number), "fuzz", "fuzz");
            ++made;
            loaded += c ? 1U : 0U;
            EXPECT_TRUE(c) << pose.text() << '\n' << cases::to_string(c.error().front());
        }
    }
    EXPECT_EQ(loaded, made);
    for (size_t feature = 0; feature < features().size(); ++feature) {
        for (size_t value = 1; value < features()[feature].values.size(); ++value) {
            EXPECT_GT(seen[std::pair(feature, value)], 0U)
                << features()[feature].name << " = " << features()[feature].values[value];
        }
    }
}

TEST(Poses, UnseenPairsComeFirst) {
    // Of as many poses without that preference fewer pairs are met.
    Poses poses(5);
    size_t plain = 0;
    std::set<std::pair<uint64_t, uint64_t>> pairs;
    for (uint64_t k = 0; k < 200; ++k) {
        poses.next([](const Pose&) { return true; });
        Poses other(1000 + k);  // its first pose: nothing is seen yet, so no pair is preferred
        const auto active = other.next([](const Pose&) { return true; }).active();
        for (const auto& a : active) {
            for (const auto& b : active) {
                if (!(b < a)) {
                    pairs.insert({a.first * 64 + a.second, b.first * 64 + b.second});
                }
            }
        }
    }
    plain = pairs.size();
    EXPECT_GT(poses.pairs(), plain);
}

}  // namespace
}  // namespace fuzz
