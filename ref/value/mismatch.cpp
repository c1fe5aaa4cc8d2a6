// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is wrong with a fragment: the value, the rule that it breaks, the loosest profile that
// forbids it, and what was expected instead.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "cases/model/rule_ids.hpp"
#include "ref/number/rational.hpp"
#include "ref/value/accept/reach.hpp"
#include "ref/value/describe.hpp"
#include "ref/value/set_ups.hpp"

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

// Why stored depth must not be what the plane, which has `z` there, does not lead to; nothing if T
// cannot tell whether it was clamped.
template <class T>
std::optional<ReasonKind> depth_reason(const value::Primitive& primitive, const T& z) {
    const cases::DepthState& depth = primitive.draw->depth;
    const cases::Viewport& v = primitive.draw->viewport;
    if (depth.clamp) {
        const Answer is_inside = value::both(
            value::is_at_most(value::from_float<T>(std::min(v.min_depth, v.max_depth)), z),
            value::is_at_most(z, value::from_float<T>(std::max(v.min_depth, v.max_depth))));
        if (is_inside == Answer::unknown) {
            return std::nullopt;
        }
        if (is_inside == Answer::no) {
            return ReasonKind::value_clamped_depth;
        }
    }
    if (depth.bias) {
        return ReasonKind::value_biased_depth;
    }
    return primitive.depth_format == cases::DepthFormat::d32_float ? ReasonKind::value_set_up
                                                                   : ReasonKind::value_stored_depth;
}

}  // namespace

mpq_class value::biased_depth(const Primitive& primitive, const Basis<mpq_class>& basis,
                              const mpq_class& z, Profile profile) {
    return z + value::nominal_bias(value::make_depth_path<mpq_class>(primitive, profile), basis);
}

mpq_class value::nominal_depth(const Primitive& primitive, const Basis<mpq_class>& basis,
                               const mpq_class& z, Profile profile) {
    const auto path = value::make_depth_path<mpq_class>(primitive, profile);
    const mpq_class out = std::clamp(biased_depth(primitive, basis, z, profile),
                                     mpq_class(path.viewport.low), mpq_class(path.viewport.high));
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
    const float want = value::provoking_value(primitive, q);
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
    add_mismatch(
        value::mismatch_of(q, reason, Profile::vulkan), got,
        [&] {
            return bits_of(want) + " of the provoking vertex " +
                   std::to_string(primitive.triangle.provoking);
        },
        out);
}

void ValueReference::Impl::add_mismatch(ValueMismatch mismatch, float got,
                                        const std::function<std::string()>& expected,
                                        FragmentVerdict& out) const {
    if (!is_told || is_told(mismatch)) {
        mismatch.expected = expected();
        mismatch.got = bits_of(got);
    }
    out.mismatches.push_back(std::move(mismatch));
}

const value::SetBounds& ValueReference::Impl::bounds(uint32_t t, Profile at) {
    Loaded& triangle = load(t);
    std::optional<value::SetBounds>& slot = triangle.bounds.at(static_cast<size_t>(at));
    if (!slot) {
        // What is asked for lies in pixels that the triangle reaches, and in the target, or in
        // fragments that have some of their pixels there.
        const bool is_large = cases::has_large_fragments(*triangle.primitive.draw);
        const double beyond = is_large ? cases::kMaxFragmentSide : 0;
        const double margin = 2 + beyond;
        value::PixelBox box{0, 0, static_cast<double>(c.target.width) + beyond,
                            static_cast<double>(c.target.height) + beyond};
        if (triangle.primitive.is_projectable) {
            const auto v = value::ideal_vertices<Ball>(triangle.primitive);
            const auto shrink = [&](const value::Triple<Ball>& h, double& low, double& high) {
                const auto [least, most] =
                    std::minmax({h[0].v / v.w[0].v, h[1].v / v.w[1].v, h[2].v / v.w[2].v});
                low = std::max(low, std::floor(least) - margin);
                high = std::min(high, std::ceil(most) + margin);
            };
            shrink(v.hx, box.low_x, box.high_x);
            shrink(v.hy, box.low_y, box.high_y);
        }
        slot.emplace(candidates<Ball>(t, at), box);
    }
    return *slot;
}

std::optional<value::Range<double>> ValueReference::Impl::outer(uint32_t t, cases::SampleId id,
                                                                size_t index) {
    const value::Asked asked{quantities_of(t), load(t).primitive.is_projectable};
    return bounds(t, profile).outer(places_of_range(t, id), asked, index);
}

bool ValueReference::Impl::are_rejected(uint32_t t, cases::SampleId id,
                                        const FragmentValues& device, Profile at,
                                        const std::vector<size_t>& suspects) {
    const value::SetBounds& all = bounds(t, at);
    const auto places = value::evaluations<Ball>(fragment(t, id, at), at);
    const value::Asked asked{quantities_of(t), load(t).primitive.is_projectable, nullptr, &device};
    return std::all_of(suspects.begin(), suspects.end(), [&](size_t index) {
        return is_asked(t, index, at) && all.rejects(places, asked, index);
    });
}

std::vector<size_t> ValueReference::Impl::failing_at(uint32_t t, cases::SampleId id,
                                                     const FragmentValues& device, Profile at,
                                                     const std::vector<size_t>& suspects) {
    std::vector<size_t> only = asked(t, at);
    if (at == Profile::vulkan && !only.empty()) {
        const value::ProbePlace place = probe_place(t, id, at);
        const auto places = value::evaluations<Ball>(fragment(t, id, at), at);
        std::vector<size_t> rejected;
        // A stricter profile has accepted the others, and each value stands alone here.
        if (places.size() == 1) {
            const value::SetBounds& all = bounds(t, at);
            const value::Asked asked{quantities_of(t), load(t).primitive.is_projectable, &place,
                                     &device};
            std::erase_if(only, [&](size_t index) {
                if (std::find(suspects.begin(), suspects.end(), index) == suspects.end() ||
                    all.accepts(places.front(), asked, index)) {
                    return true;
                }
                const bool is_rejected = all.rejects(places, asked, index);
                if (is_rejected) {
                    rejected.push_back(index);
                }
                return is_rejected;
            });
            if (only.empty()) {
                return rejected;
            }
        }
        auto failing = ask_balls(t, at, [&](const value::CandidateSet<Ball>& set) {
            return failing_separately(
                set, places,
                {quantities_of(t), load(t).primitive.is_projectable, &place, &device, only});
        });
        if (failing) {
            failing->insert(failing->end(), rejected.begin(), rejected.end());
            return *std::move(failing);
        }
    }
    if (at != Profile::vulkan) {
        const auto places = value::evaluations<Ball>(fragment(t, id, at), at);
        std::optional<std::vector<size_t>> failing(std::in_place);
        for (const std::vector<size_t>& group : groups_of(t, only)) {
            if (group.empty() || !failing) {
                continue;
            }
            const auto of_group = ask_balls(t, at, [&](const value::CandidateSet<Ball>& set) {
                return failing_together(
                    set, places,
                    {quantities_of(t), load(t).primitive.is_projectable, nullptr, &device, group});
            });
            if (of_group) {
                failing->insert(failing->end(), of_group->begin(), of_group->end());
            } else {
                failing.reset();
            }
        }
        if (failing) {
            return *std::move(failing);
        }
    }
    return wide(t, id, device, at).failing;
}

// The loosest profile at which each failing value is wrong, given that one basis has to explain all
// values of the fragment. A looser profile may blame values that this one does not (they fit the
// basis that explains most); if it blames none of those that are left, they share its level.
std::vector<Profile> ValueReference::Impl::ask_levels(uint32_t t, cases::SampleId id,
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
        std::vector<size_t> left;
        for (size_t k = 0; k < failing.size(); ++k) {
            if (levels[k] > p) {
                left.push_back(failing[k]);
            }
        }
        if (are_rejected(t, id, device, p, left)) {  // so each of them is blamed, whatever else is
            for (Profile& level : levels) {
                level = std::min(level, p);
            }
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

std::vector<Profile> ValueReference::Impl::levels_of(uint32_t t, cases::SampleId id,
                                                     const FragmentValues& device,
                                                     const std::vector<size_t>& failing,
                                                     const std::vector<ReasonKind>& reasons) {
    if (!loosest_levels) {
        return ask_levels(t, id, device, failing);
    }
    std::vector<Asked*> asked;
    for (size_t k = 0; k < failing.size(); ++k) {
        asked.push_back(&(*loosest_levels)[{triangles[t].draw, failing[k], reasons[k]}]);
    }
    std::vector<Profile> levels;
    if (std::ranges::all_of(asked, [](const Asked* one) { return one->is_enough(); })) {
        std::ranges::transform(asked, std::back_inserter(levels), &Asked::loosest);
        return levels;
    }
    levels = ask_levels(t, id, device, failing);
    for (size_t k = 0; k < failing.size(); ++k) {
        ++asked[k]->values;
        asked[k]->loosest = std::min(asked[k]->loosest, levels[k]);
    }
    return levels;
}

// Why a value must not be what it is; nothing if T cannot tell.
template <class T>
std::optional<ReasonKind> ValueReference::Impl::reason_of(uint32_t t, cases::SampleId id,
                                                          const FragmentValues& device,
                                                          size_t index) {
    const value::Primitive& primitive = load(t).primitive;
    const std::vector<Quantity>& all = quantities_of(t);
    const Quantity& q = all[index];
    if (q.kind == Kind::probe) {
        return ReasonKind::value_set_up;
    }
    const value::Basis<T>& basis = unsnapped_basis<T>(t);
    if (basis.orientation == 2) {
        return std::nullopt;
    }
    const auto place = value::evaluations<T>(fragment(t, id, profile), profile).front();
    const float got = q.get(device);
    const auto g = static_cast<double>(got);
    if (q.rule == cases::rule::barycentric_value) {
        const Answer is_other = value::is_other_vertex(basis, q, all, place, profile, g);
        return is_other == Answer::unknown ? std::nullopt
               : is_other == Answer::yes   ? std::optional(ReasonKind::value_other_weight)
                                           : std::optional(ReasonKind::value_set_up);
    }
    std::optional<ReasonKind> inside = ReasonKind::value_set_up;
    double reach = 0;
    if (basis.orientation != 0) {
        const value::Valued<T> v = value::nominal_value(basis, q, place, profile);
        if (v.exists == Answer::unknown) {
            return std::nullopt;
        }
        if (v.exists == Answer::yes) {
            reach = value::nearest_double(v.reach);
            if (q.id.is_depth() && !is_plain_depth(primitive)) {
                inside = depth_reason<T>(primitive, v.value);
            }
        }
    }
    const value::Range<Ball>& hull = candidates<Ball>(t, profile).hulls[index];
    const double low = hull.low.v - hull.low.e - reach * (1 + 0x1p-30);
    const double high = hull.high.v + hull.high.e + reach * (1 + 0x1p-30);
    const bool is_moved =
        (q.id.is_depth() || q.plane == value::kPlaneDepth) && !is_plain_depth(primitive);
    return !std::isfinite(got) || (!is_moved && (g < low || g > high))
               ? std::optional(ReasonKind::value_hull)
               : inside;
}

std::string ValueReference::Impl::expected_text(uint32_t t, cases::SampleId id, const Quantity& q) {
    const value::Primitive& primitive = load(t).primitive;
    const value::Basis<mpq_class>& basis = unsnapped_basis<mpq_class>(t);
    if (q.kind == Kind::probe) {
        return value::probe_text(basis, q, probe_place(t, id, profile));
    }
    const auto places = value::evaluations<mpq_class>(fragment(t, id, profile), profile);
    const auto v = basis.orientation != 0 ? value::nominal_value(basis, q, places.front(), profile)
                                          : value::Valued<mpq_class>{};
    if (v.exists != Answer::yes) {
        const auto& place = places.front();
        const bool is_outside =
            basis.orientation != 0 &&
            (primitive.draw->conservative == cases::Conservative::overestimate ||
             !value::is_same(place.attributes, place.sample));
        return is_outside ? "any finite value" : "a value between the vertex values";
    }
    const double factor = budget_factor(profile);
    if (q.id.is_depth() && !is_plain_depth(primitive)) {
        return fmt::format("{:.9g} or near it (plane {:.9g} within {:.4g} x {:.3g})",
                           nominal_depth(primitive, basis, v.value, profile).get_d(),
                           v.value.get_d(), factor, v.budget.get_d());
    }
    std::string text =
        fmt::format("{} within {:.4g} x {:.3g}", value::number_text(v.value.get_d(), v.value),
                    factor, v.budget.get_d());
    if (q.id.of == QuantityId::Of::frag_coord) {
        for (const value::OtherCoord& other :
             value::other_coords(primitive, basis, q, places, profile)) {
            text += fmt::format(", or {:.9g} or near it {}", other.nearest, other.what);
        }
    }
    return text;
}

void ValueReference::Impl::describe(uint32_t t, cases::SampleId id, const FragmentValues& device,
                                    const value::CandidateVerdict& verdict, FragmentVerdict& out) {
    std::vector<ReasonKind> reasons;
    for (const size_t index : verdict.failing) {
        std::optional<ReasonKind> reason = reason_of<Ball>(t, id, device, index);
        reason = reason ? reason : reason_of<mpq_class>(t, id, device, index);
        reasons.push_back(reason.value());
    }
    const std::vector<Profile> levels = levels_of(t, id, device, verdict.failing, reasons);
    for (size_t k = 0; k < verdict.failing.size(); ++k) {
        const Quantity& q = quantities_of(t)[verdict.failing[k]];
        ValueMismatch m = value::mismatch_of(q, reasons[k], levels[k]);
        m.ratio = verdict.ratios[k];
        add_mismatch(
            std::move(m), q.get(device), [&] { return expected_text(t, id, q); }, out);
    }
}

}  // namespace ref
