// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/exact/reason_names.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "ref/coverage/exact/exact.hpp"
#include "ref/number/edge_function.hpp"

namespace ref {

namespace {

// Which plane an edge of an outline lies on, if it is none of the triangle's.
std::optional<Reason> plane_of(EdgeLabel label) {
    if (label < kFirstClipEdge) {
        return std::nullopt;
    }
    return reason_of_plane(static_cast<ClipPlane>(label - kFirstClipEdge));
}

Reason outside_of(EdgeLabel label) {
    return plane_of(label).value_or(Reason{ReasonKind::outside, label});
}

// That an edge leaves the sample open.
Reason open_at(EdgeLabel label, ReasonKind kind) {
    const std::optional<Reason> plane = plane_of(label);
    return plane && plane->kind == ReasonKind::clip_distance
               ? Reason{ReasonKind::near_distance, plane->which}
               : Reason{kind, label};
}

// What the candidates' edges say of p.
struct Candidates {
    bool has_area = false;
    std::array<bool, kMaxClippedVertices> is_outside{};  // edge i in every candidate with an area
    std::vector<EdgeLabel> owning,
        losing;  // edges of a candidate on which p lies, inside the others
};

Candidates candidates_at(const TriangleSetup& setup, const Outline& o, const FixedPoint& p) {
    Candidates out;
    out.is_outside.fill(true);
    for_each_candidate(o, setup.grid_step, [&](std::span<const FixedPoint> polygon) {
        const int sign = area_sign(polygon);
        if (sign == 0) {
            return;
        }
        out.has_area = true;
        std::vector<EdgeLabel> owning, losing;
        bool is_inside = true;
        for (size_t i = 0; i < polygon.size(); ++i) {
            const FixedPoint& a = polygon[i];
            const FixedPoint& b = polygon[(i + 1) % polygon.size()];
            const int side = sign * sign_of(edge_function(a, b, p));
            out.is_outside.at(i) = out.is_outside.at(i) && side < 0;
            is_inside = is_inside && side >= 0;
            if (side == 0 && !(a == b)) {
                const bool owns = sign > 0 ? is_top_left(a, b) : is_top_left(b, a);
                (owns ? owning : losing).push_back(o.edge.at(i));
            }
        }
        if (is_inside) {
            out.owning.insert(out.owning.end(), owning.begin(), owning.end());
            out.losing.insert(out.losing.end(), losing.begin(), losing.end());
        }
    });
    return out;
}

// Whether p lies strictly beyond the line through a and b, and no corner of the boxes does.
bool is_separating(const FixedPoint& a, const FixedPoint& b, std::span<const Box> boxes,
                   const FixedPoint& p) {
    const int beyond = sign_of(edge_function(a, b, p));
    return beyond != 0 && std::all_of(boxes.begin(), boxes.end(), [&](const Box& box) {
               const BoxCorners points(box);
               return std::all_of(points.begin(), points.end(), [&](const FixedPoint& q) {
                   return sign_of(edge_function(a, b, q)) != beyond;
               });
           });
}

// The edges of an outline in mode boxes that keep p out of the hull of the boxes, and those that p
// is outside of wherever their ends may lie.
void add_outside_edges(const Outline& o, const FixedPoint& p, Reasons& out) {
    std::vector<FixedPoint> middles;
    for (const Box& b : o.vertices()) {
        middles.push_back(middle_of(b));
    }
    const int sign = area_sign(middles);
    for (uint32_t i = 0; i < o.count; ++i) {
        bool is_separated = false;
        bool is_outside = sign != 0;
        for (const FixedPoint& a : BoxCorners(o.boxes[i])) {
            for (const FixedPoint& b : BoxCorners(o.boxes[(i + 1) % o.count])) {
                is_outside = is_outside && sign * sign_of(edge_function(a, b, p)) < 0;
                is_separated = is_separated || is_separating(a, b, o.vertices(), p);
            }
        }
        if (is_separated || is_outside) {
            add_reason(out, outside_of(o.edge.at(i)));
        }
    }
    // Beside a corner's box: the edges of the ideal polygon.
    for (uint32_t i = 0; out.empty() && i < o.count; ++i) {
        if (sign * sign_of(edge_function(middles[i], middles[(i + 1) % o.count], p)) < 0) {
            out.push_back(outside_of(o.edge.at(i)));
        }
    }
}

// An edge that the top-left rule decides in mode boxes, and what E of p is there: positive inside.
struct Tie {
    EdgeLabel label = 0;
    int side = 0;
    bool owns = false;
};

std::vector<Tie> ties_of(const Outline& o, const FixedPoint& p) {
    std::vector<Tie> out;
    const std::span<const Box> boxes = o.must_vertices();
    for (size_t k = 0; k < boxes.size(); ++k) {
        if (o.must_test.at(k) != EdgeTest::top_left) {
            continue;
        }
        const Box& from = boxes[k];
        const Box& to = boxes[(k + 1) % boxes.size()];
        const FixedPoint a{from.x0, from.y0};
        const FixedPoint b{to.x0, to.y0};
        Tie tie;
        tie.side = o.tie_side.at(k) * sign_of(edge_function(a, b, p));
        tie.owns = o.tie_side.at(k) > 0 ? is_top_left(a, b) : is_top_left(b, a);
        for (uint32_t i = 0; i < o.count; ++i) {
            if (o.boxes[i] == from && o.boxes[(i + 1) % o.count] == to) {
                tie.label = o.edge.at(i);
            }
        }
        out.push_back(tie);
    }
    return out;
}

void name_must(const TriangleSetup& setup, const Outline& o, const FixedPoint& p, Reasons& out) {
    if (o.mode == OutlineMode::snapped) {
        const Candidates c = candidates_at(setup, o, p);
        if (!c.owning.empty()) {
            add_reason(out, {ReasonKind::top_left_in, c.owning.front()});
            return;
        }
    }
    for (const Tie& tie : ties_of(o, p)) {
        if (tie.side == 0) {
            add_reason(out, {ReasonKind::top_left_in, tie.label});
            return;
        }
    }
    add_reason(out, {ReasonKind::inside});
}

// Of an outline that does not cover p whatever its cuts say.
void name_outside(const TriangleSetup& setup, const Outline& o, const FixedPoint& p, Reasons& out) {
    if (o.mode == OutlineMode::snapped) {
        const Candidates c = candidates_at(setup, o, p);
        for (uint32_t i = 0; c.has_area && i < o.count; ++i) {
            if (c.is_outside.at(i)) {
                add_reason(out, outside_of(o.edge.at(i)));
            }
        }
        if (!c.losing.empty()) {
            add_reason(out, {ReasonKind::top_left_out, c.losing.front()});
        } else if (!c.has_area && exact::is_in_hull(o.vertices(), p)) {
            add_reason(out, {ReasonKind::no_area});
        }
    } else if (o.mode == OutlineMode::boxes) {
        Reasons edges;
        add_outside_edges(o, p, edges);
        for (const Reason& edge : edges) {
            add_reason(out, edge);
        }
        const bool is_in_hull = exact::is_in_hull(o.vertices(), p);
        for (const Tie& tie : ties_of(o, p)) {
            if (is_in_hull && tie.side == 0 && !tie.owns) {
                add_reason(out, {ReasonKind::top_left_out, tie.label});
            } else if (tie.side < 0) {
                add_reason(out, outside_of(tie.label));
            }
        }
    }
    if (out.empty() && o.mode != OutlineMode::empty) {
        add_reason(out, {ReasonKind::outside_hull});
    }
}

// Whether p is on the edge between two boxes, or at an end of it, wherever these may be.
bool is_exactly_on(const Box& from, const Box& to, const FixedPoint& p) {
    bool is_on = true;
    for (const FixedPoint& a : BoxCorners(from)) {
        for (const FixedPoint& b : BoxCorners(to)) {
            is_on = is_on && edge_function(a, b, p) == 0;
        }
    }
    return is_on;
}

void name_open(const Outline& o, const FixedPoint& p, Reasons& out) {
    const size_t before = out.size();
    if (o.mode == OutlineMode::boxes) {
        for (uint32_t i = 0; i < o.count; ++i) {
            const std::array<Box, 2> ends{o.boxes[i], o.boxes[(i + 1) % o.count]};
            if (exact::is_in_hull(ends, p)) {
                const bool is_fixed = is_exactly_on(ends[0], ends[1], p);
                add_reason(out, open_at(o.edge.at(i),
                                        is_fixed ? ReasonKind::on_edge : ReasonKind::vertex_boxes));
            }
        }
    }
    if (out.size() == before) {
        add_reason(out, {ReasonKind::vertex_boxes});
    }
}

// That a cut keeps a sample out, or leaves it open.
Reason reason_of_cut(const DistanceCut& cut, bool is_open) {
    const Reason reason =
        cut.plane ? reason_of_plane(*cut.plane) : Reason{ReasonKind::clip_distance};
    if (!is_open) {
        return reason;
    }
    return {
        reason.kind == ReasonKind::clip_plane ? ReasonKind::near_plane : ReasonKind::near_distance,
        reason.which};
}

}  // namespace

namespace {

// The same of a pixel of a conservative draw: of an outline that must, may or must not cover it.
void name_pixel_reason(const TriangleSetup& setup, const Outline& o, const FixedPoint& centre,
                       Coverage coverage, Reasons& out) {
    const bool is_over = setup.area.is_over();
    PixelArea other = setup.area;
    switch (coverage) {
        case Coverage::must:
            other.least = 0;
            other.keeps_degenerates = false;
            if (!is_over) {
                add_reason(out, {ReasonKind::fills_pixel});
            } else if (exact::pixel_coverage(setup, other, o, centre) == Coverage::must) {
                add_reason(out, {ReasonKind::touches_pixel});
            } else {
                other.keeps_degenerates = setup.area.keeps_degenerates;
                const bool is_kept =
                    exact::pixel_coverage(setup, other, o, centre) == Coverage::must;
                add_reason(out,
                           {is_kept ? ReasonKind::degenerate_kept : ReasonKind::extra_reached});
            }
            return;
        case Coverage::either:
            if (!is_over && exact::meets_inner_edge(setup.area, o, centre)) {
                add_reason(out, {ReasonKind::between_pieces});
            } else {
                add_reason(out, {is_over ? ReasonKind::may_reach : ReasonKind::may_fill});
            }
            return;
        case Coverage::must_not:
            other.keeps_degenerates = true;
            if (!is_over) {
                add_reason(out, {ReasonKind::unfilled_pixel});
            } else if (exact::pixel_coverage(setup, other, o, centre) != Coverage::must_not) {
                add_reason(out, {ReasonKind::degenerate_culled});
            } else {
                add_reason(out, {ReasonKind::beyond_size});
            }
            return;
    }
}

}  // namespace

void name_reasons(const TriangleSetup& setup, const Outline& o, const FixedPoint& p, Coverage own,
                  Decision& out) {
    if (setup.area.is_on()) {
        if (out.coverage == Coverage::must || own != Coverage::must) {
            name_pixel_reason(setup, o, p, out.coverage, out.reasons);
        }
        return;
    }
    if (out.coverage == Coverage::must) {
        name_must(setup, o, p, out.reasons);
        return;
    }
    if (own == Coverage::must) {
        return;  // another outline leaves the sample open
    }
    const bool is_open = out.coverage == Coverage::either;
    for (const DistanceCut& cut : o.cuts) {
        if (is_open ? cut.must.at(p) < 0 : cut.may.at(p) < 0) {
            add_reason(out.reasons, reason_of_cut(cut, is_open));
        }
    }
    const Coverage whole = exact::coverage_of(setup, o, p);
    if (!is_open && whole == Coverage::must_not) {
        name_outside(setup, o, p, out.reasons);
    } else if (is_open && whole == Coverage::either) {
        name_open(o, p, out.reasons);
    } else if (is_open && whole == Coverage::must_not) {
        // Another outline may cover p: where the cut vertices lie leaves it open.
        Reasons outside;
        name_outside(setup, o, p, outside);
        for (const Reason& r : outside) {
            const bool is_distance = r.kind == ReasonKind::clip_distance;
            const uint8_t plane = static_cast<uint8_t>(r.which + kFirstClipEdge);
            add_reason(out.reasons,
                       is_distance ? Reason{ReasonKind::near_distance, r.which}
                                   : Reason{ReasonKind::vertex_boxes,
                                            r.kind == ReasonKind::clip_plane ? plane : r.which});
        }
    }
}

void name_setup_reasons(const TriangleSetup& setup, const FixedPoint& p, Decision& out) {
    const Window& w = setup.window;
    Reasons& reasons = out.reasons;
    const bool is_anywhere = setup.kind == TriangleSetup::Kind::anywhere;
    for (const Reason& r : setup.reasons) {
        const bool is_of_nothing = r.kind < ReasonKind::undefined;
        if (out.coverage == (is_of_nothing ? Coverage::must_not : Coverage::either)) {
            add_reason(reasons, r);
        }
    }
    const bool is_clear = setup.kind == TriangleSetup::Kind::cleared;
    if (is_clear && out.coverage == Coverage::must) {
        add_reason(reasons, {ReasonKind::cleared});
    }
    if (out.coverage == Coverage::must_not) {
        if (!w.is_in_scissor(p)) {
            add_reason(reasons, {is_clear ? ReasonKind::beside_clear : ReasonKind::scissor});
        }
        if (!w.is_in_zone(p)) {
            add_reason(reasons, {ReasonKind::viewport});
        }
        if (setup.is_culled) {
            add_reason(reasons, {ReasonKind::culled});
        }
    } else if (out.coverage == Coverage::either && !is_anywhere) {
        if (setup.may_be_culled) {
            add_reason(reasons, {ReasonKind::open_facing});
        }
        if (w.is_open()) {
            add_reason(reasons, {ReasonKind::open_alpha});
        }
        if (!w.is_in_core(p)) {
            add_reason(reasons, {ReasonKind::viewport_border});
        }
    }
    if (reasons.empty()) {
        reasons.push_back({ReasonKind::outside_hull});
    }
    std::sort(reasons.begin(), reasons.end());
    if (out.coverage == Coverage::must) {
        reasons.resize(1);
    }
}

}  // namespace ref
