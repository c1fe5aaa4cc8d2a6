// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is right passes, whatever is drawn: generated cases by the reference itself, and by the
// software device without a fault. EDGECASE_FUZZ_SHARE=1/1 draws all; usually it is a share.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "cases/load/loader.hpp"
#include "diff/resolve.hpp"
#include "fuzz/generate/generator.hpp"
#include "rasterizers/captures.hpp"
#include "rasterizers/strength/strength.hpp"
#include "tests/share.hpp"

namespace fuzz {
namespace {

constexpr uint64_t kSeeds = 3, kPosesOfSeed = 64;  // 4096 cases of each seed
constexpr size_t kUsualShares = 96;

size_t all_values() {
    size_t sum = 0;
    for (const Feature& feature : features()) {
        sum += feature.values.size();
    }
    return sum;
}

std::string told(const diff::Verdict& verdict) {
    if (verdict.findings.empty()) {
        return verdict.error;
    }
    const diff::Finding& f = verdict.findings.front();
    return fmt::format("{} at ({}, {}) sample {}: {}: expected {}, got {}", f.rule, f.x, f.y,
                       f.sample, f.quantity, f.expected, f.got);
}

TEST(GeneratedCases, TheReferenceAndTheFaultlessDevicePass) {
    const test_support::Share share =
        test_support::share_of(kUsualShares, all_values(), "EDGECASE_FUZZ_SHARE");
    size_t judged = 0;
    for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
        Poses poses(seed);
        for (uint64_t k = 0; k < kPosesOfSeed; ++k) {
            const Pose pose =
                poses.next([&](const Pose& candidate) { return is_case(seed, candidate, k); });
            for (uint64_t number = k * kGeometries; number < (k + 1) * kGeometries; ++number) {
                if ((number + seed) % share.shares != share.share) {
                    continue;
                }
                const auto loaded =
                    cases::load_text(case_text(seed, pose, k, number), "fuzz", "fuzz");
                ASSERT_TRUE(loaded);
                const cases::Case& c = loaded->front();
                const ref::Expectation expectation = ref::expect(c, {}, cases::Profile::direct3d);
                if (expectation.must_samples == 0) {
                    continue;  // nothing to judge
                }
                capture::Capture drawn = rasterizers::draw_by_reference(c);
                diff::add_dependent_planes(drawn);
                const diff::Verdict reference = diff::compare(c, expectation, drawn);
                EXPECT_TRUE(reference.ok()) << "reference, case " << number << " of seed " << seed
                                            << ": " << told(reference);
                const diff::Verdict device =
                    software::compare(c, expectation, software::captured(c, {}));
                EXPECT_TRUE(device.ok()) << "software device, case " << number << " of seed "
                                         << seed << ": " << told(device);
                ++judged;
            }
        }
    }
    EXPECT_GE(judged * share.shares, kSeeds * kPosesOfSeed * kGeometries / 2);
}

}  // namespace
}  // namespace fuzz
