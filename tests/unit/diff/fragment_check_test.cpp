// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Values planted in single pixels of a fragment.
#include "diff/fragment_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/model/rule_ids.hpp"
#include "cases/model/sample.hpp"
#include "diff/verdict.hpp"
#include "rasterizers/captures.hpp"
#include "tests/unit/diff/perfect_capture.hpp"

namespace diff {
namespace {

using cases::Profile;

cases::Case in_blocks(uint32_t width, uint32_t height) {
    cases::Case c = pixel_case(8, 8, {{0, 0}, {8, 0}, {0, 8}, {8, 0}, {8, 8}, {0, 8}});
    add_attribute(c, cases::Interpolation::smooth, {1, 2, 4, 2, 9, 4});
    c.draws[0].fragment_size = {width, height};
    return c;
}

Verdict verdict_of(const cases::Case& c, const capture::Capture& capture,
                   Profile profile = Profile::direct3d) {
    return compare(c, ref::expect(c, {}, profile), capture);
}

float after(float value) {
    return std::nextafter(value, 1000.0F);
}

TEST(FragmentCheck, TheReferenceSharesValues) {
    for (const auto& [width, height] : {std::pair(2U, 1U), {1U, 2U}, {2U, 2U}, {4U, 4U}}) {
        const cases::Case c = in_blocks(width, height);
        for (const Profile profile : cases::kProfiles) {
            const Verdict verdict = verdict_of(c, rasterizers::draw_by_reference(c), profile);
            EXPECT_TRUE(verdict.ok()) << verdict.error << width << "x" << height;
        }
    }
}

// A unit in the last place is within every budget: only the fragment's other pixels tell.
TEST(FragmentCheck, OnePixelsBitsAreFound) {
    const cases::Case c = in_blocks(2, 2);
    capture::Capture capture = rasterizers::draw_by_reference(c);
    float& value = capture.attributes[0][size_t{3} * 8 + 1].x;
    value = after(value);
    const Verdict verdict = verdict_of(c, capture);
    ASSERT_EQ(verdict.finding_total(), 1U) << verdict.error;
    const Finding& finding = verdict.findings[0];
    EXPECT_EQ(finding.rule, cases::rule::fragment_size_shared);
    EXPECT_EQ(finding.level, Profile::practice);
    EXPECT_EQ(finding.quantity, "attribute 0.x");
    EXPECT_EQ(finding.x, 1U);
    EXPECT_EQ(finding.y, 3U);
    EXPECT_EQ(finding.why,
              "triangle 0 of draw 0: one invocation serves the 2 x 2 pixels of its fragment");
    EXPECT_TRUE(finding.expected.ends_with(" as at pixel (0, 2)")) << finding.expected;
    EXPECT_TRUE(verdict_of(c, capture, Profile::vulkan).ok());
    // Of a fragment whose first pixel is wrong all others differ from it, which is told once.
    float& first = capture.attributes[0][size_t{4} * 8].x;
    first = after(first);
    EXPECT_EQ(verdict_of(c, capture).finding_total(), 2U);
}

TEST(FragmentCheck, OtherFragmentsMayDiffer) {
    // Of a block that both triangles share each has its own bits, and so has each block.
    cases::Case c = in_blocks(2, 2);
    capture::Capture capture = rasterizers::draw_by_reference(c);
    for (uint32_t y = 2; y < 4; ++y) {
        for (uint32_t x = 4; x < 6; ++x) {
            const size_t index = size_t{y} * 8 + x;
            if (capture.writers[index].primitive == 0) {
                capture.attributes[0][index].x = after(capture.attributes[0][index].x);
            }
        }
    }
    EXPECT_TRUE(verdict_of(c, capture).ok());
    // Without fragments of several pixels nothing has to agree.
    c = in_blocks(1, 1);
    capture = rasterizers::draw_by_reference(c);
    capture.attributes[0][9].x = after(capture.attributes[0][9].x);
    EXPECT_TRUE(verdict_of(c, capture).ok());
    EXPECT_FALSE(has_fragment_rules(c, ref::expect(c, {}, Profile::direct3d)));
}

// What clipping leaves may be several fragments, each with values of its own planes.
TEST(FragmentCheck, ClippedTrianglesAreNotAsked) {
    cases::Case c = in_blocks(2, 2);
    c.draws[0].positions[0].z = -0.25F;
    capture::Capture capture = rasterizers::draw_by_reference(c);
    const size_t index = size_t{2} * 8 + 3;
    ASSERT_EQ(capture.writers[index].primitive, 0U);
    capture.attributes[0][index].x = after(capture.attributes[0][index].x);
    EXPECT_TRUE(verdict_of(c, capture).ok());
}

// Two invocations of one fragment share out its 16 samples, those of one pixel among them: Vulkan
// allows it, devices do not do it.
TEST(FragmentCheck, InvocationsMayShareOutTheSamplesOfAMask) {
    cases::Case c = in_blocks(2, 2);
    c.target.samples = 4;
    cases::Attribute mask;
    mask.source = cases::Source::sample_mask_in;
    mask.components = 1;
    c.draws[0].attributes = {mask};
    capture::Capture capture = rasterizers::draw_by_reference(c);
    ASSERT_TRUE(verdict_of(c, capture).ok());
    const uint32_t own = 1U << cases::coverage_index({0, 0, 2, 2}, c.target, {1, 0, 2});
    const auto at = [&](uint32_t x, uint32_t y, uint32_t s) -> float& {
        return capture.attributes[0][cases::index_of(c.target, {x, y, s})].x;
    };
    for (uint32_t y = 0; y < 2; ++y) {
        for (uint32_t x = 0; x < 2; ++x) {
            for (uint32_t s = 0; s < 4; ++s) {
                ASSERT_EQ(at(x, y, s), 0xffff);
                const bool is_apart = x == 1 && y == 0 && s == 2;
                at(x, y, s) = static_cast<float>(is_apart ? own : 0xffff & ~own);
            }
        }
    }
    EXPECT_TRUE(verdict_of(c, capture, Profile::vulkan).ok());
    EXPECT_FALSE(verdict_of(c, capture, Profile::practice).ok());
    at(1, 0, 2) = static_cast<float>(own | 1U);  // which the other invocation has, too
    EXPECT_FALSE(verdict_of(c, capture, Profile::vulkan).ok());
}

}  // namespace
}  // namespace diff
