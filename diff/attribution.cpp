// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/attribution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "cases/model/sample.hpp"
#include "ref/expectation/explain.hpp"

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

// The triangles whose edge or vertex the sample lies on.
struct Ties {
    size_t edges = 0, vertices = 0, clipped = 0;
    const ref::TriangleExplanation* first = nullptr;
};

Ties ties_of(const ref::SampleExplanation& s) {
    Ties ties;
    for (const ref::TriangleExplanation& t : s.triangles) {
        if (t.on_edge && t.in_layer && t.has_area && !t.culled && !t.is_discarded) {
            ++ties.edges;
            ties.vertices += t.on_vertex ? 1 : 0;
            ties.first = ties.first ? ties.first : &t;
        }
        ties.clipped += t.needs_clipping ? 1 : 0;
    }
    return ties;
}

const ref::TriangleExplanation* first_with(const ref::SampleExplanation& s,
                                           ref::Coverage coverage) {
    const auto it = std::find_if(s.triangles.begin(), s.triangles.end(),
                                 [&](const auto& t) { return t.coverage == coverage; });
    return it == s.triangles.end() ? nullptr : &*it;
}

struct Cause {
    std::string_view rule;
    std::string why;
};

// A triangle that would cover the sample but for scissor, viewport, culling or clipping: why it
// must not. A draw to another layer comes last: any other cause says more.
std::optional<Cause> cause_of_suppressed(const ref::SampleExplanation& s) {
    std::optional<Cause> other_layer;
    for (const ref::TriangleExplanation& t : s.triangles) {
        const bool negative =
            std::any_of(t.edges.begin(), t.edges.end(), [](const auto& e) { return e.value < 0; });
        const bool outside = negative || (!t.edges.empty() && !t.has_area);
        if (outside || t.coverage != ref::Coverage::must_not) {
            continue;
        }
        if (!t.in_layer) {
            other_layer = other_layer.value_or(
                Cause{"layer.select", fmt::format("{}: {}", name_of(t), t.reason)});
            continue;
        }
        if (!t.in_scissor) {
            return Cause{
                "scissor.half-open",
                fmt::format("{}: the sample lies outside its scissor rectangle", name_of(t))};
        }
        if (!t.in_mask) {
            return Cause{"sample.mask",
                         fmt::format("{}: its sample mask leaves the sample out", name_of(t))};
        }
        if (!t.in_viewport) {
            return Cause{"clip.viewport",
                         fmt::format("{}: the sample lies outside its viewport", name_of(t))};
        }
        if (t.is_discarded) {
            return Cause{"discard.rasterizer",
                         fmt::format("the draw of {} has rasterizer discard", name_of(t))};
        }
        if (t.culled) {
            return Cause{"face.cull", fmt::format("{} is culled", name_of(t))};
        }
        if (t.culled_by_distance) {
            return Cause{
                "cull.distance",
                fmt::format("a cull distance of {} is negative at all vertices", name_of(t))};
        }
        if (t.clipped_by_distance && !t.on_edge) {
            return Cause{"clip.distance",
                         fmt::format("a clip distance of {} is negative here", name_of(t))};
        }
        if (t.needs_clipping && !t.on_edge) {
            return Cause{"clip.volume", fmt::format("{} is clipped away here", name_of(t))};
        }
    }
    return other_layer;
}

// Why a sample was written last by a triangle that must not cover it; nothing if one of those that
// may have written it may.
std::optional<Cause> cause_of_stray_writer(
    const ref::SampleExplanation& s, const std::function<bool(const cases::Triangle&)>& wrote) {
    ref::SampleExplanation writers = s;
    std::erase_if(writers.triangles, [&](const auto& t) { return !wrote(t.triangle); });
    if (writers.triangles.empty() ||
        std::any_of(writers.triangles.begin(), writers.triangles.end(),
                    [](const auto& t) { return t.coverage != ref::Coverage::must_not; })) {
        return std::nullopt;
    }
    if (std::optional<Cause> cause = cause_of_suppressed(writers)) {
        return cause;
    }
    const ref::TriangleExplanation& t = writers.triangles.front();
    return Cause{"cover.outside", fmt::format("{}: {}", name_of(t), t.reason)};
}

// A hit too many of a triangle that must fail the depth test, or one too few of a triangle that
// must pass it; the number alone does not tell which, so the last one that fits is named.
std::optional<Cause> cause_of_depth(const cases::Case& c, const ref::SampleExplanation& s,
                                    bool is_missing) {
    const ref::DepthOutcome asked =
        is_missing ? ref::DepthOutcome::passes : ref::DepthOutcome::fails;
    const auto fits = [&](const ref::TriangleExplanation& t) {
        return t.depth == asked && (!is_missing || t.coverage == ref::Coverage::must);
    };
    const auto it = std::find_if(s.triangles.rbegin(), s.triangles.rend(), fits);
    // Without a test nothing can have been lost to it.
    const bool is_tested = std::any_of(s.triangles.begin(), s.triangles.end(), [&](const auto& t) {
        return t.depth && c.draws[t.triangle.draw].depth.compare != cases::CompareOp::always;
    });
    if (it == s.triangles.rend() || !is_tested) {
        return std::nullopt;
    }
    const std::string_view rule = it->depth_reason == ref::DepthReason::same    ? "depth.repeat"
                                  : it->depth_reason == ref::DepthReason::apart ? "depth.distinct"
                                                                                : "depth.compare";
    return Cause{rule, fmt::format("{} {}", name_of(*it), it->depth_text)};
}

// Too many hits at a sample that no triangle may cover.
Cause cause_of_extra(const ref::SampleExplanation& s, cases::Profile level) {
    if (!s.in_layer) {
        return {"layer.select", "no draw goes to this layer"};
    }
    if (!s.in_scissor) {
        return {"scissor.half-open", "the sample lies outside the scissor rectangle"};
    }
    if (!s.in_viewport) {
        return {"clip.viewport", "the sample lies outside the viewport"};
    }
    if (level == cases::Profile::direct3d) {
        for (const ref::TriangleExplanation& t : s.triangles) {
            if (t.on_edge && t.in_layer && t.in_scissor && t.in_mask && !t.culled) {
                return {t.has_area ? "tie.top-left" : "cover.degenerate",
                        fmt::format("{}: {}", name_of(t), t.reason)};
            }
        }
        return {"snap.nearest",
                "no vertex position within the rounding of Direct3D covers the sample"};
    }
    if (const std::optional<Cause> cause = cause_of_suppressed(s)) {
        return *cause;
    }
    const ref::TriangleExplanation* t = first_with(s, ref::Coverage::must_not);
    return {"cover.outside", t ? fmt::format("{}: {}", name_of(*t), t->reason)
                               : std::string("no triangle is within two pixels of the sample")};
}

// Too few hits, or too many where some hits are allowed.
Cause cause_of_count(const cases::Case& c, const ref::SampleExplanation& s, cases::Profile level,
                     uint32_t total) {
    const Ties ties = ties_of(s);
    uint32_t must = 0, may = 0;
    for (const ref::TriangleExplanation& t : s.triangles) {
        must += t.coverage == ref::Coverage::must ? 1U : 0U;
        may += t.coverage != ref::Coverage::must_not ? 1U : 0U;
    }
    if (level == cases::Profile::direct3d) {
        if (ties.first != nullptr) {
            return {"tie.top-left",
                    fmt::format("{}: {}", name_of(*ties.first), ties.first->reason)};
        }
        const ref::TriangleExplanation* t = first_with(s, ref::Coverage::must);
        return {"snap.nearest", t ? fmt::format("{}: {}", name_of(*t), t->reason)
                                  : std::string("the vertices' nearest subpixel positions decide")};
    }
    if (total >= must && total <= may) {
        // Each triangle alone would allow it: what is broken is that shared edges close exactly.
        if (std::any_of(s.triangles.begin(), s.triangles.end(),
                        [](const auto& t) { return t.near_distance; })) {
            return {"clip.complement",
                    "a clip distance and its negative are 0 here within their error: exactly one "
                    "side draws the sample"};
        }
        const std::string who = fmt::format("{} triangles meet here", may);
        if (level == cases::Profile::practice && ties.clipped > 0) {
            return {"cover.clipped-edge", who + " along edges they share, clipped"};
        }
        if (level == cases::Profile::practice && ties.vertices > 0) {
            return {"cover.shared-vertex", who + " in a vertex they share"};
        }
        return {"cover.shared-edge", who + " along edges they share with identical end points"};
    }
    if (total < must) {
        const ref::TriangleExplanation* t = first_with(s, ref::Coverage::must);
        // What might have removed it, but must not have: culling by distance goes first.
        if (c.draws[t->triangle.draw].distances.cull_count > 0) {
            return {"cull.distance",
                    fmt::format("{}: {}, and no cull distance is negative at all vertices",
                                name_of(*t), t->reason)};
        }
        return {t->has_distances ? "clip.distance" : "cover.inside",
                fmt::format("{}: {}{}", name_of(*t), t->reason,
                            t->has_distances ? ", and no clip distance is negative" : "")};
    }
    if (const std::optional<Cause> cause = cause_of_suppressed(s)) {
        return *cause;
    }
    // Whichever hit it once more: one that lies elsewhere, or one of these again.
    if (may == 1) {
        const auto t = std::find_if(s.triangles.begin(), s.triangles.end(), [](const auto& e) {
            return e.coverage != ref::Coverage::must_not;
        });
        return {"cover.outside",
                fmt::format("{} alone may cover the sample, and only once", name_of(*t))};
    }
    return {"cover.outside",
            may == 0 ? std::string("no triangle near the sample may cover it")
                     : fmt::format("{} triangles may cover the sample, each only once", may)};
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
        slot = ref::expect(case_, expectation_.limits, profile);
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
    const ref::SampleExplanation s =
        ref::explain_sample(case_, expectation_.limits, finding.level, sample_of(finding));
    if (finding.level == cases::Profile::vulkan) {
        // Whatever is granted, that triangle cannot have been the last. If it may not cover the
        // sample at all, that says more than the order.
        if (const std::optional<Cause> cause = cause_of_stray_writer(s, wrote)) {
            finding.rule = cause->rule;
            finding.why = cause->why;
        }
        like_writer_.insert_or_assign(finding.level, finding);
        return;
    }
    // A looser profile lets the writer cover the sample: it is a question of who owns it.
    const bool is_direct3d = finding.level == cases::Profile::direct3d;
    if (const Ties ties = ties_of(s); is_direct3d && ties.first != nullptr) {
        finding.rule = "tie.top-left";
        finding.why = fmt::format("{}: {}", name_of(*ties.first), ties.first->reason);
    } else {
        finding.rule = is_direct3d ? "snap.nearest" : "cover.outside";
        finding.why = "where the vertices snap decides which triangle covers the sample";
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
    const auto earlier = like_.find(key);
    if (explained_ >= explains_ && earlier != like_.end()) {
        finding.rule = earlier->second.rule;
        finding.quantity = earlier->second.quantity;
        finding.why = "as at " + cases::pixel_text(case_.target, sample_of(earlier->second));
        return;
    }
    explain_hits(finding, asked, front + back);
    ++explained_;
    like_.insert_or_assign(key, finding);
}

void Attribution::explain_hits(Finding& finding, const ref::HitBounds& asked,
                               uint32_t total) const {
    const ref::SampleExplanation s =
        ref::explain_sample(case_, expectation_.limits, finding.level, sample_of(finding));
    if (finding.kind == FindingKind::value) {
        if (const Ties ties = ties_of(s);
            finding.level == cases::Profile::direct3d && ties.first != nullptr) {
            finding.rule = "tie.top-left";
            finding.quantity = "facing";
            finding.why = fmt::format("{}: {}", name_of(*ties.first), ties.first->reason);
            return;
        }
        finding.rule = "face.area-sign";
        finding.quantity = "facing";
        const ref::TriangleExplanation* t = first_with(s, ref::Coverage::must);
        finding.why =
            t ? fmt::format("{}: the sign of its area decides which face shows", name_of(*t))
              : std::string("the sign of the area decides which face shows");
        return;
    }
    if (const std::optional<Cause> depth = cause_of_depth(case_, s, total < asked.total_min)) {
        finding.rule = depth->rule;
        finding.why = depth->why;
        return;
    }
    const Cause cause = asked.total_max == 0 ? cause_of_extra(s, finding.level)
                                             : cause_of_count(case_, s, finding.level, total);
    finding.rule = cause.rule;
    finding.why = cause.why;
}

}  // namespace diff
