// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How findings add up in a verdict.
#include "diff/verdict.hpp"

#include <gtest/gtest.h>

#include <array>

namespace {

using cases::Profile;
using diff::FindingKind;

// The first finding at a sample gives its mark; the box and the level are those of all.
TEST(Verdict, FindingsAreCountedWhereTheyAre) {
    cases::Target target;
    target.width = 4;
    target.height = 4;
    target.layers = 2;
    diff::Verdict v;
    v.level = Profile::direct3d;
    v.marks.assign(32, diff::SampleMark::ok);
    v.marks[5] = diff::SampleMark::either;
    const auto add = [&](FindingKind kind, cases::SampleId id, Profile level) {
        diff::Finding finding = diff::finding_at(kind, target, id);
        finding.level = level;
        v.add(std::move(finding), target);
    };
    add(FindingKind::order, {1, 1, 0}, Profile::direct3d);
    EXPECT_EQ(v.level, Profile::direct3d);
    add(FindingKind::value, {1, 1, 0}, Profile::vulkan);
    add(FindingKind::extra, {3, 2, 0, 1}, Profile::practice);
    EXPECT_EQ(v.marks[5], diff::SampleMark::order);
    EXPECT_EQ(v.marks[16 + 8 + 3], diff::SampleMark::extra);
    EXPECT_EQ(v.level, Profile::vulkan);
    EXPECT_EQ((std::array{v.min_x, v.min_y, v.max_x, v.max_y}), (std::array{1U, 1U, 3U, 6U}));
    EXPECT_EQ(v.counts, (std::array<uint64_t, diff::kFindingKinds>{0, 1, 0, 1, 1}));
    EXPECT_EQ(v.findings.size(), 3U);
    EXPECT_FALSE(v.ok());
}

}  // namespace
