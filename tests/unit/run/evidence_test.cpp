// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is kept of wrong samples beside their values: what becomes of each triangle there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/load/loader.hpp"
#include "folders.hpp"
#include "rasterizers/strength/strength.hpp"
#include "run/judge.hpp"

namespace run {
namespace {

using cases::operator""_fault;

using testing::Contains;
using testing::HasSubstr;
using testing::Pair;

// The record of a case of the suite that a device with a fault drew.
report::CaseRecord drawn_with(const std::string& file, const std::string& leaf,
                              cases::Fault fault) {
    const std::string root = test_support::source_dir() + "/cases/suite";
    const auto loaded = cases::load_file(root + "/" + file + ".toml", root);
    for (const cases::Case& c : loaded.value()) {
        if (c.id.ends_with(leaf)) {
            software::Device device;
            device.fault = fault;
            report::CaseRecord record = planned_case(c);
            judge(record, c, software::captured(c, device), {}, {8}, cases::Profile::direct3d,
                  KeepPictures::failed);
            return record;
        }
    }
    return {};
}

TEST(Evidence, TellsDiscardsTestsAndStencils) {
    const report::CaseRecord discard =
        drawn_with("discard/fragments", "samples=1", "discard-fragment-ignored"_fault);
    ASSERT_FALSE(discard.evidence.samples.empty());
    EXPECT_THAT(discard.evidence.samples[0].courses,
                Contains(Pair(testing::EndsWith("of draw 1"), HasSubstr("discards"))));

    const report::CaseRecord stencil =
        drawn_with("stencil/draws", "samples=1", "stencil-fail-lost"_fault);
    ASSERT_FALSE(stencil.evidence.samples.empty());
    EXPECT_THAT(stencil.evidence.samples[0].courses,
                Contains(Pair(testing::StartsWith("triangle "), HasSubstr("the stencil test"))));
    EXPECT_FALSE(stencil.evidence.samples[0].stencil.empty());
    EXPECT_FALSE(stencil.evidence.samples[0].device_stencil.empty());

    // The picture of the stencil, from the least to the greatest number.
    const report::Pictures& p = stencil.evidence.pictures;
    EXPECT_EQ(p.device_stencils.size(), p.marks.size());
    EXPECT_EQ(p.expected_stencils.size(), p.marks.size());
    EXPECT_LT(p.stencil_low, p.stencil_high);
    EXPECT_THAT(p.device_stencils, testing::Each(testing::Ge(1)));

    // Nothing of it where nothing is tested or discarded.
    const report::CaseRecord plain =
        drawn_with("ties/diagonal-edge", "rotation=0", "ties-top-right"_fault);
    ASSERT_FALSE(plain.evidence.samples.empty());
    for (const report::SampleEvidence& e : plain.evidence.samples) {
        EXPECT_TRUE(e.courses.empty() && e.stencil.empty());
    }
}

TEST(Evidence, TellsHowAColorComesAbout) {
    const report::CaseRecord record = drawn_with(
        "logic/operations", "op=and-reverse,format=rgba8-uint", "logic-operands-exchanged"_fault);
    ASSERT_FALSE(record.evidence.samples.empty());
    EXPECT_TRUE(record.evidence.pictures.is_uncounted);
    bool is_told = false;
    for (const report::SampleEvidence& e : record.evidence.samples) {
        EXPECT_TRUE(e.colors.at(0).first.empty());
        for (const auto& [name, sentence] : e.colors) {
            is_told = is_told || (name == "triangle 0 of draw 1" &&
                                  sentence.find("r 204 & ~51 = 204") != std::string::npos);
        }
    }
    EXPECT_TRUE(is_told);
}

// A row of values is of what the draw writes.
TEST(Evidence, HasNoDepthThatTheDrawDoesNotWrite) {
    const std::string root = test_support::source_dir() + "/cases/suite";
    const auto loaded = cases::load_file(root + "/attributes/depth.toml", root);
    for (const bool writes : {true, false}) {
        cases::Case c = loaded.value().front();
        for (cases::Draw& draw : c.draws) {
            draw.depth.write = writes;
        }
        capture::Capture wrong = software::captured(c, {});
        for (size_t k = 0; k < wrong.hits.size(); ++k) {
            wrong.frag_coord[k].z += wrong.hits[k].x + wrong.hits[k].y > 0 ? 0.125F : 0.0F;
        }
        report::CaseRecord record = planned_case(c);
        judge(record, c, wrong, {}, {8}, cases::Profile::direct3d, KeepPictures::failed);
        ASSERT_FALSE(record.evidence.samples.empty());
        bool has_depth = false;
        for (const report::SampleEvidence& e : record.evidence.samples) {
            for (const report::SampleValue& value : e.values) {
                has_depth = has_depth || value.quantity == "depth";
            }
        }
        EXPECT_EQ(has_depth, writes);
    }
}

}  // namespace
}  // namespace run
