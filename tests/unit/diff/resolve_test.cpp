// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults planted in the stencil and in what was resolved, against the capture's own samples.
#include "diff/resolve.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <limits>

#include "perfect_capture.hpp"

namespace diff {

namespace {

using cases::ColorFormat;
using cases::Profile;
using cases::Resolve;

// A capture of 2 x 1 pixels with the planes that are judged here.
capture::Capture make_capture(uint32_t samples) {
    capture::Capture c;
    c.target.width = 2;
    c.target.height = 1;
    c.target.samples = samples;
    const size_t n = c.sample_count();
    c.hits.assign(n, {0, 0, capture::kHitGuard, capture::kHitGuard});
    c.writers.assign(n, capture::Writer{});
    c.frag_coord.assign(n, glm::vec4(capture::kClearValue));
    c.depth.assign(n, capture::kClearDepth);
    return c;
}

void hit(capture::Capture& c, size_t index, float front, float back) {
    set_hits(c, index, front, back);
    c.writers[index] = {0, 0, 0, capture::kClearId};
    c.frag_coord[index] = glm::vec4(0.5F);
}

capture::Capture colored(ColorFormat format, Resolve mode, std::vector<uint32_t> reds) {
    capture::Capture c = make_capture(static_cast<uint32_t>(reds.size()));
    c.target.color.emplace();
    c.target.color->format = format;
    c.target.color_resolve = mode;
    for (uint32_t pixel = 0; pixel < 2; ++pixel) {
        for (const uint32_t red : reds) {
            c.color.push_back({red, 0, 0, 0});
        }
    }
    add_dependent_planes(c);
    return c;
}

std::vector<Finding> judge(const capture::Capture& c, Profile profile = Profile::direct3d) {
    std::vector<Finding> findings;
    const std::string error = judge_dependent_planes(
        c, profile, [&](Finding finding) { findings.push_back(std::move(finding)); });
    EXPECT_EQ(error, "");
    return findings;
}

TEST(Stencil, CountsFrontLessBackModulo256) {
    EXPECT_EQ(stencil_of({0, 0, 0, 0}), 0U);
    EXPECT_EQ(stencil_of({3, 1, 0, 0}), 2U);
    EXPECT_EQ(stencil_of({0, 1, 0, 0}), 255U);
    EXPECT_EQ(stencil_of({258, 0, 0, 0}), 2U);
    EXPECT_EQ(stencil_of({0, 258, 0, 0}), 254U);
}

TEST(Stencil, EveryOtherValueIsAFinding) {
    for (const uint32_t samples : {1U, 4U}) {
        capture::Capture c = make_capture(samples);
        c.target.has_stencil = true;
        hit(c, samples, 2, 3);  // the first sample of the second pixel
        add_dependent_planes(c);
        const auto judge_sample = [&](size_t index) {
            const glm::vec4& hits = c.hits[index];
            return judge_count(c, index,
                               {ref::path::SeenHits::Detail::faces, static_cast<uint32_t>(hits.x),
                                static_cast<uint32_t>(hits.y)});
        };
        EXPECT_FALSE(judge_sample(samples));
        for (const uint32_t wrong :
             {0U, 1U, 5U, 254U}) {  // lost, exchanged, both added, off by one
            c.stencil[samples] = wrong;
            const std::optional<Finding> finding = judge_sample(samples);
            ASSERT_TRUE(finding);
            EXPECT_EQ(finding->rule, "stencil.count");
            EXPECT_EQ(finding->level, Profile::vulkan);
            EXPECT_EQ(finding->x, 1U);
            EXPECT_EQ(finding->sample, 0U);
            EXPECT_EQ(finding->expected, "255");
        }
        c.stencil[samples] = 255;
        c.stencil[samples - 1] = 1;  // where nothing hit
        EXPECT_TRUE(judge_sample(samples - 1));
        // Without faces nothing is counted.
        EXPECT_FALSE(judge_count(c, samples - 1, {ref::path::SeenHits::Detail::total, 0, 0}));
    }
}

TEST(Resolve, NotCopiedIsAnError) {
    capture::Capture c = colored(ColorFormat::rgba8_unorm, Resolve::average, {0, 255});
    c.resolved_color[1] = {capture::kPoison, capture::kPoison, capture::kPoison, capture::kPoison};
    EXPECT_NE(judge_dependent_planes(c, Profile::vulkan, [](const Finding&) {}), "");
    capture::Capture d = make_capture(2);
    d.target.depth_resolve = Resolve::min;
    d.resolved_depth.assign(2, std::bit_cast<float>(capture::kPoison));
    EXPECT_NE(judge_dependent_planes(d, Profile::vulkan, [](const Finding&) {}), "");
    capture::Capture e = make_capture(2);
    e.target.has_stencil = true;
    e.target.stencil_resolve = Resolve::min;
    e.resolved_stencil.assign(2, capture::kPoison);
    EXPECT_NE(judge_dependent_planes(e, Profile::vulkan, [](const Finding&) {}), "");
}

// Codes 10, 20, 20, 35: mean 21.25. From practice on 20.25..22.25 may be stored, that is 21 or 22;
// Vulkan's text allows all from 10 to 35.
TEST(Resolve, AverageOfUnormWithinAStepOfTheMean) {
    capture::Capture c = colored(ColorFormat::rgba8_unorm, Resolve::average, {10, 20, 20, 35});
    EXPECT_EQ(c.resolved_color[0][0], 21U);
    for (uint32_t code = 0; code < 256; ++code) {
        c.resolved_color[1][0] = code;
        const std::vector<Finding> findings = judge(c);
        const bool vulkan = code < 10 || code > 35;
        const bool practice = code != 21 && code != 22;
        ASSERT_EQ(findings.size(), practice ? 1U : 0U) << code;
        EXPECT_EQ(judge(c, Profile::vulkan).size(), vulkan ? 1U : 0U) << code;
        if (practice) {
            EXPECT_EQ(findings[0].rule, "resolve.average");
            EXPECT_EQ(findings[0].level, vulkan ? Profile::vulkan : Profile::practice);
            EXPECT_EQ(findings[0].x, 1U);
        }
    }
}

TEST(Resolve, SamplesAlikeStayWhatTheyAre) {
    capture::Capture c = colored(ColorFormat::rgba16_unorm, Resolve::average, {513, 513, 513, 513});
    EXPECT_TRUE(judge(c).empty());
    c.resolved_color[0][0] = 514;
    EXPECT_EQ(judge(c, Profile::vulkan).size(), 1U);
}

TEST(Resolve, AverageOfSrgbIsFreeAmongTheSamples) {
    capture::Capture c = colored(ColorFormat::rgba8_srgb, Resolve::average, {0, 255});
    c.resolved_color[0][0] = 188;  // the mean of linear numbers
    EXPECT_TRUE(judge(c).empty());
    c.resolved_color[0][0] = 128;  // the mean of codes
    EXPECT_TRUE(judge(c).empty());
    c.color[0][0] = 129;
    EXPECT_EQ(judge(c, Profile::vulkan).size(), 1U);
}

// Every order and rounding of a binary32 sum lies inside; a lost sample or a step of 2^-20 does
// not.
TEST(Resolve, AverageOfFloatsWithinTheBoundOfTheSum) {
    const std::vector<float> values = {0.1F, 0.7F, 0.3F, 0.9F, 0.2F, 0.6F, 0.8F, 0.5F};
    std::vector<uint32_t> bits;
    for (const float value : values) {
        bits.push_back(std::bit_cast<uint32_t>(value));
    }
    capture::Capture c = colored(ColorFormat::r32_float, Resolve::average, bits);
    float forwards = 0;
    float backwards = 0;
    float lost = 0;
    for (size_t k = 0; k < values.size(); ++k) {
        forwards += values[k];
        backwards += values[values.size() - 1 - k];
        lost += k == 3 ? values[2] : values[k];
    }
    const auto give = [&](float sum) {
        c.resolved_color[0][0] = std::bit_cast<uint32_t>(sum / 8);
        return judge(c).size();
    };
    EXPECT_EQ(give(forwards), 0U);
    EXPECT_EQ(give(backwards), 0U);
    EXPECT_EQ(give(lost), 1U);
    EXPECT_EQ(give(forwards + 0x1p-17F), 1U);
    EXPECT_EQ(give(std::numeric_limits<float>::quiet_NaN()), 1U);
}

// The mean of 0 and the smallest normal number is a denormal one, which may become 0; nothing more
// may be lost.
TEST(Resolve, ADenormalAverageMayBecomeZero) {
    capture::Capture c =
        colored(ColorFormat::r32_float, Resolve::average, {0, std::bit_cast<uint32_t>(0x1p-126F)});
    const auto give = [&](float got) {
        c.resolved_color[0][0] = std::bit_cast<uint32_t>(got);
        return judge(c).size();
    };
    EXPECT_EQ(give(0), 0U);
    EXPECT_EQ(give(0x1p-127F), 0U);
    EXPECT_EQ(give(0x1p-123F), 1U);
    EXPECT_EQ(give(-0x1p-124F), 1U);
}

TEST(Resolve, NothingIsKnownOfASumWithInfinity) {
    constexpr uint32_t kInfinity = 0x7f800000, kMinusInfinity = 0xff800000, kOne = 0x3f800000;
    EXPECT_TRUE(
        judge(colored(ColorFormat::r32_float, Resolve::average, {kInfinity, kOne})).empty());
    EXPECT_TRUE(judge(colored(ColorFormat::r32_float, Resolve::average,
                              {kOne, kInfinity, kMinusInfinity, kOne}))
                    .empty());
}

TEST(Resolve, SampleZeroOfIntegersIsExact) {
    capture::Capture c = colored(ColorFormat::r32_uint, Resolve::sample_zero, {7, 9, 9, 9});
    EXPECT_EQ(c.resolved_color[0][0], 7U);
    EXPECT_TRUE(judge(c).empty());
    for (const uint32_t wrong : {6U, 8U, 9U, 0U}) {  // 8: their average
        c.resolved_color[0][0] = wrong;
        const std::vector<Finding> findings = judge(c, Profile::vulkan);
        ASSERT_EQ(findings.size(), 1U);
        EXPECT_EQ(findings[0].rule, "resolve.select");
    }
}

TEST(Resolve, DepthByEachMode) {
    for (const auto format : {cases::DepthFormat::d32_float, cases::DepthFormat::d16_unorm}) {
        const std::vector<float> wishes = {0.5F, 0.25F, 0.75F, 0.625F};
        const auto stored = [format](float z) { return cases::nearest_depth(z, format); };
        for (const auto& [mode, right] :
             {std::pair(Resolve::sample_zero, 0.5F), std::pair(Resolve::min, 0.25F),
              std::pair(Resolve::max, 0.75F), std::pair(Resolve::average, 0.53125F)}) {
            capture::Capture c = make_capture(4);
            c.target.depth_format = format;
            c.target.depth_resolve = mode;
            for (size_t k = 0; k < c.depth.size(); ++k) {
                c.depth[k] = stored(wishes[k % 4]);
            }
            add_dependent_planes(c);
            EXPECT_EQ(c.resolved_depth[0], stored(right));
            EXPECT_TRUE(judge(c).empty());
            for (const float other : {0.5F, 0.25F, 0.75F, 0.625F, 0.53125F, 0.8125F}) {
                c.resolved_depth[1] = stored(other);
                EXPECT_EQ(judge(c).size(), std::equal_to<>()(other, right) ? 0U : 1U) << other;
            }
        }
    }
}

TEST(Resolve, StencilByEachMode) {
    const std::vector<uint32_t> samples = {130, 3, 200, 127};
    for (const auto& [mode, right] : {std::pair(Resolve::sample_zero, 130U),
                                      std::pair(Resolve::min, 3U), std::pair(Resolve::max, 200U)}) {
        capture::Capture c = make_capture(4);
        c.target.has_stencil = true;
        c.target.stencil_resolve = mode;
        for (size_t k = 0; k < c.sample_count(); ++k) {
            c.stencil.push_back(samples[k % 4]);
        }
        add_dependent_planes(c);
        EXPECT_EQ(c.resolved_stencil[0], right);
        EXPECT_TRUE(judge(c).empty());
        for (const uint32_t other : {130U, 3U, 200U, 127U, 115U, 0U}) {
            c.resolved_stencil[1] = other;
            EXPECT_EQ(judge(c).size(), other == right ? 0U : 1U) << other;
        }
    }
}

// Through the whole comparison: a finding reaches the verdict and marks a sample of its pixel.
TEST(Resolve, TheVerdictHoldsIt) {
    cases::Case c = pixel_case(8, 8, {{0, 0}, {8, 0}, {0, 8}});
    c.target.samples = 4;
    c.target.depth_resolve = Resolve::max;
    c.target.has_stencil = true;
    const ref::Expectation e = ref::expect(c, ref::Limits{8}, Profile::direct3d);
    capture::Capture capture = perfect_capture(c, e);
    EXPECT_FALSE(compare(c, e, capture).ok());  // the planes are missing
    add_dependent_planes(capture);
    const Verdict right = compare(c, e, capture);
    EXPECT_TRUE(right.ok()) << right.error;
    capture.resolved_depth[63] = 0.8125F;
    const Verdict wrong = compare(c, e, capture);
    EXPECT_EQ(wrong.counts[static_cast<size_t>(FindingKind::value)], 1U);
    EXPECT_EQ(wrong.marks[63 * 4], SampleMark::value);
    capture.resolved_depth[63] = capture::kClearDepth;
    capture.stencil[9 * 4 + 2] ^= 1U;
    EXPECT_EQ(compare(c, e, capture).counts[static_cast<size_t>(FindingKind::value)], 1U);
}

}  // namespace

}  // namespace diff
