// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/reason_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cases/model/rule_ids.hpp"
#include "ref/position/clip.hpp"

namespace ref {

namespace {

struct Row {
    ReasonKind kind;
    std::string_view rule;
    std::string_view direct3d;  // rule of what only profile direct3d demands
    std::string_view sentence;  // names in braces: sentence_of() has them
};

// In the order of ReasonKind.
constexpr std::array kRows = {
    Row{ReasonKind::top_left_in, cases::rule::tie_top_left, cases::rule::tie_top_left,
        "{ties}: covered under the top-left rule"},
    Row{ReasonKind::passes_cull_distance, cases::rule::cull_distance, cases::rule::snap_nearest,
        "{inside}, and no cull distance is negative at all vertices"},
    Row{ReasonKind::passes_clip_distance, cases::rule::clip_distance, cases::rule::snap_nearest,
        "{inside}, and no clip distance is negative"},
    Row{ReasonKind::inside, cases::rule::cover_inside, cases::rule::snap_nearest, "{inside}"},
    Row{ReasonKind::other_layer, cases::rule::layer_select, cases::rule::layer_select,
        "the draw goes to layer {layer}"},
    Row{ReasonKind::masked, cases::rule::sample_mask, cases::rule::sample_mask,
        "the sample mask {mask:#x} of the draw leaves sample {sample} out"},
    Row{ReasonKind::scissor, cases::rule::scissor_half_open, cases::rule::scissor_half_open,
        "the sample lies outside the scissor rectangle, {scissor}"},
    Row{ReasonKind::viewport, cases::rule::clip_viewport, cases::rule::clip_viewport,
        "the sample lies outside the viewport, {viewport}"},
    Row{ReasonKind::discarded, cases::rule::discard_rasterizer, cases::rule::discard_rasterizer,
        "the draw has rasterizer discard"},
    Row{ReasonKind::outside, cases::rule::cover_outside, cases::rule::snap_nearest,
        "{edge}: outside that edge"},
    Row{ReasonKind::outside_hull, cases::rule::cover_outside, cases::rule::snap_nearest,
        "outside all that the vertices can span, wherever they are snapped"},
    Row{ReasonKind::no_area, cases::rule::cover_degenerate, cases::rule::cover_degenerate,
        "the triangle has no area after snapping"},
    Row{ReasonKind::top_left_out, cases::rule::tie_top_left, cases::rule::tie_top_left,
        "{ties}: not covered under the top-left rule"},
    Row{ReasonKind::culled, cases::rule::face_cull, cases::rule::face_cull,
        "the triangle is culled: it faces {facing}"},
    Row{ReasonKind::cull_distance, cases::rule::cull_distance, cases::rule::cull_distance,
        "cull distance {number} is negative at all three vertices"},
    Row{ReasonKind::clip_distance, cases::rule::clip_distance, cases::rule::clip_distance,
        "clip distance {number} is negative at the sample"},
    Row{ReasonKind::clip_plane, cases::rule::clip_volume, cases::rule::clip_volume,
        "clipped away by the plane {plane} of the view volume"},
    Row{ReasonKind::undefined, cases::rule::number_undefined, cases::rule::number_undefined,
        "a vertex has a NaN, an infinity or a number beyond the guaranteed range: the triangle may "
        "cover any sample or none"},
    Row{ReasonKind::unbounded, cases::rule::number_undefined, cases::rule::number_undefined,
        "a vertex lies behind the eye or beyond 2^32 pixels, and nothing bounds where the corners "
        "of the clipped polygon may lie"},
    Row{ReasonKind::near_distance, cases::rule::clip_distance, cases::rule::clip_distance,
        "inside the triangle, but clip distance {number} is 0 within its error at the sample"},
    Row{ReasonKind::open_facing, cases::rule::face_area_sign, cases::rule::face_area_sign,
        "which way the triangle faces depends on where its vertices are snapped ({boxes}), and one "
        "of its faces is culled"},
    Row{ReasonKind::viewport_border, cases::rule::clip_viewport, cases::rule::clip_viewport,
        "the sample lies within a pixel of a border of the viewport that is no whole number, "
        "{viewport}"},
    Row{ReasonKind::on_edge, cases::rule::tie_top_left, cases::rule::tie_top_left,
        "{ties}: only the top-left rule, between fixed points at profile direct3d, would decide"},
    Row{ReasonKind::vertex_boxes, cases::rule::cover_inside, cases::rule::snap_nearest,
        "inside for some positions of the vertices only: {boxes}"},
    Row{ReasonKind::complement, cases::rule::clip_complement, cases::rule::clip_complement,
        "{number} of {triangles} covers the sample: a clip distance and its negative are 0 here "
        "within their error"},
    Row{ReasonKind::clipped_edge, cases::rule::cover_clipped_edge, cases::rule::snap_nearest,
        "{number} of {triangles} covers the sample: they meet here along edges they share, "
        "clipped"},
    Row{ReasonKind::shared_vertex, cases::rule::cover_shared_vertex, cases::rule::snap_nearest,
        "{number} of {triangles} covers the sample: they meet here in a vertex they share"},
    Row{ReasonKind::shared_edge, cases::rule::cover_shared_edge, cases::rule::snap_nearest,
        "{number} of {triangles} covers the sample: they meet here along edges they share with "
        "identical end points"},
};
static_assert(kRows.size() == static_cast<size_t>(kLastReason) + 1);
static_assert([] {
    for (size_t k = 0; k < kRows.size(); ++k) {
        if (kRows[k].kind != static_cast<ReasonKind>(k)) {
            return false;
        }
    }
    return true;
}());

constexpr std::string_view kPlanes[] = {"x = -w", "x = w", "y = -w", "y = w",
                                        "z = 0",  "z = w", "z = -w"};

const Row& row_of(ReasonKind kind) {
    return kRows.at(static_cast<size_t>(kind));
}

std::string span_text(int64_t low, int64_t high) {
    return low == high ? to_text(low) : fmt::format("{} to {}", to_text(low), to_text(high));
}

// An edge of the outline that is none of the triangle's.
std::string plane_text(EdgeLabel label) {
    const size_t plane = label - size_t{kFirstClipEdge};
    return plane < std::size(kPlanes)
               ? fmt::format("the edge along the plane {}", kPlanes[plane])
               : fmt::format("the edge along clip distance {} = 0", plane - std::size(kPlanes));
}

const EdgeExplanation* edge_of(const TriangleExplanation& t, uint8_t label) {
    const auto it = std::find_if(t.edges.begin(), t.edges.end(),
                                 [&](const EdgeExplanation& e) { return e.label == label; });
    return it == t.edges.end() ? nullptr : &*it;
}

std::string edge_name(const TriangleExplanation& t, uint8_t label) {
    if (label >= kFirstClipEdge) {
        return label == kNothing ? "" : plane_text(label);
    }
    const EdgeExplanation* const e = edge_of(t, label);
    return e ? fmt::format("E({},{})", e->from, e->to)
             : fmt::format("E({},{})", t.triangle.vertex.at(label),
                           t.triangle.vertex.at((label + 1U) % 3U));
}

std::string outside_text(const TriangleExplanation& t, uint8_t label) {
    const EdgeExplanation* const e = edge_of(t, label);
    return e && e->value < 0
               ? fmt::format("{} = {} < 0", edge_name(t, label), to_text(e->value))
               : fmt::format("{} < 0 wherever its ends are snapped", edge_name(t, label));
}

std::string ties_text(const TriangleExplanation& t, uint8_t label) {
    std::string text;
    for (const EdgeExplanation& e : t.edges) {
        if (e.value == 0) {
            text += fmt::format("{}{} = 0 exactly, a {} edge", text.empty() ? "" : "; ",
                                edge_name(t, e.label), to_string(e.kind));
        }
    }
    return text.empty()
               ? fmt::format("on {} for a position that its ends may take", edge_name(t, label))
               : text;
}

std::string inside_text(const TriangleExplanation& t) {
    const auto is_positive = [](const EdgeExplanation& e) { return e.value > 0; };
    return t.edges.size() == 3 && std::all_of(t.edges.begin(), t.edges.end(), is_positive)
               ? fmt::format("inside: E = {}, {}, {} are all positive", to_text(t.edges[0].value),
                             to_text(t.edges[1].value), to_text(t.edges[2].value))
               : std::string("inside all edges of the clipped polygon, wherever its corners lie");
}

std::string boxes_text(const TriangleExplanation& t) {
    std::string text;
    for (size_t k = 0; k < 3; ++k) {
        const std::optional<Box>& box = t.boxes.at(k);
        if (!box || !box->is_point()) {
            text += fmt::format("{}vertex {} {}", text.empty() ? "" : "; ", t.triangle.vertex.at(k),
                                box ? fmt::format("x {}, y {}", span_text(box->x0, box->x1),
                                                  span_text(box->y0, box->y1))
                                    : std::string("has none of its own"));
        }
    }
    return text.empty() ? "the corners that clipping makes are snapped" : text;
}

std::string facing_text(Facing facing) {
    return facing == Facing::front  ? "to the front"
           : facing == Facing::back ? "to the back"
                                    : "either way";
}

std::string triangles_text(const std::vector<uint32_t>& members,
                           const std::vector<cases::Triangle>& triangles) {
    constexpr size_t kShown = 8;
    const bool is_one_draw = std::all_of(members.begin(), members.end(), [&](uint32_t t) {
        return triangles[t].draw == triangles[members[0]].draw;
    });
    std::string text = is_one_draw ? "triangles " : "";
    const size_t shown = std::min(members.size(), kShown);
    for (size_t k = 0; k < shown; ++k) {
        const cases::Triangle& t = triangles[members[k]];
        text += k == 0 ? "" : k + 1 == members.size() ? " and " : ", ";
        text += is_one_draw ? fmt::format("{}", t.primitive)
                            : fmt::format("triangle {} of draw {}", t.primitive, t.draw);
    }
    text += members.size() > shown ? fmt::format(" and {} more", members.size() - shown) : "";
    return is_one_draw ? fmt::format("{} of draw {}", text, triangles[members[0]].draw) : text;
}

}  // namespace

std::string_view rule_of(ReasonKind kind, cases::Profile level) {
    const Row& row = row_of(kind);
    return level == cases::Profile::direct3d ? row.direct3d : row.rule;
}

std::string sentence_of(Reason reason, const TriangleExplanation& t, const cases::Case& c,
                        cases::SampleId sample) {
    const cases::Draw& draw = c.draws[t.triangle.draw];
    const cases::Rect& r = draw.scissor;
    const cases::Viewport& v = draw.viewport;
    const auto [left, right] = std::minmax({v.x, v.x + v.width});
    const auto [top, bottom] = std::minmax({v.y, v.y + v.height});
    const size_t plane = std::min<size_t>(reason.which, std::size(kPlanes) - 1);
    return fmt::format(
        fmt::runtime(row_of(reason.kind).sentence), fmt::arg("ties", ties_text(t, reason.which)),
        fmt::arg("inside", inside_text(t)), fmt::arg("layer", draw.layer),
        fmt::arg("mask",
                 draw.multisample.sample_mask & draw.multisample.shader_mask.value_or(0xffffffffU)),
        fmt::arg("sample", sample.sample),
        fmt::arg("scissor", fmt::format("x {} to {}, y {} to {}", r.x, int64_t{r.x} + r.width, r.y,
                                        int64_t{r.y} + r.height)),
        fmt::arg("viewport", fmt::format("x {} to {}, y {} to {}", left, right, top, bottom)),
        fmt::arg("edge", outside_text(t, reason.which)), fmt::arg("facing", facing_text(t.facing)),
        fmt::arg("number", reason.which), fmt::arg("plane", kPlanes[plane]),
        fmt::arg("boxes", boxes_text(t)));
}

std::string sentence_of(const FixedSet& set, const std::vector<cases::Triangle>& triangles) {
    const std::string number = set.count == set.least ? fmt::format("exactly {}", set.count)
                               : set.least == 0       ? fmt::format("at most {}", set.count)
                                                : fmt::format("{} to {}", set.least, set.count);
    return fmt::format(fmt::runtime(row_of(set.why).sentence), fmt::arg("number", number),
                       fmt::arg("triangles", triangles_text(set.triangles, triangles)));
}

std::string_view sentence_of_all(ReasonKind kind) {
    return kind == ReasonKind::other_layer ? "no draw goes to this layer"
           : kind == ReasonKind::scissor   ? "the sample lies outside every scissor rectangle"
                                           : "the sample lies outside every viewport";
}

}  // namespace ref
