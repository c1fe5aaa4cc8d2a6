// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/mismatch.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "cases/model/rule_ids.hpp"
#include "ref/value/accept/reach.hpp"
#include "ref/value/describe.hpp"

namespace ref::value {

using cases::Profile;

namespace {

// Why stored depth must not be what the plane, which has `z` there, does not lead to; nothing if T
// cannot tell whether it was clamped.
template <class T>
std::optional<ReasonKind> depth_reason(const Primitive& primitive, const T& z) {
    const cases::DepthState& depth = primitive.draw->depth;
    const cases::Viewport& v = primitive.draw->viewport;
    if (depth.clamp) {
        const Answer is_inside =
            both(is_at_most(from_float<T>(std::min(v.min_depth, v.max_depth)), z),
                 is_at_most(z, from_float<T>(std::max(v.min_depth, v.max_depth))));
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

// Nothing if T cannot tell.
template <class T>
std::optional<ReasonKind> reason_by(const DrawnFragment& f, size_t index) {
    SetUps& set_ups = f.set_ups;
    const Profile profile = set_ups.profile();
    const Quantity& q = f.quantities()[index];
    if (q.kind == Kind::probe) {
        return ReasonKind::value_set_up;
    }
    const Basis<T>& basis = set_ups.unsnapped_basis<T>(f.t);
    if (basis.orientation == 2) {
        return std::nullopt;
    }
    const auto place = set_ups.places<T>(f.t, f.id, profile).front();
    const auto got = static_cast<double>(q.get(f.device));
    if (q.rule == cases::rule::barycentric_value) {
        const Answer is_other = is_other_vertex(basis, q, f.quantities(), place, profile, got);
        return is_other == Answer::unknown ? std::nullopt
               : is_other == Answer::yes   ? std::optional(ReasonKind::value_other_weight)
                                           : std::optional(ReasonKind::value_set_up);
    }
    const bool is_plain = is_plain_depth(f.primitive());
    std::optional<ReasonKind> inside = ReasonKind::value_set_up;
    double reach = 0;
    if (basis.orientation != 0) {
        const Valued<T> v = nominal_value(basis, q, place, profile);
        if (v.exists == Answer::unknown) {
            return std::nullopt;
        }
        if (v.exists == Answer::yes) {
            reach = nearest_double(v.reach);
            if (q.id.is_depth() && !is_plain) {
                inside = depth_reason<T>(f.primitive(), v.value);
            }
        }
    }
    const Range<Ball>& hull = set_ups.candidates<Ball>(f.t, profile).hulls[index];
    const double low = hull.low.v - hull.low.e - reach * (1 + 0x1p-30);
    const double high = hull.high.v + hull.high.e + reach * (1 + 0x1p-30);
    const bool is_moved = (q.id.is_depth() || q.plane == kPlaneDepth) && !is_plain;
    return !std::isfinite(got) || (!is_moved && (got < low || got > high))
               ? std::optional(ReasonKind::value_hull)
               : inside;
}

}  // namespace

ValueMismatch mismatch_of(const Quantity& q, ReasonKind reason, Profile level) {
    ValueMismatch m;
    m.quantity = q.id;
    m.reason = reason;
    m.level = level;
    m.rule = rule_of(reason, level);
    m.rule = m.rule.empty() ? q.rule : m.rule;
    m.ratio = std::numeric_limits<double>::infinity();
    return m;
}

ReasonKind reason_of(const DrawnFragment& f, size_t index) {
    const std::optional<ReasonKind> reason = reason_by<Ball>(f, index);
    return reason ? *reason : reason_by<mpq_class>(f, index).value();
}

bool LoosestLevels::Asked::is_enough() const {
    constexpr size_t kOfVulkan = 16, kOfOthers = 256;
    return values >= (loosest == Profile::vulkan ? kOfVulkan : kOfOthers);
}

std::vector<Profile> LoosestLevels::of(const DrawnFragment& f, const std::vector<size_t>& failing,
                                       const std::vector<ReasonKind>& reasons) {
    std::vector<Asked*> asked;
    for (size_t k = 0; k < failing.size(); ++k) {
        asked.push_back(&asked_[{f.set_ups.draw_of(f.t), failing[k], reasons[k]}]);
    }
    std::vector<Profile> levels;
    if (std::ranges::all_of(asked, &Asked::is_enough)) {
        std::ranges::transform(asked, std::back_inserter(levels), &Asked::loosest);
        return levels;
    }
    levels = f.levels_of(failing);
    for (size_t k = 0; k < failing.size(); ++k) {
        ++asked[k]->values;
        asked[k]->loosest = std::min(asked[k]->loosest, levels[k]);
    }
    return levels;
}

}  // namespace ref::value
