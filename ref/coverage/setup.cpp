// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/setup.hpp"

#include <algorithm>
#include <cmath>

#include "cases/model/sample.hpp"
#include "ref/coverage/distance_cut.hpp"
#include "ref/coverage/facing.hpp"
#include "ref/coverage/outline.hpp"
#include "ref/coverage/outline_source.hpp"
#include "ref/number/edge_function.hpp"
#include "ref/number/rational.hpp"
#include "ref/position/position_detail.hpp"

namespace ref {

namespace {

// Decides how an outline's samples are tested, and notes the signs that its area may have.
void settle(const OutlineSource& s, const TriangleSetup& t, Outline& o, AreaSigns& signs) {
    choose_mode(o, t.grid_step, s.profile);
    signs |= signs_of(o, t.grid_step, t.area.keeps_degenerates);
}

// The outline cut by the planes of the view volume, the clip distances tested at each sample. False
// as of cut_outline.
bool tested_outline(const OutlineSource& s, std::span<const ClipPlane> planes, Outline& out,
                    bool& is_bounded) {
    std::vector<ClippedVertex> polygon;
    if (!cut_outline(s, planes, out, polygon)) {
        return false;
    }
    const auto cuts = distance_cuts(cut_source(s), polygon, out.vertices());
    is_bounded = cuts.has_value();
    out.cuts = cuts.value_or(std::vector<DistanceCut>{});
    return true;
}

// Adds the outlines of a device that tests the depth at each sample instead of cutting by the depth
// planes: from the triangle, and from what the borders leave of it.
void add_depth_tested(const OutlineSource& s, TriangleSetup& t, AreaSigns& signs) {
    std::vector<ClipPlane> planes(s.volume.all().begin() + s.volume.view_count,
                                  s.volume.all().end());
    for (const bool is_cut_by_borders : {false, true}) {
        if (is_cut_by_borders) {
            const auto borders = s.volume.borders();
            if (is_inside(s.input, borders)) {
                return;
            }
            planes.insert(planes.begin(), borders.begin(), borders.end());
        }
        std::vector<ClippedVertex> polygon;
        Outline o;
        if (!cut_outline(s, planes, o, polygon)) {
            continue;
        }
        auto cuts = depth_cuts(cut_source(s), polygon, o.vertices(), s.volume.depth());
        if (!cuts) {
            continue;
        }
        o.cuts = std::move(*cuts);
        settle(s, t, o, signs);
        t.tested.push_back(std::move(o));
    }
}

// An outline with this cut may be drawn or not, whatever its vertices say.
DistanceCut open_cut(std::optional<ClipPlane> plane) {
    return {{0, 0, 1}, {0, 0, -1}, plane};
}

// A denormal that is input into a shader, or made by one, may be flushed to zero (Vulkan,
// "Precision and Operation of SPIR-V Instructions"), and so may the z of a position be: a triangle
// just before the near plane may lie on it.
ClipInput with_zero_for_denormal_depths(const ClipInput& triangle, const ClipVolume& volume) {
    ClipInput out = triangle;
    const auto depth = volume.depth();
    if (std::ranges::find(depth, ClipPlane::z_low) != depth.end()) {
        for (glm::vec4& v : out.clip) {
            v.z = v.z > -0x1p-126F && v.z < 0 ? 0.0F : v.z;
        }
    }
    return out;
}

// Nothing has to be drawn of any outline.
void leave_open(TriangleSetup& t) {
    t.unclipped.cuts.push_back(open_cut(ClipPlane::z_low));
    if (t.clipped) {
        t.clipped->cuts.push_back(open_cut(ClipPlane::z_low));
    }
    for (Outline& o : t.tested) {
        o.cuts.push_back(open_cut(ClipPlane::z_low));
    }
}

// Adds the outlines of a device that tests the distances; false if some vertex has no box.
bool add_tested(const OutlineSource& s, TriangleSetup& t, AreaSigns& signs) {
    std::array<std::span<const ClipPlane>, 2> volumes{s.volume.depth(), s.volume.view()};
    const bool leaves_view = !is_inside(s.input, s.volume.view());
    bool is_defined = true;
    for (const bool is_view : {false, true}) {
        if (is_view ? !leaves_view : !t.has_outline) {
            continue;
        }
        Outline o;
        bool is_bounded = true;
        if (!tested_outline(s, volumes[is_view ? 1 : 0], o, is_bounded)) {
            is_defined = is_defined && !is_view;
            continue;
        }
        if (!is_bounded) {
            o.cuts = {open_cut(std::nullopt)};
        }
        const bool is_cut = !is_inside(s.input, s.volume.all().subspan(s.volume.view_count));
        if (o.cuts.empty() && !is_cut) {
            continue;  // the same as the outline that is cut by the distances
        }
        settle(s, t, o, signs);
        (is_view ? t.tested_clipped : t.tested_unclipped) = static_cast<int8_t>(t.tested.size());
        t.tested.push_back(std::move(o));
    }
    if (!leaves_view) {
        t.tested_clipped = t.tested_unclipped;
    }
    return is_defined;
}

void apply_facing(TriangleSetup& t, const AreaSigns& signs, const cases::Draw& draw) {
    t.orientation = signs.only();
    t.can_be_front = can_face_front(signs, draw.front_face);
    t.can_be_back = can_face_back(signs, draw.front_face);
    t.facing = t.can_be_front == t.can_be_back ? Facing::depends
                                               : (t.can_be_front ? Facing::front : Facing::back);
    // A face whose fragments are all taken away is as good as culled.
    const bool culls_front = draw.cull == cases::CullMode::front ||
                             draw.cull == cases::CullMode::front_and_back ||
                             takes_away_face(draw, true);
    const bool culls_back = draw.cull == cases::CullMode::back ||
                            draw.cull == cases::CullMode::front_and_back ||
                            takes_away_face(draw, false);
    t.may_be_culled = (culls_front && t.can_be_front) || (culls_back && t.can_be_back);
    t.can_be_front = t.can_be_front && !culls_front;
    t.can_be_back = t.can_be_back && !culls_back;
    t.drawn_faces = {!culls_front, !culls_back};
    t.is_culled = !t.can_be_front && !t.can_be_back;
    if (t.is_culled) {
        t.kind = TriangleSetup::Kind::nothing;
    }
}

// "discarded if ... negative for all of the vertices".
bool is_culled_by_distance(const cases::Draw& draw, const cases::Triangle& triangle, uint32_t k) {
    return std::all_of(triangle.vertex.begin(), triangle.vertex.end(), [&](uint32_t v) {
        return draw.distances.cull[v][static_cast<glm::vec4::length_type>(k)] < 0;
    });
}
bool is_culled_by_distance(const cases::Draw& draw, const cases::Triangle& triangle) {
    for (uint32_t k = 0; k < draw.distances.cull_count; ++k) {
        if (is_culled_by_distance(draw, triangle, k)) {
            return true;
        }
    }
    return false;
}

// Nothing is promised of the triangle but that it stays inside `window`.
void set_up_anywhere(const OutlineSource& s, ReasonKind why, TriangleSetup& t) {
    t.kind = TriangleSetup::Kind::anywhere;
    t.window.is_viewport_ignored = true;
    apply_facing(t, {true, true, true}, s.draw);
    t.reasons = {{why}};
}

// Of the triangle as it is, before anything is rounded: (x, y, w) of its vertices are linearly
// dependent.
bool is_flat(const std::array<glm::vec4, 3>& clip) {
    const auto q = [](float f) { return rational(f); };
    const auto& [a, b, c] = clip;
    const mpq_class det = q(a.x) * (q(b.y) * q(c.w) - q(c.y) * q(b.w)) -
                          q(a.y) * (q(b.x) * q(c.w) - q(c.x) * q(b.w)) +
                          q(a.w) * (q(b.x) * q(c.y) - q(c.x) * q(b.y));
    return det == 0;
}

// A pixel outside the viewport may be touched by what clipping leaves, or reached once that is
// enlarged.
void widen_for(const PixelArea& area, Window& w) {
    if (area.is_over()) {
        const int64_t by = area.is_unbounded ? int64_t{1} << kPositionBits : kHalfPixel + area.most;
        for (FixedRange* zone : {&w.zone_x, &w.zone_y}) {
            zone->low -= by;
            zone->high += by;
        }
    }
}

// Nothing of the triangle is drawn if its draw has rasterizer discard.
void discard_by_state(const cases::Draw& draw, TriangleSetup& t) {
    if (draw.rasterizer_discard) {
        t.kind = TriangleSetup::Kind::nothing;
        t.reasons.push_back({ReasonKind::discarded});
    }
}

// That planes take the whole triangle away: those beyond which all of its vertices lie, or else
// those beyond which some do.
void tell_planes(const OutlineSource& s, TriangleSetup& t) {
    for (const size_t least : {size_t{3}, size_t{1}}) {
        for (const ClipPlane plane : s.volume.all()) {
            size_t beyond = 0;
            for (size_t i = 0; i < 3; ++i) {
                beyond += is_inside(s.input, i, {&plane, 1}) ? 0U : 1U;
            }
            if (beyond >= least) {
                t.reasons.push_back(reason_of_plane(plane));
            }
        }
        if (!t.reasons.empty()) {
            break;
        }
    }
    t.has_outline = outline_by(s, {}, t.unclipped);
    AreaSigns signs{true, true, true};
    if (t.has_outline) {
        choose_mode(t.unclipped, t.grid_step, s.profile);
        signs = signs_of(t.unclipped, t.grid_step, t.area.keeps_degenerates);
    }
    apply_facing(t, signs, s.draw);
    t.kind = TriangleSetup::Kind::nothing;
}

// The set-up of a triangle of numbers, some of which lies inside each plane.
void set_up_outlines(const OutlineSource& s, bool is_told, TriangleSetup& t) {
    const std::array<glm::vec4, 3>& clip = s.input.clip;
    const cases::Profile profile = s.profile;
    AreaSigns signs;
    t.kind = TriangleSetup::Kind::outlines;
    t.is_clipped = !is_inside(s.input, s.volume.all());
    t.has_outline = outline_by(s, s.volume.without_borders(), t.unclipped);
    if (t.has_outline) {
        settle(s, t, t.unclipped, signs);
    }
    // A vertex beyond the range takes what is cut from its edges with it.
    const bool is_in_range = std::all_of(clip.begin(), clip.end(), [&](const glm::vec4& v) {
        return ref::is_in_guaranteed_range(v, profile);
    });
    bool is_defined = is_in_range && (t.has_outline || t.is_clipped);
    if (t.is_clipped) {
        t.clipped = std::make_shared<Outline>();
    }
    if (t.is_clipped && is_in_range) {
        if (!is_inside(s.input, s.volume.borders())) {  // it leaves the viewport
            is_defined = outline_by(s, s.volume.all(), *t.clipped);
        } else {
            is_defined = t.has_outline;  // the borders cut nothing: the same polygon
            *t.clipped = t.unclipped;
        }
        const bool is_fractional = t.window.zone_x.low != t.window.core_x.low ||
                                   t.window.zone_y.low != t.window.core_y.low;
        if (is_fractional && !t.has_outline) {
            is_defined = false;  // nothing says what the zone around the viewport shows
        }
        if (is_defined) {
            settle(s, t, *t.clipped, signs);
        }
    }
    if (is_defined && s.volume.has_user_planes()) {
        is_defined = add_tested(s, t, signs);
    }
    if (is_defined && !is_inside(s.input, s.volume.depth())) {
        add_depth_tested(s, t, signs);
    }
    const bool crosses_eye =
        std::any_of(clip.begin(), clip.end(), [](const glm::vec4& v) { return !(v.w > 0); });
    if (!is_defined) {
        t.kind = TriangleSetup::Kind::anywhere;
        if (is_told) {
            t.reasons = {{ReasonKind::unbounded}};
        }
        signs = {true, true, true};
    } else if (crosses_eye && profile == cases::Profile::vulkan) {
        // "(clipped or unclipped)": the unclipped area may have the opposite sign.
        signs.negative = signs.positive = true;
    }
    if (!signs.negative && !signs.zero && !signs.positive) {
        t.kind = TriangleSetup::Kind::nothing;  // every outline is empty
        if (is_told) {
            tell_planes(s, t);
        }
        return;
    }
    apply_facing(t, signs, s.draw);
}

}  // namespace

OutlineList TriangleSetup::outlines() const {
    OutlineList out;
    if (has_outline) {
        out.add(&unclipped);
    }
    if (is_clipped) {
        out.add(clipped.get());
    }
    for (const Outline& o : tested) {
        out.add(&o);
    }
    return out;
}

TriangleSetup set_up(const cases::Case& c, const cases::Triangle& triangle, const Limits& limits,
                     cases::Profile profile, VertexBoxes& boxes, const Window& window,
                     bool is_told) {
    const cases::Draw& draw = c.draws[triangle.draw];
    TriangleSetup t;
    t.window = window;
    if (draw.clear) {
        const cases::Rect& r = rect_of(*draw.clear, triangle);
        constexpr int64_t kFar = int64_t{1} << kPositionBits;
        constexpr FixedRange kAll{-kFar, kFar};
        t.window = {r.x, r.x + int64_t{r.width}, r.y, r.y + int64_t{r.height}, kAll, kAll, kAll,
                    kAll};
        t.kind = TriangleSetup::Kind::cleared;
        t.can_be_front = true;
        t.drawn_faces.front = true;
        discard_by_state(draw, t);
        return t;
    }
    t.area = pixel_area_of(draw, limits, profile);
    widen_for(t.area, t.window);
    t.grid_step = int64_t{1} << (kFixedBits - limits.subpixel_bits);
    const OutlineSource s{draw,
                          triangle,
                          limits,
                          profile,
                          boxes,
                          window,
                          {draw, triangle.vertex},
                          clip_volume_of(draw)};
    const std::array<glm::vec4, 3>& clip = s.input.clip;
    const bool is_number = std::all_of(
        clip.begin(), clip.end(), [&](const glm::vec4& v) { return is_representable(v, profile); });
    if (!is_number) {
        // Undefined for this primitive, anywhere inside scissor and framebuffer.
        set_up_anywhere(s, ReasonKind::undefined, t);
        discard_by_state(draw, t);
        return t;
    }
    t.is_flat = t.area.keeps_degenerates && is_flat(clip);
    const bool is_outside = is_trivially_outside(clip, s.volume.view());
    const ClipInput flushed = with_zero_for_denormal_depths(s.input, s.volume);
    const bool may_be_flushed = is_outside && !is_trivially_outside(flushed.clip, s.volume.view());
    const bool is_culled = is_culled_by_distance(draw, triangle);
    if (!is_told && ((is_outside && !may_be_flushed) || is_culled || draw.rasterizer_discard)) {
        return t;
    }
    // "x/w ... division by zero produces an unspecified result" (Vulkan, "General Requirements"); a
    // denormal w may be flushed to zero. Direct3D clips to 0 < w before it divides.
    const bool may_divide_by_zero = profile != cases::Profile::direct3d &&
                                    std::any_of(clip.begin(), clip.end(), [](const glm::vec4& v) {
                                        return std::fabs(v.w) < 0x1p-126F;
                                    });
    if (is_outside && !may_be_flushed) {
        tell_planes(s, t);
    } else if (may_divide_by_zero) {
        set_up_anywhere(s, ReasonKind::undefined, t);
    } else if (may_be_flushed) {
        OutlineSource other = s;
        other.input = flushed;
        set_up_outlines(other, is_told, t);
        leave_open(t);
        t.reasons.push_back({ReasonKind::flushed});
    } else {
        set_up_outlines(s, is_told, t);
    }
    for (uint32_t k = 0; is_culled && k < draw.distances.cull_count; ++k) {
        if (is_culled_by_distance(draw, triangle, k)) {
            t.kind = TriangleSetup::Kind::nothing;
            t.reasons.push_back({ReasonKind::cull_distance, static_cast<uint8_t>(k)});
        }
    }
    discard_by_state(draw, t);
    return t;
}

bool is_plain_triangle(const Outline& o) {
    return o.count == 3 && o.must_count == 3 &&
           std::all_of(o.edge.begin(), o.edge.begin() + 3,
                       [](EdgeLabel e) { return e < kFirstClipEdge; });
}

FixedPoint middle_of(const Box& box) {
    return {box.x0 + (box.x1 - box.x0) / 2, box.y0 + (box.y1 - box.y0) / 2};
}

std::vector<FixedPoint> grid_points(const Box& box, int64_t step) {
    std::vector<FixedPoint> out;
    for (int64_t y = box.y0; y <= box.y1; y += step) {
        for (int64_t x = box.x0; x <= box.x1; x += step) {
            out.push_back({x, y});
        }
    }
    return out;
}

}  // namespace ref
