// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is right passes, whatever is drawn: generated cases by the reference itself, and by the
// software device without a fault. EDGECASE_FUZZ_SHARE=1/1 draws all; usually it is a share.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <optional>
#include <random>
#include <string>

#include "cases/load/loader.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/sample.hpp"
#include "diff/resolve.hpp"
#include "fuzz/generate/generator.hpp"
#include "rasterizers/captures.hpp"
#include "rasterizers/strength/strength.hpp"
#include "ref/color/color.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"
#include "tests/share.hpp"

namespace fuzz {
namespace {

using cases::Profile;

constexpr uint64_t kSeeds = 3, kPosesOfSeed = 64;  // 4096 cases of each seed
constexpr size_t kUsualShares = 96;

size_t all_values() {
    size_t sum = 0;
    for (const Feature& feature : features()) {
        sum += feature.values.size();
    }
    return sum;
}

size_t sample_count(const cases::Case& c) {
    return size_t{c.target.width} * c.target.rows() * c.target.samples;
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

// What bounds on all set-ups at once leave holds all that the set-ups accept, and colours that the
// bounds rule out are ruled out.
TEST(GeneratedCases, BoundsHoldWhatIsAccepted) {
    std::map<Profile, size_t> bounded, ruled_out;
    std::mt19937 rng(1);
    Poses poses(8);
    for (uint64_t k = 0; k < 48; ++k) {
        const Pose pose = poses.next([&](const Pose& p) { return is_case(8, p, k); });
        const std::string text = case_text(8, pose, k, k * kGeometries + 1);
        const auto loaded = cases::load_text(text, "fuzz", "fuzz");
        ASSERT_TRUE(loaded);
        const cases::Case& c = loaded->front();
        if (c.blit || !c.target.color || sample_count(c) > 2048) {
            continue;
        }
        for (const Profile profile : cases::kProfiles) {
            const ref::Expectation expected = ref::expect(c, {}, profile);
            ref::ValueReference values(c, {}, profile);
            ref::ColorReference colors(c, expected);
            for (size_t index = k % 5; index < expected.samples.size(); index += 5) {
                const cases::SampleId id = cases::sample_at(c.target, index);
                for (const ref::path::Fragment& hit :
                     expected.fragments_of(expected.samples[index])) {
                    const cases::Triangle& triangle = expected.triangles[hit.triangle];
                    const size_t count = c.draws[triangle.draw].attributes.size();
                    for (size_t a = 0; a < count; ++a) {
                        const auto exact = values.ranges(hit.triangle, id, a);
                        const auto outer = values.ranges(hit.triangle, id, a, true);
                        for (size_t n = 0; n < 4; ++n) {
                            const bool holds =
                                !outer[n].is_promised ||
                                (exact[n].is_promised && outer[n].low <= exact[n].low &&
                                 outer[n].high >= exact[n].high);
                            EXPECT_TRUE(holds)
                                << "attribute " << a << ", component " << n << " of triangle "
                                << hit.triangle << " at sample " << index << ": [" << exact[n].low
                                << ", " << exact[n].high << "] " << exact[n].is_promised
                                << " beyond [" << outer[n].low << ", " << outer[n].high << "]\n"
                                << text;
                            bounded[profile] += outer[n].low < exact[n].low ? 1U : 0U;
                        }
                    }
                }
                std::array<uint32_t, 4> codes = colors.codes(index, id);
                codes.at(rng() % 4) ^= 1U << rng() % 8;
                const bool may = colors.may_explain(index, id, codes);
                if (!may) {
                    EXPECT_FALSE(colors.explains(index, id, codes)) << text;
                    ++ruled_out[profile];
                }
            }
        }
    }
    for (const Profile profile : cases::kProfiles) {
        EXPECT_GT(bounded[profile], 300U) << cases::to_string(profile);
        EXPECT_GT(ruled_out[profile], 300U) << cases::to_string(profile);
    }
}

}  // namespace
}  // namespace fuzz
