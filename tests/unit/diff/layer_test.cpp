// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Captures of several layers: wrong samples are found in their layer, and named with it.
#include <gtest/gtest.h>

#include "diff/consistency.hpp"
#include "diff/verdict.hpp"
#include "perfect_capture.hpp"

namespace {

using cases::Profile;
using diff::FindingKind;

// The same triangle in layer 1 and, smaller, in layer 2 of three.
cases::Case two_of_three() {
    cases::Case c = pixel_case(8, 4, {{0, 0}, {8, 0}, {0, 4}});
    c.target.layers = 3;
    c.draws[0].layer = 1;
    c.draws.push_back(pixel_case(8, 4, {{0, 0}, {4, 0}, {0, 2}}).draws[0]);
    c.draws[1].layer = 2;
    return c;
}

struct Checked {
    cases::Case c = two_of_three();
    ref::Expectation e = ref::expect(c, ref::Limits{8}, Profile::direct3d);
    capture::Capture capture = perfect_capture(c, e);
    size_t at(uint32_t x, uint32_t y, uint32_t layer) const {
        return cases::index_of(c.target, {x, y, 0, layer});
    }
    // Moves what is drawn in a layer to another one, as a device does that errs about the layer.
    void move(uint32_t from, uint32_t to) {
        for (uint32_t y = 0; y < 4; ++y) {
            for (uint32_t x = 0; x < 8; ++x) {
                capture.hits[at(x, y, to)] = capture.hits[at(x, y, from)];
                capture.writers[at(x, y, to)] = capture.writers[at(x, y, from)];
                capture.frag_coord[at(x, y, to)] = capture.frag_coord[at(x, y, from)];
                capture.depth[at(x, y, to)] = capture.depth[at(x, y, from)];
                clear_sample(capture, at(x, y, from));
            }
        }
    }
};

TEST(LayeredCompare, ARightPicturePasses) {
    const Checked k;
    const diff::Verdict v = diff::compare(k.c, k.e, k.capture);
    EXPECT_TRUE(v.ok()) << v.error;
    EXPECT_EQ(v.compared_samples, 3U * 32U);
    EXPECT_EQ(v.marks.size(), 3U * 32U);
}

TEST(LayeredCompare, AMissingSampleIsNamedWithItsLayer) {
    Checked k;
    clear_sample(k.capture, k.at(2, 1, 1));
    const diff::Verdict v = diff::compare(k.c, k.e, k.capture);
    ASSERT_EQ(v.findings.size(), 1U);
    EXPECT_EQ(v.findings[0].kind, FindingKind::missing);
    EXPECT_EQ(v.findings[0].rule, "cover.inside");
    EXPECT_EQ(v.findings[0].x, 2U);
    EXPECT_EQ(v.findings[0].y, 1U);
    EXPECT_EQ(v.findings[0].layer, 1U);
    EXPECT_EQ(v.min_y, 5U);  // rows of the stacked layers
    EXPECT_EQ(v.max_y, 5U);
    EXPECT_EQ(v.marks[k.at(2, 1, 1)], diff::SampleMark::missing);
    EXPECT_EQ(cases::pixel_text(k.c.target, diff::sample_of(v.findings[0])),
              "layer 1, pixel (2, 1)");
}

TEST(LayeredCompare, ATriangleInAnotherLayerBreaksTheLayerRule) {
    Checked k;
    k.move(1, 0);
    const diff::Verdict v = diff::compare(k.c, k.e, k.capture);
    EXPECT_EQ(v.counts[static_cast<size_t>(FindingKind::extra)], 16U);
    EXPECT_EQ(v.counts[static_cast<size_t>(FindingKind::missing)], 16U);
    ASSERT_FALSE(v.findings.empty());
    EXPECT_EQ(v.level, Profile::vulkan);
    EXPECT_EQ(v.findings[0].layer, 0U);
    EXPECT_EQ(v.findings[0].rule, "layer.select");
    EXPECT_EQ(v.findings[0].why, "no draw goes to this layer");
}

TEST(LayeredCompare, AnExtraHitFromAnotherLayersDrawNamesIt) {
    Checked k;
    // Layer 2 shows a pixel of the larger triangle of layer 1.
    ref::ValueReference values(k.c, ref::Limits{8}, Profile::direct3d);
    set_hits(k.capture, k.at(5, 0, 2), 0, 1);
    write_fragment(k.capture, k.c, k.e, values, 0, {5, 0, 0, 2});
    const diff::Verdict v = diff::compare(k.c, k.e, k.capture);
    ASSERT_EQ(v.findings.size(), 1U);
    EXPECT_EQ(v.findings[0].rule, "layer.select");
    EXPECT_EQ(v.findings[0].why, "triangle 0 of draw 0: the draw goes to layer 1");
    EXPECT_EQ(v.findings[0].level, Profile::vulkan);
}

TEST(LayeredCompare, OneLayerNamesNone) {
    const cases::Case c = pixel_case(8, 8, {{0, 0}, {8, 0}, {0, 8}});
    const ref::Expectation e = ref::expect(c, ref::Limits{8}, Profile::direct3d);
    capture::Capture capture = perfect_capture(c, e);
    clear_sample(capture, 0);
    const diff::Verdict v = diff::compare(c, e, capture);
    ASSERT_EQ(v.findings.size(), 1U);
    EXPECT_FALSE(v.findings[0].layer.has_value());
    EXPECT_EQ(cases::pixel_text(c.target, {3, 4, 0}), "pixel (3, 4)");
}

TEST(LayeredCompare, ACaptureOfOneLayerIsRefused) {
    Checked k;
    k.capture.target.layers = 1;
    const diff::Verdict v = diff::compare(k.c, k.e, k.capture);
    EXPECT_EQ(v.error,
              "the capture has another size than the case's 8x4 target with 1 sample and 3 "
              "layers");
}

TEST(LayeredCompare, WhatWasNotCopiedIsNamedWithItsLayer) {
    Checked k;
    k.capture.hits[k.at(7, 3, 2)] = glm::vec4(std::bit_cast<float>(capture::kPoison));
    const diff::Verdict v = diff::compare(k.c, k.e, k.capture);
    EXPECT_EQ(v.error,
              "sample 0 of layer 2, pixel (7, 3) was not copied from the device: it still holds "
              "the read-back memory's fill pattern");
}

TEST(LayeredCompare, ADifferenceOfARelationIsInItsLayer) {
    Checked k;
    k.c.relations = {{cases::RelationKind::same_twice, {}}};
    const auto derivations = cases::derivations(k.c);
    ASSERT_FALSE(derivations.empty());
    capture::Capture again = k.capture;
    again.depth[k.at(1, 0, 2)] = 0.25F;
    std::vector<diff::Consistency> found(derivations.size());
    found[0] = diff::compare_bits(k.c, k.capture, again, derivations[0]);
    diff::Verdict v = diff::compare(k.c, k.e, k.capture);
    diff::add_differences(k.c, derivations, found, v);
    ASSERT_EQ(v.findings.size(), 1U);
    EXPECT_EQ(v.findings[0].x, 1U);
    EXPECT_EQ(v.findings[0].y, 0U);
    EXPECT_EQ(v.findings[0].layer, 2U);
    EXPECT_EQ(v.min_y, 8U);
}

// The picture drawn by hand has all samples of layer 0 first.
TEST(LayeredPicture, TheReferenceIsCheckedLayerByLayer) {
    cases::Case c = two_of_three();
    c.claim.expected_hits = cases::ExpectedHits{{"........", "........", "........", "........",  //
                                                 "1111111.", "11111...", "111.....", "1.......",  //
                                                 "111.....", "1.......", "........", "........"},
                                                {}};
    EXPECT_FALSE(diff::check_expected_hits(c));
    std::swap(c.claim.expected_hits->rows[4], c.claim.expected_hits->rows[8]);
    EXPECT_EQ(diff::check_expected_hits(c)->message,
              "the picture has '.' at layer 1, pixel (3, 0), the reference says 1 hit");
}

}  // namespace
