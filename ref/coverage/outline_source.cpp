// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/outline_source.hpp"

#include "ref/number/rational.hpp"
#include "ref/position/position_detail.hpp"

namespace ref {

namespace {

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
    return rational(a.x) * rational(b.w) == rational(b.x) * rational(a.w) ||
           rational(a.y) * rational(b.w) == rational(b.y) * rational(a.w);
}

bool is_before_eye(const std::array<glm::vec4, 3>& clip, EdgeLabel edge) {
    return clip[edge].w > 0 && clip[(edge + 1U) % 3U].w > 0;
}

// Whether a cut vertex lies where an edge of the triangle, or a depth plane's, meets the border of
// the viewport: a device with a guard band has no vertex there, only an edge that runs across. An
// axis-aligned edge between two vertices before the eye is snapped to the same coordinate wherever
// it is cut. One that passes through the eye's plane is not: far outside, w is the small difference
// of two numbers, whose rounding errors the division by it makes as large as subpixels.
bool is_crossing(const std::array<glm::vec4, 3>& clip, EdgeLabel in, EdgeLabel out) {
    constexpr EdgeLabel kFirstDepthEdge = kFirstClipEdge + static_cast<EdgeLabel>(ClipPlane::z_low);
    const auto is_border = [](EdgeLabel e) { return e >= kFirstClipEdge && e < kFirstDepthEdge; };
    if (is_border(in) == is_border(out)) {
        return false;
    }
    const EdgeLabel line = is_border(in) ? out : in;
    return line >= kFirstDepthEdge || !is_before_eye(clip, line) || !is_axis_aligned(clip, line);
}

// The outline of a clipped triangle. False if some vertex has no box.
bool outline_of(const std::vector<ClippedVertex>& polygon, const OutlineSource& s, Outline& out) {
    out.count = out.cut_corners = 0;
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
        const bool is_on_plane = v.edge >= kFirstClipEdge || in >= kFirstClipEdge;
        out.cut_corners += v.original >= 0 && is_on_plane ? 1U : 0U;
    }
    return true;
}

}  // namespace

bool cut_outline(const OutlineSource& s, std::span<const ClipPlane> planes, Outline& out,
                 std::vector<ClippedVertex>& polygon) {
    bool is_sure = true;
    polygon = clip_triangle(s.input, s.draw.viewport, s.profile, planes, &is_sure);
    return is_sure && outline_of(polygon, s, out);
}

bool outline_by(const OutlineSource& s, std::span<const ClipPlane> planes, Outline& out) {
    out.count = out.cut_corners = 0;
    if (is_inside(s.input, planes)) {
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
    std::vector<ClippedVertex> polygon;
    return cut_outline(s, planes, out, polygon);
}

CutSource cut_source(const OutlineSource& s) {
    CutSource out{s.input, s.draw.viewport, s.profile, {}, s.window};
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec4& v = s.input.clip[i];
        out.vertex[i] = v.w < 0 ? position_box(-v, s.draw.viewport, s.limits, s.profile)
                                : s.boxes.of(s.triangle.draw, s.triangle.vertex[i]);
    }
    return out;
}

}  // namespace ref
