// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/rule.hpp"

#include <algorithm>
#include <array>

namespace cases {

namespace {

constexpr std::array kRules = {
    Rule{"cover.inside", Profile::vulkan, "A sample strictly inside a triangle is covered",
         "Whatever positions the device may use for the vertices, the sample is inside: it must be "
         "hit.",
         "primsrast-polygons-basic", "3.4.2", "ref/coverage.hpp"},
    Rule{"cover.outside", Profile::vulkan, "A sample strictly outside a triangle is not covered",
         "The sample is outside the convex hull of the positions that the device may use for the "
         "vertices: "
         "it must not be hit.",
         "primsrast-polygons-basic", "3.4.2", "ref/coverage.hpp"},
    Rule{"cover.shared-edge", Profile::vulkan,
         "A sample on a shared edge belongs to exactly one triangle",
         "If two triangles lie on either side of a common edge with identical end points, a sample "
         "on that edge "
         "is covered by exactly one of them. Which one is free in Vulkan.",
         "primsrast-polygons-basic", "3.4.2", "ref/expectation.hpp"},
    Rule{"cover.shared-vertex", Profile::practice,
         "A sample on a shared vertex belongs to exactly one triangle",
         "The Vulkan text speaks of pairs of triangles and contradicts itself where more than two "
         "meet in the "
         "sample; the intention, and every known device, is exactly one hit.",
         "primsrast-polygons-basic", "3.4.2", "ref/expectation.hpp"},
    Rule{"cover.clipped-edge", Profile::practice, "A shared edge stays closed after clipping",
         "The Vulkan text does not promise that two clipped triangles stay watertight along their "
         "shared edge; "
         "every known clipper does.",
         "vertexpostproc-clipping", "15.4", "ref/expectation.hpp"},
    Rule{"cover.degenerate", Profile::direct3d, "A triangle without area covers nothing",
         "No sample is strictly inside. Vulkan leaves the samples on its edges free; with the "
         "top-left rule "
         "none is hit.",
         "primsrast-polygons-basic", "3.4.2", "ref/coverage.hpp"},
    Rule{"snap.nearest", Profile::direct3d, "Vertices snap to the nearest subpixel position",
         "Direct3D rounds to nearest within 0.6 of a unit; Vulkan names no rounding, practice is "
         "floor or ceil.",
         "limits-subPixelPrecisionBits", "3.2.4.1", "ref/position.hpp"},
    Rule{"tie.top-left", Profile::direct3d,
         "A sample on an edge belongs to the top or left edge's triangle",
         "A top edge is exactly horizontal and above the others, a left edge is not horizontal and "
         "on the left "
         "side. Vulkan does not demand this rule.",
         "primsrast-polygons-basic", "3.4.2", "ref/coverage.hpp"},
    Rule{"face.area-sign", Profile::vulkan, "Facing follows the sign of the area",
         "a = -1/2 sum(x_i y_i+1 - x_i+1 y_i) in framebuffer coordinates; positive is "
         "counter-clockwise. "
         "Zero area is back facing. Free where the sign depends on snapping.",
         "primsrast-polygons-basic", "15.11.1", "ref/coverage.hpp"},
    Rule{"face.cull", Profile::vulkan, "A culled triangle draws nothing",
         "Culling by facing happens before fragments are produced.", "primsrast-polygons-basic",
         "15.11", "ref/expectation.hpp"},
    Rule{"clip.volume", Profile::vulkan, "Nothing is drawn outside the clip volume",
         "-w <= x <= w, -w <= y <= w, 0 <= z <= w; what lies behind the eye does not show.",
         "vertexpostproc-clipping", "15.4", "ref/clip.hpp"},
    Rule{"clip.viewport", Profile::vulkan, "Nothing is drawn outside the viewport",
         "Polygons are clipped to the view volume, so no sample outside the viewport's rectangle "
         "is covered.",
         "vertexpostproc-clipping", "15.6", "ref/clip.hpp"},
    Rule{"number.undefined", Profile::vulkan, "A bad number spoils its own triangle only",
         "NaN and infinity make the result of their own triangle undefined inside scissor and "
         "framebuffer, and so do positions beyond 2^32 (beyond FLT_MAX/16 from practice on); all "
         "other triangles are drawn as ever and nothing is terminated. Denormals and zeros of "
         "either sign are ordinary numbers, but a denormal w may be taken for zero.",
         "fundamentals-floating-point", "15.4", "ref/position.hpp"},
    Rule{"scissor.half-open", Profile::vulkan, "The scissor rectangle is half-open",
         "A sample passes iff x is in [offset.x, offset.x + width) and y likewise.",
         "fragops-scissor", "15.14", "ref/expectation.hpp"},
    Rule{"order.primitive", Profile::vulkan, "Primitives write in drawing order",
         "Of the triangles that hit a sample, the last one drawn is the one that stays.",
         "primsrast-order", "", "ref/expectation.hpp"},
    Rule{"provoking.first", Profile::vulkan, "Flat values come from the first vertex",
         "The provoking vertex is 3i in a list, i in a strip, i+1 in a fan; values are copied "
         "before clipping.",
         "drawing-primitive-topologies", "8.14", "ref/triangle.hpp"},
    Rule{"interp.linear", Profile::practice, "noperspective values are linear in framebuffer space",
         "a f_a + b f_b + c f_c with barycentric coordinates at the sample; binary32 budget of "
         "docs/design.md.",
         "primsrast-polygon-barycentrics", "15.16", "ref/value.hpp"},
    Rule{"interp.perspective", Profile::practice, "smooth values are perspective-correct",
         "(sum a_i f_i/w_i) / (sum a_i/w_i); binary32 budget of docs/precision.md. Vulkan itself "
         "bounds only each operation, to 1 part in 10^5.",
         "primsrast-polygon-barycentrics", "15.16", "ref/value.hpp"},
    Rule{"interp.hull", Profile::vulkan, "A value stays inside the vertex values' range",
         "NaN, or a value outside the hull of the vertex values by more than the budget, is wrong "
         "under every "
         "profile.",
         "primsrast-polygon-barycentrics", "", "ref/value.hpp"},
    Rule{"interp.flat", Profile::vulkan, "flat values arrive bit for bit",
         "Finite normal numbers of the provoking vertex, unchanged.", "vertexpostproc-flatshading",
         "15.16", "ref/value.hpp"},
    Rule{"fragcoord.xy", Profile::vulkan, "FragCoord.xy is the pixel centre",
         "Exactly (i + 1/2, j + 1/2) without sample shading.",
         "interfaces-builtin-variables-fragcoord", "", "ref/value.hpp"},
    Rule{"fragcoord.w", Profile::practice, "FragCoord.w is the interpolated 1/w",
         "Linear in framebuffer space; binary32 budget.", "interfaces-builtin-variables-fragcoord",
         "", "ref/value.hpp"},
    Rule{"write.consistent", Profile::vulkan, "A fragment writes all its attachments, or none",
         "Different color attachments of one draw receive the same fragments, and additive "
         "blending of "
         "exactly representable values is exact.",
         "invariance", "", "diff/capture.cpp"},
    Rule{"depth.linear", Profile::practice, "Depth is linear in framebuffer space",
         "z_f is interpolated linearly at the sample; binary32 budget on a D32 target and for "
         "FragCoord.z.",
         "primsrast-polygon-barycentrics", "15.10", "ref/value.hpp"},
};

}  // namespace

std::span<const Rule> all_rules() {
    return kRules;
}

const Rule* find_rule(std::string_view id) {
    const auto it =
        std::find_if(kRules.begin(), kRules.end(), [&](const Rule& r) { return r.id == id; });
    return it == kRules.end() ? nullptr : &*it;
}

}  // namespace cases
