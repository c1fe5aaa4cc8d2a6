// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/setup.hpp"

#include <algorithm>
#include <cmath>

#include "ref/coverage/distance_cut.hpp"
#include "ref/coverage/facing.hpp"
#include "ref/coverage/outline.hpp"
#include "ref/number/edge_function.hpp"
#include "ref/position/position_detail.hpp"

namespace ref {

namespace {

mpq_class exact(float f) {
    return mpq_class(static_cast<double>(f));
}

mpz_class floor_units(const mpq_class& pixels) {
    const mpq_class units = pixels * kFixedOne;
    mpz_class r;
    mpz_fdiv_q(r.get_mpz_t(), units.get_num_mpz_t(), units.get_den_mpz_t());
    return r;
}

mpz_class ceil_units(const mpq_class& pixels) {
    return -floor_units(-pixels);
}

int64_t saturate(const mpz_class& v) {
    constexpr int64_t kFar = int64_t{1} << kPositionBits;
    return v > kFar ? kFar : (v < -kFar ? -kFar : int64_t{v.get_si()});
}

bool is_integer(float f) {
    return !(std::floor(f) < f);
}

void axis_window(float origin, float extent, cases::Profile profile, FixedRange& zone,
                 FixedRange& core) {
    const mpq_class end = exact(origin) + exact(extent);
    const mpq_class low = std::min<mpq_class>(exact(origin), end);
    const mpq_class high = std::max<mpq_class>(exact(origin), end);
    if (is_integer(origin) && is_integer(extent)) {
        // Polygon clipping: a sample on the border lies on an edge; only the top-left rule decides
        // it.
        const int64_t open = profile == cases::Profile::direct3d ? 1 : 0;
        zone = {saturate(ceil_units(low)), saturate(floor_units(high)) - open};
        core = zone;
        return;
    }
    // viewportSubPixelBits may be 0, and Direct3D 11.3, 15.6.1 has a zone of up to half a pixel:
    // within less than a pixel of a fractional border both answers are left open.
    zone = {saturate(floor_units(low - 1)) + 1, saturate(ceil_units(high + 1)) - 1};
    core = {saturate(ceil_units(low + 1)), saturate(floor_units(high - 1))};
}

struct Source {
    const cases::Draw& draw;
    const cases::Triangle& triangle;
    const Limits& limits;
    cases::Profile profile;
    VertexBoxes& boxes;
    const Window& window;
    ClipInput input;
    ClipVolume volume;
};

// As for a vertex of the triangle (ref/position/position.hpp). x, y and z of a vertex of the view
// volume are at most w.
bool is_in_guaranteed_range(const ClippedVertex& v, cases::Profile profile) {
    constexpr int64_t kLargest = int64_t{1} << 32;
    return profile != cases::Profile::vulkan || v.position.inv_w <= kLargest;
}

// Whether all points of an edge of the triangle have the same ideal x, or the same ideal y.
bool is_axis_aligned(const std::array<glm::vec4, 3>& clip, EdgeLabel edge) {
    const glm::vec4& a = clip[edge];
    const glm::vec4& b = clip[(edge + 1U) % 3U];
    return exact(a.x) * exact(b.w) == exact(b.x) * exact(a.w) ||
           exact(a.y) * exact(b.w) == exact(b.y) * exact(a.w);
}

// Whether a cut vertex lies where an edge of the triangle, or a depth plane's, meets the border of
// the viewport: a device with a guard band has no vertex there, only an edge that runs across. An
// axis-aligned edge is snapped to the same coordinate wherever it is cut.
bool is_crossing(const std::array<glm::vec4, 3>& clip, EdgeLabel in, EdgeLabel out) {
    constexpr EdgeLabel kFirstDepthEdge = kFirstClipEdge + static_cast<EdgeLabel>(ClipPlane::z_low);
    const auto is_border = [](EdgeLabel e) { return e >= kFirstClipEdge && e < kFirstDepthEdge; };
    if (is_border(in) == is_border(out)) {
        return false;
    }
    const EdgeLabel line = is_border(in) ? out : in;
    return line >= kFirstDepthEdge || !is_axis_aligned(clip, line);
}

// False if some vertex has no box.
bool outline_of(const std::vector<ClippedVertex>& polygon, const Source& s, Outline& out) {
    out.count = 0;
    if (polygon.size() > kMaxClippedVertices) {
        return false;
    }
    for (size_t i = 0; i < polygon.size(); ++i) {
        const ClippedVertex& v = polygon[i];
        const EdgeLabel in = polygon[(i + polygon.size() - 1) % polygon.size()].edge;
        std::optional<Box> box;
        if (v.original >= 0) {
            box = s.boxes.of(s.triangle.draw, s.triangle.vertex[static_cast<size_t>(v.original)]);
        } else if (!v.is_bounded || !is_in_guaranteed_range(v, s.profile)) {
            return false;
        } else if (is_crossing(s.input.clip, in, v.edge)) {
            box = box_around_crossing(v.position.x, v.position.y, v.error, s.draw.viewport,
                                      s.limits, s.profile);
            out.is_on_grid = false;
        } else {
            box = box_around(v.position.x, v.position.y, v.error, s.draw.viewport, s.limits,
                             s.profile);
        }
        if (!box) {
            return false;
        }
        out.boxes[out.count] = *box;
        out.edge[out.count] = v.edge;
        ++out.count;
    }
    return true;
}

// The outline cut by `planes`, which holds no border of the viewport or all of them.
bool outline_by(const Source& s, std::span<const ClipPlane> planes, Outline& out) {
    out.count = 0;
    const std::array<size_t, 3> all{0, 1, 2};
    if (std::all_of(all.begin(), all.end(),
                    [&](size_t i) { return is_inside(s.input, i, planes); })) {
        for (uint32_t i = 0; i < 3; ++i) {
            const std::optional<Box>& box = s.boxes.of(s.triangle.draw, s.triangle.vertex[i]);
            if (!box) {
                return false;
            }
            out.boxes[i] = *box;
            out.edge[i] = static_cast<EdgeLabel>(i);
        }
        out.count = 3;
        return true;
    }
    return outline_of(clip_triangle(s.input, s.draw.viewport, s.profile, planes), s, out);
}

// The outline cut by the planes of the view volume, the clip distances tested at each sample. False
// if some vertex has no box.
bool tested_outline(const Source& s, std::span<const ClipPlane> planes, Outline& out,
                    bool& is_bounded) {
    const std::vector<ClippedVertex> polygon =
        clip_triangle(s.input, s.draw.viewport, s.profile, planes);
    if (!outline_of(polygon, s, out)) {
        return false;
    }
    CutSource source{s.input, s.draw.viewport, s.profile, {}, s.window};
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec4& v = s.input.clip[i];
        source.vertex[i] = v.w < 0 ? position_box(-v, s.draw.viewport, s.limits, s.profile)
                                   : s.boxes.of(s.triangle.draw, s.triangle.vertex[i]);
    }
    const auto cuts = distance_cuts(source, polygon, out.vertices());
    is_bounded = cuts.has_value();
    out.cuts = cuts.value_or(std::vector<DistanceCut>{});
    return true;
}

// What does not follow from the vertices: an outline that may be drawn or not.
constexpr DistanceCut kOpenCut = {{0, 0, 1}, {0, 0, -1}};

// Adds the outlines of a device that tests the distances; false if some vertex has no box.
bool add_tested(const Source& s, TriangleSetup& t, AreaSigns& signs) {
    std::array<std::span<const ClipPlane>, 2> volumes{s.volume.depth(), s.volume.view()};
    const std::array<size_t, 3> all{0, 1, 2};
    const bool leaves_view = !std::all_of(
        all.begin(), all.end(), [&](size_t i) { return is_inside(s.input, i, s.volume.view()); });
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
            o.cuts = {kOpenCut};
        }
        const bool is_cut = std::any_of(all.begin(), all.end(), [&](size_t i) {
            return !is_inside(s.input, i, s.volume.all().subspan(s.volume.view_count));
        });
        if (o.cuts.empty() && !is_cut) {
            continue;  // the same as the outline that is cut by the distances
        }
        choose_mode(o, t.grid_step, s.profile);
        signs |= signs_of(o, t.grid_step);
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
    const bool culls_front =
        draw.cull == cases::CullMode::front || draw.cull == cases::CullMode::front_and_back;
    const bool culls_back =
        draw.cull == cases::CullMode::back || draw.cull == cases::CullMode::front_and_back;
    t.may_be_culled = (culls_front && t.can_be_front) || (culls_back && t.can_be_back);
    t.can_be_front = t.can_be_front && !culls_front;
    t.can_be_back = t.can_be_back && !culls_back;
    if (!t.can_be_front && !t.can_be_back) {
        t.kind = TriangleSetup::Kind::nothing;
    }
}

// "discarded if ... negative for all of the vertices".
bool is_culled_by_distance(const cases::Draw& draw, const cases::Triangle& triangle) {
    for (uint32_t k = 0; k < draw.distances.cull_count; ++k) {
        if (std::all_of(triangle.vertex.begin(), triangle.vertex.end(), [&](uint32_t v) {
                return draw.distances.cull[v][static_cast<glm::vec4::length_type>(k)] < 0;
            })) {
            return true;
        }
    }
    return false;
}

}  // namespace

bool Window::may_touch(const FixedPoint& p) const {
    const int64_t i = p.x >> kFixedBits;  // arithmetic shift: floor
    const int64_t j = p.y >> kFixedBits;
    return i >= pixel_x0 && i < pixel_x1 && j >= pixel_y0 && j < pixel_y1 &&
           (is_viewport_ignored || (zone_x.contains(p.x) && zone_y.contains(p.y)));
}

bool Window::must_touch(const FixedPoint& p) const {
    return may_touch(p) && core_x.contains(p.x) && core_y.contains(p.y);
}

std::array<const Outline*, 4> TriangleSetup::outlines(size_t& count) const {
    std::array<const Outline*, 4> out{};
    count = 0;
    if (has_outline) {
        out[count++] = &unclipped;
    }
    if (is_clipped) {
        out[count++] = clipped.get();
    }
    for (const Outline& o : tested) {
        out[count++] = &o;
    }
    return out;
}

Window window_of(const cases::Case& c, const cases::Draw& draw, cases::Profile profile) {
    Window w;
    const cases::Rect& r = draw.scissor;
    w.pixel_x0 = std::max<int64_t>(0, r.x);
    w.pixel_y0 = std::max<int64_t>(0, r.y);
    w.pixel_x1 = std::min<int64_t>(c.target.width, int64_t{r.x} + r.width);
    w.pixel_y1 = std::min<int64_t>(c.target.height, int64_t{r.y} + r.height);
    axis_window(draw.viewport.x, draw.viewport.width, profile, w.zone_x, w.core_x);
    axis_window(draw.viewport.y, draw.viewport.height, profile, w.zone_y, w.core_y);
    const cases::Multisample& m = draw.multisample;
    w.sample_mask = m.sample_mask & m.shader_mask.value_or(0xffffffffU);
    return w;
}

TriangleSetup set_up(const cases::Case& c, const cases::Triangle& triangle, const Limits& limits,
                     cases::Profile profile, VertexBoxes& boxes, const Window& window) {
    const cases::Draw& draw = c.draws[triangle.draw];
    TriangleSetup t;
    t.window = window;
    t.grid_step = int64_t{1} << (kFixedBits - limits.subpixel_bits);
    const Source s{draw,
                   triangle,
                   limits,
                   profile,
                   boxes,
                   window,
                   {draw, triangle.vertex},
                   clip_volume_of(draw)};
    const std::array<glm::vec4, 3>& clip = s.input.clip;
    if (draw.rasterizer_discard) {
        return t;  // covers nothing
    }
    AreaSigns signs;
    const bool is_number = std::all_of(
        clip.begin(), clip.end(), [&](const glm::vec4& v) { return is_representable(v, profile); });
    if (!is_number) {
        // Undefined for this primitive, anywhere inside scissor and framebuffer.
        t.kind = TriangleSetup::Kind::anywhere;
        t.window.is_viewport_ignored = true;
        apply_facing(t, {true, true, true}, draw);
        return t;
    }
    if (is_trivially_outside(clip, s.volume.view()) || is_culled_by_distance(draw, triangle)) {
        return t;
    }
    // "x/w ... division by zero produces an unspecified result" (Vulkan, "General Requirements"); a
    // denormal w may be flushed to zero. Direct3D clips to 0 < w before it divides.
    const bool may_divide_by_zero = profile != cases::Profile::direct3d &&
                                    std::any_of(clip.begin(), clip.end(), [](const glm::vec4& v) {
                                        return std::fabs(v.w) < 0x1p-126F;
                                    });
    if (may_divide_by_zero) {
        t.kind = TriangleSetup::Kind::anywhere;
        t.window.is_viewport_ignored = true;
        apply_facing(t, {true, true, true}, draw);
        return t;
    }
    t.kind = TriangleSetup::Kind::outlines;
    const std::array<size_t, 3> all{0, 1, 2};
    t.is_clipped = !std::all_of(all.begin(), all.end(),
                                [&](size_t i) { return is_inside(s.input, i, s.volume.all()); });
    t.has_outline = outline_by(s, s.volume.without_borders(), t.unclipped);
    if (t.has_outline) {
        choose_mode(t.unclipped, t.grid_step, profile);
        signs |= signs_of(t.unclipped, t.grid_step);
    }
    // A vertex beyond the range takes what is cut from its edges with it.
    const bool is_in_range = std::all_of(clip.begin(), clip.end(), [&](const glm::vec4& v) {
        return is_in_guaranteed_range(v, profile);
    });
    bool is_defined = is_in_range && (t.has_outline || t.is_clipped);
    if (t.is_clipped) {
        t.clipped = std::make_shared<Outline>();
    }
    if (t.is_clipped && is_in_range) {
        const bool leaves_viewport = !std::all_of(all.begin(), all.end(), [&](size_t i) {
            return is_inside(s.input, i, s.volume.all().first(4));
        });
        if (leaves_viewport) {
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
            choose_mode(*t.clipped, t.grid_step, profile);
            signs |= signs_of(*t.clipped, t.grid_step);
        }
    }
    if (is_defined && s.volume.has_user_planes()) {
        is_defined = add_tested(s, t, signs);
    }
    const bool crosses_eye =
        std::any_of(clip.begin(), clip.end(), [](const glm::vec4& v) { return !(v.w > 0); });
    if (!is_defined) {
        t.kind = TriangleSetup::Kind::anywhere;
        signs = {true, true, true};
    } else if (crosses_eye && profile == cases::Profile::vulkan) {
        // "(clipped or unclipped)": the unclipped area may have the opposite sign.
        signs.negative = signs.positive = true;
    }
    if (!signs.negative && !signs.zero && !signs.positive) {
        t.kind = TriangleSetup::Kind::nothing;  // every outline is empty
        return t;
    }
    apply_facing(t, signs, draw);
    return t;
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
