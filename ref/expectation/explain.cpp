// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ref/position/clip.hpp"

namespace ref {

namespace {

// The triangle alone, seen through a scissor of one pixel: what the reference then says of that
// pixel is the class of this triangle.
cases::Case alone(const cases::Case& c, const cases::Triangle& t, cases::SampleId sample) {
    const cases::Draw& draw = c.draws[t.draw];
    cases::Draw single;
    single.positions = {draw.positions[t.vertex[0]], draw.positions[t.vertex[1]],
                        draw.positions[t.vertex[2]]};
    single.viewport = draw.viewport;
    single.layer = draw.layer;
    single.rasterizer_discard = draw.rasterizer_discard;
    single.cull = draw.cull;
    single.depth.clamp = draw.depth.clamp;
    single.depth.clip = draw.depth.clip;
    single.depth.negative_one_to_one = draw.depth.negative_one_to_one;
    single.front_face = draw.front_face;
    single.multisample = draw.multisample;
    single.distances.clip_count = draw.distances.clip_count;
    single.distances.cull_count = draw.distances.cull_count;
    for (const uint32_t v : t.vertex) {
        if (draw.distances.clip_count > 0) {
            single.distances.clip.push_back(draw.distances.clip[v]);
        }
        if (draw.distances.cull_count > 0) {
            single.distances.cull.push_back(draw.distances.cull[v]);
        }
    }
    const auto x = static_cast<int64_t>(sample.x);
    const auto y = static_cast<int64_t>(sample.y);
    const bool inside = x >= draw.scissor.x && x < draw.scissor.x + int64_t{draw.scissor.width} &&
                        y >= draw.scissor.y && y < draw.scissor.y + int64_t{draw.scissor.height};
    single.scissor = {static_cast<int32_t>(sample.x), static_cast<int32_t>(sample.y),
                      inside ? 1U : 0U, inside ? 1U : 0U};
    cases::Case result;
    result.id = c.id;
    result.target = c.target;
    result.draws.push_back(std::move(single));
    return result;
}

mpq_class pixels(int64_t fixed) {
    mpq_class value(static_cast<long>(fixed), static_cast<long>(kFixedOne));
    value.canonicalize();
    return value;
}

// E_ab(p) in square pixels (coverage.hpp has sign and source).
mpq_class edge_function(FixedPoint a, FixedPoint b, FixedPoint p) {
    return (pixels(b.x) - pixels(a.x)) * (pixels(p.y) - pixels(a.y)) -
           (pixels(b.y) - pixels(a.y)) * (pixels(p.x) - pixels(a.x));
}

// Top-left rule's names for an edge a->b of a triangle of positive area (y down, clockwise on
// screen).
EdgeKind kind_of(FixedPoint a, FixedPoint b) {
    if (a.y == b.y) {
        return b.x > a.x ? EdgeKind::top : EdgeKind::bottom;
    }
    return b.y < a.y ? EdgeKind::left : EdgeKind::right;
}

Coverage coverage_of(const HitBounds& bounds) {
    return bounds.total_min > 0   ? Coverage::must
           : bounds.total_max > 0 ? Coverage::either
                                  : Coverage::must_not;
}

// What the distances of a triangle alone change.
void explain_distances(const cases::Case& single, const Limits& limits, cases::Profile profile,
                       size_t index, TriangleExplanation& e) {
    const cases::ClipDistances& distances = single.draws[0].distances;
    const auto without = [&](bool clip, bool cull) {
        cases::Case other = single;
        cases::ClipDistances& d = other.draws[0].distances;
        if (clip) {
            d.clip_count = 0;
            d.clip.clear();
        }
        if (cull) {
            d.cull_count = 0;
            d.cull.clear();
        }
        return coverage_of(expect(other, limits, profile).samples[index].hits);
    };
    e.has_distances = distances.clip_count > 0;
    if (distances.cull_count > 0 && e.coverage == Coverage::must_not) {
        e.culled_by_distance = without(false, true) != Coverage::must_not;
    }
    if (distances.clip_count > 0 && e.coverage != Coverage::must) {
        const Coverage whole = without(true, false);
        e.clipped_by_distance = e.coverage == Coverage::must_not && whole != Coverage::must_not;
        e.near_distance = e.coverage == Coverage::either && whole == Coverage::must;
    }
}

// Rough screen distance test that decides which triangles an explanation mentions at all.
bool is_near(const cases::Draw& draw, const cases::Triangle& t, FixedPoint p) {
    double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = HUGE_VAL, y1 = -HUGE_VAL;
    for (const uint32_t v : t.vertex) {
        const glm::vec4& clip = draw.positions[v];
        if (!is_projectable(clip)) {
            return true;
        }
        const double x = (static_cast<double>(clip.x) / static_cast<double>(clip.w) + 1) *
                             static_cast<double>(draw.viewport.width) / 2 +
                         static_cast<double>(draw.viewport.x);
        const double y = (static_cast<double>(clip.y) / static_cast<double>(clip.w) + 1) *
                             static_cast<double>(draw.viewport.height) / 2 +
                         static_cast<double>(draw.viewport.y);
        x0 = std::min(x0, x);
        x1 = std::max(x1, x);
        y0 = std::min(y0, y);
        y1 = std::max(y1, y);
    }
    const double px = static_cast<double>(p.x) / static_cast<double>(kFixedOne);
    const double py = static_cast<double>(p.y) / static_cast<double>(kFixedOne);
    return px >= x0 - 2 && px <= x1 + 2 && py >= y0 - 2 && py <= y1 + 2;
}

std::string reason_for(const TriangleExplanation& t, const cases::Draw& draw) {
    if (!t.in_layer) {
        return fmt::format("the draw goes to layer {}", draw.layer);
    }
    if (!t.in_mask) {
        return "the sample mask of the draw leaves the sample out";
    }
    if (!t.in_scissor) {
        return "the sample lies outside the scissor rectangle";
    }
    if (!t.in_viewport) {
        return "the sample lies outside the viewport";
    }
    if (t.is_discarded) {
        return "the draw has rasterizer discard";
    }
    if (t.culled) {
        return "the triangle is culled";
    }
    if (t.culled_by_distance) {
        return "a cull distance is negative at all three vertices";
    }
    if (t.clipped_by_distance) {
        return "a clip distance is negative at the sample";
    }
    if (t.near_distance) {
        return "inside the triangle, but a clip distance is 0 within its error at the sample";
    }
    if (t.is_undefined) {
        return "a vertex has a NaN, an infinity or a number beyond the guaranteed range: the "
               "triangle "
               "may cover any sample or none";
    }
    if (t.edges.empty()) {
        return "a vertex lies behind the eye or beyond 2^32 pixels; the clipped polygon decides";
    }
    if (!t.has_area) {
        return "the triangle has no area after snapping";
    }
    for (const EdgeExplanation& e : t.edges) {
        if (e.value < 0) {
            return fmt::format(
                "E({},{}) = {} < 0: outside that edge{}", e.from, e.to, to_text(e.value),
                t.coverage == Coverage::either ? ", but within what snapping may move"
                : t.coverage == Coverage::must ? ", yet inside for every allowed position"
                                               : "");
        }
    }
    std::string ties;
    bool owned = true;
    for (const EdgeExplanation& e : t.edges) {
        if (e.value == 0) {
            const bool owns = e.kind == EdgeKind::top || e.kind == EdgeKind::left;
            owned = owned && owns;
            ties += fmt::format("{}E({},{}) = 0 exactly, a {} edge", ties.empty() ? "" : "; ",
                                e.from, e.to, to_string(e.kind));
        }
    }
    if (!ties.empty()) {
        return ties + (owned ? ": covered under the top-left rule"
                             : ": not covered under the top-left rule");
    }
    return fmt::format("inside: E = {}, {}, {} are all positive{}", to_text(t.edges[0].value),
                       to_text(t.edges[1].value), to_text(t.edges[2].value),
                       t.coverage == Coverage::either     ? ", but within what snapping may move"
                       : t.coverage == Coverage::must_not ? ", yet clipped away"
                                                          : "");
}

constexpr std::string_view kCompareNames[] = {
    "NEVER", "LESS", "EQUAL", "LESS_OR_EQUAL", "GREATER", "NOT_EQUAL", "GREATER_OR_EQUAL",
    "ALWAYS"};

std::string depth_text(DepthOutcome outcome, DepthReason reason, std::string_view op,
                       const std::string& range) {
    const std::string_view verdict = outcome == DepthOutcome::passes  ? "passes"
                                     : outcome == DepthOutcome::fails ? "fails"
                                                                      : "may pass or fail";
    const std::string_view because =
        reason == DepthReason::same ? ": the same triangle was drawn before by the same state, so "
                                      "the depths are equal"
        : reason == DepthReason::apart
            ? ": the same triangle was drawn before, biased apart by whole units of r"
            : "";
    return fmt::format("{} the depth test {}, {}{}", verdict, op, range, because);
}

// The depth test of every triangle that may cover the sample.
void explain_depth(const cases::Case& c, const std::vector<cases::Triangle>& triangles,
                   const Limits& limits, cases::Profile profile, SampleExplanation& out) {
    if (!DepthTest::is_needed(c)) {
        return;
    }
    DepthTest test(c, triangles, limits, profile, true);
    std::vector<DepthCandidate> candidates;
    std::vector<TriangleExplanation*> explained;
    for (TriangleExplanation& t : out.triangles) {
        if (t.coverage != Coverage::must_not) {
            candidates.push_back({t.index, t.coverage == Coverage::must, false, -1});
            explained.push_back(&t);
        }
    }
    const DepthResolution r = test.resolve(out.position, candidates);
    for (size_t k = 0; k < explained.size(); ++k) {
        TriangleExplanation& t = *explained[k];
        const cases::CompareOp op = c.draws[t.triangle.draw].depth.compare;
        t.depth = r.outcomes[k];
        t.depth_reason = r.reasons[k];
        t.depth_text =
            depth_text(r.outcomes[k], r.reasons[k], kCompareNames[static_cast<size_t>(op)],
                       test.range_text(t.index, out.position));
    }
}

}  // namespace

std::string_view to_string(EdgeKind kind) {
    switch (kind) {
        case EdgeKind::top:
            return "top";
        case EdgeKind::left:
            return "left";
        case EdgeKind::bottom:
            return "bottom";
        case EdgeKind::right:
            return "right";
    }
    return "";
}

std::string to_text(const mpq_class& value) {
    // Up to eight decimals say it exactly, or else the fraction does.
    const mpz_class decimals = 100000000;
    if (decimals % value.get_den() == 0) {
        const mpz_class scaled = abs(value.get_num()) * (decimals / value.get_den());
        const mpz_class whole = scaled / decimals;
        std::string text = fmt::format("{}{}.{:08}", value < 0 ? "-" : "", whole.get_str(),
                                       mpz_class(scaled % decimals).get_ui());
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.') {
            text.pop_back();
        }
        return text;
    }
    return value.get_str();
}

std::string to_text(int64_t fixed) {
    return to_text(pixels(fixed));
}

SampleExplanation explain_sample(const cases::Case& c, const Limits& limits, cases::Profile profile,
                                 cases::SampleId sample) {
    SampleExplanation result;
    result.position = sample_position(sample.x, sample.y, sample.sample, c.target);
    const size_t index = index_of(c.target, sample);

    // The whole case, seen through this pixel's scissor.
    cases::Case window = c;
    result.in_layer = false;
    result.in_scissor = false;
    result.in_viewport = false;
    std::vector<bool> in_viewport;  // of each draw
    for (cases::Draw& draw : window.draws) {
        const auto x = static_cast<int64_t>(sample.x);
        const auto y = static_cast<int64_t>(sample.y);
        const bool inside =
            x >= draw.scissor.x && x < draw.scissor.x + int64_t{draw.scissor.width} &&
            y >= draw.scissor.y && y < draw.scissor.y + int64_t{draw.scissor.height};
        const bool in_layer = draw.layer == sample.layer;
        result.in_layer = result.in_layer || in_layer;
        result.in_scissor = result.in_scissor || (in_layer && inside);
        draw.scissor = {static_cast<int32_t>(sample.x), static_cast<int32_t>(sample.y),
                        inside ? 1U : 0U, inside ? 1U : 0U};
        const auto& v = draw.viewport;
        const mpq_class px = pixels(result.position.x);
        const mpq_class py = pixels(result.position.y);
        const mpq_class vx0 = v.x, vx1 = mpq_class(v.x) + mpq_class(v.width);
        const mpq_class va = v.y, vb = mpq_class(v.y) + mpq_class(v.height);
        in_viewport.push_back(px >= vx0 && px <= vx1 && py >= std::min(va, vb) &&
                              py <= std::max(va, vb));
        result.in_viewport = result.in_viewport || (in_layer && in_viewport.back());
    }
    const Expectation whole = expect(window, limits, profile);
    result.expectation = whole.samples[index];

    const std::vector<cases::Triangle> triangles = assemble(c);
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        const cases::Triangle& t = triangles[i];
        const cases::Draw& draw = c.draws[t.draw];
        if (!is_near(draw, t, result.position)) {
            continue;
        }
        TriangleExplanation e;
        e.index = i;
        e.triangle = t;
        const cases::Case single = alone(c, t, sample);
        e.coverage = coverage_of(expect(single, limits, profile).samples[index].hits);
        explain_distances(single, limits, profile, index, e);
        if (draw.cull != cases::CullMode::none && e.coverage == Coverage::must_not) {
            cases::Case unculled = single;
            unculled.draws[0].cull = cases::CullMode::none;
            e.culled = expect(unculled, limits, profile).samples[index].hits.total_max > 0;
        }
        std::array<std::optional<FixedPoint>, 3> snapped;
        e.on_grid = true;
        for (size_t k = 0; k < 3; ++k) {
            const glm::vec4& clip = draw.positions[t.vertex[k]];
            e.is_undefined = e.is_undefined || !is_representable(clip, profile);
            e.needs_clipping = e.needs_clipping || !is_inside(clip, clip_volume_of(draw).view());
            if (is_projectable(clip)) {
                snapped[k] = snap_nearest(clip, draw.viewport, limits);
            }
            const std::optional<Box> box = is_projectable(clip)
                                               ? position_box(clip, draw.viewport, limits, profile)
                                               : std::nullopt;
            e.on_grid = e.on_grid && box && box->is_point();
        }
        if (snapped[0] && snapped[1] && snapped[2]) {
            const mpq_class area = edge_function(*snapped[0], *snapped[1], *snapped[2]);
            e.has_area = area != 0;
            const std::array<size_t, 3> order =
                area < 0 ? std::array<size_t, 3>{0, 2, 1} : std::array<size_t, 3>{0, 1, 2};
            bool negative = false, zero = false;
            for (size_t k = 0; k < 3; ++k) {
                const size_t from = order[k];
                const size_t to = order[(k + 1) % 3];
                EdgeExplanation edge;
                edge.from = t.vertex[from];
                edge.to = t.vertex[to];
                edge.a = *snapped[from];
                edge.b = *snapped[to];
                edge.value = edge_function(edge.a, edge.b, result.position);
                edge.kind = kind_of(edge.a, edge.b);
                negative = negative || edge.value < 0;
                zero = zero || edge.value == 0;
                e.on_vertex = e.on_vertex || edge.a == result.position;
                e.edges.push_back(std::move(edge));
            }
            e.on_edge = zero && !negative;
        }
        e.is_discarded = draw.rasterizer_discard;
        e.in_layer = draw.layer == sample.layer;
        e.in_scissor = single.draws[0].scissor.width != 0;
        e.in_viewport = in_viewport[t.draw];
        e.in_mask = is_in_mask(draw.multisample, sample.sample);
        e.reason = reason_for(e, draw);
        result.triangles.push_back(std::move(e));
    }
    explain_depth(c, triangles, limits, profile, result);
    return result;
}

}  // namespace ref
