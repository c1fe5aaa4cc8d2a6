// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A device whose samples are not at the standard locations, and says so, is held to its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>

#include "cases/load/loader.hpp"
#include "cases/write/to_toml.hpp"
#include "folders.hpp"
#include "rasterizers/strength/strength.hpp"
#include "run/judge.hpp"

namespace run {
namespace {

const cases::SampleLocations kOwn{{1, 5}, {9, 2}, {13, 11}, {4, 14}};

std::vector<cases::Case> cases_of(const std::string& file) {
    const std::string root = test_support::source_dir() + "/cases/suite";
    return cases::load_file(root + "/" + file + ".toml", root).value();
}

// The verdict on what a device with its samples at kOwn draws, and says of them what the limits
// say.
report::CaseRecord judged(const cases::Case& c, const ref::Limits& limits) {
    cases::Case placed = c;
    placed.target.sample_locations = kOwn;
    capture::Capture drawn = software::captured(placed, {});
    drawn.target = c.target;
    report::CaseRecord record = planned_case(c);
    judge(record, c, drawn, {}, limits, cases::Profile::direct3d, KeepPictures::failed);
    return record;
}

TEST(OwnSamples, AreWhereTheDeviceSays) {
    ref::Limits limits;
    size_t seen = 0, wrong_without = 0, wrong_elsewhere = 0;
    for (const char* file :
         {"multisample/large-triangle", "multisample/mesh", "multisample/clipped",
          "multisample/places", "multisample/interior-square-4x"}) {
        for (const cases::Case& c : cases_of(file)) {
            if (c.target.samples != kOwn.size() || !c.target.sample_locations.empty() ||
                !c.relations.empty()) {
                continue;
            }
            ++seen;
            limits.sample_locations = {{{4, 4}, {12, 12}}, kOwn};
            const report::CaseRecord right = judged(c, limits);
            EXPECT_EQ(right.status, report::Status::pass)
                << c.id << ": " << right.reason
                << (right.outcome.findings.empty() ? "" : right.outcome.findings.front().why);
            wrong_without += judged(c, {}).status == report::Status::fail;
            limits.sample_locations = {{{1, 5}, {9, 2}, {13, 11}, {8, 8}}};
            wrong_elsewhere += judged(c, limits).status == report::Status::fail;
        }
    }
    EXPECT_GE(seen, 4);
    EXPECT_GE(wrong_without, seen / 2);
    EXPECT_GE(wrong_elsewhere, seen / 2);
}

// What `edgecase diff --sample-locations` judges: coverage that another program delivers.
TEST(OwnSamples, OfAnotherRenderer) {
    const std::vector<cases::Case> leaves = cases_of("multisample/large-triangle");
    const auto found = std::ranges::find_if(
        leaves, [](const cases::Case& leaf) { return leaf.target.samples == kOwn.size(); });
    ASSERT_NE(found, leaves.end());
    const cases::Case& c = *found;
    cases::Case placed = c;
    placed.target.sample_locations = kOwn;
    capture::Delivered planes;
    planes.detail = capture::HitDetail::coverage;
    for (const glm::vec4& hits : software::captured(placed, {}).hits) {
        planes.front.push_back(hits.x + hits.y > 0 ? 1 : 0);
    }
    const auto status_at = [&](const cases::SampleLocations& locations) {
        ref::Limits limits;
        limits.sample_locations = {locations};
        report::CaseRecord record = planned_case(c);
        judge_delivered(record, c, planes, limits, cases::Profile::direct3d, KeepPictures::failed);
        return record.status;
    };
    EXPECT_EQ(status_at(kOwn), report::Status::pass);
    EXPECT_EQ(status_at({{6, 2}, {14, 6}, {2, 10}, {10, 14}}), report::Status::fail);
}

TEST(OwnSamples, ThoseOfACaseAreItsOwn) {
    cases::Case c;
    c.target.samples = 4;
    ref::Limits limits;
    EXPECT_FALSE(ref::as_drawn(c, limits).has_value());
    limits.sample_locations = {{{4, 4}, {12, 12}}};
    EXPECT_FALSE(ref::as_drawn(c, limits).has_value());
    limits.sample_locations.push_back(kOwn);
    EXPECT_EQ(ref::as_drawn(c, limits)->target.sample_locations, kOwn);
    c.target.sample_locations = {{0, 0}, {1, 1}, {2, 2}, {3, 3}};
    EXPECT_FALSE(ref::as_drawn(c, limits).has_value());
    c.target = {};
    EXPECT_FALSE(ref::as_drawn(c, limits).has_value());
}

// D24S8 stands for D32S8 where a case has a stencil and names no format.
TEST(OwnDepth, StandsBesideAStencilAlone) {
    ref::Limits limits;
    limits.beside_stencil = ref::depth_beside_stencil("d24-unorm");
    cases::Case c;
    EXPECT_FALSE(ref::as_drawn(c, limits).has_value());
    c.target.has_stencil = true;
    EXPECT_EQ(ref::as_drawn(c, limits)->target.depth_format, cases::DepthFormat::d24_unorm);
    EXPECT_FALSE(ref::as_drawn(c, {}).has_value());
    c.target.names_depth = true;
    EXPECT_FALSE(ref::as_drawn(c, limits).has_value());
    c.target.names_depth = false;
    c.target.depth_format = cases::DepthFormat::d16_unorm;
    EXPECT_FALSE(ref::as_drawn(c, limits).has_value());
    c.target.depth_format = cases::DepthFormat::d32_float;
    c.target.has_depth = false;
    EXPECT_FALSE(ref::as_drawn(c, limits).has_value());
}

// A picture in D24S8 is right for a device that says so, and wrong for one that does not.
TEST(OwnDepth, IsJudgedAsItIsDrawn) {
    ref::Limits limits;
    limits.beside_stencil = cases::DepthFormat::d24_unorm;
    size_t seen = 0, wrong_without = 0;
    for (const char* file : {"stencil/depth-fail", "stencil/faces", "discard/stencil"}) {
        for (const cases::Case& c : cases_of(file)) {
            const std::optional<cases::Case> own = ref::as_drawn(c, limits);
            if (!own || c.target.samples > 1 || !c.relations.empty()) {
                continue;
            }
            ++seen;
            capture::Capture drawn = software::captured(*own, {});
            drawn.target = c.target;
            const auto status = [&](const ref::Limits& of) {
                report::CaseRecord record = planned_case(c);
                judge(record, c, drawn, {}, of, cases::Profile::direct3d, KeepPictures::failed);
                return record.status;
            };
            EXPECT_EQ(status(limits), report::Status::pass) << c.id;
            wrong_without += status({}) == report::Status::fail ? 1U : 0U;
        }
    }
    EXPECT_GE(seen, 4U);
    EXPECT_GE(wrong_without, 1U);
}

// The flag goes through a case file and back.
TEST(OwnDepth, ANamedFormatStaysNamed) {
    for (const char* key : {"", "depth = \"d32-float\"\n"}) {
        const std::string text =
            "format = 1\ndescription = \"d\"\nrules = [\"cover.inside\"]\n[target]\nsize = [4, "
            "4]\n" +
            std::string(key) + "stencil = true\n[[draw]]\nvertices = [[0, 0], [4, 0], [0, 4]]\n";
        const auto c = cases::load_text(text, "a.toml", "a");
        ASSERT_TRUE(c.has_value());
        EXPECT_EQ(c->front().target.names_depth, *key != 0);
        const auto again = cases::load_text(cases::to_toml(c->front()).value(), "a.toml", "a");
        ASSERT_TRUE(again.has_value());
        EXPECT_EQ(again->front().target, c->front().target);
    }
}

}  // namespace
}  // namespace run
