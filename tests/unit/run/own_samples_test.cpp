// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A device whose samples are not at the standard locations, and says so, is held to its own.
#include <gtest/gtest.h>

#include <algorithm>

#include "cases/load/loader.hpp"
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
    report::CaseRecord record = make_record(c);
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
                << (right.findings.empty() ? "" : right.findings.front().why);
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
        report::CaseRecord record = make_record(c);
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

}  // namespace
}  // namespace run
