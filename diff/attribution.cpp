// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/attribution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "cases/model/sample.hpp"
#include "ref/expectation/explain.hpp"
#include "ref/reason/reason.hpp"

namespace diff {

namespace {

std::string range(uint32_t low, uint32_t high) {
    if (low == high) {
        return fmt::format("{}", low);
    }
    return high == low + 1 ? fmt::format("{} or {}", low, high)
                           : fmt::format("{} to {}", low, high);
}

std::string hits_text(uint32_t front, uint32_t back, bool by_face) {
    return by_face ? fmt::format("{} front, {} back", front, back)
                   : fmt::format("{}", front + back);
}

bool faces_matter(const ref::HitBounds& b, uint32_t front, uint32_t back) {
    return (b.front_max > 0 || front > 0) && (b.back_max > 0 || back > 0);
}

std::string name_of(const ref::TriangleExplanation& t) {
    return fmt::format("triangle {} of draw {}", t.triangle.primitive, t.triangle.draw);
}

std::string told(const ref::TriangleExplanation& t) {
    return fmt::format("{}: {}", name_of(t), t.sentence);
}

template <class Fits>
const ref::TriangleExplanation* first_that(const ref::SampleExplanation& s, Fits fits) {
    const auto it = std::find_if(s.triangles.begin(), s.triangles.end(), fits);
    return it == s.triangles.end() ? nullptr : &*it;
}

const ref::TriangleExplanation* first_with(const ref::SampleExplanation& s,
                                           ref::Coverage coverage) {
    return first_that(s, [&](const auto& t) { return t.decision.coverage == coverage; });
}

// A triangle that the top-left rule decides: if there is one, one that it gives the sample to
// (takes it from).
const ref::TriangleExplanation* first_tie(const ref::SampleExplanation& s, bool is_given) {
    const auto asked = is_given ? ref::ReasonKind::top_left_in : ref::ReasonKind::top_left_out;
    const auto* const t = first_that(s, [&](const auto& e) { return e.why() == asked; });
    return t ? t : first_that(s, [](const auto& e) { return e.is_tie(); });
}

struct Cause {
    std::string_view rule;
    std::string why;
};

void tell(Finding& finding, const Cause& cause) {
    finding.rule = cause.rule;
    finding.why = cause.why;
}

Cause cause_of(const ref::TriangleExplanation& t, cases::Profile level) {
    return {ref::rule_of(t.why(), level), told(t)};
}

Cause cause_of(const ref::SetExplanation& s, cases::Profile level) {
    return {ref::rule_of(s.set.why, level), s.sentence};
}

// A reason of the sample as a whole: `triangle` and `number` are those that its sentence names.
Cause cause_of(ref::ReasonKind why, cases::Profile level, const std::string& triangle = "",
               uint32_t number = 0) {
    return {ref::rule_of(why, level),
            fmt::format(fmt::runtime(ref::text_of(why)), fmt::arg("triangle", triangle),
                        fmt::arg("number", number))};
}

// A triangle that would cover the sample but for the state of its draw, or for planes and
// distances: why it must not. A draw to another layer comes last: any other cause says more.
std::optional<Cause> cause_of_suppressed(const ref::SampleExplanation& s, cases::Profile level) {
    const auto is_here = [](const auto& t) {
        return t.is_suppressed() && t.why() != ref::ReasonKind::other_layer;
    };
    const ref::TriangleExplanation* t = first_that(s, is_here);
    t = t ? t : first_that(s, [](const auto& e) { return e.is_suppressed(); });
    return t ? std::optional<Cause>(cause_of(*t, level)) : std::nullopt;
}

// Why a sample was written last by a triangle that must not cover it; nothing if one of those that
// may have written it may.
std::optional<Cause> cause_of_stray_writer(
    const ref::SampleExplanation& s, const std::function<bool(const cases::Triangle&)>& wrote) {
    ref::SampleExplanation writers = s;
    std::erase_if(writers.triangles, [&](const auto& t) { return !wrote(t.triangle); });
    if (writers.triangles.empty() ||
        std::any_of(writers.triangles.begin(), writers.triangles.end(),
                    [](const auto& t) { return t.decision.coverage != ref::Coverage::must_not; })) {
        return std::nullopt;
    }
    if (std::optional<Cause> cause = cause_of_suppressed(writers, cases::Profile::vulkan)) {
        return cause;
    }
    return cause_of(writers.triangles.front(), cases::Profile::vulkan);
}

// A hit too many of a triangle that must fail the depth test, or one too few of a triangle that
// must pass it; the number alone does not tell which, so the last one that fits is named.
std::optional<Cause> cause_of_depth(const cases::Case& c, const ref::SampleExplanation& s,
                                    bool is_missing) {
    const ref::DepthOutcome asked =
        is_missing ? ref::DepthOutcome::passes : ref::DepthOutcome::fails;
    const auto fits = [&](const ref::TriangleExplanation& t) {
        return t.depth == asked && (!is_missing || t.decision.coverage == ref::Coverage::must);
    };
    const auto it = std::find_if(s.triangles.rbegin(), s.triangles.rend(), fits);
    // Without a test nothing can have been lost to it.
    const bool is_tested = std::any_of(s.triangles.begin(), s.triangles.end(), [&](const auto& t) {
        return t.depth && c.draws[t.triangle.draw].depth.compare != cases::CompareOp::always;
    });
    if (it == s.triangles.rend() || !is_tested) {
        return std::nullopt;
    }
    return Cause{ref::rule_of(it->depth_reason, cases::Profile::vulkan),
                 fmt::format("{} {}", name_of(*it), it->depth_text)};
}

// Too many hits at a sample that no triangle may cover.
Cause cause_of_extra(const ref::SampleExplanation& s, cases::Profile level) {
    if (s.of_all) {
        const auto* const t =
            first_that(s, [&](const auto& e) { return e.is_suppressed() && e.why() == *s.of_all; });
        if (t && *s.of_all != ref::ReasonKind::other_layer) {
            return cause_of(*t, level);
        }
        return {ref::rule_of(*s.of_all, level), std::string(ref::text_of_all(*s.of_all))};
    }
    if (level == cases::Profile::direct3d) {
        const auto* const t = first_that(s, [](const auto& e) {
            return e.why() == ref::ReasonKind::top_left_out || e.why() == ref::ReasonKind::no_area;
        });
        return t ? cause_of(*t, level) : cause_of(ref::ReasonKind::nearest_positions, level);
    }
    if (const std::optional<Cause> cause = cause_of_suppressed(s, level)) {
        return *cause;
    }
    const ref::TriangleExplanation* t = first_with(s, ref::Coverage::must_not);
    return t ? cause_of(*t, level) : cause_of(ref::ReasonKind::none_near, level);
}

// Too few hits, or too many where some hits are allowed.
Cause cause_of_count(const ref::SampleExplanation& s, cases::Profile level, uint32_t total,
                     bool is_missing) {
    uint32_t must = 0, may = 0;
    for (const ref::TriangleExplanation& t : s.triangles) {
        must += t.decision.coverage == ref::Coverage::must ? 1U : 0U;
        may += t.decision.coverage != ref::Coverage::must_not ? 1U : 0U;
    }
    const ref::TriangleExplanation* const covering = first_with(s, ref::Coverage::must);
    if (level == cases::Profile::direct3d) {
        const ref::TriangleExplanation* t = first_tie(s, is_missing);
        t = t ? t : covering;
        return t                 ? cause_of(*t, level)
               : !s.sets.empty() ? cause_of(s.sets[0], level)
                                 : cause_of(ref::ReasonKind::nearest_positions, level);
    }
    if (total >= must && total <= may) {
        // Each triangle alone would allow it: what is broken is the number that some share, or the
        // faces that they show.
        return s.sets.empty() ? cause_of(ref::ReasonKind::area_sign, level)
                              : cause_of(s.sets[0], level);
    }
    if (total < must) {
        return cause_of(*covering, level);
    }
    if (const std::optional<Cause> cause = cause_of_suppressed(s, level)) {
        return *cause;
    }
    // Whichever hit it once more: one that lies elsewhere, or one of these again.
    if (may == 1) {
        const auto* const t = first_that(
            s, [](const auto& e) { return e.decision.coverage != ref::Coverage::must_not; });
        return cause_of(ref::ReasonKind::once_alone, level, name_of(*t));
    }
    return cause_of(may == 0 ? ref::ReasonKind::none_may : ref::ReasonKind::once_each, level, "",
                    may);
}

}  // namespace

std::string to_text(const ref::HitBounds& b) {
    if (b.front_max > 0 && b.back_max > 0) {
        return fmt::format(
            "{} front, {} back{}", range(b.front_min, b.front_max), range(b.back_min, b.back_max),
            b.is_decided() ? "" : fmt::format(" ({} in all)", range(b.total_min, b.total_max)));
    }
    return range(b.total_min, b.total_max);
}

const ref::Expectation& Attribution::at(cases::Profile profile) {
    if (profile == expectation_.profile) {
        return expectation_;
    }
    std::optional<ref::Expectation>& slot = looser_[static_cast<size_t>(profile)];
    if (!slot) {
        slot = explainer(profile).expectation();
    }
    return *slot;
}

ref::Explainer& Attribution::explainer(cases::Profile level) {
    std::optional<ref::Explainer>& slot = explainers_[static_cast<size_t>(level)];
    if (!slot) {
        slot.emplace(case_, expectation_.limits, level);
    }
    return *slot;
}

size_t Attribution::index_of(const Finding& finding) const {
    return cases::index_of(case_.target, sample_of(finding));
}

void Attribution::level_hits(Finding& finding, uint32_t front, uint32_t back) {
    const size_t index = index_of(finding);
    finding.level = expectation_.profile;
    for (const cases::Profile profile : cases::kProfiles) {
        if (profile <= expectation_.profile &&
            !at(profile).samples[index].hits.allows(front, back)) {
            finding.level = profile;
            break;
        }
    }
}

void Attribution::attribute_writer(Finding& finding,
                                   const std::function<bool(const cases::Triangle&)>& wrote) {
    const size_t index = index_of(finding);
    finding.level = expectation_.profile;
    for (const cases::Profile profile : cases::kProfiles) {
        const ref::Expectation& e = at(std::min(profile, expectation_.profile));
        const ref::SampleExpectation& s = e.samples[index];
        const auto begin = e.writers.begin() + s.writers_begin;
        if (std::none_of(begin, begin + s.writers_count,
                         [&](uint32_t t) { return wrote(e.triangles[t]); })) {
            finding.level = std::min(profile, expectation_.profile);
            break;
        }
    }
    const auto earlier = like_writer_.find(finding.level);
    if (explained_ >= explains_ && earlier != like_writer_.end()) {
        finding.rule = earlier->second.rule;
        finding.why = fmt::format("as at pixel ({}, {})", earlier->second.x, earlier->second.y);
        return;
    }
    ++explained_;
    const ref::SampleExplanation s = explainer(finding.level).explain(sample_of(finding));
    if (finding.level == cases::Profile::vulkan) {
        // Whatever is granted, that triangle cannot have been the last. If it may not cover the
        // sample at all, that says more than the order.
        if (const std::optional<Cause> cause = cause_of_stray_writer(s, wrote)) {
            tell(finding, *cause);
        }
        like_writer_.insert_or_assign(finding.level, finding);
        return;
    }
    // A looser profile lets the writer cover the sample: it is a question of who owns it.
    const bool is_direct3d = finding.level == cases::Profile::direct3d;
    if (const auto* const tie = first_tie(s, true); is_direct3d && tie != nullptr) {
        tell(finding, cause_of(*tie, finding.level));
    } else {
        tell(finding, ref::ReasonKind::snapped_owner);
    }
    like_writer_.insert_or_assign(finding.level, finding);
}

void Attribution::attribute_hits(Finding& finding, uint32_t front, uint32_t back) {
    const size_t index = index_of(finding);
    level_hits(finding, front, back);
    const ref::HitBounds& asked = at(finding.level).samples[index].hits;
    const bool by_face = faces_matter(asked, front, back);
    finding.expected = to_text(asked);
    if (by_face && asked.is_decided()) {
        finding.expected = hits_text(asked.front_min, asked.back_min, true);
    }
    finding.got = hits_text(front, back, by_face);

    const std::string key =
        fmt::format("{} {} {}|{}", static_cast<int>(finding.kind), static_cast<int>(finding.level),
                    finding.expected, finding.got);
    const Finding* earlier = nullptr;
    const std::pair rough(finding.kind, finding.level);
    if (const auto like = like_.find(key); like != like_.end() && explained_ >= explains_) {
        earlier = &like->second;
    } else if (const auto alike = alike_.find(rough);
               alike != alike_.end() && explained_ >= kMostExplained) {
        earlier = &alike->second;
    }
    if (earlier != nullptr) {
        finding.rule = earlier->rule;
        finding.quantity = earlier->quantity;
        finding.why = "as at " + cases::pixel_text(case_.target, sample_of(*earlier));
        return;
    }
    explain_hits(finding, asked, front + back);
    ++explained_;
    like_.insert_or_assign(key, finding);
    alike_.insert_or_assign(rough, finding);
}

void Attribution::explain_hits(Finding& finding, const ref::HitBounds& asked, uint32_t total) {
    const ref::SampleExplanation s = explainer(finding.level).explain(sample_of(finding));
    if (finding.kind == FindingKind::value) {
        finding.quantity = "facing";
        if (const auto* const tie = first_tie(s, true);
            finding.level == cases::Profile::direct3d && tie != nullptr) {
            tell(finding, cause_of(*tie, finding.level));
            return;
        }
        tell(finding, ref::ReasonKind::area_sign);
        if (const ref::TriangleExplanation* t = first_with(s, ref::Coverage::must)) {
            finding.why = fmt::format("{}: {}", name_of(*t), finding.why);
        }
        return;
    }
    if (const std::optional<Cause> depth = cause_of_depth(case_, s, total < asked.total_min)) {
        tell(finding, *depth);
        return;
    }
    tell(finding, asked.total_max == 0
                      ? cause_of_extra(s, finding.level)
                      : cause_of_count(s, finding.level, total, total < asked.total_min));
}

void tell(Finding& finding, ref::ReasonKind why) {
    finding.rule = ref::rule_of(why, finding.level);
    finding.why = ref::text_of(why);
}

}  // namespace diff
