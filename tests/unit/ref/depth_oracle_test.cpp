// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Depth tests, bias, clamp and formats: the fast reference against the oracle on random cases.
#include <gtest/gtest.h>

#include <random>

#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"
#include "tests/unit/ref/same_expectations.hpp"
#include "tests/unit/ref/value_case.hpp"

namespace ref::test {
namespace {

class RandomDepth {
  public:
    explicit RandomDepth(uint64_t seed) : engine_(seed) {}

    int64_t integer(int64_t low, int64_t high) {
        return low + static_cast<int64_t>(engine_() % static_cast<uint64_t>(high - low + 1));
    }
    // A multiple of 2^-bits, so that ties are frequent.
    double dyadic(double low, double high, int bits) {
        const double steps = std::ldexp(high - low, bits);
        return low +
               std::ldexp(static_cast<double>(integer(0, static_cast<int64_t>(steps))), -bits);
    }
    bool one_in(int64_t n) { return integer(1, n) == 1; }

    cases::Case next() {
        cases::Case c;
        c.id = "random depth";
        c.target = {8, 8, one_in(3) ? 4U : 1U};
        c.target.depth_format = static_cast<cases::DepthFormat>(integer(0, 2));
        const float clears[] = {0, 0.375F, 0.5F, 1};
        c.target.depth_clear = clears[integer(0, 3)];
        const int64_t draws = integer(2, 4);
        for (int64_t k = 0; k < draws; ++k) {
            if (k > 0 && one_in(3)) {
                c.draws.push_back(c.draws.back());  // the same again, or biased
                if (one_in(2)) {
                    change(c.draws.back().depth);
                }
                if (one_in(3)) {  // by another shader
                    cases::Attribute a;
                    a.values.assign(c.draws.back().positions.size(), {1, 0, 0, 0});
                    c.draws.back().attributes.assign(1, a);
                }
            } else {
                c.draws.push_back(draw());
            }
        }
        return c;
    }

  private:
    void change(cases::DepthState& depth) {
        depth.compare = static_cast<cases::CompareOp>(integer(0, 7));
        depth.write = !one_in(4);
        if (one_in(2)) {
            depth.bias =
                cases::DepthBias{static_cast<float>(integer(-3, 3)), one_in(4) ? 0.0625F : 0.0F,
                                 one_in(2) ? static_cast<float>(integer(-1, 1)) : 0.0F};
        }
    }
    cases::Draw draw() {
        cases::Draw d;
        d.viewport = {0, 0, 8, 8, 0, 1};
        if (one_in(3)) {
            d.viewport.min_depth = 0.75F;
            d.viewport.max_depth = 0.25F;
        }
        d.scissor = {0, 0, 8, 8};
        change(d.depth);
        d.depth.clamp = one_in(4);
        const int64_t triangles = integer(1, 2);
        const bool is_level = one_in(2);
        for (int64_t t = 0; t < triangles; ++t) {
            const double level = dyadic(0, 1, 3);
            const int bits = one_in(2) ? 1 : 7;
            for (int v = 0; v < 3; ++v) {
                const double w = one_in(3) ? dyadic(0.5, 4, 1) : 1;
                d.positions.push_back(value_test::clip_of(dyadic(0, 8, bits), dyadic(0, 8, bits),
                                                          is_level ? level : dyadic(0, 1, 4), w,
                                                          8));
            }
        }
        return d;
    }
    std::mt19937_64 engine_;
};

TEST(ExhaustiveDepthOracle, ExpectationsAgree) {
    uint64_t must = 0, open = 0, failed = 0;
    for (uint64_t seed = 1; seed <= 150; ++seed) {
        RandomDepth random(seed);
        const cases::Case c = random.next();
        cases::Case untested = c;
        for (cases::Draw& d : untested.draws) {
            d.depth.compare = cases::CompareOp::always;
            d.depth.write = true;
        }
        for (const cases::Profile profile : cases::kProfiles) {
            const Expectation fast = expect(c, Limits{}, profile);
            const Expectation slow = exact::expect(c, Limits{}, profile);
            ASSERT_TRUE(same_expectations(fast, slow)) << "seed " << seed;
            must += fast.must_samples;
            open += fast.either_samples;
            // A test takes hits away and adds none.
            const Expectation all = expect(untested, Limits{}, profile);
            for (size_t k = 0; k < all.samples.size(); ++k) {
                ASSERT_LE(fast.samples[k].hits.total_max, all.samples[k].hits.total_max);
                failed += fast.samples[k].hits.total_max < all.samples[k].hits.total_max ? 1U : 0U;
            }
        }
    }
    EXPECT_GT(must, 2500U);  // the cases are about something
    EXPECT_GT(open, 250U);
    EXPECT_GT(failed, 2500U);
}

// Whatever a looser profile is sure of, a stricter one is sure of too.
TEST(ExhaustiveDepthOracle, ProfilesNest) {
    for (uint64_t seed = 1; seed <= 150; ++seed) {
        RandomDepth random(seed + 1000);
        const cases::Case c = random.next();
        const Expectation loose = expect(c, Limits{}, cases::Profile::vulkan);
        const Expectation middle = expect(c, Limits{}, cases::Profile::practice);
        const Expectation strict = expect(c, Limits{}, cases::Profile::direct3d);
        for (size_t k = 0; k < loose.samples.size(); ++k) {
            const HitBounds& a = loose.samples[k].hits;
            const HitBounds& b = middle.samples[k].hits;
            const HitBounds& d = strict.samples[k].hits;
            ASSERT_TRUE(a.total_min <= b.total_min && b.total_max <= a.total_max) << seed;
            ASSERT_TRUE(b.total_min <= d.total_min && d.total_max <= b.total_max) << seed;
        }
    }
}

TEST(ExhaustiveDepthOracle, VerdictsAgree) {
    uint64_t accepted = 0, rejected = 0;
    for (uint64_t seed = 1; seed <= 60; ++seed) {
        RandomDepth random(seed);
        const cases::Case c = random.next();
        std::mt19937_64 noise(seed);
        const Expectation e = expect(c, Limits{}, cases::Profile::direct3d);
        for (const cases::Profile profile : cases::kProfiles) {
            ValueReference fast(c, Limits{}, profile);
            ValueReference slow(c, Limits{}, profile);
            for (size_t k = 0; k < e.samples.size(); k += 4) {
                const SampleExpectation& s = e.samples[k];
                if (s.writers_count == 0) {
                    continue;
                }
                const size_t pixel = k / c.target.samples;
                const cases::SampleId id{static_cast<uint32_t>(pixel % 8),
                                         static_cast<uint32_t>(pixel / 8),
                                         static_cast<uint32_t>(k % c.target.samples)};
                const uint32_t t = e.writers[s.writers_begin];
                FragmentValues device = value_test::rounded(fast.expected(t, id));
                device.frag_coord.x = static_cast<float>(id.x) + 0.5F;
                device.frag_coord.y = static_cast<float>(id.y) + 0.5F;
                const double sizes[] = {0, 0x1p-23, 0x1p-16, 0x1p-12, 0x1p-6};
                const double size = sizes[noise() % 5];
                const double off = static_cast<double>(noise() % 9) - 4;
                device.depth = static_cast<float>(static_cast<double>(device.depth) + off * size);
                // FragCoord.z between its plane and what the bias makes of it, or a little off.
                const double shares[] = {0, 0, 0.5, 1, 1};
                const double share = shares[noise() % 5];
                const double z = static_cast<double>(device.frag_coord.z);
                device.frag_coord.z = static_cast<float>(
                    z + share * (static_cast<double>(device.depth) - z) + off * size * share);
                for (const FragmentPart part :
                     {FragmentPart::all, FragmentPart::all_but_depth, FragmentPart::depth}) {
                    const FragmentVerdict a = fast.judge(t, id, device, part);
                    const FragmentVerdict b = slow.judge_exact(t, id, device, part);
                    ASSERT_EQ(a.ok, b.ok) << "seed " << seed << " sample " << k;
                    (a.ok ? accepted : rejected) += 1;
                }
            }
        }
    }
    EXPECT_GT(accepted, 1000U);
    EXPECT_GT(rejected, 300U);
}

}  // namespace
}  // namespace ref::test
