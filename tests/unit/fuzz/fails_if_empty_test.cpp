// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a device that draws nothing fails (diff/color.hpp), of cases as hunts draw them.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <tuple>

#include "cases/load/loader.hpp"
#include "cases/model/profile.hpp"
#include "diff/color.hpp"
#include "fuzz/entry.hpp"
#include "fuzz/generate/generator.hpp"
#include "ref/expectation/expectation.hpp"

namespace fuzz {
namespace {

using cases::Profile;

// What ends at the first samples that tell says what the whole expectation does.
TEST(FailsIfEmpty, AsTheWholeExpectationSays) {
    std::map<std::tuple<Profile, bool, bool>, size_t> seen;
    Poses poses(6);
    for (uint64_t k = 0; k < 64; ++k) {
        const Pose pose = poses.next([&](const Pose& p) { return is_case(6, p, k); });
        for (uint64_t number = k * kGeometries; number < k * kGeometries + 2; ++number) {
            const auto c = load_one(case_text(6, pose, k, number), "case");
            if (!c || c->blit ||
                size_t{c->target.width} * c->target.rows() * c->target.samples > 1024) {
                continue;
            }
            for (const Profile profile : cases::kProfiles) {
                const ref::Expectation whole = ref::expect(*c, ref::Limits{}, profile);
                const bool fails = whole.must_samples > 0 &&
                                   (c->target.has_instruments || !diff::may_stay_clear(*c, whole));
                EXPECT_EQ(diff::fails_if_empty(*c, profile), fails)
                    << case_text(6, pose, k, number);
                ++seen[{profile, c->target.has_instruments, fails}];
            }
        }
    }
    EXPECT_EQ(seen.size(), 12U);  // each answer, at each profile, with instruments and without
}

// One sample of four pixels tells, and not in the middle of the row.
TEST(FailsIfEmpty, OneSampleIsEnough) {
    const auto fails = [](const std::string& target, const std::string& draw) {
        const auto all = cases::load_text(
            "format = 1\ndescription = \"d\"\nrules = [\"cover.inside\"]\n[target]\n"
            "size = [4, 1]\n" +
                target + "[[draw]]\n" + draw + "vertices = [[0, -8], [0, 8], [16, 0]]\n",
            "one.toml", "one");
        EXPECT_TRUE(all) << cases::to_string(all.error().front());
        return all && diff::fails_if_empty(all->front(), Profile::vulkan);
    };
    EXPECT_TRUE(fails("", ""));
    EXPECT_TRUE(fails("", "scissor = [3, 0, 1, 1]\n"));
    EXPECT_FALSE(fails("", "scissor = [3, 0, 0, 1]\n"));
    // Colours alone, of which the target holds one already.
    const std::string color = "attachments = \"color\"\n[target.color]\nformat = \"rgba8-unorm\"\n";
    EXPECT_TRUE(fails(color, "color = { value = [1, 0, 0, 0] }\nscissor = [3, 0, 1, 1]\n"));
    EXPECT_FALSE(fails(color, "color = { value = [0, 0, 0, 0] }\n"));
}

}  // namespace
}  // namespace fuzz
