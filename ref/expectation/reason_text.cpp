// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/reason_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ref/position/clip.hpp"
#include "ref/stencil/values.hpp"

namespace ref {

namespace {

constexpr std::string_view kPlanes[] = {"x = -w", "x = w", "y = -w", "y = w",
                                        "z = 0",  "z = w", "z = -w"};

constexpr std::string_view kCompareNames[] = {
    "NEVER", "LESS", "EQUAL", "LESS_OR_EQUAL", "GREATER", "NOT_EQUAL", "GREATER_OR_EQUAL",
    "ALWAYS"};

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

// In the order of cases::Discard.
constexpr std::array<std::string_view, 6> kDiscarded = {
    "nothing", "odd columns", "odd rows", "pixels whose x + y is odd", "front faces", "back faces"};

std::string discarded_text(const cases::Draw& draw) {
    return cases::discards_by_value(draw)
               ? fmt::format("fragments of which attribute {} is negative", draw.discard_attribute)
               : std::string(kDiscarded.at(static_cast<size_t>(draw.discard)));
}

// What a test meets: up to three numbers, else only that it is the stencil.
std::string met_text(const stencil::Values& met) {
    constexpr size_t kShown = 3;
    return met.none() || met.count() > kShown ? "stencil" : stencil::to_text(met, " or ", kShown);
}

// What the comparison has of a number: with the mask, unless that keeps all bits.
std::string masked(const std::string& number, const cases::StencilFace& face) {
    const std::string shown = number.find(' ') == std::string::npos ? number : "(" + number + ")";
    return face.compare_mask == cases::kStencilBits
               ? shown
               : fmt::format("({} & {})", shown, face.compare_mask);
}

}  // namespace

std::string sentence_of(Reason reason, const TriangleExplanation& t, const cases::Case& c,
                        cases::SampleId sample) {
    const cases::Draw& draw = c.draws[t.triangle.draw];
    const cases::Rect& r = draw.clear ? rect_of(*draw.clear, t.triangle) : draw.scissor;
    const cases::Viewport& v = draw.viewport;
    const auto [left, right] = std::minmax({v.x, v.x + v.width});
    const auto [top, bottom] = std::minmax({v.y, v.y + v.height});
    const size_t plane = std::min<size_t>(reason.which, std::size(kPlanes) - 1);
    return fmt::format(
        fmt::runtime(text_of(reason.kind)), fmt::arg("ties", ties_text(t, reason.which)),
        fmt::arg("inside", inside_text(t)), fmt::arg("layer", layer_of(draw, t.triangle)),
        fmt::arg("mask",
                 draw.multisample.sample_mask & draw.multisample.shader_mask.value_or(0xffffffffU)),
        fmt::arg("sample", sample.sample), fmt::arg("alpha", draw.color.value.w),
        fmt::arg("kept", c.target.color && cases::is_integer(c.target.color->format)
                             ? std::string("of integers")
                             : fmt::format("of an alpha of {}", draw.color.value.w)),
        fmt::arg("scissor", fmt::format("x {} to {}, y {} to {}", r.x, int64_t{r.x} + r.width, r.y,
                                        int64_t{r.y} + r.height)),
        fmt::arg("viewport", fmt::format("x {} to {}, y {} to {}", left, right, top, bottom)),
        fmt::arg("edge", outside_text(t, reason.which)), fmt::arg("facing", facing_text(t.facing)),
        fmt::arg("number", reason.which), fmt::arg("plane", kPlanes[plane]),
        fmt::arg("discarded", discarded_text(draw)), fmt::arg("attribute", draw.discard_attribute),
        fmt::arg("boxes", boxes_text(t)));
}

std::string sentence_of(const FixedSet& set, const std::vector<cases::Triangle>& triangles) {
    const std::string number = set.count == set.least ? fmt::format("exactly {}", set.count)
                               : set.least == 0       ? fmt::format("at most {}", set.count)
                                                : fmt::format("{} to {}", set.least, set.count);
    return fmt::format(fmt::runtime(text_of(set.why)), fmt::arg("number", number),
                       fmt::arg("triangles", triangles_text(set.triangles, triangles)));
}

std::string sentence_of(ReasonKind depth_reason, DepthOutcome outcome, cases::CompareOp compare,
                        const std::string& depths) {
    const std::string_view told = outcome == DepthOutcome::passes  ? "passes"
                                  : outcome == DepthOutcome::fails ? "fails"
                                                                   : "may pass or fail";
    return fmt::format(fmt::runtime(text_of(depth_reason)), fmt::arg("outcome", told),
                       fmt::arg("compare", kCompareNames[static_cast<size_t>(compare)]),
                       fmt::arg("depths", depths));
}

std::string sentence_of(const path::Fate& fate, const cases::DepthBounds& bounds) {
    const bool may_pass = fate.is_tested();
    const auto pick = [&](std::string_view passes, std::string_view fails, std::string_view open) {
        return !fate.fails_bounds ? passes : may_pass ? open : fails;
    };
    return fmt::format(fmt::runtime(text_of(ReasonKind::bounds_test)),
                       fmt::arg("outcome", pick("passes", "fails", "may pass or fail")),
                       fmt::arg("lies", pick("lies", "does not lie", "may or may not lie")),
                       fmt::arg("bounds", fmt::format("{} to {}", bounds.min, bounds.max)));
}

std::string sentence_of(const path::Fate& fate, const cases::StencilState& state, bool can_be_front,
                        bool can_be_back) {
    const bool passes = fate.passes || fate.fails_depth || fate.is_discarded;
    const std::string_view told = passes && !fate.fails   ? "passes"
                                  : fate.fails && !passes ? "fails"
                                                          : "may pass or fail";
    std::string out;
    for (const bool front : {true, false}) {
        if (front ? !can_be_front : !can_be_back) {
            continue;
        }
        const cases::StencilFace& face = front ? state.front : state.back;
        out += out.empty() ? "" : ", or ";
        out += fmt::format(fmt::runtime(text_of(ReasonKind::stencil_test)),
                           fmt::arg("outcome", told), fmt::arg("face", front ? "front" : "back"),
                           fmt::arg("reference", masked(std::to_string(face.reference), face)),
                           fmt::arg("stencil", masked(met_text(fate.met), face)),
                           fmt::arg("compare", kCompareNames[static_cast<size_t>(face.compare)]));
    }
    return out;
}

}  // namespace ref
