// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/model/statement.hpp"

namespace cases {

namespace {

using enum Strictness;

// Sources: Vulkan specification 1.4 and Direct3D 11.3 functional specification 1.17; the anchors
// stand with the rules (rule.cpp).
constexpr Statement kStatements[] = {
    // clang-format off
    {1, "the same command with the same state, twice", exact, exact,
     "Every bit of every attachment is the same, samples that are open included.",
     {"repeat.same"}, ""},
    {2, "the scissor decides what is kept, not what is covered", exact, exact,
     "The union of scissored pieces equals the unscissored picture bit for bit, open "
     "samples included.",
     {"repeat.scissor"}, ""},
    {3, "attachment contents, write masks and clear values do not change coverage", exact, exact,
     "The same case over other clear values and under other write masks covers the same "
     "samples.",
     {"repeat.clears", "repeat.write-masks"}, ""},
    {4, "color attachments of one draw get the same fragments", exact, exact,
     "All attachments of a sample tell of the same fragments; with more or fewer "
     "attachments the picture is the same.",
     {"write.consistent", "repeat.attachments"}, ""},
    {5, "depth, blend and stencil parameters and coverage", Strictness::free, Strictness::free,
     "",
     {}, "Vulkan only suggests it: a difference inside the open band is legal, and outside the "
     "band the coverage rules already speak."},
    {6, "moving a triangle by whole pixels", Strictness::free, Strictness::free,
     "",
     {}, "Vulkan removed this invariance on purpose; each picture is judged by its own geometry"
     " instead."},
    {7, "a sample strictly inside, vertices on the subpixel grid", exact, exact,
     "Must be hit.",
     {"cover.inside"}, ""},
    {8, "a sample strictly outside, vertices on the subpixel grid", exact, exact,
     "Must not be hit.",
     {"cover.outside"}, ""},
    {9, "vertices off the subpixel grid", Strictness::free, tolerance,
     "Every position that the profile allows is tried: must, must not, or open.",
     {"cover.inside", "cover.outside", "snap.nearest"}, ""},
    {10, "which way vertices are rounded", Strictness::free, tolerance,
     "At direct3d to the nearest, within 0.6 of a unit; at practice down or up; at vulkan "
     "it is not given.",
     {"snap.nearest", "cover.inside", "cover.outside"}, "", Profile::practice},
    {11, "a sample on an edge that two triangles share", exact, exact,
     "Exactly one of the two hits it; which one, only direct3d says.",
     {"cover.shared-edge", "tie.top-left"}, ""},
    {12, "a sample on an edge that no triangle shares", Strictness::free, exact,
     "Open at vulkan; decided by the top-left rule at direct3d.",
     {"tie.top-left"}, ""},
    {13, "a sample on a vertex that several triangles share", contrary, exact,
     "One hit at practice, although the text speaks of pairs only.",
     {"cover.shared-vertex", "tie.top-left"}, ""},
    {14, "the inside of a closed mesh", exact, exact,
     "Every sample is hit once however the vertices are snapped; slivers that may turn over"
     " count with their sign.",
     {"cover.shared-edge", "cover.shared-vertex"}, ""},
    {15, "a shared edge of triangles of two pipelines", Strictness::free, Strictness::free,
     "",
     {}, "Positions computed by two pipelines need not be equal. All cases here pass positions "
     "through unchanged, in draws of one vertex shader, and are judged as one mesh."},
    {16, "a vertex in the middle of a neighbour's edge", Strictness::free, Strictness::free,
     "No rule joins the triangles: each sample is judged by each triangle alone, so exact "
     "gaps and overlaps are predicted where the vertices are on the grid.",
     {"cover.inside", "cover.outside"}, ""},
    {17, "two triangles on the same side of an edge, or one of them culled", Strictness::free, exact,
     "Each triangle is judged alone; ties by top-left at direct3d.",
     {"tie.top-left", "face.cull"}, ""},
    {18, "a triangle without area", exact, exact,
     "Back-facing; nothing off its line is hit. Samples on the line are open at vulkan, not"
     " hit at direct3d.",
     {"cover.degenerate", "cover.outside", "face.area-sign"}, ""},
    {19, "a sliver that may collapse or turn over when it is snapped", Strictness::free, exact,
     "Open inside the hull of the positions, not hit outside it.",
     {"cover.outside", "cover.degenerate"}, ""},
    {20, "NaN and infinite positions", undefined, Strictness::free,
     "Nothing is asked of the triangle itself; all others and everything outside scissor "
     "and framebuffer stay right, and the device lives.",
     {"number.undefined"}, ""},
    {21, "magnitudes beyond 2^32", undefined, tolerance,
     "Open at vulkan; the other profiles go as far as binary32.",
     {"cover.inside", "clip.volume"}, "", Profile::practice},
    {22, "a vertex behind the eye", exact, exact,
     "The exact clipped polygon, with its derived band; nothing of the part behind the eye.",
     {"clip.volume"}, ""},
    {23, "a vertex with w = 0", undefined, exact,
     "Clipped exactly where the rest of the triangle is defined; the device lives.",
     {"clip.volume", "number.undefined"}, ""},
    {24, "facing where every allowed position gives the same sign", exact, exact,
     "Front and back hits are counted apart.",
     {"face.area-sign"}, ""},
    {25, "facing where the sign depends on snapping", Strictness::free, exact,
     "Either face, decided by the snapped vertices at direct3d.",
     {"face.area-sign"}, "", Profile::direct3d},
    {26, "facing of a triangle with vertices behind the eye", contrary, exact,
     "The sign of what is visible, at practice: the text allows the area of the unclipped "
     "triangle, which has the other sign.",
     {"face.area-sign"}, "", Profile::practice},
    {27, "culling", exact, exact,
     "A culled triangle hits nothing.",
     {"face.cull"}, ""},
    {28, "nothing outside the viewport", exact, exact,
     "Samples beyond an integer viewport are not hit.",
     {"clip.viewport"}, ""},
    {29, "the border of a fractional viewport", tolerance, Strictness::free,
     "The pixel on either side of the border is open.",
     {"clip.viewport"}, ""},
    {30, "a viewport finer than viewportSubPixelBits", Strictness::free, exact,
     "Positions are widened by what the device may shift the viewport.",
     {"clip.viewport", "cover.inside"}, ""},
    {31, "depth clipping on and off", exact, exact,
     "Which planes cut is exact; where they cut has the band of the depth at the plane.",
     {"clip.volume", "clip.depth"}, ""},
    {32, "user clip distances", tolerance, exact,
     "Hit where the interpolated distance is positive, not where it is negative, open "
     "inside the derived band.",
     {"clip.distance"}, ""},
    {33, "clip distances d and -d", exact, not_spoken,
     "Together they hit every sample exactly as often as the triangle without them.",
     {"clip.complement"}, ""},
    {34, "user cull distances", exact, exact,
     "A triangle whose three distances are negative hits nothing.",
     {"cull.distance"}, ""},
    {35, "a clipped polygon is one polygon", exact, exact,
     "No hole and no second hit along the diagonals that a clipper adds.",
     {"clip.volume", "cover.inside"}, ""},
    {36, "a shared edge after clipping", Strictness::free, Strictness::free,
     "Stays closed, at practice; inside the band Vulkan does not promise it.",
     {"cover.clipped-edge"}, ""},
    {37, "the scissor rectangle", exact, exact,
     "Half-open, by sample.",
     {"scissor.half-open"}, ""},
    {38, "nothing outside the framebuffer", exact, exact,
     "Tiny and odd targets with triangles far beyond them; buffers before and after each "
     "attachment, in its own memory, keep every word.",
     {"cover.outside", "write.outside"}, ""},
    {39, "drawing outside the render area", not_spoken, not_spoken,
     "",
     {}, "The application must prevent it; there is nothing that a device could do wrong."},
    {40, "standard sample locations", exact, exact,
     "Coverage, depth and values at the sixteenths that the specification lists; devices "
     "without them are asked with locations of the case's own.",
     {"sample.locations"}, ""},
    {41, "sample mask and gl_SampleMask", exact, exact,
     "A sample is written if and only if it is covered and both masks have its bit.",
     {"sample.mask", "sample.mask-in"}, ""},
    {42, "alpha to coverage", Strictness::free, Strictness::free,
     "",
     {}, "Not checked: no case turns it on. No algorithm is given, and even the ends 0 and 1 are "
     "only intended; that it adds no sample is certain, and not checked either."},
    {43, "the number of invocations under sample shading", tolerance, exact,
     "At least as many distinct ones as minSampleShading asks for; more are always legal.",
     {"sample.shading", "sample.id"}, ""},
    {44, "how often a fragment shader runs", Strictness::free, Strictness::free,
     "",
     {}, "Shaders may run more often than there are fragments; therefore nothing here counts by"
     " stores or atomics."},
    {45, "FragCoord.xy without sample shading", exact, exact,
     "The pixel centre, bit for bit.",
     {"fragcoord.xy"}, ""},
    {46, "FragCoord.xy under sample shading", exact, exact,
     "One of the invocation's samples, bit for bit.",
     {"fragcoord.sample"}, ""},
    {47, "FragCoord.z", contrary, exact,
     "The hull over centre and samples, with and without bias.",
     {"depth.linear"}, ""},
    {48, "FragCoord.w", tolerance, tolerance,
     "The interpolated 1/w within the budget.",
     {"fragcoord.w"}, ""},
    {49, "where inputs are evaluated, one sample", exact, exact,
     "At the pixel centre.",
     {"interp.perspective", "interp.linear"}, ""},
    {50, "where undecorated inputs are evaluated, several samples", Strictness::free, exact,
     "Anywhere in the pixel; at direct3d at its centre.",
     {"interp.perspective", "interp.linear"}, ""},
    {51, "where centroid inputs are evaluated", Strictness::free, exact,
     "Anywhere in the part of the pixel that the triangle covers; at direct3d the centre or"
     " the first covered sample.",
     {"interp.centroid", "interp.at-centroid", "interp.perspective"}, ""},
    {52, "where sample inputs are evaluated", exact, exact,
     "At the sample.",
     {"interp.sample", "interp.at-sample"}, ""},
    {53, "interpolateAtOffset", tolerance, exact,
     "At the offset, rounded either way to subPixelInterpolationOffsetBits.",
     {"interp.at-offset"}, ""},
    {54, "the precision of values", tolerance, tolerance,
     "1 part in 10^5 an operation at vulkan; the derived binary32 budget at practice.",
     {"interp.perspective", "interp.linear"}, ""},
    {55, "a constant comes back as the constant", tolerance, tolerance,
     "Within the budget, never by equality.",
     {"interp.perspective", "interp.hull"}, ""},
    {56, "smooth and noperspective", exact, exact,
     "Each by its own formula; cases where the two differ.",
     {"interp.perspective", "interp.linear"}, ""},
    {57, "values on a clipped polygon", Strictness::free, tolerance,
     "Between the vertex values at vulkan; the plane equation at practice.",
     {"interp.hull", "interp.perspective"}, ""},
    {58, "flat values and provoking vertex", exact, exact,
     "Bit for bit the provoking vertex's value, first or last.",
     {"interp.flat", "provoking.first", "provoking.last"}, ""},
    {59, "flat values that are NaN, infinite, -0 or denormal", Strictness::free, exact,
     "A denormal or 0 of either sign arrives as it is or as a zero; NaN and infinity need not "
     "arrive, but spoil nothing else.",
     {"interp.flat", "number.undefined"}, ""},
    {60, "barycentric built-ins", exact, not_spoken,
     "The order of the vertices exactly, the values as any other interpolation.",
     {"barycentric.order", "barycentric.value"}, ""},
    {61, "fine derivatives", exact, exact,
     "The difference of two neighbours in the pixel's own row or column; either neighbour.",
     {"derivative.fine"}, ""},
    {62, "coarse and unqualified derivatives", Strictness::free, Strictness::free,
     "The difference in any row or column of a quad that holds the pixel.",
     {"derivative.coarse", "derivative.plain"}, ""},
    {63, "depth at the sample", tolerance, tolerance,
     "Linear, at the sample's own position, within the budget.",
     {"depth.linear"}, ""},
    {64, "the slope of depth bias", tolerance, exact,
     "Between the larger partial derivative and the Euclidean length.",
     {"depth.bias"}, ""},
    {65, "the unit of depth bias, fixed point", Strictness::free, tolerance,
     "At most 2 * 2^-n and not 0; planes one unit apart stay distinct; 2^-n with "
     "depthBiasExact.",
     {"depth.bias", "depth.distinct"}, ""},
    {66, "the unit of depth bias, floating point", exact, exact,
     "2^(e-23) with the exponent e of the largest depth, in cases where e is unambiguous.",
     {"depth.bias"}, ""},
    {67, "the clamp of depth bias", exact, exact,
     "The clamped bias, exactly.",
     {"depth.bias"}, ""},
    {68, "depth outside the viewport's range without clamp", undefined, exact,
     "Left open: Vulkan makes the value undefined.",
     {}, "Undefined by Vulkan; cases that reach it leave depth free."},
    {69, "depth clamp", exact, exact,
     "Depths beyond the range are the range's end, bit for bit on a floating-point target.",
     {"depth.clamp"}, ""},
    {70, "rounding of depth before it is compared", Strictness::free, exact,
     "Outcomes that depend on the rounding of a D16 or D24 value are open.",
     {"depth.compare", "depth.store"}, ""},
    {71, "the same geometry again under LESS_OR_EQUAL", exact, exact,
     "Every fragment passes the second time.",
     {"depth.repeat"}, ""},
    {72, "writing FragCoord.z to FragDepth", Strictness::free, exact,
     "",
     {}, "Not checked: no shader here writes FragDepth. Vulkan only relates shaders that do so to "
     "each other (Rule 5), not to the depth that fixed functions compute."},
    {73, "storing UNORM", tolerance, tolerance,
     "Either code next to the value; whole codes exactly.",
     {"store.unorm", "store.srgb"}, ""},
    {74, "storing half precision", tolerance, exact,
     "Either neighbour.",
     {"store.half"}, ""},
    {75, "blending on UNORM targets", tolerance, tolerance,
     "With the precision of the destination or more: the set of codes that any such "
     "arithmetic reaches.",
     {"blend.equation"}, ""},
    {76, "blending on floating-point targets", exact, exact,
     "Exactly, where every sum is representable.",
     {"blend.equation", "store.float"}, ""},
    {77, "stencil operations", exact, exact,
     "A stencil that counts up for front and down for back faces holds their difference, "
     "modulo 256.",
     {"stencil.count"}, ""},
    {78, "primitive order", exact, exact,
     "The last one drawn stays, and blending runs in drawing order.",
     {"order.primitive", "blend.equation"}, ""},
    {79, "vkCmdResolveImage", Strictness::free, tolerance,
     "",
     {}, "Mode and precision are the device's choice; no case uses it, samples are read one by "
     "one."},
    {80, "averaging resolve at the end of rendering", tolerance, tolerance,
     "Between the smallest and the largest sample; the mean within a step at practice.",
     {"resolve.average"}, ""},
    {81, "resolves that select", exact, not_spoken,
     "Exactly the selected sample.",
     {"resolve.select"}, ""},
    {82, "blits without scaling, mirrored or by whole factors", exact, not_spoken,
     "The one texel: the same bits from practice on, or a neighbouring code at vulkan.",
     {"blit.nearest", "blit.outside"}, ""},
    {83, "scaled blits", Strictness::free, not_spoken,
     "Any texel, or weight, that the derived error of the coordinate allows; either edge "
     "clamp.",
     {"blit.nearest", "blit.linear"}, ""},
    {84, "level of detail", tolerance, tolerance,
     "Between the largest partial derivative and sqrt(2) times their sum.",
     {"lod.query"}, ""},
    {85, "anisotropic filtering", Strictness::free, Strictness::free,
     "",
     {}, "The scheme is the device's choice."},
    {86, "conservative overestimation", tolerance, tolerance,
     "",
     {}, "Not checked: no pipeline here turns VK_EXT_conservative_rasterization on. A pixel is then "
     "hit if it touches the triangle, enlarged by an amount of the device's choice; the reference "
     "knows points in a triangle, not areas."},
    {87, "conservative underestimation and FullyCovered", tolerance, tolerance,
     "",
     {}, "Not checked, as the statement before."},
    {88, "lines and points", Strictness::free, Strictness::free,
     "",
     {}, "Not triangles."},
    {89, "the layer that a triangle names", exact, exact,
     "All its hits, depths and colours in that layer, none in another.",
     {"layer.select"}, ""},
    {90, "storing integers and binary32", exact, exact,
     "Bit for bit what the shader wrote.",
     {"store.integer", "store.float"}, ""},
    {91, "the colour write mask", exact, exact,
     "Masked components keep their bits.",
     {"blend.write-mask"}, ""},
    {92, "when depth is written", exact, exact,
     "Where the test passes and writes are on; else the older depth stays.",
     {"depth.write"}, ""},
    {93, "rasterizer discard", exact, not_spoken,
     "A draw with it leaves no trace in any attachment; the draws around it are as ever.",
     {"discard.rasterizer"}, ""},
    // clang-format on
};

}  // namespace

std::span<const Statement> all_statements() {
    return kStatements;
}

std::string_view to_string(Strictness strictness) {
    switch (strictness) {
        case exact:
            return "exact";
        case tolerance:
            return "tolerance";
        case Strictness::free:
            return "free";
        case undefined:
            return "undefined";
        case contrary:
            return "unclear";
        case not_spoken:
            break;
    }
    return "-";
}

}  // namespace cases
