// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/bare.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "cases/format/color_format.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/triangle.hpp"
#include "cases/model/way.hpp"
#include "cases/wire/case_bytes.hpp"
#include "cases/write/to_toml.hpp"
#include "diff/resolve.hpp"
#include "fuzz/generate/generator.hpp"
#include "fuzz/generate/geometry.hpp"
#include "fuzz/generate/source.hpp"
#include "rasterizers/captures.hpp"
#include "rasterizers/strength/strength.hpp"
#include "ref/expectation/expectation.hpp"
#include "tests/share.hpp"

namespace fuzz {
namespace {

constexpr uint64_t kSeed = 3;

// visit(pose, its number) of the bare ones among the first poses of the seed.
template <class Visit>
void for_each_bare(uint64_t seed, uint64_t poses, Visit&& visit) {
    Poses all(seed);
    for (uint64_t k = 0; k < poses; ++k) {
        const Pose pose =
            all.next([&](const Pose& candidate) { return is_case(seed, candidate, k); });
        EXPECT_EQ(pose.is_default("way"), k % 3 != 2) << k << ": " << pose.text();
        if (k % 3 == 2) {
            visit(pose, k);
        }
    }
}

// What is drawn on, and where, is no feature beside the geometry.
size_t features_beside(const Pose& pose) {
    static const std::set<std::string_view> kNone = {"way",  "bare-format", "stencil", "draws",
                                                     "size", "z",           "w"};
    size_t count = 0;
    for (const auto& [feature, value] : pose.active()) {
        count += kNone.contains(features()[feature].name) ? 0U : 1U;
    }
    return count;
}

TEST(BarePoses, AThirdOfAllHasAWayAndAtMostTwoFeatures) {
    std::map<size_t, size_t> by_count;
    std::set<std::string_view> ways, formats;
    for_each_bare(kSeed, 600, [&](const Pose& pose, uint64_t) {
        EXPECT_LE(features_beside(pose), 2U) << pose.text();
        ++by_count[features_beside(pose)];
        ways.insert(pose.value("way"));
        formats.insert(pose.value("bare-format"));
    });
    for (const size_t count : {0U, 1U, 2U}) {
        EXPECT_GT(by_count[count], 40U) << count;
    }
    EXPECT_EQ(ways.size(), cases::all_ways().size());
    EXPECT_EQ(formats.size(), 12U);
}

// Each is a case file, and nothing of a case is lost in it.
TEST(BarePoses, TheirCasesLoadAndAreWrittenAndLoadAgain) {
    size_t made = 0;
    std::set<std::string> attached, sources;
    for_each_bare(kSeed, 300, [&](const Pose& pose, uint64_t k) {
        for (uint64_t number = k * kGeometries; number < (k + 1) * kGeometries; ++number) {
            const std::string text = case_text(kSeed, pose, k, number);
            const auto c = load_one(text, "case");
            ASSERT_TRUE(c) << pose.text() << ": case " << number << '\n' << text;
            const auto written = cases::to_toml(*c);
            ASSERT_TRUE(written) << text;
            const auto again = load_one(*written, "case");
            ASSERT_TRUE(again) << *written;
            EXPECT_EQ(cases::to_bytes(*c), cases::to_bytes(*again)) << *written;
            EXPECT_FALSE(c->target.has_instruments);
            EXPECT_TRUE(c->target.other_colors.empty() && c->relations.empty());
            attached.insert(fmt::format("{}{}{}", c->target.color ? "color " : "",
                                        c->target.has_depth ? "depth " : "",
                                        c->target.has_stencil ? "stencil " : ""));
            if (c->target.color) {
                EXPECT_FALSE(cases::is_integer(c->target.color->format));
                EXPECT_LE(cases::bytes_of(c->target.color->format), 8U);
                const cases::ColorOutput& color = c->draws.back().color;
                sources.insert(color.attribute >= 0 ? "input"
                                                    : std::to_string(static_cast<int>(color.from)));
            }
            ++made;
        }
    });
    EXPECT_GT(made, 6000U);
    EXPECT_EQ(attached, (std::set<std::string>{"color ", "color depth ", "color stencil ",
                                               "color depth stencil ", "depth ", "stencil "}));
    EXPECT_EQ(sources.size(), 9U) << "eight places that a constant comes from, and inputs";
}

TEST(BarePoses, AFaultlessDevicePassesAtEveryProfile) {
    const test_support::Share share =
        test_support::share_of(12, features().size(), "EDGECASE_FUZZ_SHARE");
    constexpr uint64_t kPoses = 180;
    size_t judged = 0;
    for_each_bare(kSeed, kPoses, [&](const Pose& pose, uint64_t k) {
        for (uint64_t number = k * kGeometries; number < (k + 1) * kGeometries; ++number) {
            if ((number + k) % share.shares != share.share) {
                continue;
            }
            const auto c = load_one(case_text(kSeed, pose, k, number), "case");
            ASSERT_TRUE(c);
            const capture::Capture device = software::captured(*c, {});
            capture::Capture reference = rasterizers::draw_by_reference(*c);
            diff::add_dependent_planes(reference);
            for (const cases::Profile profile : cases::kProfiles) {
                const ref::Expectation expected = ref::expect(*c, {}, profile);
                if (expected.must_samples == 0) {
                    continue;  // nothing to judge
                }
                const diff::Verdict by_device = software::compare(*c, expected, device);
                EXPECT_TRUE(by_device.ok()) << "device, case " << number << " at "
                                            << cases::to_string(profile) << ", " << pose.text();
                EXPECT_TRUE(diff::compare(*c, expected, reference).ok())
                    << "reference, case " << number << " at " << cases::to_string(profile) << ", "
                    << pose.text();
                ++judged;
            }
        }
    });
    EXPECT_GE(judged * share.shares, 3 * kPoses / 3 * kGeometries / 2);
}

Pose pose_with(std::string_view feature, std::string_view word) {
    Pose pose;
    pose.set("way", 1);
    for (const Feature& row : features()) {
        const auto value = std::ranges::find(row.values, word);
        if (row.name == feature && value != row.values.end()) {
            pose.set(feature, static_cast<size_t>(value - row.values.begin()));
        }
    }
    EXPECT_TRUE(pose.is(feature, word));
    return pose;
}

// How many of 256 cases of a pose are so: visit(case, see) sees things by name, once a case.
template <class Visit>
std::map<std::string, size_t> counted(const Pose& pose, Visit&& visit) {
    std::map<std::string, size_t> counts;
    for (uint64_t number = 0; number < 256; ++number) {
        const auto c = load_one(case_text(kSeed, pose, 2, number), "case");
        EXPECT_TRUE(c);
        std::set<std::string> seen;
        if (c) {
            visit(*c, [&](bool what, const char* words) {
                if (what) {
                    seen.insert(words);
                }
            });
        }
        for (const std::string& words : seen) {
            ++counts[words];
        }
    }
    return counts;
}

// Between two ends along a side of the target: beside it, over its border, or all around.
void see_place(double begin, double end, double side, const auto& see) {
    see(end <= 0 || begin >= side, "beside");
    see(std::abs(end) < 1e-9 || std::abs(begin - side) < 1e-9, "at the border");
    see((begin < 0 && end > 0 && end < side) || (begin > 0 && begin < side), "over the border");
    see(begin < 0 && end > side, "around");
    see(end - begin >= 8192, "far");
}

TEST(BarePoses, ViewportsLieBesideAndFarAroundTheTarget) {
    const auto places = [&](std::string_view word) {
        return counted(
            pose_with("viewport-place", word), [](const cases::Case& c, const auto& see) {
                const cases::Viewport& v = c.draws.back().viewport;
                const auto x = static_cast<double>(v.x), width = static_cast<double>(v.width);
                const double y = static_cast<double>(std::min(v.y, v.y + v.height));
                see_place(x, x + width, 16, see);
                see_place(y, y + std::abs(static_cast<double>(v.height)), 16, see);
                see(v.height < 0, "flipped");
            });
    };
    std::map<std::string, size_t> beside = places("beside"), far = places("far");
    EXPECT_GT(beside["beside"], 150U);
    EXPECT_GT(beside["at the border"], 100U);
    EXPECT_GT(beside["over the border"], 10U);
    EXPECT_GT(beside["flipped"], 30U);
    EXPECT_GT(far["far"], 50U);
    EXPECT_GT(far["beside"], 50U);
    EXPECT_GT(far["around"], 20U);
    EXPECT_EQ(places("around")["beside"], 0U);
    EXPECT_GT(places("around")["around"], 100U);
}

// A case without anything that has to be seen would not be judged.
TEST(BarePoses, WhatLiesBesideTheTargetHasACompanion) {
    for (const char* feature : {"viewport-place", "scissor-place"}) {
        for (uint64_t number = 0; number < 64; ++number) {
            const auto c =
                load_one(case_text(kSeed, pose_with(feature, "beside"), 2, number), "case");
            ASSERT_TRUE(c);
            EXPECT_EQ(c->draws.size(), 2U);
            EXPECT_GT(ref::expect(*c, {}, cases::Profile::vulkan).must_samples, 0U) << number;
        }
    }
}

// Twice its area, as (y down) corners of a list have it.
double area(const std::array<std::array<double, 2>, 3>& p) {
    return (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]);
}

TEST(BarePoses, TrianglesAreFewRectanglesFullScreensAndNearlyDegenerate) {
    Dice dice(kSeed, 99, 0);
    size_t rectangles = 0, screens = 0, thin = 0, none = 0, triangles = 0;
    constexpr size_t kShapes = 1000;
    for (size_t k = 0; k < kShapes; ++k) {
        const Shape shape = make_bare_shape(dice, Connection::list, false, 16, 16, {0, 0, 16, 16});
        ASSERT_EQ(shape.vertices.size() % 3, 0U);
        triangles += shape.vertices.size() / 3;
        for (size_t t = 0; t < shape.vertices.size(); t += 3) {
            std::array<std::array<double, 2>, 3> p{};
            std::set<double> xs, ys;
            for (size_t v = 0; v < 3; ++v) {
                const Position& at = shape.vertices[t + v];
                p.at(v) = {at.x, at.y};
                xs.insert(at.x);
                ys.insert(at.y);
            }
            const double twice = std::abs(area(p));
            none += twice <= 0 ? 1U : 0U;
            thin += twice > 0 && twice < 0.25 ? 1U : 0U;
            rectangles += twice > 0 && xs.size() == 2 && ys.size() == 2 ? 1U : 0U;
            screens += xs.contains(32) && ys.contains(32) && xs.contains(0) ? 1U : 0U;
        }
    }
    EXPECT_LT(triangles, 3 * kShapes);
    EXPECT_GT(rectangles, triangles / 4);
    EXPECT_GT(screens, triangles / 40);
    EXPECT_GT(thin, triangles / 40);
    EXPECT_GT(none, triangles / 40);
}

}  // namespace
}  // namespace fuzz
