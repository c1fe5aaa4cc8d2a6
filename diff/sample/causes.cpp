// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/sample/causes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace diff {

using ref::Coverage;
using ref::ReasonKind;
using ref::TriangleExplanation;

namespace {

std::string name_of(const TriangleExplanation& t) {
    return fmt::format("triangle {} of draw {}", t.triangle.primitive, t.triangle.draw);
}

// Whether a triangle's fragment cannot pass the test, and reaches no later one.
bool fails_bounds(const TriangleExplanation& t) {
    return t.fate && t.fate->fails_bounds && !t.fate->is_tested();
}
bool fails_stencil(const TriangleExplanation& t) {
    return t.fate && t.fate->fails && !t.fate->passes && !t.fate->fails_depth;
}

}  // namespace

const TriangleExplanation* Causes::first_that(const Fits& fits) const {
    const auto it = std::find_if(reasons_.triangles.begin(), reasons_.triangles.end(), fits);
    return it == reasons_.triangles.end() ? nullptr : &*it;
}

const TriangleExplanation* Causes::last_that(const Fits& fits) const {
    const auto& all = reasons_.triangles;
    const auto it = std::find_if(all.rbegin(), all.rend(), fits);
    return it == all.rend() ? nullptr : &*it;
}

const TriangleExplanation* Causes::first_with(Coverage coverage) const {
    return first_that([&](const auto& t) { return t.decision.coverage == coverage; });
}

// A triangle that the top-left rule decides: if there is one, one that it gives the sample to
// (takes it from).
const TriangleExplanation* Causes::first_tie(bool is_given) const {
    const ReasonKind asked = is_given ? ReasonKind::top_left_in : ReasonKind::top_left_out;
    const TriangleExplanation* const t =
        first_that([&](const auto& e) { return e.why() == asked; });
    return t ? t : first_that([](const auto& e) { return e.is_tie(); });
}

Cause Causes::of(const TriangleExplanation& t) const {
    return {ref::rule_of(t.why(), level_), [this, &t] {
                return fmt::format("{}: {}", name_of(t), explainer_.sentence(t, sample_));
            }};
}

std::optional<Cause> Causes::told(const TriangleExplanation* t) const {
    return t ? std::optional<Cause>(of(*t)) : std::nullopt;
}

Cause Causes::of(const ref::FixedSet& set) const {
    return {ref::rule_of(set.why, level_), [this, &set] { return explainer_.sentence(set); }};
}

Cause Causes::of(ReasonKind why, const std::string& triangle, uint32_t number) const {
    return {ref::rule_of(why, level_), [why, triangle, number] {
                return fmt::format(fmt::runtime(ref::text_of(why)), fmt::arg("triangle", triangle),
                                   fmt::arg("number", number));
            }};
}

// A triangle that would cover the sample but for the state of its draw, or for planes and
// distances: why it must not. A draw to another layer comes last: any other cause says more.
std::optional<Cause> Causes::of_suppressed(const Fits& fits) const {
    const auto is_suppressed = [&](const auto& t) { return t.is_suppressed() && fits(t); };
    const TriangleExplanation* t = first_that(
        [&](const auto& e) { return is_suppressed(e) && e.why() != ReasonKind::other_layer; });
    t = t ? t : first_that(is_suppressed);
    return told(t);
}

std::optional<Cause> Causes::of_tie() const {
    const TriangleExplanation* const t = first_tie(true);
    return told(t);
}

Cause Causes::of_facing() const {
    const TriangleExplanation* const t = first_with(Coverage::must);
    if (t == nullptr) {
        return of(ReasonKind::area_sign);
    }
    return {ref::rule_of(ReasonKind::area_sign, level_), [t] {
                return fmt::format("{}: {}", name_of(*t), ref::text_of(ReasonKind::area_sign));
            }};
}

std::optional<Cause> Causes::of_stray_writer(
    const std::function<bool(const cases::Triangle&)>& wrote) const {
    const auto is_writer = [&](const auto& t) { return wrote(t.triangle); };
    const TriangleExplanation* const first = first_that(is_writer);
    if (first == nullptr || first_that([&](const auto& t) {
                                return is_writer(t) && t.decision.coverage != Coverage::must_not;
                            }) != nullptr) {
        return std::nullopt;
    }
    if (std::optional<Cause> cause = of_suppressed(is_writer)) {
        return cause;
    }
    return of(*first);
}

Cause Causes::of_test(ReasonKind why, const TriangleExplanation& t) const {
    return {ref::rule_of(why, cases::Profile::vulkan), [this, why, &t] {
                return fmt::format("{} {}", name_of(t),
                                   why == ReasonKind::bounds_test ? explainer_.bounds_sentence(t)
                                   : why == ReasonKind::stencil_test
                                       ? explainer_.stencil_sentence(t)
                                       : explainer_.depth_sentence(t, sample_));
            }};
}

std::optional<Cause> Causes::of_last_hit(
    const std::function<bool(const cases::Triangle&)>& wrote) const {
    const TriangleExplanation* first = nullptr;
    for (const TriangleExplanation& t : reasons_.triangles) {
        if (!wrote(t.triangle)) {
            continue;
        }
        const bool may_hit = t.decision.coverage != Coverage::must_not &&
                             (!t.fate || t.fate->passes) &&
                             (!t.depth || *t.depth != ref::DepthOutcome::fails);
        if (may_hit) {
            return std::nullopt;
        }
        first = first == nullptr ? &t : first;
    }
    if (first == nullptr) {
        return std::nullopt;
    }
    const TriangleExplanation& t = *first;
    if (t.decision.coverage == Coverage::must_not) {
        // A looser profile lets it cover the sample: that is a question of positions.
        const bool is_told =
            (level_ == cases::Profile::vulkan && t.why() != ReasonKind::other_layer) ||
            t.why() == ReasonKind::no_alpha;
        return is_told ? std::optional<Cause>(of(t)) : std::nullopt;
    }
    if (fails_bounds(t) || fails_stencil(t)) {
        return of_test(fails_bounds(t) ? ReasonKind::bounds_test : ReasonKind::stencil_test, t);
    }
    return t.depth == ref::DepthOutcome::fails ? std::optional<Cause>(of_test(t.depth_reason, t))
                                               : std::nullopt;
}

std::optional<Cause> Causes::of_earlier_hit(uint32_t draw) const {
    // A looser profile lets it cover the sample: that is a question of positions.
    return level_ != cases::Profile::vulkan
               ? std::nullopt
               : of_suppressed([draw](const TriangleExplanation& t) {
                     return t.triangle.draw < draw && t.why() != ReasonKind::other_layer;
                 });
}

std::optional<Cause> Causes::of_depth(bool is_missing) const {
    const ref::DepthOutcome asked =
        is_missing ? ref::DepthOutcome::passes : ref::DepthOutcome::fails;
    const TriangleExplanation* const found = last_that([&](const auto& t) {
        return t.depth == asked && (!is_missing || t.decision.coverage == Coverage::must);
    });
    // Without a test nothing can have been lost to it.
    const bool is_tested = first_that([&](const auto& t) {
        return t.depth && case_.draws[t.triangle.draw].depth.compare != cases::CompareOp::always;
    });
    return found && is_tested ? std::optional<Cause>(of_test(found->depth_reason, *found))
                              : std::nullopt;
}

std::optional<Cause> Causes::of_bounds(bool is_missing) const {
    const TriangleExplanation* const found = last_that([&](const auto& t) {
        return t.fate && case_.target.has_depth && case_.draws[t.triangle.draw].depth.bounds &&
               (is_missing ? t.fate->always_passes() : fails_bounds(t));
    });
    return found ? std::optional<Cause>(of_test(ReasonKind::bounds_test, *found)) : std::nullopt;
}

std::optional<Cause> Causes::of_stencil(bool is_missing) const {
    const TriangleExplanation* const found = last_that([&](const auto& t) {
        const cases::StencilState& state = case_.draws[t.triangle.draw].stencil;
        return t.fate && (is_missing ? t.fate->always_passes() : fails_stencil(t)) &&
               (state.front.compare != cases::CompareOp::always ||
                state.back.compare != cases::CompareOp::always);
    });
    return found ? std::optional<Cause>(of_test(ReasonKind::stencil_test, *found)) : std::nullopt;
}

namespace {
// Whether a conservative triangle must not cover the sample for its area.
bool is_kept_by_area(const TriangleExplanation& t) {
    return t.why() == ReasonKind::beyond_size || t.why() == ReasonKind::unfilled_pixel ||
           t.why() == ReasonKind::degenerate_culled;
}

// A triangle that covers the sample, but for alpha to coverage.
bool is_without_alpha(const TriangleExplanation& t) {
    return t.is_suppressed() && t.why() == ReasonKind::no_alpha;
}
}  // namespace

std::optional<Cause> Causes::of_lost(uint32_t triangle) const {
    const TriangleExplanation* const t = first_that([&](const auto& e) {
        return e.index == triangle && e.decision.coverage == Coverage::must;
    });
    return told(t);
}

std::optional<Cause> Causes::of_another(uint32_t triangle) const {
    const TriangleExplanation* const like =
        first_that([&](const auto& e) { return e.index == triangle; });
    const TriangleExplanation* const t = first_that([&](const auto& e) {
        return like != nullptr && e.triangle.draw == like->triangle.draw &&
               case_.draws[e.triangle.draw].color.attribute < 0 &&
               e.decision.coverage == Coverage::must_not;
    });
    return told(t);
}

Cause Causes::of_extra() const {
    if (reasons_.of_all) {
        const TriangleExplanation* const t = first_that(
            [&](const auto& e) { return e.is_suppressed() && e.why() == *reasons_.of_all; });
        if (t && *reasons_.of_all != ReasonKind::other_layer) {
            return of(*t);
        }
        return {ref::rule_of(*reasons_.of_all, level_),
                [this] { return std::string(ref::text_of_all(*reasons_.of_all)); }};
    }
    if (level_ == cases::Profile::direct3d) {
        const TriangleExplanation* const t = first_that([](const auto& e) {
            return is_without_alpha(e) || e.why() == ReasonKind::top_left_out ||
                   e.why() == ReasonKind::no_area || is_kept_by_area(e);
        });
        return t ? of(*t) : of(ReasonKind::nearest_positions);
    }
    if (const std::optional<Cause> cause = of_suppressed([](const auto&) { return true; })) {
        return *cause;
    }
    const TriangleExplanation* const t = first_with(Coverage::must_not);
    return t ? of(*t) : of(ReasonKind::none_near);
}

Cause Causes::of_count(uint32_t total, bool is_missing) const {
    const auto& sets = reasons_.sets;
    uint32_t must = 0, may = 0, pieces = 0;
    for (const TriangleExplanation& t : reasons_.triangles) {
        must += t.decision.coverage == Coverage::must ? 1U : 0U;
        may += t.decision.coverage != Coverage::must_not ? 1U : 0U;
        pieces += t.decision.further;
    }
    may += pieces;
    const TriangleExplanation* const covering = first_with(Coverage::must);
    if (level_ == cases::Profile::direct3d) {
        const TriangleExplanation* t = first_that([&](const auto& e) {
            return is_missing ? e.why() == ReasonKind::kept_by_alpha : is_without_alpha(e);
        });
        t = t ? t : first_tie(is_missing);
        t = t || is_missing ? t : first_that(is_kept_by_area);
        t = t ? t : covering;
        return t ? of(*t) : !sets.empty() ? of(sets[0].set) : of(ReasonKind::nearest_positions);
    }
    if (total >= must && total <= may) {
        // Each triangle alone would allow it: what is broken is the number that some share, or the
        // faces that they show.
        return sets.empty() ? of(ReasonKind::area_sign) : of(sets[0].set);
    }
    if (total < must) {
        return of(*covering);
    }
    if (const std::optional<Cause> cause = of_suppressed([](const auto&) { return true; })) {
        return *cause;
    }
    // Whichever hit it once more: one that lies elsewhere, or one of these again.
    if (may == 1) {
        const TriangleExplanation* const t =
            first_that([](const auto& e) { return e.decision.coverage != Coverage::must_not; });
        return of(ReasonKind::once_alone, name_of(*t));
    }
    return of(may == 0     ? ReasonKind::none_may
              : pieces > 0 ? ReasonKind::once_pieces
                           : ReasonKind::once_each,
              "", may);
}

}  // namespace diff
