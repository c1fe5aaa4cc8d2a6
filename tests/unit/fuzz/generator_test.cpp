// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/generator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
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
    EXPECT_EQ(cases::hex(hash), "bee7e258038dd9f9");
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

Pose pose_of(std::initializer_list<std::pair<std::string_view, std::string_view>> values) {
    Pose pose;
    for (const auto& [name, word] : values) {
        for (size_t k = 0; k < features().size(); ++k) {
            const Feature& feature = features()[k];
            const auto value = std::ranges::find(feature.values, word);
            if (feature.name == name && value != feature.values.end()) {
                pose.set(k, static_cast<size_t>(value - feature.values.begin()));
            }
        }
        EXPECT_TRUE(pose.is(name, word)) << name << " = " << word;
    }
    return pose;
}

// What is counted of many cases of a pose: visit(case, see) sees things by name.
template <class Visit>
std::set<std::string> seen_in(const Pose& pose, Visit&& visit) {
    std::set<std::string> seen;
    for (uint64_t number = 0; number < 400; ++number) {
        // Each with a state of its own.
        const auto c = cases::load_text(case_text(9, pose, number, number), "fuzz", "fuzz");
        EXPECT_TRUE(c) << pose.text() << '\n' << cases::to_string(c.error().front());
        if (c) {
            visit(c->front(), [&](bool what, const char* words) {
                if (what) {
                    seen.insert(words);
                }
            });
        }
    }
    return seen;
}

using testing::IsSupersetOf;
using testing::UnorderedElementsAre;

// At a depth that is stored, and at its neighbour among binary32: there a test is right or wrong.
TEST(Generator, BoundsLieAtAndBesideStoredDepths) {
    EXPECT_THAT(
        seen_in(pose_of({{"depth-bounds", "ends"}, {"frag-depth", "value"}, {"draws", "2"}}),
                [](const cases::Case& c, const auto& see) {
                    const auto& bounds = c.draws[1].depth.bounds;
                    ASSERT_TRUE(bounds);
                    const auto& first = c.draws[0].frag_depth;
                    for (const float stored : {c.target.depth_clear, first ? first->value : 0.5F}) {
                        see(bounds->min >= stored && bounds->min <= stored, "begin");
                        see(bounds->max >= stored && bounds->max <= stored, "end");
                        const float less = std::nextafter(stored, -1.0F);
                        const float more = std::nextafter(stored, 2.0F);
                        see(bounds->min >= more && bounds->min <= more, "begin beside");
                        see(bounds->max >= less && bounds->max <= less, "end beside");
                    }
                    see(!first, "an own depth");
                    see(c.draws[0].depth.bounds.has_value(), "two tests");
                }),
        UnorderedElementsAre("begin", "end", "begin beside", "end beside", "an own depth",
                             "two tests"));
}

TEST(Generator, WrittenDepthsMeetStoredOnesAndKeepPromises) {
    const auto see_depths = [](const cases::Case& c, const auto& see) {
        const auto& written = c.draws.back().frag_depth;
        ASSERT_TRUE(written);
        const auto& first = c.draws[0].frag_depth;
        const float stored = first ? first->value : c.target.depth_clear;
        see(written->value >= stored && written->value <= stored, "equal");
        const float more = std::nextafter(stored, 2.0F);
        see(written->value >= more && written->value <= more, "just more");
        see(written->layout == cases::DepthLayout::greater, "greater");
        see(written->layout == cases::DepthLayout::less, "less");
        see(written->value > 1 || written->value < 0, "clamped");
        see(written->is_coord, "its own");
        see(written->where == cases::Discard::checker &&
                std::fabs(written->other - written->value) > 0,
            "two");
    };
    EXPECT_THAT(seen_in(pose_of({{"frag-depth", "checker"}, {"draws", "2"}, {"compare", "less"}}),
                        see_depths),
                UnorderedElementsAre("equal", "just more", "two"));
    for (const std::string_view z : {"half", "plane"}) {
        for (const std::string_view viewport : {"target", "depth"}) {
            EXPECT_THAT(seen_in(pose_of({{"frag-depth", "value"},
                                         {"depth-layout", "greater"},
                                         {"z", z},
                                         {"viewport", viewport}}),
                                see_depths),
                        testing::Contains("greater"));
            EXPECT_THAT(seen_in(pose_of({{"frag-depth", "value"},
                                         {"depth-layout", "less"},
                                         {"depth-volume", "negative-one-to-one"},
                                         {"z", z},
                                         {"viewport", viewport}}),
                                see_depths),
                        testing::Contains("less"));
        }
    }
    EXPECT_THAT(seen_in(pose_of({{"frag-depth", "value"},
                                 {"depth-layout", "greater"},
                                 {"depth-clamp", "true"},
                                 {"z", "beyond"}}),
                        see_depths),
                IsSupersetOf({"clamped", "greater"}));
    EXPECT_THAT(
        seen_in(pose_of({{"frag-depth", "frag-coord"}, {"depth-layout", "less"}}), see_depths),
        IsSupersetOf({"its own", "less"}));
}

// Operands are codes, of which no bit is open.
TEST(Generator, LogicalOperationsCombineCodes) {
    EXPECT_THAT(seen_in(pose_of({{"logic", "nor"},
                                 {"color", "rgb10a2-unorm"},
                                 {"attachments", "color"},
                                 {"draws", "3"}}),
                        [](const cases::Case& c, const auto& see) {
                            for (int k = 0; k < 4; ++k) {
                                const float code =
                                    c.draws[2].color.value[k] * (k < 3 ? 1023.0F : 3.0F);
                                EXPECT_NEAR(code, std::round(code), 1e-4F);
                            }
                            EXPECT_EQ(c.draws[2].color.logic, cases::LogicOp::nor);
                            const auto& early = c.draws[0].color.logic;
                            see(!early, "none before");
                            see(early && *early != cases::LogicOp::nor, "another before");
                        }),
                UnorderedElementsAre("none before", "another before"));
}

TEST(Generator, DrawsOfACaseHaveQueriesOfBothKinds) {
    EXPECT_THAT(seen_in(pose_of({{"query", "occlusion"}, {"draws", "2"}}),
                        [](const cases::Case& c, const auto& see) {
                            EXPECT_EQ(c.draws[1].query, cases::Query::occlusion);
                            see(c.draws[0].query == cases::Query::none, "none");
                            see(c.draws[0].query == cases::Query::occlusion, "any");
                            see(c.draws[0].query == cases::Query::occlusion_precise, "precise");
                        }),
                UnorderedElementsAre("none", "any", "precise"));
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
