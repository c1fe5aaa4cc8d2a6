// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The fast reference against the oracle on the shipped suite: what may be drawn, and what values
// may be. On a share of the leaves (share.hpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "cases/load/loader.hpp"
#include "folders.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/on_demand.hpp"
#include "ref/expectation/scene.hpp"
#include "ref/value/reference.hpp"
#include "tests/share.hpp"
#include "tests/unit/ref/same_expectations.hpp"
#include "tests/unit/ref/value_case.hpp"

namespace {

using cases::Profile;

// Work of the oracle at which a leaf takes some tenths of a second: a larger one is left out.
constexpr uint64_t kMostWork = 1U << 14U;
// The oracle tries the histories of a stencil one by one, and gives up where the fast reference
// still tells all: stencil/clamp-many, of 300 triangles.
constexpr uint64_t kMostTriangles = 64;

uint64_t work_of(const cases::Case& c) {
    uint64_t triangles = 0;
    for (const cases::Draw& d : c.draws) {
        triangles += (d.indices ? d.indices->size() : d.positions.size()) / 3 + 1;
    }
    return c.target.has_stencil && triangles > kMostTriangles
               ? kMostWork + 1
               : uint64_t{c.target.width} * c.target.rows() * c.target.samples * triangles;
}

struct Leaves {
    std::vector<cases::Case> cases;
    size_t large = 0;  // that were left out
};

const Leaves& leaves() {
    static const Leaves kLeaves = [] {
        Leaves out;
        const auto suite = cases::load_suite(test_support::source_dir() + "/cases/suite");
        const auto share = test_support::share_of(96, suite.cases.size());
        for (const cases::Case& c : suite.cases) {
            if (c.blit || !share.has(c.id)) {
                continue;
            }
            if (work_of(c) > kMostWork) {
                ++out.large;
            } else {
                out.cases.push_back(c);
            }
        }
        return out;
    }();
    return kLeaves;
}

TEST(Oracle, ExpectsOfTheSuiteWhatTheFastReferenceDoes) {
    size_t compared = 0;
    for (const cases::Case& c : leaves().cases) {
        for (const Profile profile : cases::kProfiles) {
            for (const int bits : {8, 4}) {
                ref::Limits limits;
                limits.subpixel_bits = bits;
                const ref::Expectation fast = ref::expect(c, limits, profile);
                const ref::Expectation exact = ref::exact::expect(c, limits, profile);
                const auto where = [&] { return c.id + " at " + std::string(to_string(profile)); };
                EXPECT_TRUE(ref::test::same_expectations(fast, exact)) << where();
                ++compared;
            }
        }
    }
    EXPECT_EQ(compared, 6 * leaves().cases.size());
    EXPECT_GT(leaves().cases.size(), 2 * leaves().large);
}

// Samples that are asked for one by one, in any order.
TEST(Oracle, ExpectsOfASampleThatIsAskedForWhatIsExpectedOfAll) {
    std::mt19937 rng(2);
    size_t compared = 0;
    for (const cases::Case& c : leaves().cases) {
        for (const Profile profile : cases::kProfiles) {
            const ref::Expectation all = ref::expect(c, {}, profile);
            ref::Scene scene(c, {}, profile, false);
            ref::OnDemand on_demand(scene);
            std::vector<size_t> order(all.samples.size());
            std::iota(order.begin(), order.end(), size_t{0});
            std::shuffle(order.begin(), order.end(), rng);
            const ref::Expectation* found = nullptr;
            for (const size_t index : order) {
                found = &on_demand.at(index);
                ASSERT_TRUE(ref::is_same(*found, all, index)) << c.id << " sample " << index;
            }
            ASSERT_NE(found, nullptr);
            EXPECT_TRUE(ref::test::same_expectations(*found, all)) << c.id;
            ++compared;
        }
    }
    EXPECT_EQ(compared, 3 * leaves().cases.size());
}

// Some samples of a leaf, and for each of them a device that rounds the exact values once, and one
// that is wrong in the last bits of one value: sometimes accepted, sometimes not.
TEST(Oracle, JudgesValuesOfTheSuiteAsTheFastReferenceDoes) {
    constexpr size_t kSamples = 3;
    std::mt19937 rng(1);
    size_t right = 0;
    size_t wrong = 0;
    for (const cases::Case& c : leaves().cases) {
        if (!c.target.has_instruments) {
            continue;
        }
        for (const Profile profile : cases::kProfiles) {
            const ref::Expectation e = ref::expect(c, {}, profile);
            ref::ValueReference values(c, {}, profile);
            std::vector<size_t> written;
            for (size_t i = 0; i < e.samples.size(); ++i) {
                if (e.samples[i].writers_count > 0) {
                    written.push_back(i);
                }
            }
            std::shuffle(written.begin(), written.end(), rng);
            written.resize(std::min(written.size(), kSamples));
            for (const size_t index : written) {
                const cases::SampleId id = cases::sample_at(c.target, index);
                const uint32_t t = e.writers[e.samples[index].writers_begin];
                const auto all = values.expected(t, id);
                for (const int moved : {-1, 0, 1, 2, 3}) {
                    auto device = all;
                    if (moved >= 0 && !device.empty()) {
                        ref::ExpectedValue& v = device[rng() % device.size()];
                        const double most = std::max(v.factor, 1.0) * v.budget;
                        v.nearest += std::ldexp(most, static_cast<int>(rng() % 4) - 2) *
                                     (moved % 2 == 0 ? 1 : -1);
                    }
                    const ref::FragmentValues drawn = value_test::rounded(device);
                    const ref::FragmentVerdict fast = values.judge(t, id, drawn);
                    const ref::FragmentVerdict exact = values.judge_exact(t, id, drawn);
                    values.tell_ratios(false);
                    const ref::FragmentVerdict bare = values.judge(t, id, drawn);
                    values.tell_ratios(true);
                    const auto where = [&] {
                        return c.id + " at " + std::string(to_string(profile)) + ", sample " +
                               std::to_string(index) + ", triangle " + std::to_string(t);
                    };
                    ASSERT_EQ(fast.ok, exact.ok) << where();
                    ASSERT_EQ(fast.mismatches.size(), exact.mismatches.size()) << where();
                    ASSERT_EQ(fast.ok, bare.ok) << where();
                    ASSERT_EQ(fast.mismatches.size(), bare.mismatches.size()) << where();
                    for (size_t k = 0; k < fast.mismatches.size(); ++k) {
                        EXPECT_EQ(fast.mismatches[k].quantity, bare.mismatches[k].quantity)
                            << where();
                        EXPECT_EQ(fast.mismatches[k].rule, bare.mismatches[k].rule) << where();
                        EXPECT_EQ(fast.mismatches[k].level, bare.mismatches[k].level) << where();
                        EXPECT_EQ(fast.mismatches[k].expected, bare.mismatches[k].expected)
                            << where();
                        EXPECT_EQ(fast.mismatches[k].quantity, exact.mismatches[k].quantity)
                            << where();
                        EXPECT_EQ(fast.mismatches[k].rule, exact.mismatches[k].rule) << where();
                        EXPECT_EQ(fast.mismatches[k].level, exact.mismatches[k].level) << where();
                    }
                    (fast.ok ? right : wrong) += 1;
                }
            }
        }
    }
    EXPECT_GT(right, wrong);
    EXPECT_GT(wrong, right / 20);
}

}  // namespace
