// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/generator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "cases/base/checksum.hpp"
#include "cases/format/color_format.hpp"
#include "cases/load/loader.hpp"
#include "cases/model/sample.hpp"

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
        hash = cases::stable_hash(case_text(1, pose, k, k * kGeometries + 5), hash);
    }
    EXPECT_EQ(cases::hex(hash), "00e6fabf6716f0b9");
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
    constexpr uint64_t kPoses = 750;
    Poses poses(4);
    std::map<std::pair<size_t, size_t>, size_t> seen;
    size_t made = 0, loaded = 0;
    for (uint64_t k = 0; k < kPoses; ++k) {
        const Pose pose = next(poses, 4);
        for (const auto& value : pose.active()) {
            ++seen[value];
        }
        for (uint64_t number : {k * kGeometries + 1, k * kGeometries + 45}) {
            const auto c = cases::load_text(case_text(4, pose, k, number), "fuzz", "fuzz");
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
        seen_in(pose_of({{"depth-bounds", "ends"}, {"frag_depth", "value"}, {"draws", "2"}}),
                [](const cases::Case& c, const auto& see) {
                    const auto& bounds = c.draws[1].depth.bounds;
                    see(!bounds, "no test");  // some devices have none
                    if (!bounds) {
                        EXPECT_FALSE(c.draws[0].depth.bounds);
                        return;
                    }
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
                             "two tests", "no test"));
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
    EXPECT_THAT(seen_in(pose_of({{"frag_depth", "checker"}, {"draws", "2"}, {"compare", "less"}}),
                        see_depths),
                UnorderedElementsAre("equal", "just more", "two"));
    for (const std::string_view z : {"half", "plane"}) {
        for (const std::string_view viewport : {"target", "depth"}) {
            EXPECT_THAT(seen_in(pose_of({{"frag_depth", "value"},
                                         {"depth-layout", "greater"},
                                         {"z", z},
                                         {"viewport", viewport}}),
                                see_depths),
                        testing::Contains("greater"));
            EXPECT_THAT(seen_in(pose_of({{"frag_depth", "value"},
                                         {"depth-layout", "less"},
                                         {"depth_volume", "negative-one-to-one"},
                                         {"z", z},
                                         {"viewport", viewport}}),
                                see_depths),
                        testing::Contains("less"));
        }
    }
    EXPECT_THAT(seen_in(pose_of({{"frag_depth", "value"},
                                 {"depth-layout", "greater"},
                                 {"depth-clamp", "true"},
                                 {"z", "beyond"}}),
                        see_depths),
                IsSupersetOf({"clamped", "greater"}));
    EXPECT_THAT(
        seen_in(pose_of({{"frag_depth", "frag-coord"}, {"depth-layout", "less"}}), see_depths),
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
                            const auto& last = c.draws[2].color.logic;
                            const auto& early = c.draws[0].color.logic;
                            EXPECT_EQ(last.value_or(cases::LogicOp::nor), cases::LogicOp::nor);
                            see(!early, "none before");
                            see(early && *early != cases::LogicOp::nor, "another before");
                            see(early && !last, "none at last");
                        }),
                UnorderedElementsAre("none before", "another before", "none at last"));
}

// By values that are of either sign, of any of the attributes.
TEST(Generator, ShadersDiscardByAttributes) {
    EXPECT_THAT(
        seen_in(pose_of({{"discard", "checker"}, {"discard_by", "demote"}, {"attributes", "two"}}),
                [](const cases::Case& c, const auto& see) {
                    const cases::Draw& draw = c.draws[0];
                    EXPECT_EQ(draw.discard_by, cases::DiscardBy::demote);
                    if (!cases::discards_by_value(draw)) {
                        see(draw.discard == cases::Discard::checker, "checker");
                        return;
                    }
                    for (const glm::vec4& v : draw.attributes.at(draw.discard_attribute).values) {
                        see(v.x < 0, "negative");
                        see(v.x > 0, "positive");
                    }
                    see(std::ranges::all_of(draw.attributes.at(draw.discard_attribute).values,
                                            [](auto& v) { return !(v.x < 0) && !(v.x > 0); }),
                        "zero");
                    see(draw.discard_attribute == 0, "first");
                    see(draw.discard_attribute == 1, "second");
                }),
        UnorderedElementsAre("checker", "negative", "positive", "zero", "first", "second"));
}

TEST(Generator, DrawsOfACaseHaveQueriesOfAllKinds) {
    EXPECT_THAT(seen_in(pose_of({{"query", "occlusion"}, {"draws", "2"}}),
                        [](const cases::Case& c, const auto& see) {
                            EXPECT_NE(c.draws[1].query, cases::Query::none);
                            EXPECT_NE(c.draws[1].query, cases::Query::occlusion_precise);
                            see(cases::is_statistic(c.draws[1].query), "statistic");
                            see(c.draws[0].query == cases::Query::none, "none");
                            see(c.draws[0].query == cases::Query::occlusion, "any");
                            see(c.draws[0].query == cases::Query::occlusion_precise, "precise");
                        }),
                UnorderedElementsAre("none", "any", "precise", "statistic"));
    std::set<cases::Query> counters;
    seen_in(pose_of({{"query", "statistics"}}), [&](const cases::Case& c, const auto&) {
        EXPECT_TRUE(cases::is_statistic(c.draws[0].query));
        counters.insert(c.draws[0].query);
    });
    EXPECT_EQ(counters.size(), 6U);
}

// The last draw shows whether a state ends with the draw that has it.
TEST(Generator, BlendingMeetsAllOfItsOperands) {
    EXPECT_THAT(seen_in(pose_of({{"blend", "factors"}, {"color", "rgba16-float"}, {"draws", "2"}}),
                        [](const cases::Case& c, const auto& see) {
                            using F = cases::BlendFactor;
                            const auto& last = c.draws[1].color;
                            see(c.draws[0].color.blend && !last.blend, "none at last");
                            // Infinity would be stored, of which nothing is known once it is
                            // blended.
                            EXPECT_LE(std::fabs(last.value.r), 3);
                            see(last.value.r > 2, "above 1");
                            see(last.value.g < 0, "below 0");
                            if (!last.blend) {
                                return;
                            }
                            const cases::Blend& blend = *last.blend;
                            see(blend.color.source == F::src_alpha_saturate, "saturated");
                            see(blend.color.source == F::constant_color && blend.constants.r > 1,
                                "a large constant");
                            see(!(blend.alpha == blend.color), "another equation of alpha");
                        }),
                UnorderedElementsAre("none at last", "above 1", "below 0", "saturated",
                                     "a large constant", "another equation of alpha"));
}

// A second source comes with a factor that takes it, whatever the turn draws.
TEST(Generator, SecondSourcesAreBlended) {
    EXPECT_THAT(seen_in(pose_of({{"second", "true"},
                                 {"blend", "factors"},
                                 {"color", "rgba8-unorm"},
                                 {"attachments", "color"},
                                 {"draws", "2"}}),
                        [](const cases::Case& c, const auto& see) {
                            using F = cases::BlendFactor;
                            const auto& blend = c.draws[1].color.blend;
                            see(!blend, "none at last");
                            if (!blend) {
                                return;
                            }
                            EXPECT_TRUE(cases::takes_second(*blend));
                            see(blend->second.r > 0 && blend->second.a > 0, "a second source");
                            see(blend->color.source == F::src1_color, "its colour");
                            see(blend->color.destination == F::one_minus_src1_alpha, "its alpha");
                            see(!cases::is_second(blend->color.source) &&
                                    !cases::is_second(blend->color.destination),
                                "for alpha alone");
                        }),
                UnorderedElementsAre("none at last", "a second source", "its colour", "its alpha",
                                     "for alpha alone"));
}

// Of an alpha between 0 and 1 nothing is known once it takes samples away.
TEST(Generator, AlphaTakesSamplesAwayAndIsReplaced) {
    const auto see_alpha = [](const cases::Case& c, const auto& see) {
        EXPECT_TRUE(c.target.other_colors.empty());
        const cases::ColorOutput& color = c.draws[1].color;
        see(color.alpha_to_coverage && color.value.a <= 0, "none");
        see(color.alpha_to_coverage && color.value.a >= 1, "all");
        see(color.alpha_to_coverage && color.value.a > 0 && color.value.a < 1, "some");
        see(color.alpha_to_one, "to one");
        see(c.draws[0].color.alpha_to_one && !color.alpha_to_one, "to one before");
        see(c.draws[0].color.alpha_to_coverage && !color.alpha_to_coverage, "some before");
    };
    EXPECT_THAT(seen_in(pose_of({{"alpha_to_coverage", "true"},
                                 {"samples", "4"},
                                 {"color", "rgba8-unorm"},
                                 {"attachments", "color+depth"},
                                 {"draws", "2"}}),
                        see_alpha),
                UnorderedElementsAre("none", "all", "some", "some before"));
    EXPECT_THAT(seen_in(pose_of({{"alpha_to_one", "true"},
                                 {"color", "rgba8-unorm"},
                                 {"attachments", "color"},
                                 {"draws", "2"}}),
                        see_alpha),
                UnorderedElementsAre("to one", "to one before"));
}

TEST(Generator, FragmentsOfSeveralPixelsReadWhatIsTheirs) {
    for (const std::string_view input : {"sample-mask-in", "shading-rate"}) {
        EXPECT_THAT(seen_in(pose_of({{"fragment_size", "2x2"},
                                     {"fragment-input", input},
                                     {"attributes", "two"},
                                     {"draws", "2"}}),
                            [](const cases::Case& c, const auto& see) {
                                const auto& draw = c.draws[0];
                                EXPECT_EQ(draw.fragment_size, (std::array<uint32_t, 2>{2, 2}));
                                see(draw.attributes[0].source == cases::Source::sample_mask_in,
                                    "sample-mask-in");
                                see(draw.attributes[0].source == cases::Source::shading_rate,
                                    "shading-rate");
                                EXPECT_EQ(draw.attributes[1].source, cases::Source::vertex);
                            }),
                    UnorderedElementsAre(input));
    }
}

TEST(Generator, FloatsReachBeyondBinary16) {
    EXPECT_THAT(seen_in(pose_of({{"color", "rgba16-float"}}),
                        [](const cases::Case& c, const auto& see) {
                            for (int k = 0; k < 4; ++k) {
                                see(c.draws[0].color.value[k] > 65504, "beyond");
                                see(c.draws[0].color.value[k] < -65504, "far below");
                            }
                        }),
                UnorderedElementsAre("beyond", "far below"));
}

TEST(Generator, ComplementsAreTheLastDrawWithNegatedDistances) {
    EXPECT_THAT(seen_in(pose_of({{"complement", "true"}, {"clip-distances", "2"}, {"draws", "3"}}),
                        [](const cases::Case& c, const auto& see) {
                            ASSERT_EQ(c.draws.size(), 3U);
                            const auto& one = c.draws[1].distances.clip;
                            const auto& other = c.draws[2].distances.clip;
                            EXPECT_EQ(c.draws[1].positions, c.draws[2].positions);
                            ASSERT_EQ(one.size(), other.size());
                            for (size_t v = 0; v < one.size(); ++v) {
                                EXPECT_EQ(one[v], -other[v]);
                                see(one[v].x > 0 && one[v].y < 0, "both signs");
                            }
                        }),
                UnorderedElementsAre("both signs"));
}

TEST(Generator, FewCasesAreLargeAndBiasesReachFar) {
    EXPECT_THAT(seen_in(pose_of({{"size", "large"}, {"bias", "constant"}, {"z", "plane"}}),
                        [](const cases::Case& c, const auto& see) {
                            see(c.target.width * c.target.height > 65536, "more than 16 bits");
                            see(c.target.width == 16, "small");
                            const float steps = std::fabs(c.draws[0].depth.bias->constant);
                            see(steps > 4096, "many steps");
                            see(steps > 0 && steps < 10, "few steps");
                        }),
                UnorderedElementsAre("more than 16 bits", "small", "many steps", "few steps"));
}

TEST(Generator, CasesGoThroughDoors) {
    std::set<cases::Door> doors;
    size_t without = 0;
    for (uint64_t number = 0; number < 8000; number += 16) {
        const auto c = cases::load_text(case_text(9, Pose(), number / 64, number), "fuzz", "fuzz");
        ASSERT_TRUE(c) << cases::to_string(c.error().front());
        without += c->front().relations.empty() ? 1U : 0U;
        for (const cases::Relation& relation : c->front().relations) {
            EXPECT_EQ(relation.kind, cases::RelationKind::door);
            doors.insert(relation.door);
        }
    }
    EXPECT_GT(without, 300U);  // of 500: each costs pipelines
    EXPECT_GT(doors.size(), 25U);
}

// What is beside a target changes nothing of what is judged.
TEST(Generator, TargetsAreDrawnBesideOthers) {
    using ::testing::UnorderedElementsAre;
    std::set<size_t> counts;
    std::set<uint32_t> judged;
    std::set<std::string_view> states;
    for (const Pose& pose :
         {pose_of({{"color", "rgba8-unorm"}, {"draws", "2"}}),
          pose_of({{"color", "rgba16-float"}, {"blend", "factors"}}),
          pose_of({{"color", "r32-uint"},
                   {"attributes", "one"},
                   {"color-from", "attribute"},
                   {"interpolation", "flat"}}),
          pose_of({{"color", "rgba8-uint"}, {"attachments", "color"}, {"logic", "xor"}})}) {
        for (uint64_t number = 0; number < 4000; number += 16) {
            const auto loaded =
                cases::load_text(case_text(9, pose, number / 64, number), "fuzz", "fuzz");
            if (!loaded) {
                continue;  // as is_case() would leave it out
            }
            const cases::Case& c = loaded->front();
            EXPECT_EQ(cases::name_of(c.target.color->format), pose.value("color"));
            counts.insert(c.target.color_count());
            judged.insert(c.target.judged_color);
            for (const cases::ColorOutput& other : c.draws[0].other_colors) {
                states.insert(other.attribute >= 0 ? "attribute" : "value");
                states.insert(other.blend ? "blended" : "plain");
                states.insert(other.write_mask == 0xf ? "whole" : "masked");
            }
        }
    }
    EXPECT_THAT(counts, UnorderedElementsAre(1, 2, 3, 4));
    EXPECT_THAT(judged, UnorderedElementsAre(0, 1, 2, 3));
    EXPECT_THAT(states,
                UnorderedElementsAre("attribute", "value", "blended", "plain", "whole", "masked"));
}

TEST(Generator, BlitsHaveRegionsOfAllKinds) {
    const auto see_blit = [](const cases::Case& c, const auto& see) {
        ASSERT_TRUE(c.blit);
        const cases::Corners& from = c.blit->source;
        const cases::Corners& to = c.blit->destination;
        see((from.x1 < from.x0) != (to.x1 < to.x0), "mirrored");
        see(std::abs(from.x1 - from.x0) > std::abs(to.x1 - to.x0), "smaller");
        see(std::abs(from.x1 - from.x0) < std::abs(to.x1 - to.x0), "larger");
        see(from.x0 > 0 && from.x1 < static_cast<int32_t>(c.blit->source_width), "from inside");
        see(to.x0 > 0 && to.x1 < static_cast<int32_t>(c.target.width), "to inside");
        see(c.blit->source_format != c.target.color->format, "another format");
        see(cases::is_integer(c.blit->source_format), "integers");
        see(c.blit->filter == cases::BlitFilter::linear, "linear");
    };
    EXPECT_THAT(seen_in(pose_of({{"blit", "nearest"}}), see_blit),
                UnorderedElementsAre("mirrored", "smaller", "larger", "from inside", "to inside",
                                     "another format", "integers"));
    EXPECT_THAT(seen_in(pose_of({{"blit", "linear"}}), see_blit),
                UnorderedElementsAre("mirrored", "smaller", "larger", "from inside", "to inside",
                                     "another format", "linear"));
}

// They have nothing to do with the other features, so that nothing prefers them.
TEST(Poses, BlitsComeNowAndThen) {
    Poses poses(4);
    size_t blits = 0;
    for (uint64_t k = 0; k < 128; ++k) {
        const Pose pose = poses.next([](const Pose&) { return true; });
        if (!pose.is_default("blit")) {
            ++blits;
            EXPECT_LE(pose.active().size(), 2U) << pose.text();
        }
    }
    EXPECT_GE(blits, 2U);
    EXPECT_LE(blits, 8U);
}

// Of as many poses without that preference, each a candidate that was not compared with others, not
// half as many pairs are met.
TEST(Poses, UnseenPairsComeFirst) {
    Poses poses(5);
    std::set<std::pair<uint64_t, uint64_t>> pairs;
    for (uint64_t k = 0; k < 200; ++k) {
        poses.next([](const Pose&) { return true; });
        std::optional<Pose> first;
        Poses(1000 + k).next([&](const Pose& candidate) {
            first = first ? first : candidate;
            return true;
        });
        const auto active = first->active();
        for (const auto& a : active) {
            for (const auto& b : active) {
                if (!(b < a)) {
                    pairs.insert({a.first * 64 + a.second, b.first * 64 + b.second});
                }
            }
        }
    }
    EXPECT_GT(poses.pairs(), 2 * pairs.size());
}

}  // namespace
}  // namespace fuzz
