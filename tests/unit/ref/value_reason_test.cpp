// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Every reason that is told of a wrong value decides: the value is right once it is taken away. On
// some samples of a share of the leaves of the suite at every profile (share.hpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <random>

#include "cases/load/loader.hpp"
#include "cases/model/profile.hpp"
#include "folders.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"
#include "tests/share.hpp"

namespace ref::test {
namespace {

using cases::Profile;

constexpr size_t kSamples = 2;            // of a leaf at a profile
constexpr uint64_t kLargest = 1U << 20U;  // samples times triangles of a leaf

void set(FragmentValues& values, const QuantityId& id, float number) {
    const auto component = static_cast<glm::vec4::length_type>(id.component);
    if (id.is_depth()) {
        values.depth = number;
    } else if (id.is_attribute()) {
        values.attributes.at(id.attribute)[component] = number;
    } else {
        values.frag_coord[component] = number;
    }
}

FragmentValues nearest(const std::vector<ExpectedValue>& all) {
    FragmentValues values;
    for (const ExpectedValue& e : all) {
        if (e.part.empty()) {
            set(values, e.quantity, static_cast<float>(e.nearest));
        }
    }
    return values;
}

const ValueMismatch* mismatch_of(const FragmentVerdict& verdict, const QuantityId& id) {
    const auto it = std::find_if(verdict.mismatches.begin(), verdict.mismatches.end(),
                                 [&](const ValueMismatch& m) { return m.quantity == id; });
    return it == verdict.mismatches.end() ? nullptr : &*it;
}

// The same leaf in which a reason does not hold of a value; nothing where a value that is told for
// it has no such leaf.
std::optional<cases::Case> without(const cases::Case& c, const cases::Triangle& t,
                                   const ValueMismatch& m, float got) {
    cases::Case out = c;
    cases::Draw& draw = out.draws[t.draw];
    switch (m.reason) {
        case ReasonKind::value_clamped_depth:
            draw.depth.clamp = false;
            return out;
        case ReasonKind::value_biased_depth:
            draw.depth.bias.reset();
            return out;
        case ReasonKind::value_stored_depth:
            out.target.depth_format = cases::DepthFormat::d32_float;
            return out;
        case ReasonKind::value_coord_depth:
            draw.frag_depth.reset();
            return out;
        case ReasonKind::value_not_discarded:
            draw.discard = cases::Discard::none;
            return out;
        case ReasonKind::value_set_up:
        case ReasonKind::value_hull:
        case ReasonKind::value_flat:
        case ReasonKind::value_of_not_first:
        case ReasonKind::value_of_not_last:
            break;
        default:
            return std::nullopt;
    }
    // With the same value at all vertices there is nothing but it.
    if (!m.quantity.is_attribute() || !std::isfinite(got) ||
        draw.attributes[m.quantity.attribute].source != cases::Source::vertex ||
        draw.attributes[m.quantity.attribute].probe != cases::Probe::value) {
        return std::nullopt;
    }
    for (glm::vec4& v : draw.attributes[m.quantity.attribute].values) {
        v[static_cast<glm::vec4::length_type>(m.quantity.component)] = got;
    }
    return out;
}

class LeafValues {
  public:
    LeafValues(const cases::Case& c, Profile profile)
        : case_(c),
          profile_(profile),
          expectation_(expect(c, Limits{}, profile)),
          values_(c, Limits{}, profile) {}

    void check(std::map<ReasonKind, size_t>& told, std::map<ReasonKind, size_t>& taken) {
        if (expectation_.samples.size() * expectation_.triangles.size() > kLargest) {
            return;
        }
        std::mt19937 random(static_cast<uint32_t>(expectation_.samples.size()));
        std::uniform_int_distribution<size_t> any(0, expectation_.samples.size() - 1);
        size_t left = kSamples;
        for (size_t k = any(random), n = 0; n < expectation_.samples.size() && left > 0;
             ++n, k = (k + 1) % expectation_.samples.size()) {
            const SampleExpectation& s = expectation_.samples[k];
            if (s.hits.total_min > 0 && s.writers_count == 1) {
                --left;
                check_sample(expectation_.writers[s.writers_begin],
                             cases::sample_at(case_.target, k), told, taken);
            }
        }
    }

  private:
    void check_sample(uint32_t t, cases::SampleId at, std::map<ReasonKind, size_t>& told,
                      std::map<ReasonKind, size_t>& taken) {
        const std::vector<ExpectedValue> all = values_.expected(t, at);
        const FragmentValues right = nearest(all);
        if (!values_.judge(t, at, right).ok) {
            return;  // a coarse derivative's or a barycentric's nearest numbers are of no one
                     // device
        }
        const cases::Triangle& triangle = expectation_.triangles[t];
        for (const ExpectedValue& e : all) {
            if (!e.part.empty()) {
                continue;
            }
            for (const float wrong : wrong_numbers(triangle, e)) {
                FragmentValues device = right;
                set(device, e.quantity, wrong);
                const FragmentVerdict verdict = values_.judge(t, at, device);
                const ValueMismatch* const m = mismatch_of(verdict, e.quantity);
                if (m == nullptr) {
                    continue;
                }
                ++told[m->reason];
                EXPECT_FALSE(m->rule.empty());
                EXPECT_EQ(m->rule, rule_of(m->reason, m->level).empty()
                                       ? m->rule
                                       : std::string(rule_of(m->reason, m->level)));
                if (const auto other = without(case_, triangle, *m, wrong)) {
                    ValueReference reference(*other, Limits{}, profile_);
                    const FragmentVerdict now = reference.judge(t, at, device);
                    const ValueMismatch* const still = mismatch_of(now, e.quantity);
                    EXPECT_TRUE(still == nullptr || still->reason != m->reason)
                        << case_.id << " at " << to_string(profile_) << ", "
                        << cases::sample_text(case_.target, at) << ", " << to_text(e.quantity)
                        << " = " << wrong << ": " << text_of(m->reason);
                    ++taken[m->reason];
                }
            }
        }
    }

    // Numbers that somebody may take for a quantity: another vertex's, the depth of the plane
    // (neither biased nor clamped nor rounded), one beyond all vertices', one a little off.
    std::vector<float> wrong_numbers(const cases::Triangle& t, const ExpectedValue& e) const {
        const auto nearest = static_cast<float>(e.nearest);
        std::vector<float> out = {nearest + 4096, nearest * (1 + 0x1p-9F) + 0x1p-9F};
        if (e.quantity.is_depth()) {
            out.push_back(static_cast<float>(mpq_class(e.exact).get_d()));
        }
        if (e.quantity.is_attribute()) {
            const auto component = static_cast<glm::vec4::length_type>(e.quantity.component);
            const cases::Attribute& a = case_.draws[t.draw].attributes[e.quantity.attribute];
            for (size_t k = 0; k < 3 && a.source == cases::Source::vertex; ++k) {
                out.push_back(a.values[t.vertex.at(k)][component]);
            }
        }
        return out;
    }

    const cases::Case& case_;
    Profile profile_;
    Expectation expectation_;
    ValueReference values_;
};

// A vertex whose weight has another one's place.
TEST(ExhaustiveReasons, NameTheBarycentricOfAnotherVertex) {
    const cases::Suite suite = cases::load_suite(test_support::source_dir() + "/cases/suite");
    size_t seen = 0;
    for (const cases::Case& c : suite.cases) {
        if (c.blit || c.draws[0].attributes.empty() ||
            c.draws[0].attributes[0].source != cases::Source::barycentric ||
            c.draws[0].attributes[0].probe != cases::Probe::value) {
            continue;
        }
        const Expectation e = expect(c, Limits{}, Profile::direct3d);
        ValueReference values(c, Limits{}, Profile::direct3d);
        for (size_t k = 0; k < e.samples.size(); ++k) {
            const SampleExpectation& s = e.samples[k];
            if (s.hits.total_min == 0 || s.writers_count != 1) {
                continue;
            }
            const uint32_t t = e.writers[s.writers_begin];
            const cases::SampleId at = cases::sample_at(c.target, k);
            FragmentValues device = nearest(values.expected(t, at));
            glm::vec4& weights = device.attributes[0];
            if (e.triangles[t].draw != 0 || !(std::abs(weights.x - weights.y) > 0.01F)) {
                continue;
            }
            std::swap(weights.x, weights.y);
            const FragmentVerdict verdict = values.judge(t, at, device);
            const ValueMismatch* const m = mismatch_of(verdict, QuantityId::of_attribute(0, 0));
            ASSERT_NE(m, nullptr) << c.id;
            EXPECT_EQ(m->reason, ReasonKind::value_other_weight) << c.id;
            EXPECT_EQ(m->rule, "barycentric.order") << c.id;
            ++seen;
            break;
        }
    }
    EXPECT_GT(seen, 0U);
}

TEST(ExhaustiveReasons, OfValuesDecide) {
    std::map<ReasonKind, size_t> told, taken;
    const cases::Suite suite = cases::load_suite(test_support::source_dir() + "/cases/suite");
    const auto share = test_support::share_of(12, suite.cases.size());
    const auto is_shown = [&](ReasonKind kind) {
        return kind == ReasonKind::value_other_weight ||  // the test above
               (told[kind] > 0 && (kind == ReasonKind::value_exact || taken[kind] > 0));
    };
    const auto is_all_shown = [&] {
        size_t k = static_cast<size_t>(ReasonKind::value_set_up);
        while (k <= static_cast<size_t>(kLastReason) && is_shown(static_cast<ReasonKind>(k))) {
            ++k;
        }
        return k > static_cast<size_t>(kLastReason);
    };
    // Then the other leaves, until a reason that the share does not show is seen, too.
    for (const bool is_of_share : {true, false}) {
        for (const size_t index : test_support::spread(suite.cases.size())) {
            const cases::Case& c = suite.cases[index];
            for (const Profile profile : cases::kProfiles) {
                if (!c.blit && c.target.has_instruments &&
                    share.has(c.id + std::string(to_string(profile))) == is_of_share &&
                    (is_of_share || !is_all_shown())) {
                    LeafValues(c, profile).check(told, taken);
                }
            }
        }
    }
    for (size_t k = static_cast<size_t>(ReasonKind::value_set_up);
         k <= static_cast<size_t>(kLastReason); ++k) {
        const auto kind = static_cast<ReasonKind>(k);
        if (kind == ReasonKind::value_other_weight) {
            continue;  // the test above
        }
        EXPECT_GT(told[kind], 0U) << "no leaf shows reason " << k;
        EXPECT_TRUE(kind == ReasonKind::value_exact || taken[kind] > 0)
            << "reason " << k << " was never taken away";
    }
}

}  // namespace
}  // namespace ref::test
