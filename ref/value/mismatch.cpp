// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is wrong with a fragment: the value, the rule that it breaks, the loosest profile that
// forbids it, and what was expected instead.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "cases/model/rule_ids.hpp"
#include "ref/number/rational.hpp"
#include "ref/value/describe.hpp"
#include "ref/value/reference.hpp"

namespace ref {

using cases::Profile;
using value::Answer;
using value::Ball;
using value::bits_of;
using value::is_plain_depth;
using value::Kind;
using value::nominal_depth;
using value::Quantity;

namespace {

// Why stored depth must not be what the plane does not lead to.
ReasonKind depth_reason(const value::Primitive& primitive, double z) {
    const cases::DepthState& depth = primitive.draw->depth;
    const cases::Viewport& v = primitive.draw->viewport;
    const auto near = static_cast<double>(v.min_depth);
    const auto far = static_cast<double>(v.max_depth);
    if (depth.clamp && (z < std::min(near, far) || z > std::max(near, far))) {
        return ReasonKind::value_clamped_depth;
    }
    if (depth.bias) {
        return ReasonKind::value_biased_depth;
    }
    return primitive.depth_format == cases::DepthFormat::d32_float ? ReasonKind::value_set_up
                                                                   : ReasonKind::value_stored_depth;
}

}  // namespace

mpq_class value::nominal_depth(const Primitive& primitive, const Basis<mpq_class>& basis,
                               const mpq_class& z, Profile profile) {
    const auto path = value::make_depth_path<mpq_class>(primitive, profile);
    const mpq_class biased = z + value::nominal_bias(path, basis);
    const mpq_class out =
        std::clamp(biased, mpq_class(path.viewport.low), mpq_class(path.viewport.high));
    const double steps = cases::depth_steps(path.format);
    const mpq_class half(1, 2);
    return steps > 0
               ? mpq_class(floor_of(mpq_class(out * mpq_class(steps) + half))) / mpq_class(steps)
               : out;
}

void ValueReference::Impl::judge_flat(const value::Primitive& primitive, const Quantity& q,
                                      float got, FragmentVerdict& out) const {
    const auto component = static_cast<glm::vec4::length_type>(q.id.component);
    const auto& values = primitive.draw->attributes[q.id.attribute].values;
    const float want = values[primitive.triangle.provoking][component];
    const auto bits = [](float f) { return std::bit_cast<uint32_t>(f); };
    if (bits(got) == bits(want)) {
        return;
    }
    const bool zero = !(std::fabs(want) > 0) && !std::isnan(want);
    const bool got_zero = !(std::fabs(got) > 0) && !std::isnan(got);
    if (!std::isfinite(want)) {
        return;  // NaN and infinity need not arrive
    }
    if ((zero || std::fpclassify(want) == FP_SUBNORMAL) && got_zero) {
        return;  // denormals may be flushed, the sign of zero may be lost
    }
    ReasonKind reason = ReasonKind::value_flat;
    for (const uint32_t v : primitive.triangle.vertex) {
        if (v != primitive.triangle.provoking && bits(values[v][component]) == bits(got)) {
            reason = primitive.draw->provoking == cases::ProvokingVertex::first
                         ? ReasonKind::value_of_not_first
                         : ReasonKind::value_of_not_last;
        }
    }
    ValueMismatch m = value::mismatch_of(q, reason, Profile::vulkan, got);
    m.expected =
        bits_of(want) + " of the provoking vertex " + std::to_string(primitive.triangle.provoking);
    out.mismatches.push_back(std::move(m));
}

std::vector<size_t> ValueReference::Impl::failing_at(uint32_t t, cases::SampleId id,
                                                     const FragmentValues& device, Profile at,
                                                     const std::vector<size_t>& suspects) {
    std::vector<size_t> only = asked(t, at);
    if (at == Profile::vulkan && !only.empty()) {
        const value::CandidateSet<Ball>& set = candidates<Ball>(t, at);
        if (set.is_known) {
            const value::ProbePlace place = probe_place(t, id, at);
            const auto places = value::evaluations<Ball>(fragment(t, id, at), at);
            // A stricter profile has accepted the others, and each value stands alone here.
            if (places.size() == 1) {
                std::erase_if(only, [&](size_t index) {
                    return std::find(suspects.begin(), suspects.end(), index) == suspects.end();
                });
                if (only.empty()) {
                    return {};
                }
            }
            auto failing = failing_separately(
                set, places,
                {quantities_of(t), load(t).primitive.is_projectable, &place, &device, only});
            if (failing) {
                return std::move(*failing);
            }
        }
    }
    return wide(t, id, device, at).failing;
}

// The loosest profile at which each failing value is wrong, given that one basis has to explain all
// values of the fragment. A looser profile may blame values that this one does not (they fit the
// basis that explains most); if it blames none of those that are left, they share its level.
std::vector<Profile> ValueReference::Impl::levels_of(uint32_t t, cases::SampleId id,
                                                     const FragmentValues& device,
                                                     const std::vector<size_t>& failing) {
    std::vector<Profile> levels(failing.size(), profile);
    std::vector<size_t> blamed;  // by a looser profile
    for (const Profile p : cases::kProfiles) {
        const bool is_settled =
            std::all_of(levels.begin(), levels.end(), [p](Profile level) { return level < p; });
        if (p >= profile || is_settled) {
            break;
        }
        const std::vector<size_t> wrong = failing_at(t, id, device, p, failing);
        const auto is_in = [](const std::vector<size_t>& set, size_t index) {
            return std::find(set.begin(), set.end(), index) != set.end();
        };
        const bool is_new = std::any_of(wrong.begin(), wrong.end(),
                                        [&](size_t index) { return !is_in(blamed, index); });
        const bool is_shared = std::any_of(failing.begin(), failing.end(), [&](size_t index) {
            return is_in(wrong, index) && !is_in(blamed, index);
        });
        for (size_t k = 0; k < failing.size() && is_new; ++k) {
            if (!is_in(blamed, failing[k]) && (!is_shared || is_in(wrong, failing[k]))) {
                levels[k] = std::min(levels[k], p);
            }
        }
        blamed.insert(blamed.end(), wrong.begin(), wrong.end());
    }
    return levels;
}

void ValueReference::Impl::describe(uint32_t t, cases::SampleId id, const FragmentValues& device,
                                    const value::CandidateVerdict& verdict, FragmentVerdict& out) {
    const value::Primitive& primitive = load(t).primitive;
    const std::vector<Quantity>& all = quantities_of(t);
    const std::vector<Profile> levels = levels_of(t, id, device, verdict.failing);
    const auto place = value::evaluations<mpq_class>(fragment(t, id, profile), profile).front();
    const value::Basis<mpq_class>& basis = exact_basis(t);
    const value::CandidateSet<Ball>& set = candidates<Ball>(t, profile);
    for (size_t k = 0; k < verdict.failing.size(); ++k) {
        const size_t index = verdict.failing[k];
        const Quantity& q = all[index];
        const float got = q.get(device);
        ReasonKind reason = ReasonKind::value_set_up;
        std::string expected;
        double reach = 0;
        if (q.kind == Kind::probe) {
            expected = value::probe_text(basis, q, probe_place(t, id, profile));
        } else if (basis.orientation != 0) {
            const auto v = value::exact_value(basis, q, place, profile);
            if (v.exists == Answer::yes) {
                expected = fmt::format("{} within {:.4g} x {:.3g}",
                                       value::number_text(v.value.get_d(), v.value),
                                       budget_factor(profile), v.budget.get_d());
                reach = v.reach.get_d();
                if (q.id.is_depth() && !is_plain_depth(primitive)) {
                    reason = depth_reason(primitive, v.value.get_d());
                    expected =
                        fmt::format("{:.9g} or near it (plane {:.9g} within {:.4g} x {:.3g})",
                                    nominal_depth(primitive, basis, v.value, profile).get_d(),
                                    v.value.get_d(), budget_factor(profile), v.budget.get_d());
                }
            }
        }
        const value::Range<Ball>& hull = set.hulls[index];
        const double g = static_cast<double>(got);
        const double low = hull.low.v - hull.low.e - reach * (1 + 0x1p-30);
        const double high = hull.high.v + hull.high.e + reach * (1 + 0x1p-30);
        const bool is_moved =
            (q.id.is_depth() || q.plane == value::kPlaneDepth) && !is_plain_depth(primitive);
        if (q.rule == cases::rule::barycentric_value) {
            if (value::is_other_vertex(basis, q, all, place, profile, g)) {
                reason = ReasonKind::value_other_weight;
            }
        } else if (q.kind != Kind::probe &&
                   (!std::isfinite(got) || (!is_moved && (g < low || g > high)))) {
            reason = ReasonKind::value_hull;
        }
        ValueMismatch m = value::mismatch_of(q, reason, levels[k], got);
        m.expected = expected.empty() ? "a value between the vertex values" : expected;
        m.ratio = verdict.ratios[k];
        out.mismatches.push_back(std::move(m));
    }
}

}  // namespace ref
