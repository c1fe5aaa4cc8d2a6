// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "ref/coverage/exact/exact.hpp"
#include "ref/expectation/reason_text.hpp"
#include "ref/position/clip.hpp"
#include "ref/stencil/values.hpp"

namespace ref {

namespace {

// E_ab(p) in square pixels (coverage.hpp has sign and source).
mpq_class edge_in_pixels(FixedPoint a, FixedPoint b, FixedPoint p) {
    return exact_pixels(b.x - a.x) * exact_pixels(p.y - a.y) -
           exact_pixels(b.y - a.y) * exact_pixels(p.x - a.x);
}

// Top-left rule's names for an edge a->b of a triangle of positive area (y down, clockwise on
// screen).
EdgeKind kind_of(FixedPoint a, FixedPoint b) {
    if (a.y == b.y) {
        return b.x > a.x ? EdgeKind::top : EdgeKind::bottom;
    }
    return b.y < a.y ? EdgeKind::left : EdgeKind::right;
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
    const double px = pixels(p.x);
    const double py = pixels(p.y);
    return px >= x0 - 2 && px <= x1 + 2 && py >= y0 - 2 && py <= y1 + 2;
}

// Takes a triangle away that the state of its draw keeps from the sample.
void refuse(Decision& d, ReasonKind why) {
    if (d.coverage != Coverage::must_not) {
        d = {};
    }
    d.reasons.push_back({why});
    std::sort(d.reasons.begin(), d.reasons.end());
}

}  // namespace

std::string_view to_string(EdgeKind kind) {
    constexpr std::array<std::string_view, 4> kNames = {"top", "left", "bottom", "right"};
    return kNames.at(static_cast<size_t>(kind));
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
    return to_text(exact_pixels(fixed));
}

namespace {

bool has_reason(const Decision& decision, ReasonKind kind) {
    return std::any_of(decision.reasons.begin(), decision.reasons.end(),
                       [&](const Reason& r) { return r.kind == kind; });
}

}  // namespace

bool is_suppressed(const Decision& decision) {
    using enum ReasonKind;
    return decision.coverage == Coverage::must_not &&
           std::ranges::none_of(std::array{outside, outside_hull, no_area, beyond_size,
                                           unfilled_pixel, degenerate_culled, top_left_out},
                                [&](ReasonKind of_area) { return has_reason(decision, of_area); });
}

bool TriangleExplanation::has(ReasonKind kind) const {
    return has_reason(decision, kind);
}

bool TriangleExplanation::is_tie() const {
    return why() == ReasonKind::top_left_in || why() == ReasonKind::top_left_out;
}

Explainer::Explainer(const cases::Case& c, const Limits& limits, cases::Profile profile)
    : scene_(c, limits, profile, true) {}

bool Explainer::is_taken_away_by_face(uint32_t t) {
    const cases::Draw& draw = scene_.c.draws[scene_.triangles[t].draw];
    const bool is_back = draw.discard == cases::Discard::back;
    return scene_.setups[t].facing == (is_back ? Facing::back : Facing::front) &&
           takes_away_face(draw, !is_back);
}

namespace {

// What must be hit need not be, for this reason.
void leave_open(Decision& decision, ReasonKind why) {
    if (decision.coverage == Coverage::must) {
        decision.coverage = Coverage::either;
        decision.reasons.clear();
    }
    decision.reasons.push_back({why});
    std::sort(decision.reasons.begin(), decision.reasons.end());
}

}  // namespace

Decision Explainer::decide(uint32_t t, const FixedPoint& p, cases::SampleId sample) {
    const cases::Draw& draw = scene_.c.draws[scene_.triangles[t].draw];
    Decision out = exact::decide(scene_.setups[t], p, true);
    if (!is_in_mask(draw.multisample, sample.sample)) {
        refuse(out, ReasonKind::masked);
    }
    if (scene_.setups[t].window.alpha == cases::AlphaCoverage::none) {
        refuse(out, ReasonKind::no_alpha);
    }
    if (draw.color.alpha_to_coverage && out.coverage == Coverage::must &&
        out.reasons.front().kind == ReasonKind::inside) {
        out.reasons.front().kind = ReasonKind::kept_by_alpha;
    }
    if (takes_away_pixel(draw, sample.x, sample.y) || is_taken_away_by_face(t)) {
        refuse(out, ReasonKind::fragment_discarded);
    }
    const bool is_by_value = takes_away_by_value(draw) && out.coverage != Coverage::must_not;
    const Sign sign = is_by_value ? scene_.discards.at(t, sample) : Sign::not_negative;
    if (sign == Sign::negative) {
        refuse(out, ReasonKind::value_discarded);
    } else if (sign == Sign::open) {
        leave_open(out, ReasonKind::near_zero);
    }
    if (layer_of(draw, scene_.triangles[t]) != sample.layer) {
        refuse(out, ReasonKind::other_layer);
    }
    // What might have taken it away, but must not have: culling by distance goes first.
    if (out.coverage == Coverage::must && out.reasons[0].kind == ReasonKind::inside) {
        out.reasons[0].kind = draw.distances.cull_count > 0   ? ReasonKind::passes_cull_distance
                              : draw.distances.clip_count > 0 ? ReasonKind::passes_clip_distance
                                                              : ReasonKind::inside;
    }
    return out;
}

void Explainer::add_details(TriangleExplanation& e, const FixedPoint& p) {
    e.facing = scene_.setups[e.index].facing;
    const cases::Draw& draw = scene_.c.draws[e.triangle.draw];
    if (draw.clear) {
        return;
    }
    std::array<std::optional<FixedPoint>, 3> snapped;
    for (size_t k = 0; k < 3; ++k) {
        const glm::vec4& clip = draw.positions[e.triangle.vertex[k]];
        e.is_clipped = e.is_clipped || !is_inside(clip, clip_volume_of(draw).view());
        if (is_projectable(clip)) {
            snapped[k] = snap_nearest(clip, draw.viewport, scene_.limits);
            e.boxes[k] = position_box(clip, draw.viewport, scene_.limits, scene_.profile);
        }
    }
    if (!snapped[0] || !snapped[1] || !snapped[2]) {
        return;
    }
    const bool is_reversed = edge_in_pixels(*snapped[0], *snapped[1], *snapped[2]) < 0;
    for (const size_t from :
         is_reversed ? std::array<size_t, 3>{0, 2, 1} : std::array<size_t, 3>{0, 1, 2}) {
        const size_t to = (from + (is_reversed ? 2 : 1)) % 3;
        EdgeExplanation edge;
        edge.label = static_cast<EdgeLabel>(is_reversed ? to : from);
        edge.from = e.triangle.vertex[from];
        edge.to = e.triangle.vertex[to];
        edge.a = *snapped[from];
        edge.b = *snapped[to];
        edge.value = edge_in_pixels(edge.a, edge.b, p);
        edge.kind = kind_of(edge.a, edge.b);
        e.edges.push_back(std::move(edge));
    }
}

std::string Explainer::sentence(const TriangleExplanation& t, cases::SampleId sample) {
    TriangleExplanation e = t;
    e.edges.clear();
    add_details(e, sample_position(sample.x, sample.y, sample.sample, scene_.c.target));
    return sentence_of(e.decision.reasons.front(), e, scene_.c, sample);
}

std::string Explainer::depth_sentence(const TriangleExplanation& t, cases::SampleId sample) {
    const FixedPoint p = sample_position(sample.x, sample.y, sample.sample, scene_.c.target);
    return sentence_of(t.depth_reason, t.depth.value(),
                       scene_.c.draws[t.triangle.draw].depth.compare,
                       scene_.depth->range_text(t.index, p));
}

std::string Explainer::bounds_sentence(const TriangleExplanation& t) {
    return sentence_of(t.fate.value(), scene_.c.draws[t.triangle.draw].depth.bounds.value());
}

std::string Explainer::stencil_sentence(const TriangleExplanation& t) {
    const TriangleSetup& setup = scene_.setups[t.index];
    return sentence_of(t.fate.value(), scene_.c.draws[t.triangle.draw].stencil, setup.can_be_front,
                       setup.can_be_back);
}

std::string Explainer::sentence(const FixedSet& set) {
    return sentence_of(set, scene_.triangles);
}

std::optional<ReasonKind> Explainer::reason_of_all(cases::SampleId sample,
                                                   const FixedPoint& p) const {
    ReasonKind out = ReasonKind::other_layer;
    for (const cases::Draw& draw : scene_.c.draws) {
        const Window window = window_of(scene_.c, draw, scene_.profile);
        if (draw.clear || (draw.layer == sample.layer && window.may_touch(p))) {
            return std::nullopt;
        }
        const ReasonKind why = draw.layer != sample.layer ? ReasonKind::other_layer
                               : !window.is_in_scissor(p) ? ReasonKind::scissor
                                                          : ReasonKind::viewport;
        out = std::max(out, why);
    }
    return out;
}

Explainer::HitsAt Explainer::hits_at(cases::SampleId sample, Detail detail,
                                     SampleExplanation& out) {
    const FixedPoint& p = out.position;
    std::set<uint32_t> at_sample;
    const uint32_t row = sample.layer * scene_.c.target.height + sample.y;
    for (const fast::Span& s : scene_.spans) {
        if (s.y == row && s.sample == sample.sample && s.x0 <= sample.x && sample.x < s.x1) {
            at_sample.insert(s.triangle);
        }
    }
    HitsAt found;
    for (uint32_t t = 0; t < scene_.triangles.size(); ++t) {
        const bool is_told =
            is_near(scene_.c.draws[scene_.triangles[t].draw], scene_.triangles[t], p);
        if (!is_told && !at_sample.contains(t)) {
            continue;
        }
        Decision decision = decide(t, p, sample);
        if (decision.coverage != Coverage::must_not) {
            found.hits.push_back({t, decision.coverage});
            found.explained.push_back(is_told ? out.triangles.size() : kUntold);
            found.hits.insert(found.hits.end(), decision.further, {t, Coverage::either});
            found.explained.insert(found.explained.end(), decision.further, kUntold);
        }
        if (is_told) {
            TriangleExplanation& e = out.triangles.emplace_back();
            e.index = t;
            e.triangle = scene_.triangles[t];
            e.decision = std::move(decision);
            if (detail == Detail::all) {
                add_details(e, p);
                e.sentence = sentence_of(e.decision.reasons.front(), e, scene_.c, sample);
            }
        }
    }
    return found;
}

void Explainer::add_fate(TriangleExplanation& t, const path::Fate& fate, cases::SampleId sample,
                         Detail detail) {
    t.fate = fate;
    const bool is_all = detail == Detail::all;
    const cases::Draw& draw = scene_.c.draws[t.triangle.draw];
    if (fate.is_discarded && !fate.passes) {
        refuse(t.decision, draw.clear ? ReasonKind::cleared : ReasonKind::discarded_late);
    } else if (fate.is_discarded && cases::discards_by_value(draw)) {
        leave_open(t.decision, ReasonKind::near_zero);
    }
    if (fate.is_discarded) {
        t.sentence = is_all ? sentence(t, sample) : std::string();
    }
    if (draw.clear) {
        return;
    }
    if (is_all && scene_.c.target.has_depth && draw.depth.bounds) {
        t.bounds_text = bounds_sentence(t);
    }
    if (is_all && stencil::is_needed(scene_.c) && fate.is_tested()) {
        t.stencil_text = stencil_sentence(t);
    }
}

SampleExplanation Explainer::explain(cases::SampleId sample, Detail detail) {
    SampleExplanation out;
    out.position = sample_position(sample.x, sample.y, sample.sample, scene_.c.target);
    out.of_all = reason_of_all(sample, out.position);
    const auto [hits, explained] = hits_at(sample, detail, out);
    Lists lists;
    JudgeReasons reasons;
    const SampleExpectation judged =
        scene_.narrowing.judge(out.position, sample.sample, hits, lists, &reasons);
    out.hits = judged.hits;
    for (FixedSet& set : reasons.sets) {
        std::string words = detail == Detail::all ? sentence(set) : std::string();
        out.sets.push_back({std::move(set), std::move(words)});
    }
    if (stencil::is_needed(scene_.c)) {
        out.stencils = path::values_of(lists.stencils, judged.is_free,
                                       scene_.c.target.stencil_clear, std::nullopt);
    }
    for (size_t m = 0; m < hits.size(); ++m) {
        if (explained[m] == kUntold) {
            continue;
        }
        TriangleExplanation& t = out.triangles[explained[m]];
        const path::Fate& fate = reasons.fates[m];
        add_fate(t, fate, sample, detail);
        if (scene_.depth && fate.gets_to_depth() && !scene_.c.draws[t.triangle.draw].clear) {
            t.depth = fate.depth();
            t.depth_reason = *t.depth == DepthOutcome::open ? ReasonKind::depth_ranges
                                                            : reasons.depth_reasons[m];
            t.depth_text = detail == Detail::all ? depth_sentence(t, sample) : std::string();
        }
    }
    return out;
}

SampleExplanation explain_sample(const cases::Case& c, const Limits& limits, cases::Profile profile,
                                 cases::SampleId sample) {
    return Explainer(c, limits, profile).explain(sample);
}

}  // namespace ref
