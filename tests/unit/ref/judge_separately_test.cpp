// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The shortcuts of the wide stage against the whole of it: what fails alone, and what several
// evaluations share, and what bounds of all set-ups prove.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>

#include "ref/value/accept/failing.hpp"
#include "ref/value/accept/probe.hpp"
#include "ref/value/accept/reach.hpp"
#include "ref/value/accept/set_bounds.hpp"
#include "ref/value/places.hpp"
#include "value_case.hpp"

namespace {

using cases::Profile;
using ref::value::Ball;
using ref::value::CandidateVerdict;
using value_test::uniform;

// A random triangle with four samples, inputs of all decorations, sometimes a probe.
struct Random {
    value_test::Sampled sampled;
    ref::value::Primitive primitive;
    std::vector<ref::value::Quantity> quantities;
    ref::value::Fragment fragment;

    Random(std::mt19937_64& rng, int n, uint32_t samples = 4)
        : sampled(value_test::random_case(rng, 64, static_cast<value_test::Shape>(n % 3),
                                          n % 4 < 2 ? 0 : 4)) {
        cases::Case& c = sampled.c;
        c.target.samples = samples;
        cases::Draw& draw = c.draws[0];
        for (size_t a = 0; a < 2; ++a) {
            draw.attributes[a].auxiliary = static_cast<cases::Auxiliary>(rng() % 3);
        }
        if (n % 3 == 0) {
            draw.attributes[1].probe = n % 2 == 0 ? cases::Probe::at_sample : cases::Probe::dx_fine;
            draw.attributes[1].probe_sample = 2 % samples;
        }
        if (n % 5 == 0) {
            draw.multisample.min_sample_shading = 0.5F;
        }
        primitive = ref::value::make_primitive(c, cases::assemble(c).front());
        quantities = ref::value::quantities(draw, c.target);
        fragment.id = sampled.inside.front();
        fragment.id.sample = static_cast<uint32_t>(rng() % samples);
        fragment.target = &c.target;
        fragment.draw = &draw;
        fragment.coverage.may = (1U << samples) - 1;
        fragment.coverage.must = static_cast<uint32_t>(rng() & fragment.coverage.may);
        fragment.coverage.is_one_fragment = n % 2 == 0;
        const double x = fragment.id.x;
        const double y = fragment.id.y;
        fragment.region = {{x, y}, {x + 1, y}, {x + 1, y + 0.75}, {x + 0.25, y + 1}};
    }

    // Somewhere around the exact values, the farther the larger `spread` is, or around an end of
    // what profile vulkan allows, where the candidates differ.
    ref::FragmentValues device(std::mt19937_64& rng, double spread) const {
        ref::ValueReference reference(sampled.c, ref::Limits{}, Profile::direct3d);
        const cases::SampleId id = fragment.id;
        ref::FragmentValues out = value_test::rounded(reference.expected(0, id));
        const auto move = [&](float& v) {
            if (rng() % 3 == 0) {
                v *= static_cast<float>(1 + spread * uniform(rng, -1, 1));
            }
        };
        move(out.depth);
        move(out.frag_coord.z);
        move(out.frag_coord.w);
        ref::ValueReference loose(sampled.c, ref::Limits{}, Profile::vulkan);
        for (size_t a = 0; a < 2; ++a) {
            for (uint32_t k = 0; k < sampled.c.draws[0].attributes[a].components; ++k) {
                float& v = out.attributes[a][static_cast<int>(k)];
                const auto range = loose.range(0, id, ref::QuantityId::of_attribute(a, k));
                if (range.is_promised && rng() % 2 == 0) {
                    const double width = range.high - range.low;
                    v = static_cast<float>((rng() % 2 == 0 ? range.low : range.high) +
                                           uniform(rng, -0.01, 0.01) * width);
                } else {
                    move(v);
                }
            }
        }
        return out;
    }

    template <class T>
    ref::value::CandidateSet<T> set(Profile at) const {
        return ref::value::make_candidates<T>(primitive, quantities, ref::Limits{}, at);
    }
    ref::value::ProbePlace place(Profile at) const {
        return {fragment.id, fragment.target, fragment.draw, ref::Limits{}, at};
    }
    template <class T>
    CandidateVerdict judge(const ref::value::CandidateSet<T>& wide,
                           const std::vector<ref::value::Evaluation<T>>& evaluations, Profile at,
                           const ref::FragmentValues& device) const {
        const ref::value::ProbePlace here = place(at);
        return ref::value::judge_candidates(wide, evaluations,
                                            {quantities, primitive.is_projectable, &here, &device});
    }
};

TEST(ExhaustiveValueAlone, FailsWhatTheWholeSetFails) {
    std::mt19937_64 rng(23);
    uint32_t none = 0, some = 0, told = 0, open = 0;
    for (int n = 0; n < 15; ++n) {
        const Random r(rng, n);
        const auto balls = r.set<Ball>(Profile::vulkan);
        const auto exact = r.set<mpq_class>(Profile::vulkan);
        for (const double spread : {1e-5, 1e-3, 0.03, 1.0}) {
            const ref::FragmentValues device = r.device(rng, spread);
            const ref::value::ProbePlace place = r.place(Profile::vulkan);
            const auto failing = ref::value::failing_separately(
                balls, ref::value::evaluations<Ball>(r.fragment, Profile::vulkan),
                {r.quantities, r.primitive.is_projectable, &place, &device});
            if (!failing) {
                ++open;
                continue;
            }
            ++told;
            const auto whole =
                r.judge(exact, ref::value::evaluations<mpq_class>(r.fragment, Profile::vulkan),
                        Profile::vulkan, device);
            ASSERT_EQ(*failing, whole.failing) << n << " " << spread;
            ++(failing->empty() ? none : some);
        }
    }
    EXPECT_GT(told, 10 * open);
    EXPECT_GT(none, told / 10);
    EXPECT_GT(some, told / 10);
}

// Where one candidate has to explain all of a group: what fails of it, and the verdicts of groups
// that are judged beside the whole.
TEST(ValueAlone, FailsTogetherWhatTheWholeSetFails) {
    std::mt19937_64 rng(37);
    uint32_t none = 0, some = 0, told = 0, open = 0, grouped = 0;
    for (int n = 0; n < 180; ++n) {
        const Random r(rng, n, n % 4 == 0 ? 4 : 1);
        const bool has_probes = n % 3 == 0;
        for (const Profile at : {Profile::practice, Profile::direct3d}) {
            const auto balls = r.set<Ball>(at);
            const auto places = ref::value::evaluations<Ball>(r.fragment, at);
            const ref::FragmentValues device =
                r.device(rng, std::array{1e-5, 1e-3, 0.03, 1.0}.at(rng() % 4));
            const ref::value::ProbePlace place = r.place(at);
            const ref::value::Asked asked{r.quantities, r.primitive.is_projectable, &place,
                                          &device};
            std::array<ref::value::GroupVerdict, 2> groups;
            for (size_t k = 0; k < r.quantities.size(); ++k) {
                if (ref::value::is_numeric(r.quantities[k])) {
                    groups.at(rng() % 2).only.push_back(k);
                }
            }
            const CandidateVerdict all = ref::value::judge_candidates(balls, places, asked, groups);
            for (const ref::value::GroupVerdict& group : groups) {
                if (group.only.empty()) {
                    continue;
                }
                const auto whole =
                    ref::value::judge_candidates(balls, places, asked.of(group.only));
                const auto failing =
                    ref::value::failing_together(balls, places, asked.of(group.only));
                EXPECT_FALSE(has_probes && failing);
                if (!failing || !whole.is_known) {
                    open += has_probes ? 0U : 1U;
                    continue;
                }
                ++told;
                ASSERT_EQ(*failing, whole.failing) << n;
                ++(failing->empty() ? none : some);
                if (all.is_known && !all.ok) {
                    ++grouped;
                    ASSERT_TRUE(group.verdict.is_known) << n;
                    ASSERT_EQ(group.verdict.failing, whole.failing) << n;
                    ASSERT_EQ(group.verdict.ratios, whole.ratios) << n;
                    ASSERT_EQ(group.verdict.ok, whole.ok) << n;
                    ASSERT_EQ(group.verdict.basis, whole.basis) << n;
                    ASSERT_EQ(group.verdict.worst.ratio, whole.worst.ratio) << n;
                    ASSERT_EQ(group.verdict.worst.quantity, whole.worst.quantity) << n;
                }
            }
        }
    }
    EXPECT_GT(told, 3 * open);
    EXPECT_GT(none, told / 20);
    EXPECT_GT(some, told / 10);
    EXPECT_GT(grouped, told / 10);
}

// Without the sizes of errors a verdict names the same values, in the same order, for the same
// reasons.
TEST(ValueAlone, SaysTheSameWithoutRatios) {
    std::mt19937_64 rng(41);
    uint32_t right = 0, several = 0;
    for (int n = 0; n < 240; ++n) {
        const Random r(rng, n, n % 4 == 0 ? 4 : 1);
        const Profile profile = n % 3 == 1 ? Profile::practice : Profile::vulkan;
        ref::ValueReference with(r.sampled.c, ref::Limits{}, profile);
        ref::ValueReference without(r.sampled.c, ref::Limits{}, profile);
        without.tell_ratios(false);
        for (const double spread : {1e-5, 0.03, 1.0}) {
            ref::FragmentValues device = r.device(rng, spread);
            device.attributes[0] += glm::vec4(static_cast<float>(rng() % 3) * 30, 0, 0, 0);
            const ref::FragmentVerdict a = with.judge(0, r.fragment.id, device);
            const ref::FragmentVerdict b = without.judge(0, r.fragment.id, device);
            ASSERT_EQ(a.ok, b.ok) << n;
            ASSERT_EQ(a.mismatches.size(), b.mismatches.size()) << n;
            for (size_t k = 0; k < a.mismatches.size(); ++k) {
                const ref::ValueMismatch& one = a.mismatches[k];
                const ref::ValueMismatch& other = b.mismatches[k];
                ASSERT_EQ(one.quantity, other.quantity) << n;
                ASSERT_EQ(one.rule, other.rule) << n;
                ASSERT_EQ(one.reason, other.reason) << n;
                ASSERT_EQ(one.level, other.level) << n;
                ASSERT_EQ(one.expected, other.expected) << n;
                ASSERT_EQ(one.got, other.got) << n;
            }
            right += a.ok ? 1U : 0U;
            several += a.mismatches.size() > 1 ? 1U : 0U;
        }
    }
    EXPECT_GT(right, 20U);
    EXPECT_GT(several, 20U);
}

// The exact set, rounded, against the exact set: what its Balls tell is right, and they tell nearly
// all, one point for several inputs included (profile practice), which other Balls leave open.
TEST(ExhaustiveValueAlone, ARoundedSetSaysWhatTheExactOneSays) {
    std::mt19937_64 rng(31);
    uint32_t told = 0, open = 0, wrong = 0, more = 0;
    for (int n = 0; n < 60; ++n) {
        const Random r(rng, n, n % 2 == 0 ? 4 : 1);
        for (const Profile at : cases::kProfiles) {
            const auto exact = r.set<mpq_class>(at);
            const auto set = ref::value::rounded(exact);
            const auto balls = ref::value::evaluations<Ball>(r.fragment, at);
            const ref::FragmentValues device = r.device(rng, n % 3 == 0 ? 0.1 : 1e-5);
            const CandidateVerdict verdict = r.judge(set, balls, at, device);
            more += verdict.is_known && !r.judge(r.set<Ball>(at), balls, at, device).is_known;
            if (!verdict.is_known) {
                ++open;
                continue;
            }
            ++told;
            const CandidateVerdict whole =
                r.judge(exact, ref::value::evaluations<mpq_class>(r.fragment, at), at, device);
            ASSERT_EQ(verdict.failing, whole.failing) << n;
            ASSERT_EQ(verdict.ok, whole.ok) << n;
            wrong += whole.ok ? 0U : 1U;
        }
    }
    EXPECT_GT(told, 20 * open);
    EXPECT_GT(wrong, told / 10);
    EXPECT_LT(wrong, told);
    EXPECT_GT(more, 0U);
}

// Evaluations judged together against each of them alone, where nothing can be shared.
TEST(ExhaustiveValueAlone, EvaluationsShareWhatIsTheSame) {
    std::mt19937_64 rng(29);
    uint32_t compared = 0, wrong = 0, several = 0;
    for (int n = 0; n < 240; ++n) {
        const Random r(rng, n);
        for (const Profile at : cases::kProfiles) {
            const auto set = r.set<Ball>(at);
            const auto evaluations = ref::value::evaluations<Ball>(r.fragment, at);
            const ref::FragmentValues device = r.device(rng, n % 2 == 0 ? 1e-3 : 0.1);
            std::optional<CandidateVerdict> best;
            bool is_known = true;
            for (const auto& where : evaluations) {
                CandidateVerdict one = r.judge(set, {where}, at, device);
                is_known = is_known && one.is_known;
                if (!best || one.failing.size() < best->failing.size() ||
                    (one.failing.size() == best->failing.size() &&
                     one.worst.ratio < best->worst.ratio)) {
                    best = std::move(one);
                }
                if (best->ok && best->worst.ratio <= 1) {
                    break;
                }
            }
            const CandidateVerdict all = r.judge(set, evaluations, at, device);
            ASSERT_EQ(all.is_known, is_known) << n;
            if (!is_known) {
                continue;
            }
            ASSERT_EQ(all.failing, best->failing) << n;
            ASSERT_EQ(all.ratios, best->ratios) << n;
            ASSERT_EQ(all.worst.ratio, best->worst.ratio) << n;
            ASSERT_EQ(all.worst.quantity, best->worst.quantity) << n;
            ++compared;
            wrong += all.ok ? 0U : 1U;
            several += evaluations.size() > 2 ? 1U : 0U;
        }
    }
    EXPECT_GT(compared, 300U);
    EXPECT_GT(wrong, compared / 10);
    EXPECT_LT(wrong, compared);
    EXPECT_GT(several, compared / 10);
}

// What the bounds of all set-ups reject or accept, rationals reject or accept, too; and they leave
// little open of what is far off.
TEST(ExhaustiveValueAlone, BoundsOfAllSetUpsProveWhatTheyDecide) {
    std::mt19937_64 rng(31);
    uint32_t far = 0, far_rejected = 0, rejected = 0, accepted = 0;
    for (int n = 0; n < 180; ++n) {
        const Random r(rng, n, n % 4 == 0 ? 4 : 1);
        const double x = r.fragment.id.x;
        const double y = r.fragment.id.y;
        const ref::value::PixelBox box = n % 2 == 0
                                             ? ref::value::PixelBox{0, 0, 64, 64}
                                             : ref::value::PixelBox{x - 1, y - 1, x + 2, y + 2};
        for (const Profile at : cases::kProfiles) {
            const auto balls = r.set<Ball>(at);
            const ref::value::SetBounds bounds(balls, box);
            const auto exact = r.set<mpq_class>(at);
            const auto evaluations = ref::value::evaluations<Ball>(r.fragment, at);
            const auto exactly = ref::value::evaluations<mpq_class>(r.fragment, at);
            const ref::value::ProbePlace place = r.place(at);
            const double spread = std::array{1e-5, 1e-3, 0.1, 30.0}.at(rng() % 4);
            const ref::FragmentValues device = r.device(rng, spread);
            const ref::value::Asked asked{r.quantities, r.primitive.is_projectable, &place,
                                          &device};
            for (size_t k = 0; k < r.quantities.size(); ++k) {
                if (!ref::value::is_numeric(r.quantities[k])) {
                    EXPECT_FALSE(bounds.rejects(evaluations, asked, k));
                    continue;
                }
                const bool is_rejected = bounds.rejects(evaluations, asked, k);
                const bool is_accepted = at == Profile::vulkan && evaluations.size() == 1 &&
                                         bounds.accepts(evaluations.front(), asked, k);
                const bool is_far = spread > 1;
                const bool is_near = spread < 1e-4 && at == Profile::vulkan;
                if (!is_rejected && !is_accepted && !is_far && !is_near && rng() % 4 != 0) {
                    continue;
                }
                const std::array<size_t, 1> only{k};
                const auto whole = ref::value::judge_candidates(exact, exactly, asked.of(only));
                ASSERT_FALSE(is_rejected && whole.ok) << n << " " << to_text(r.quantities[k].id);
                ASSERT_FALSE(is_accepted && !whole.ok) << n << " " << to_text(r.quantities[k].id);
                rejected += is_rejected ? 1U : 0U;
                accepted += is_accepted ? 1U : 0U;
                far += is_far && !whole.ok ? 1U : 0U;
                far_rejected += is_far && is_rejected ? 1U : 0U;
            }
        }
    }
    EXPECT_GT(far, 50U);
    EXPECT_GT(far_rejected, far / 2);
    EXPECT_GT(rejected, 100U);
    EXPECT_GT(accepted, 100U);
}

}  // namespace
