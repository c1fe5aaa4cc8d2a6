// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Broken blits, planted in captures that the reference made: each has to be found, by the rule and
// at the level that it breaks.
#include "diff/blit.hpp"

#include <gtest/gtest.h>

#include "ref/blit/blit.hpp"

namespace diff {
namespace {

using cases::BlitFilter;
using cases::ColorFormat;
using cases::Corners;
using cases::Profile;

cases::Case scene(const Corners& from, const Corners& to, BlitFilter filter = BlitFilter::nearest,
                  ColorFormat format = ColorFormat::rgba8_unorm) {
    cases::Case c;
    c.target = {16, 16, 1};
    c.target.color = cases::ColorTarget{format, {}};
    c.target.has_instruments = false;
    c.target.has_depth = false;
    cases::Blit blit;
    blit.source_format = format;
    blit.source_width = 8;
    blit.source_height = 8;
    blit.filter = filter;
    blit.source = from;
    blit.destination = to;
    c.blit = blit;
    return c;
}

// What a device draws that does `done` where `asked` is the case.
capture::Capture drawn(const cases::Case& done) {
    const ref::BlitReference reference(done);
    capture::Capture capture;
    capture.target = done.target;
    for (uint32_t y = 0; y < done.target.height; ++y) {
        for (uint32_t x = 0; x < done.target.width; ++x) {
            capture.color.push_back(reference.nominal(x, y));
        }
    }
    return capture;
}

Verdict judged(const cases::Case& asked, const capture::Capture& capture, Profile profile) {
    return compare_blit(asked, profile, capture);
}

constexpr std::array<Profile, 3> kProfiles = {Profile::vulkan, Profile::practice,
                                              Profile::direct3d};

const cases::Case kCopy = scene({1, 1, 7, 6}, {4, 3, 10, 8});
const cases::Case kDouble = scene({1, 1, 7, 6}, {2, 3, 14, 13});
const cases::Case kLinear = scene({1, 1, 7, 6}, {2, 3, 14, 13}, BlitFilter::linear);

void expect_found(const cases::Case& asked, const cases::Case& done, std::string_view rule) {
    for (const Profile profile : kProfiles) {
        const Verdict verdict = judged(asked, drawn(done), profile);
        EXPECT_EQ(verdict.error, "");
        ASSERT_FALSE(verdict.ok());
        EXPECT_EQ(verdict.level, Profile::vulkan);
        bool named = false;
        for (const Finding& finding : verdict.findings) {
            named = named || finding.rule == rule;
        }
        EXPECT_TRUE(named) << rule;
    }
}

}  // namespace

TEST(CompareBlit, TheReferencesOwnPicturesPass) {
    for (const cases::Case* c : {&kCopy, &kDouble, &kLinear}) {
        for (const Profile profile : kProfiles) {
            const Verdict verdict = judged(*c, drawn(*c), profile);
            EXPECT_TRUE(verdict.ok()) << verdict.error;
            EXPECT_EQ(verdict.compared_samples, 256U);
            EXPECT_GT(verdict.must_samples, 0U);
        }
    }
}

TEST(CompareBlit, OneTexelOff) {
    expect_found(kCopy, scene({2, 1, 8, 6}, {4, 3, 10, 8}), "blit.nearest");
    expect_found(kCopy, scene({1, 0, 7, 5}, {4, 3, 10, 8}), "blit.nearest");
    expect_found(kCopy, scene({1, 1, 7, 6}, {5, 3, 11, 8}), "blit.outside");
}

TEST(CompareBlit, MirroredWrongly) {
    expect_found(kCopy, scene({7, 1, 1, 6}, {4, 3, 10, 8}), "blit.nearest");
    const cases::Case mirrored = scene({7, 1, 1, 6}, {4, 3, 10, 8});
    expect_found(mirrored, kCopy, "blit.nearest");
    expect_found(mirrored, scene({8, 1, 2, 6}, {4, 3, 10, 8}), "blit.nearest");
    expect_found(scene({7, 1, 1, 6}, {10, 3, 4, 8}), mirrored, "blit.nearest");
}

TEST(CompareBlit, AnotherFilter) {
    expect_found(kDouble, kLinear, "blit.nearest");
    expect_found(kLinear, kDouble, "blit.linear");
}

// floor(u + 1/2) instead of floor(u): the picture moves by half a texel, one target texel of two.
TEST(CompareBlit, HalfATexelShifted) {
    capture::Capture capture = drawn(kDouble);
    for (uint32_t y = 0; y < 16; ++y) {
        for (uint32_t x = 2; x < 13; ++x) {
            capture.color[y * 16 + x] = capture.color[y * 16 + x + 1];
        }
    }
    for (const Profile profile : kProfiles) {
        EXPECT_FALSE(judged(kDouble, capture, profile).ok());
    }
    capture::Capture blurred = drawn(kLinear);
    for (uint32_t y = 0; y < 16; ++y) {
        for (uint32_t x = 2; x < 13; ++x) {
            blurred.color[y * 16 + x] = blurred.color[y * 16 + x + 1];
        }
    }
    EXPECT_FALSE(judged(kLinear, blurred, Profile::vulkan).ok());
}

TEST(CompareBlit, OutsideTouched) {
    capture::Capture capture = drawn(kCopy);
    capture.color[0] = {1, 0, 0, 0};
    const Verdict verdict = judged(kCopy, capture, Profile::vulkan);
    ASSERT_EQ(verdict.findings.size(), 1U);
    EXPECT_EQ(verdict.findings[0].kind, FindingKind::extra);
    EXPECT_EQ(verdict.findings[0].rule, "blit.outside");
    EXPECT_EQ(verdict.marks[0], SampleMark::extra);
}

TEST(CompareBlit, NothingWritten) {
    capture::Capture capture = drawn(kCopy);
    capture.color.assign(256, {0, 0, 0, 0});
    const Verdict verdict = judged(kCopy, capture, Profile::vulkan);
    EXPECT_EQ(verdict.counts[static_cast<size_t>(FindingKind::missing)], 30U);
}

TEST(CompareBlit, NothingCopied) {
    capture::Capture capture = drawn(kCopy);
    capture.color[40] = {capture::kPoison, capture::kPoison, capture::kPoison, capture::kPoison};
    EXPECT_NE(judged(kCopy, capture, Profile::vulkan).error, "");
}

TEST(CompareBlit, OneCodeIsForgivenByVulkanOnly) {
    capture::Capture capture = drawn(kCopy);
    cases::TexelCodes& codes = capture.color[4 * 16 + 6];
    codes[1] = codes[1] < 255 ? codes[1] + 1 : 254;
    EXPECT_TRUE(judged(kCopy, capture, Profile::vulkan).ok());
    const Verdict verdict = judged(kCopy, capture, Profile::direct3d);
    ASSERT_EQ(verdict.findings.size(), 1U);
    EXPECT_EQ(verdict.findings[0].level, Profile::practice);
}

TEST(CompareBlit, AnotherSizeIsAnError) {
    capture::Capture capture = drawn(kCopy);
    capture.color.pop_back();
    EXPECT_NE(judged(kCopy, capture, Profile::vulkan).error, "");
}

}  // namespace diff
