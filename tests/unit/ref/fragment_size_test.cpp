// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Fragments of several pixels: where their inputs are, which samples they have, by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "cases/model/sample.hpp"
#include "ref/value/fragment/fragment_coverage.hpp"
#include "ref/value/reference.hpp"
#include "tests/unit/ref/multisample_fixture.hpp"

namespace ref::test {
namespace {

using cases::PixelBlock;
using cases::Source;

// Pixel (4,3) is one of the block (4,2) to (6,4), whose centre is (5,3), on x + y = 8.
cases::Case in_blocks(Auxiliary auxiliary, uint32_t width = 2, uint32_t height = 2) {
    cases::Case c = triangle(auxiliary);
    c.draws[0].fragment_size = {width, height};
    return c;
}

FragmentValues at_block(Point coord, Point inputs) {
    FragmentValues v = fragment(kPart, inputs, inputs);
    v.frag_coord.x = static_cast<float>(coord[0]);
    v.frag_coord.y = static_cast<float>(coord[1]);
    return v;
}

TEST(FragmentSize, BlocksAreMultiplesOfTheirSize) {
    cases::Draw draw;
    EXPECT_FALSE(cases::has_large_fragments(draw));
    EXPECT_EQ(cases::fragment_block(draw, 5, 7), (PixelBlock{5, 7, 1, 1}));
    draw.fragment_size = {4, 2};
    EXPECT_TRUE(cases::has_large_fragments(draw));
    EXPECT_EQ(cases::fragment_block(draw, 5, 7), (PixelBlock{4, 6, 4, 2}));
    EXPECT_EQ(cases::fragment_block(draw, 4, 6), (PixelBlock{4, 6, 4, 2}));
    EXPECT_EQ(cases::fragment_block(draw, 3, 5), (PixelBlock{0, 4, 4, 2}));
}

// The tables of "Multisampling": of 2x2 pixels with four samples pixel 0 has 12 to 15, pixel 3 has
// 0 to 3.
TEST(FragmentSize, CoverageIndicesBeginWithTheLastPixel) {
    const cases::Target target{8, 8, 4};
    const PixelBlock block{4, 2, 2, 2};
    EXPECT_EQ(cases::coverage_index(block, target, {4, 2, 0}), 12U);
    EXPECT_EQ(cases::coverage_index(block, target, {5, 2, 1}), 9U);
    EXPECT_EQ(cases::coverage_index(block, target, {4, 3, 2}), 6U);
    EXPECT_EQ(cases::coverage_index(block, target, {5, 3, 3}), 3U);
    EXPECT_EQ(cases::coverage_index({0, 0, 4, 1}, {8, 8, 1}, {1, 0, 0}), 2U);
}

TEST(FragmentSize, RatesAreTwoLogarithms) {
    cases::Draw draw;
    EXPECT_EQ(cases::shading_rate_bits(draw), 0U);
    for (const auto& [width, height, bits] : {std::array{1U, 2U, 1U},
                                              {1U, 4U, 2U},
                                              {2U, 1U, 4U},
                                              {4U, 1U, 8U},
                                              {4U, 2U, 9U},
                                              {2U, 4U, 6U},
                                              {4U, 4U, 10U}}) {
        draw.fragment_size = {width, height};
        EXPECT_EQ(cases::shading_rate_bits(draw), bits);
    }
}

TEST(FragmentSize, FragCoordIsTheCentreOfTheBlock) {
    const cases::Case c = in_blocks(Auxiliary::none);
    EXPECT_EQ(accepted(c, kPart, at_block({5, 3}, {5, 3})), "vpd");
    EXPECT_EQ(accepted(c, kPart, at_block({4.5, 3.5}, {5, 3})), "---");  // of the pixel
    EXPECT_EQ(accepted(c, kPart, at_block({4.5, 2.5}, {5, 3})), "---");  // of the first one
    EXPECT_EQ(accepted(c, kPart, at_block({5, 3.5}, {5, 3})), "---");
    const cases::Case wide = in_blocks(Auxiliary::none, 4, 1);
    EXPECT_EQ(accepted(wide, kPart, at_block({6, 3.5}, {6, 3.5})), "vpd");
    EXPECT_EQ(accepted(wide, kPart, at_block({5, 3.5}, {6, 3.5})), "---");
    const cases::Case plain = in_blocks(Auxiliary::none, 1, 1);
    EXPECT_EQ(accepted(plain, kPart, at_block({4.5, 3.5}, {4.5, 3.5})), "vpd");
    EXPECT_EQ(accepted(plain, kPart, at_block({5, 3}, {4.5, 3.5})), "---");
}

TEST(FragmentSize, InputsAreAnywhereInTheBlockAndAtItsCentre) {
    const cases::Case c = in_blocks(Auxiliary::none);
    EXPECT_EQ(accepted(c, kPart, at_block({5, 3}, {4.5, 3.5})), "vp-");
    EXPECT_EQ(accepted(c, kPart, at_block({5, 3}, {5.875, 3.875})), "vp-");  // outside the triangle
    EXPECT_EQ(accepted(c, kPart, at_block({5, 3}, {6.25, 3})), "---");
    EXPECT_EQ(accepted(c, kPart, at_block({5, 3}, {5, 4.25})), "---");
    // One place for all: the first attribute's is another than the second's.
    FragmentValues two = at_block({5, 3}, {4.5, 3.5});
    two.attributes[1].x = 4.25F + 2 * 2.25F;
    EXPECT_EQ(accepted(c, kPart, two), "v--");
}

// With one sample a pixel inputs are between the pixels' centres.
TEST(FragmentSize, OneSampleIsEvaluatedAtACentre) {
    cases::Case c = in_blocks(Auxiliary::none);
    c.target.samples = 1;
    const cases::SampleId id{4, 3};
    EXPECT_EQ(accepted(c, id, at_block({5, 3}, {5, 3})), "vpd");
    EXPECT_EQ(accepted(c, id, at_block({5, 3}, {4.5, 3.5})), "vp-");
    EXPECT_EQ(accepted(c, id, at_block({5, 3}, {4.25, 3})), "---");
    for (cases::Attribute& a : c.draws[0].attributes) {
        a.auxiliary = Auxiliary::centroid;
    }
    EXPECT_EQ(accepted(c, id, at_block({5, 3}, {5, 3})), "vpd");
    EXPECT_EQ(accepted(c, id, at_block({5, 3}, {4.5, 2.5})), "vpd");  // a covered sample
    EXPECT_EQ(accepted(c, id, at_block({5, 3}, {4.25, 3})), "vp-");   // in the triangle
}

// Of the block's samples those of pixel (4,2), 0 and 2 of (5,2) and (4,3), and none of (5,3) are
// covered: 5.375 + 2.125, 5.125 + 2.625, 4.375 + 3.125 and 4.125 + 3.625 are less than 8.
TEST(FragmentSize, CentroidsAreInTheTriangle) {
    const cases::Case c = in_blocks(Auxiliary::centroid);
    EXPECT_EQ(accepted(c, kPart, at_block({5, 3}, {4.375, 2.125})), "vpd");
    EXPECT_EQ(accepted(c, kPart, at_block({5, 3}, {5.125, 2.625})), "vpd");
    EXPECT_EQ(accepted(c, kPart, at_block({5, 3}, {4.25, 2.75})), "vp-");  // no sample
    EXPECT_EQ(accepted(c, kPart, at_block({5, 3}, {5.5, 3.5})), "---");
    // All samples of the block (2,2) to (4,4) are covered: the centre, where it is on the grid.
    FragmentValues whole = fragment(kWhole, {3, 3}, {3, 3});
    whole.frag_coord.x = whole.frag_coord.y = 3;
    EXPECT_EQ(accepted(c, kWhole, whole), "vpd");
}

// A scissor that takes column 5 away: no text says whether the block's centroid is then elsewhere.
TEST(FragmentSize, CentroidsOfBlocksThatAreCut) {
    cases::Case c = in_blocks(Auxiliary::centroid);
    c.draws[0].scissor = {0, 0, 5, 8};
    EXPECT_EQ(accepted(c, kPart, at_block({5, 3}, {5, 3})), "vpd");
    EXPECT_EQ(accepted(c, kPart, at_block({5, 3}, {4.375, 2.125})), "vpd");
    EXPECT_EQ(accepted(c, kPart, at_block({5, 3}, {5.125, 2.625})), "vp-");  // not covered any more
    EXPECT_EQ(accepted(in_blocks(Auxiliary::centroid), kPart, at_block({5, 3}, {5, 3})), "vp-");
}

TEST(FragmentSize, SampleMaskInHasAllPixels) {
    cases::Case c = in_blocks(Auxiliary::none);
    cases::Attribute mask;
    mask.source = Source::sample_mask_in;
    c.draws[0].attributes = {mask};
    const auto is_accepted = [&](uint32_t bits) {
        FragmentValues v = at_block({5, 3}, {0, 0});
        v.attributes[0] = {static_cast<float>(bits), 0, 0, 0};
        return accepted(c, kPart, v);
    };
    EXPECT_EQ(is_accepted(0xf550), "vpd");
    EXPECT_EQ(is_accepted(0x055f), "---");  // the first pixel first
    EXPECT_EQ(is_accepted(0x0050), "v--");  // of an invocation for the pixel alone
    EXPECT_EQ(is_accepted(0xf500), "---");  // without the sample that it writes
    EXPECT_EQ(is_accepted(0x5), "---");
    EXPECT_EQ(is_accepted(0xffff), "---");
    c.draws[0].multisample.sample_mask = 4;
    EXPECT_EQ(is_accepted(0x4440), "vpd");
    EXPECT_EQ(is_accepted(0xf550), "---");
}

// Samples that early tests took away may be missing, those that nothing covers are not there.
TEST(FragmentSize, SampleMaskInMayBeThatAfterEarlyTests) {
    for (const bool is_large : {true, false}) {
        cases::Case c = is_large ? in_blocks(Auxiliary::none) : triangle(Auxiliary::none);
        cases::Attribute mask;
        mask.source = Source::sample_mask_in;
        c.draws[0].attributes = {mask};
        c.draws[0].early_tests = true;
        const auto is_accepted = [&](uint32_t bits) {
            FragmentValues v =
                is_large ? at_block({5, 3}, {0, 0}) : fragment(kPart, {0, 0}, {0, 0});
            v.attributes[0] = {static_cast<float>(bits), 0, 0, 0};
            return accepted(c, kPart, v);
        };
        const uint32_t all = is_large ? 0xf550 : 0x5;
        const uint32_t own = is_large ? 1U << (4 + kPart.sample) : 1U << kPart.sample;
        EXPECT_EQ(is_accepted(all), "vpd");
        EXPECT_EQ(is_accepted(own), "vpd");
        EXPECT_EQ(is_accepted(all & ~own), "---");
        EXPECT_EQ(is_accepted(own | 0x2), "---");
    }
}

TEST(FragmentSize, TheRateIsTheDrawsOwn) {
    cases::Case c = in_blocks(Auxiliary::none);
    cases::Attribute rate;
    rate.source = Source::shading_rate;
    c.draws[0].attributes = {rate};
    const auto is_accepted = [&](float number) {
        FragmentValues v = at_block({5, 3}, {0, 0});
        v.attributes[0] = {number, 0, 0, 0};
        return accepted(c, kPart, v);
    };
    EXPECT_EQ(is_accepted(5), "vpd");
    EXPECT_EQ(is_accepted(0), "---");
    EXPECT_EQ(is_accepted(4), "---");
    EXPECT_EQ(is_accepted(-5), "---");
    EXPECT_EQ(is_accepted(std::nanf("")), "---");
}

// The target's last block is cut: what lies beyond has no samples.
TEST(FragmentSize, CoverageOfABlockIsThatOfItsPixels) {
    cases::Case c = pixels(5, 5, {{0, 0}, {16, 0}, {0, 16}}, 1);
    c.draws[0].fragment_size = {4, 2};
    const std::vector<cases::Triangle> triangles = assemble(c);
    FragmentCoverage coverage(c, {8}, Profile::direct3d, triangles);
    EXPECT_EQ(coverage.of(0, 1, 1).must, 0xffU);
    EXPECT_EQ(coverage.of(0, 4, 3).must, 0x88U);  // pixels 0 and 4: column 4
    EXPECT_EQ(coverage.of(0, 4, 4).must, 0x80U);  // pixel 0 alone
    EXPECT_EQ(coverage.exact(0, 4, 4).must, 0x80U);
    EXPECT_EQ(coverage.exact(0, 4, 4).may, 0x80U);
    EXPECT_EQ(pixel_region(coverage.setup(0), {4, 2, 4, 2}).size(), 4U);
}

// Values that nobody drew there are told with the centre of the block.
TEST(FragmentSize, WhatIsExpectedIsAtTheCentre) {
    const cases::Case c = in_blocks(Auxiliary::none);
    ValueReference values(c, {8}, Profile::direct3d);
    for (const ExpectedValue& e : values.expected(0, kPart)) {
        if (e.quantity == QuantityId::of_frag_coord(0)) {
            EXPECT_EQ(e.nearest, 5);
        } else if (e.quantity == QuantityId::of_attribute(0, 1)) {
            EXPECT_EQ(e.nearest, 3);
        } else if (e.quantity == QuantityId::of_attribute(1, 0)) {
            EXPECT_EQ(e.nearest, 11);
        }
    }
    const FragmentVerdict verdict = values.judge(0, kPart, at_block({4.5, 3.5}, {5, 3}));
    ASSERT_EQ(verdict.mismatches.size(), 2U);
    EXPECT_EQ(verdict.mismatches[0].rule, "fragment-size.area");
    EXPECT_EQ(verdict.mismatches[0].level, Profile::vulkan);
    EXPECT_EQ(verdict.mismatches[0].expected,
              "5 exactly, the centre of the fragment's 2 x 2 pixels");
}

}  // namespace
}  // namespace ref::test
