// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Every generated case is valid Vulkan: the Khronos validation layer has nothing to say about any.
// 10,000 cases are drawn in shares (EDGECASE_FUZZ_SHARE=I/N, 1/1: all), those of a pose together.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fuzz/generate/generator.hpp"
#include "fuzz/generate/pose.hpp"
#include "fuzz/generate/source.hpp"
#include "tests/share.hpp"
#include "vk_harness/public/harness.hpp"

namespace fuzz {
namespace {

using capture::Rendered;

// More poses than a hunt has among as many cases: what is valid hangs on the pose.
constexpr uint64_t kPoses = 1250, kGeometriesOfPose = 8, kSeed = 11;

TEST(Validation, NothingToSayAboutGeneratedCases) {
    const auto share = test_support::share_of(25, kPoses, "EDGECASE_FUZZ_SHARE");
    capture::RendererOptions options;
    options.validation = true;
    auto renderer = vk_harness::make_renderer(options);
    ASSERT_TRUE(renderer) << renderer.error().message;
    Poses poses(kSeed);
    size_t drawn = 0, made = 0;
    // A share is a run of poses, as those before it need to be chosen, too.
    const uint64_t begin = kPoses * share.share / share.shares;
    const uint64_t end = kPoses * (share.share + 1) / share.shares;
    for (uint64_t k = 0; k < end; ++k) {
        const Pose pose = poses.next([&](const Pose& p) { return is_case(kSeed, p, k); });
        if (k < begin) {
            continue;
        }
        std::vector<cases::Case> batch;
        std::vector<std::string> texts;
        for (uint64_t n = k * kGeometries; n < k * kGeometries + kGeometriesOfPose; ++n) {
            texts.push_back(case_text(kSeed, pose, k, n));
            auto c = load_one(texts.back(), std::to_string(n));
            ASSERT_TRUE(c) << texts.back();
            batch.push_back(std::move(*c));
        }
        const std::vector<Rendered> results = (*renderer)->render(batch);
        ASSERT_EQ(results.size(), batch.size());
        for (size_t n = 0; n < results.size(); ++n) {
            EXPECT_TRUE(results[n].status == Rendered::Status::drawn ||
                        results[n].status == Rendered::Status::unsupported)
                << results[n].reason << "\n"
                << texts[n];
            EXPECT_THAT(results[n].messages, ::testing::IsEmpty()) << texts[n];
            drawn += results[n].status == Rendered::Status::drawn ? 1U : 0U;
        }
        made += batch.size();
        if (HasFailure()) {
            return;  // one case says enough
        }
    }
    EXPECT_EQ(made, (end - begin) * kGeometriesOfPose);
    EXPECT_GT(drawn, made / 2);
}

}  // namespace
}  // namespace fuzz
