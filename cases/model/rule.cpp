// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/model/rule.hpp"

#include <algorithm>
#include <array>

#include "cases/model/rule_ids.hpp"

namespace cases {

namespace {

constexpr std::array kRules = {
    Rule{rule::device_limits, Profile::vulkan, "The device's limits are what Vulkan requires",
         "Each limit that bounds what cases may draw is in the table of required limits, by the "
         "device's version and its optional features. A run judges it whatever is selected, under "
         "the id device/limits. A device that claims fewer than 4 subpixel bits is held to the 4 "
         "that are required.",
         "limits-minmax", "", "vk_harness/limits/required_limits.cpp"},
    Rule{rule::cover_inside, Profile::vulkan, "A sample strictly inside a triangle is covered",
         "Whatever positions the device may use for the vertices, the sample is inside: it must be "
         "hit.",
         "primsrast-polygons-basic", "3.4.2", "ref/coverage/exact/exact.cpp"},
    Rule{rule::cover_outside, Profile::vulkan,
         "A triangle covers no sample strictly outside it, and none twice",
         "It must not hit a sample outside the convex hull of the positions that the device may "
         "use for its vertices, nor any sample more than once.",
         "primsrast-polygons-basic", "3.4.2", "ref/coverage/exact/exact.cpp"},
    Rule{rule::cover_shared_edge, Profile::vulkan,
         "A sample on a shared edge belongs to exactly one triangle",
         "If two triangles lie on either side of a common edge with identical end points, a sample "
         "on that edge is covered by exactly one of them. Which one is free in Vulkan.",
         "primsrast-polygons-basic", "3.4.2", "ref/expectation/narrowing.cpp"},
    Rule{rule::cover_shared_vertex, Profile::practice,
         "A sample on a shared vertex belongs to exactly one triangle",
         "The Vulkan text speaks of pairs of triangles and contradicts itself where more than two "
         "meet in the sample; the intention, and every known device, is exactly one hit.",
         "primsrast-polygons-basic", "3.4.2", "ref/expectation/narrowing.cpp"},
    Rule{rule::cover_clipped_edge, Profile::practice, "A shared edge stays closed after clipping",
         "The Vulkan text does not promise that two clipped triangles stay watertight along their "
         "shared edge; every known clipper does.",
         "vertexpostproc-clipping", "15.4", "ref/expectation/narrowing.cpp"},
    Rule{rule::cover_degenerate, Profile::direct3d, "A triangle without area covers nothing",
         "No sample is strictly inside. Vulkan leaves the samples on its edges free; with the "
         "top-left rule none is hit.",
         "primsrast-polygons-basic", "3.4.2", "ref/coverage/exact/exact.cpp"},
    Rule{rule::snap_nearest, Profile::direct3d, "Vertices snap to the nearest subpixel position",
         "Direct3D rounds to nearest within 0.6 of a unit; Vulkan names no rounding, practice is "
         "floor or ceil.",
         "limits-subPixelPrecisionBits", "3.2.4.1", "ref/position/position.hpp"},
    Rule{rule::tie_top_left, Profile::direct3d,
         "A sample on an edge belongs to the top or left edge's triangle",
         "A top edge is exactly horizontal and above the others, a left edge is not horizontal and "
         "on the left side. Vulkan does not demand this rule.",
         "primsrast-polygons-basic", "3.4.2", "ref/coverage/exact/exact.cpp"},
    Rule{
        rule::conservative_overestimate, Profile::vulkan,
        "Overestimated, a triangle covers every pixel that it touches",
        "Where the triangle and the pixel have an area in common, all samples of the pixel are "
        "covered, those outside the triangle and those of every other triangle along a shared "
        "edge, too. Open where they have only their borders in common. What clipping leaves may be "
        "drawn as several triangles, each of which covers what it touches.",
        "primsrast-conservativeraster", "", "ref/coverage/pixel_area.hpp"},
    Rule{rule::conservative_size, Profile::practice,
         "An overestimated triangle is enlarged by the sizes that device and draw name",
         "Each edge is moved outwards by primitiveOverestimationSize and "
         "extraPrimitiveOverestimationSize at most, along x and y alike, and by half of the extra "
         "size at least. Vulkan says that results only approximate these sizes.",
         "primsrast-conservativeraster", "", "ref/coverage/pixel_area.cpp"},
    Rule{rule::conservative_underestimate, Profile::vulkan,
         "Underestimated, a triangle covers the pixels that it fills, and no other",
         "All samples of a pixel are covered if its square, with edges and corners, lies in the "
         "triangle, and else none. Open where the square reaches the triangle's border, or that of "
         "one of the triangles that a clipped one may be drawn as.",
         "primsrast-conservativeraster", "", "ref/coverage/pixel_area.hpp"},
    Rule{rule::conservative_degenerate, Profile::practice,
         "Overestimated, a triangle without area is drawn as the device says",
         "One that has no area once its vertices are snapped covers the pixels that it meets if "
         "degenerateTrianglesRasterized is true, as a back face, and else none. Open for one that "
         "had no area before.",
         "primsrast-conservativeraster", "", "ref/coverage/pixel_area.hpp"},
    Rule{
        rule::fragment_size_area, Profile::vulkan,
        "A fragment of several pixels is a block whose place is a multiple of its size",
        "FragCoord.xy of all its pixels is the centre of the block of f_w x f_h pixels with "
        "p_x = x % f_w and p_y = y % f_h, exactly, wherever viewport, scissor and target begin and "
        "end, and of however many of them the triangle covers samples.",
        "primsrast-multisampling-coverage-mask-vrfs", "", "ref/value/sample_values.cpp"},
    Rule{rule::fragment_size_rate, Profile::vulkan, "gl_ShadingRateEXT is the size of the fragment",
         "The pipeline's size, which the device has among its rates, and 0 of a pipeline without "
         "one: 1 and 2 for 2 and 4 pixels in height, 4 and 8 for 2 and 4 in width.",
         "interfaces-builtin-variables-shadingratekhr", "", "ref/value/sample_values.cpp"},
    Rule{
        rule::fragment_size_shared, Profile::practice,
        "All pixels of a fragment have the same values",
        "One invocation serves them, so that FragCoord and all inputs have the same bits in all "
        "that one triangle wrote last in a block. Vulkan allows further invocations of a fragment, "
        "and says nothing of which pixels each serves; a clipped triangle may be several "
        "fragments.",
        "fragops-shader", "", "diff/fragment_check.cpp"},
    Rule{rule::face_area_sign, Profile::vulkan, "Facing follows the sign of the area",
         "a = -1/2 sum(x_i y_i+1 - x_i+1 y_i) in framebuffer coordinates; positive is "
         "counter-clockwise. Zero area is back facing. Free where the sign depends on snapping.",
         "primsrast-polygons-basic", "15.11.1", "ref/coverage/facing.cpp"},
    Rule{rule::face_cull, Profile::vulkan, "A culled triangle draws nothing",
         "Culling by facing happens before fragments are produced.", "primsrast-polygons-basic",
         "15.11", "ref/coverage/setup.cpp"},
    Rule{rule::discard_rasterizer, Profile::vulkan,
         "With rasterizer discard a draw leaves no trace",
         "Its primitives are discarded before rasterization: no sample, no depth, no stencil and "
         "no colour changes, and the draws before and after it are drawn as ever.",
         "primsrast-discard", "", "ref/coverage/setup.cpp"},
    Rule{
        rule::discard_fragment, Profile::vulkan,
        "A fragment that its shader discards leaves no trace",
        "It changes no colour, no depth and no stencil, unless depth and stencil are tested before "
        "the shader; its neighbours, and the same pixel's other fragments, are drawn as ever.",
        "fragops-shader", "", "cases/model/sample.hpp"},
    Rule{rule::discard_value, Profile::vulkan,
         "A shader that discards negative values discards what must be negative, and nothing that "
         "cannot be",
         "The fragment is gone where every number that the value may be there is below 0, and is "
         "drawn where none is; -0 and 0 are not below it. In between either is right, but what is "
         "drawn shows no negative value: the shader has one value, which it tests and writes. At "
         "direct3d the samples of a pixel share that decision, unless sample shading is on or the "
         "triangle may be clipped into pieces; Vulkan lets a device run the shader more often, and "
         "each run may decide anew.",
         "fragops-shader", "", "ref/value/sign.cpp"},
    Rule{rule::discard_early_tests, Profile::vulkan,
         "With early tests a discarded fragment has stored its depth and stencil",
         "EarlyFragmentTests: depth and stencil are tested and stored before the fragment shader "
         "is executed, so what it discards then takes back its colours alone.",
         "fragops-early-mode", "", "cases/model/sample.hpp"},
    Rule{rule::clip_volume, Profile::vulkan, "Nothing is drawn outside the clip volume",
         "-w <= x <= w, -w <= y <= w, 0 <= z <= w; what lies behind the eye does not show.",
         "vertexpostproc-clipping", "15.4", "ref/position/clip.hpp"},
    Rule{rule::clip_viewport, Profile::vulkan, "Nothing is drawn outside the viewport",
         "Polygons are clipped to the view volume, so no sample outside the viewport's rectangle "
         "is covered.",
         "vertexpostproc-clipping", "15.6", "ref/coverage/window.cpp"},
    Rule{rule::layer_select, Profile::vulkan,
         "A triangle is drawn to the layer it names, and to no other",
         "gl_Layer of its vertices chooses the layer of every attachment; without it the first "
         "layer is drawn to. Coverage, depth test and colours are those of that layer alone.",
         "interfaces-builtin-variables-layer", "15.15", "ref/expectation/expectation.cpp"},
    Rule{rule::clip_depth, Profile::vulkan, "The depth planes clip as the state says",
         "z_m <= z <= w with z_m = 0, or -w with negativeOneToOne; with depth clipping disabled "
         "neither plane cuts, and the borders of the viewport still keep w from being negative.",
         "vertexpostproc-clipping", "15.4", "ref/position/clip.hpp"},
    Rule{rule::clip_distance, Profile::vulkan, "Nothing is drawn where a clip distance is negative",
         "The half-space is c_k(P) >= 0 with the distances of the vertices interpolated in "
         "perspective. Along the plane, within the precision of that arithmetic, both answers are "
         "right.",
         "vertexpostproc-clipping", "15.4.1", "ref/coverage/distance_cut.cpp"},
    Rule{rule::clip_complement, Profile::vulkan,
         "A clip distance and its negative share out a triangle",
         "Drawn with d and again with -d, otherwise alike, a triangle that the plane cuts has each "
         "of its samples hit exactly once along the cut, samples on the plane included, and where "
         "it crosses an edge that two such triangles share, these hit together once.",
         "vertexpostproc-clipping", "", "ref/expectation/complement_sets.cpp"},
    Rule{rule::cull_distance, Profile::vulkan,
         "A triangle whose cull distances are all negative is not drawn",
         "It is discarded if one of the cull distances is negative at all three vertices, and "
         "drawn whole otherwise.",
         "vertexpostproc-clipping", "15.4.2", "ref/coverage/setup.cpp"},
    Rule{rule::number_undefined, Profile::vulkan, "A bad number spoils its own triangle only",
         "NaN and infinity make the result of their own triangle undefined inside scissor and "
         "framebuffer, and so do positions beyond 2^32 (beyond FLT_MAX/16 from practice on); all "
         "other triangles are drawn as ever and nothing is terminated. Denormals and zeros of "
         "either sign are ordinary numbers, but a denormal w, or z before the near plane, may be "
         "taken for zero.",
         "fundamentals-floating-point", "15.16.1", "ref/position/position.hpp"},
    Rule{rule::scissor_half_open, Profile::vulkan, "The scissor rectangle is half-open",
         "A sample passes iff x is in [offset.x, offset.x + width) and y likewise.",
         "fragops-scissor", "15.7", "ref/coverage/window.cpp"},
    Rule{rule::sample_locations, Profile::vulkan, "Samples lie exactly at their locations",
         "The standard locations, or those that the pipeline asks for, in the order of their "
         "indices; they are points, never areas, and are not snapped.",
         "primsrast-multisampling", "19.2.4", "cases/model/sample.hpp"},
    Rule{rule::sample_mask, Profile::vulkan, "The sample mask removes samples",
         "Bit s of pSampleMask, and bit s of what the shader writes to gl_SampleMask, let sample s "
         "be written: coverage is their AND.",
         "fragops-samplemask", "17.17", "cases/model/sample.cpp"},
    Rule{
        rule::sample_alpha_to_coverage, Profile::vulkan,
        "Alpha to coverage takes samples away, and adds none",
        "A mask that the first output's alpha determines is ANDed to the coverage; by which "
        "algorithm is left open. Outputs of integers keep their coverage. With several samples and "
        "no mask of the shader's an alpha of 0 or less keeps none, and one of 1 or more all "
        "(profile direct3d).",
        "fragops-covg", "17.18", "cases/model/sample.cpp"},
    Rule{
        rule::sample_alpha_to_one, Profile::vulkan, "Alpha to one replaces the shader's alpha by 1",
        "Before blending and logical operations the alpha of the output with location 0 and index "
        "0 "
        "becomes 1, with one sample as with several; a second source keeps its own, and outputs of "
        "integers are left as they are.",
        "fragops-covg", "", "ref/color/blend.hpp"},
    Rule{rule::sample_mask_in, Profile::vulkan,
         "gl_SampleMaskIn holds the samples of the invocation",
         "Without sample shading the covered samples after the sample mask, of a fragment of "
         "several "
         "pixels in Vulkan's order (at vulkan a part of them, since it may have further "
         "invocations); early tests may have taken samples away. With sample shading a subset that "
         "holds the sample itself, which is that sample alone where every sample has an invocation "
         "(profile practice).",
         "interfaces-builtin-variables-samplemask", "", "ref/value/sample_values.hpp"},
    Rule{rule::sample_id, Profile::vulkan, "gl_SampleID and gl_SamplePosition name the sample",
         "They turn on an invocation a sample; the number is that of a sample, the position its "
         "location (undefined where the pipeline chooses locations). That it is the sample written "
         "is profile practice.",
         "interfaces-builtin-variables-sampleid", "", "ref/value/sample_values.hpp"},
    Rule{rule::sample_shading, Profile::vulkan, "Sample shading runs the shader for enough samples",
         "At least max(ceil(minSampleShading x samples), 1) invocations a fragment; more are "
         "allowed.",
         "primsrast-sampleshading", "", "diff/pixel_check.cpp"},
    Rule{rule::interp_centroid, Profile::vulkan,
         "centroid inputs are evaluated inside the primitive",
         "Somewhere in the pixel and in the triangle; one place for all centroid inputs of a "
         "fragment, within the binary32 budget, from profile practice on; the centre if all "
         "samples are covered, else the first covered sample, at direct3d.",
         "shaders-interpolation-decorations", "3.5.5", "ref/value/places.hpp"},
    Rule{rule::interp_sample, Profile::vulkan, "sample inputs are evaluated at the sample",
         "Exactly at the location of the sample that is written; within the binary32 budget from "
         "profile practice on.",
         "shaders-interpolation-decorations", "16.4", "ref/value/places.hpp"},
    Rule{rule::fragcoord_sample, Profile::vulkan, "FragCoord.xy is a sample of the invocation",
         "With sample shading one of its samples, exactly; the sample itself where every sample "
         "has an invocation (practice).",
         "interfaces-builtin-variables-fragcoord", "", "ref/value/sample_values.hpp"},
    Rule{rule::order_primitive, Profile::vulkan, "Primitives write in drawing order",
         "Of the triangles that hit a sample, the last one drawn is the one that stays. All of an "
         "instance are drawn before those of the next one, and gl_PrimitiveID begins at 0 in each.",
         "drawing-primitive-order", "", "ref/expectation/narrowing.cpp"},
    Rule{rule::instance_input, Profile::vulkan, "An instance reads the inputs of its number",
         "Instance i reads element firstInstance + floor((i - firstInstance) / divisor) of what is "
         "read once an instance, element firstInstance if the divisor is 0. gl_InstanceIndex is i.",
         "fxvertex-input-address-calculation", "", "cases/model/instances.hpp"},
    Rule{rule::provoking_first, Profile::vulkan, "Flat values come from the first vertex",
         "The provoking vertex is 3i in a list, i in a strip, i+1 in a fan; values are copied "
         "before clipping.",
         "drawing-primitive-topologies", "8.14", "cases/model/triangle.hpp"},
    Rule{rule::provoking_last, Profile::vulkan,
         "Flat values come from the last vertex, if the state says so",
         "VK_EXT_provoking_vertex: 3i+2 in a list, i+2 in a strip and in a fan. The order of the "
         "vertices, and with it facing, stays.",
         "drawing-primitive-topologies", "", "cases/model/triangle.hpp"},
    Rule{rule::interp_linear, Profile::vulkan,
         "noperspective values are linear in framebuffer space",
         "a f_a + b f_b + c f_c with barycentric coordinates at the sample, each operation to 1 "
         "part in 10^5; within the binary32 budget of docs/precision.md from profile practice on.",
         "primsrast-polygon-barycentrics", "15.16", "ref/value/reference.hpp"},
    Rule{rule::interp_perspective, Profile::vulkan, "smooth values are perspective-correct",
         "(sum a_i f_i/w_i) / (sum a_i/w_i), each operation to 1 part in 10^5; within the binary32 "
         "budget of docs/precision.md from profile practice on.",
         "primsrast-polygon-barycentrics", "15.16", "ref/value/reference.hpp"},
    Rule{rule::interp_hull, Profile::vulkan, "A value stays inside the vertex values' range",
         "NaN, or a value outside the hull of the vertex values by more than the budget, is wrong "
         "under every profile.",
         "primsrast-polygon-barycentrics", "", "ref/value/reference.hpp"},
    Rule{rule::interp_flat, Profile::vulkan, "flat values arrive bit for bit",
         "Finite normal numbers of the provoking vertex, unchanged; a denormal may be flushed to "
         "zero, zero may lose its sign, NaN and infinity need not arrive.",
         "vertexpostproc-flatshading", "16.4", "ref/value/reference.hpp"},
    Rule{rule::fragcoord_xy, Profile::vulkan, "FragCoord.xy is the pixel centre",
         "Exactly (i + 1/2, j + 1/2) without sample shading.",
         "interfaces-builtin-variables-fragcoord", "", "ref/value/sample_values.cpp"},
    Rule{rule::fragcoord_w, Profile::vulkan, "FragCoord.w is the interpolated 1/w",
         "Linear in framebuffer space; within the binary32 budget from profile practice on.",
         "interfaces-builtin-variables-fragcoord", "", "ref/value/reference.hpp"},
    Rule{rule::store_unorm, Profile::vulkan, "A colour is stored as one of the two nearest codes",
         "r = f (2^b - 1) of the clamped value; a whole r is stored as it is, otherwise one of its "
         "two neighbours. Direct3D allows 0.6 of a unit.",
         "fundamentals-fpfixedconv", "3.2.3.6", "ref/color/component.hpp"},
    Rule{rule::store_srgb, Profile::vulkan, "An sRGB target stores one of the two nearest codes",
         "The linear value is encoded by the sRGB transfer function and stored as a neighbouring "
         "code.",
         "fundamentals-fpfixedconv", "3.2.3.8", "ref/color/component.hpp"},
    Rule{rule::store_snorm, Profile::vulkan,
         "A signed normalized colour is stored as one of the two nearest codes",
         "r = f (2^(b-1) - 1) of the value clamped to -1..1, in two's complement; a whole r is "
         "stored as it is, otherwise one of its two neighbours. Direct3D allows 0.6 of a unit.",
         "fundamentals-fpfixedconv", "3.2.3.4", "ref/color/component.hpp"},
    Rule{rule::store_half, Profile::vulkan, "A half holds one of the two neighbours of a value",
         "The rounding direction is not defined; what a half can represent is kept. Halves without "
         "a sign, of 11 and 10 bits, hold 0 of what is negative.",
         "fundamentals-fp-conversion", "3.2.2", "ref/color/component.hpp"},
    Rule{rule::store_float, Profile::vulkan, "A binary32 target holds what the shader wrote",
         "No conversion takes place.", "interfaces-fragmentoutput", "3.2.2",
         "ref/color/component.hpp"},
    Rule{rule::store_integer, Profile::vulkan, "An integer target holds what the shader wrote",
         "No conversion takes place.", "interfaces-fragmentoutput", "", "ref/color/component.hpp"},
    Rule{rule::blend_equation, Profile::vulkan, "Blending follows its equation",
         "As if in floating point, with a precision no lower than the destination's: every "
         "intermediate may be rounded to a neighbour in the destination's format, and of factors f "
         "and 1 - f, as one and zero are, one product may be saved. Fixed-point targets clamp "
         "source, factors and result. "
         "What is representable throughout is exact, but that sRGB may be decoded half a code off.",
         "framebuffer-blending", "17.5", "ref/color/blend.hpp"},
    Rule{
        rule::blend_second_source, Profile::vulkan,
        "Factors of the second source are the shader's second colour",
        "SRC1_COLOR and SRC1_ALPHA are the color and the alpha of the output with index 1, clamped "
        "and rounded as those of the first source are; in all else dual-source blending is "
        "blending.",
        "framebuffer-dsb", "17.6", "ref/color/blend.hpp"},
    Rule{rule::logic_operation, Profile::vulkan,
         "A logical operation combines the bits of the colours",
         "Each component's code is combined with the stored one, bit by bit, in place of blending, "
         "which is off for every "
         "attachment. Floating-point and sRGB targets have no such operation: they are written as "
         "without it.",
         "framebuffer-logicop", "17.5", "ref/color/logic.hpp"},
    Rule{rule::blend_write_mask, Profile::vulkan, "A masked component keeps its value",
         "Components whose bit is not in the write mask are left as they were.",
         "framebuffer-color-write-mask", "17.15", "ref/color/blend.hpp"},
    Rule{rule::color_location, Profile::vulkan, "Each colour target goes by its own location",
         "Of several colour targets each holds what the shader writes to its location, cleared, "
         "converted, blended and masked as its own format and state say, whatever those of the "
         "others are. Blend constants and the logical operation are one for all of them.",
         "interfaces-fragmentoutput", "", "cases/fault/neighbour.hpp"},
    Rule{rule::load_operation, Profile::vulkan,
         "Each aspect begins with what its own load operation says",
         "Cleared it has the clear value, loaded the contents that an earlier pass has left; depth "
         "and stencil of one image have operations of their own. Of what is not cared for nothing "
         "is claimed until something replaces it.",
         "VkAttachmentLoadOp", "", "ref/expectation/narrowing.cpp"},
    Rule{
        rule::clear_attachments, Profile::vulkan,
        "A clear among the draws replaces what it names in its rectangles, and nothing else",
        "vkCmdClearAttachments replaces the named aspects in each rectangle and layer, between the "
        "draws before and behind it. Scissor, viewport, masks, tests and blending of the draws do "
        "not apply to it, and no query counts it.",
        "clears-inside", "", "ref/expectation/narrowing.cpp"},
    Rule{rule::write_consistent, Profile::vulkan, "A fragment writes all its attachments, or none",
         "Different color attachments of one draw receive the same fragments, and additive "
         "blending of exactly representable values is exact. Hits, writer, values, stencil and "
         "depth "
         "that are right one by one are those of one history of the sample's fragments.",
         "invariance", "", "diff/observers.cpp"},
    Rule{rule::write_outside, Profile::vulkan, "Nothing is written beside an attachment",
         "Drawing, clearing, resolving and blitting write to the attachments alone: buffers in the "
         "same memory, directly before and after each of them, keep every word, and so do texels "
         "beside the render area, other layers and other mip levels of an image of one sample "
         "(load, store and resolve operations are restricted to the render area). "
         "What lies between the image and the end of its memory is the driver's.",
         "resources-memory-aliasing", "", "vk_harness/memory/guard.cpp"},
    Rule{rule::depth_linear, Profile::vulkan, "Depth is linear in framebuffer space",
         "z_f is interpolated linearly at the sample; on a D32 target and for FragCoord.z within "
         "the binary32 budget from profile practice on.",
         "primsrast-polygon-barycentrics", "15.16", "ref/value/reference.hpp"},
    Rule{rule::repeat_same, Profile::vulkan, "The same commands draw the same bits",
         "Same draws, same state, same device: every sample of every attachment has the same bits, "
         "in the same submission and in another. Nothing is left free (shaders have no side "
         "effects).",
         "invariance", "", "diff/consistency.cpp"},
    Rule{rule::repeat_scissor, Profile::vulkan, "Scissors change no fragment",
         "A target drawn tile by tile, each draw repeated under the scissor of each tile, has the "
         "same bits as drawn at once, samples that are left free included (Rule 2, Corollary 1).",
         "invariance", "15.7", "diff/consistency.cpp"},
    Rule{rule::repeat_clears, Profile::vulkan, "Clear values change no fragment",
         "Attachments cleared to other values receive the same fragments with the same bits (Rule "
         "2, Corollary 1).",
         "invariance", "", "diff/consistency.cpp"},
    Rule{rule::repeat_write_masks, Profile::vulkan, "Write masks change no fragment",
         "Attachments that are not masked have the same bits, those that are keep their clear "
         "value (Rule 2, Corollary 1).",
         "invariance", "", "diff/consistency.cpp"},
    Rule{rule::repeat_attachments, Profile::practice,
         "More or fewer attachments change no fragment, and copies are alike",
         "The same primitives with more or fewer attributes, so with more or fewer colour "
         "attachments, cover the same samples with the same depth, and a copied attribute has the "
         "bits of its original (Corollary 2). The shader is another one, so Vulkan does not demand "
         "it in so many words; every known device does it.",
         "invariance", "", "diff/consistency.cpp"},
    Rule{
        rule::door_index, Profile::vulkan, "Indices of every type name the same vertices",
        "With indices of 8, 16 or 32 bits, or none, the same vertices reach the same pipeline: the "
        "picture has the same bits (Invariance, Rule 4).",
        "vkCmdBindIndexBuffer", "", "diff/consistency.cpp"},
    Rule{rule::door_restart, Profile::vulkan, "The largest index restarts only where restart is on",
         "Restart off: the largest value of an index type is a vertex like any other, and the "
         "picture has the same bits (Rule 4). Restart on, though nothing needs it: restarts before "
         "the first and behind the last index change nothing. The state is another one there, so "
         "at vulkan the picture only has to be right; from practice on it has the same bits.",
         "vkCmdSetPrimitiveRestartEnable", "", "diff/consistency.cpp"},
    Rule{rule::door_first, Profile::vulkan,
         "firstVertex, firstIndex and vertexOffset choose vertices",
         "firstVertex and vertexOffset count in gl_VertexIndex, vertexOffset may be negative, and "
         "firstIndex counts indices. The same vertices reach the same pipeline: the picture has "
         "the same bits (Rule 4).",
         "vkCmdDrawIndexed", "", "diff/consistency.cpp"},
    Rule{rule::door_buffer, Profile::vulkan, "Where buffers are bound changes no vertex",
         "Vertex buffers and the index buffer may be bound at any offset that is a multiple of "
         "what they hold, and every binding in a buffer of its own, whoever has allocated the "
         "memory. The same vertices reach the "
         "same pipeline: the picture has the same bits (Rule 4).",
         "vkCmdBindVertexBuffers", "", "diff/consistency.cpp"},
    Rule{
        rule::door_layout, Profile::vulkan, "How vertices lie in memory changes nothing",
        "Strides with room between vertices, strides given with the buffers, all inputs in one "
        "binding, other formats that hold the same numbers: fewer components where the others are "
        "0 and 1, binary16, scaled whole numbers, the ends of normalized ranges; a shader may read "
        "them from a storage buffer instead, or transform feedback have written them. The pipeline "
        "is another one, so Rule 4 does not promise the bits: at vulkan the picture has to be "
        "right by the rules of "
        "every picture, from practice on it has the same bits.",
        "fxvertex-input", "", "diff/consistency.cpp"},
    Rule{rule::door_instance, Profile::vulkan, "Inputs of an instance are those of its number",
         "What is read once an instance is read at firstInstance for the first one; with a divisor "
         "so many instances read the same, with a divisor of 0 all. The pipeline is another one: "
         "at vulkan the picture has to be right, from practice on it has the same "
         "bits.",
         "VkVertexInputRate", "", "diff/consistency.cpp"},
    Rule{rule::door_indirect, Profile::vulkan, "Draws from a buffer are draws",
         "An indirect draw, one of several in a command, or one whose number is read from a "
         "buffer, draws what the same parameters draw directly: the same vertices reach the same "
         "pipeline, and the picture has the same bits (Rule 4).",
         "vkCmdDrawIndexedIndirect", "", "diff/consistency.cpp"},
    Rule{rule::door_state, Profile::vulkan, "State is the same however it is given",
         "Dynamic state may be set before or after the pipeline is bound, and only what was set "
         "last counts, whatever was drawn with other values or with a pipeline whose state is "
         "static: the same pipeline, state and vertices give the same bits (Rule 4). Static state, "
         "state that is on and changes nothing, a pipeline that is not optimized and shaders "
         "without a pipeline or with outputs that nobody reads are another pipeline: at vulkan the "
         "picture has to be right, from "
         "practice on it has the same bits.",
         "pipelines-dynamic-state", "", "diff/consistency.cpp"},
    Rule{rule::door_recording, Profile::vulkan, "Draws are the same however they are recorded",
         "Secondary command buffers draw what a primary one draws: the same pipeline, state, "
         "vertices and attachments give the same bits (Rule 4), also when one is executed again. A "
         "rendering that ends and goes on with what was stored, one that is suspended and "
         "resumed, and vkCmdClearAttachments or a draw instead of a load operation clear in "
         "another way, and which neighbour of a clear value "
         "is stored is not fixed: at vulkan the picture has to be right, from practice on it has "
         "the same bits. So it is in a subpass of a render pass object, where its parts are "
         "submitted one by one, and where the picture is what a second subpass reads of it as "
         "input attachments.",
         "vkCmdBeginRendering", "", "diff/consistency.cpp"},
    Rule{rule::door_target, Profile::vulkan, "What an attachment is a part of changes nothing",
         "Attachments may be larger than the rendering's area, layers or levels of images with "
         "more of them, of images that may be used in other ways, too, or are tiled linearly, in "
         "memory of their own or in that of another image which is not used any more, or the "
         "second view of a multiview rendering, or one of several. Images or the pipeline are "
         "others: at vulkan the picture has to be right, from practice on it has the same bits. "
         "Drawn elsewhere in a larger target, by whole pixels that change no position's rounding, "
         "it has to be right by the rules of vulkan, and no more.",
         "VkRenderingInfo", "", "diff/consistency.cpp"},
    Rule{rule::door_stage, Profile::vulkan, "A stage that hands triangles on changes nothing",
         "A geometry shader that emits each triangle as it came, a mesh shader that makes each of "
         "the same vertices, and tessellation by factors of 1, "
         "rasterize the triangles of the draw, with their numbers, flat values and faces. Which of "
         "its vertices comes first is the stage's own choice, and with it values may be rounded "
         "otherwise: the picture has to be right by the rules of vulkan, and its bits are not "
         "compared further.",
         "geometry", "", "diff/consistency.cpp"},
    Rule{rule::depth_store, Profile::vulkan, "Fixed-point depth is stored as either neighbour",
         "z (2^n - 1) rounds down or up; a whole number of steps is stored as it is. Direct3D "
         "rounds within 0.6 of a step.",
         "fundamentals-fpfixedconv", "3.2.3.6", "ref/value/accept/judge_candidates.cpp"},
    Rule{rule::depth_bias, Profile::vulkan, "Depth bias is m slope + r constant, clamped",
         "m lies between the larger gradient and their Euclidean norm (Direct3D: the larger). r is "
         "2^(e-23) with binary32 depth, e the exponent of the primitive's largest z, clipped or "
         "not; at most 2 2^-n with n bits of fixed point, 2^-n with depthBiasExact, 1 with the "
         "representation float. The clamp is exact. FragCoord.z has all of the bias or none.",
         "primsrast-depthbias-computation", "15.10", "ref/value/fragment/depth_path.hpp"},
    Rule{rule::depth_distinct, Profile::vulkan, "Planes that are r apart stay distinct",
         "Polygons with the same vertices, biased apart by one r (fixed point: two, as r may be a "
         "little less than a step), never compare equal or the wrong way round.",
         "primsrast-depthbias-computation", "", "ref/depth/outcome.hpp"},
    Rule{rule::depth_written, Profile::vulkan,
         "A depth that the fragment shader writes replaces the fragment's own",
         "It is what is tested and stored, in all samples of the fragment alike: clamped if depth "
         "is, not biased, bit for bit with binary32 depth, either neighbour in fixed point. A "
         "layout (depth_greater, depth_less, depth_unchanged) whose promise is kept changes "
         "nothing. With "
         "early tests the fragment's own depth counts.",
         "fragops-shader-depthreplacement", "17.10", "ref/value/sample_values.hpp"},
    Rule{rule::depth_bounds, Profile::vulkan,
         "A fragment is drawn only where the stored depth lies in the depth bounds",
         "minDepthBounds <= z <= maxDepthBounds, of the depth that is stored, not the fragment's. "
         "It is tested before the stencil: a fragment that fails leaves no trace, not even of a "
         "stencil operation. Exact with binary32 depth; fixed-point bounds and depths may be "
         "either neighbour.",
         "fragops-dbt", "", "ref/path/path.cpp"},
    Rule{rule::depth_clamp, Profile::vulkan, "Depth clamp limits depth to the viewport's range",
         "With depthClampEnable z is clamped to [min, max] of the viewport's depths, whichever is "
         "the smaller, after the bias; near and far planes clip nothing.",
         "fragops-depth", "17.10", "ref/value/fragment/depth_path.hpp"},
    Rule{rule::depth_compare, Profile::vulkan, "A fragment is drawn if its depth compares as asked",
         "Exact where the ranges that binary32 may compute are apart or both are one number. "
         "Nothing says that fixed-point depth is rounded before it is compared: outcomes within a "
         "step are free.",
         "fragops-depth-comparison", "17.11", "ref/depth/outcome.hpp"},
    Rule{rule::depth_repeat, Profile::vulkan, "The same triangle has the same depth again",
         "Drawn twice by the same state but for write masks with binary32 depth, it is equal to "
         "itself in every sample: LESS_OR_EQUAL passes, LESS fails, wherever it is covered. From "
         "practice on so it is with any format, and with another comparison, stencil or "
         "attributes: a depth prepass and then EQUAL.",
         "invariance", "", "ref/depth/outcome.hpp"},
    Rule{rule::depth_write, Profile::vulkan,
         "Depth is written where the test passes and writes are on",
         "A fragment that fails, or whose draw does not write depth, leaves the older depth.",
         "fragops-depth-write", "17.8", "ref/depth/outcome.hpp"},
    Rule{rule::interp_at_offset, Profile::vulkan,
         "interpolateAtOffset evaluates at centre + offset",
         "The offset may be rounded to subPixelInterpolationOffsetBits fraction bits, in either "
         "direction; multiples of 1/16 need no rounding. Within the binary32 budget from profile "
         "practice on.",
         "limits-subPixelInterpolationOffsetBits", "16.5", "ref/value/accept/probe.hpp"},
    Rule{rule::interp_at_sample, Profile::vulkan, "interpolateAtSample evaluates at that sample",
         "At the location of the given sample, whatever the qualifier of the input; at the centre "
         "with one sample a pixel. Within the binary32 budget from profile practice on.",
         "shaders-interpolation-decorations", "16.5", "ref/value/accept/probe.hpp"},
    Rule{rule::interp_at_centroid, Profile::vulkan,
         "interpolateAtCentroid evaluates where a centroid input is",
         "A point of the pixel and of the primitive; at the centre with one sample a pixel. Within "
         "the binary32 budget from profile practice on.",
         "shaders-interpolation-decorations", "16.5", "ref/value/places.hpp"},
    Rule{rule::derivative_fine, Profile::vulkan,
         "A fine derivative is the difference inside the pixel's own row or column",
         "P(x+1) - P(x) or P(x) - P(x-1), as the pixel lies in its quad, which may begin at any "
         "pixel; one quad explains all derivatives of a fragment. Within the binary32 budgets of "
         "both values from profile practice on.",
         "shaders-derivative-operations", "22.5", "ref/value/accept/probe.hpp"},
    Rule{rule::derivative_coarse, Profile::vulkan,
         "A coarse derivative is a difference inside the pixel's quad",
         "Any row (dFdx) or column (dFdy) of the quad; within the binary32 budgets of both values "
         "from profile practice on.",
         "shaders-derivative-operations", "22.5", "ref/value/accept/probe.hpp"},
    Rule{rule::derivative_plain, Profile::vulkan,
         "dFdx and dFdy are both coarse or both fine derivatives",
         "Which of the two is free, but it \"must\" be chosen consistently between x and y. Within "
         "the binary32 budgets of both values from profile practice on.",
         "shaders-derivative-operations", "22.5", "ref/value/accept/probe.hpp"},
    Rule{rule::lod_query, Profile::vulkan, "A level of detail follows from the quad's differences",
         "log2 rho with max(m) <= rho <= sqrt(2) sum(m), to mipmapPrecisionBits bits, of the "
         "differences of any row and column of the quad; those within the binary32 budget from "
         "profile practice on. Out of range, where no bias selects a level, it may end earlier.",
         "textures-lod-and-scale-factor", "7.18.11", "ref/value/accept/probe.hpp"},
    Rule{rule::stencil_count, Profile::vulkan, "The stencil counts as the fragments do",
         "Where stencil and depth test pass, front faces add one and back faces subtract one, "
         "modulo 256: (front - back) mod 256 of the hit counter, and 0 where nothing hit.",
         "fragops-stencil", "17.12", "diff/resolve.hpp"},
    Rule{rule::stencil_compare, Profile::vulkan,
         "The stencil test compares the reference with the stencil",
         "A fragment passes if (reference & mask) op (stencil & mask), unsigned; one that fails "
         "writes no colour and no depth, and the stencil by the operation for failures alone.",
         "fragops-stencil", "17.12", "ref/stencil/operation.hpp"},
    Rule{rule::stencil_operation, Profile::vulkan, "A stencil operation is exact on eight bits",
         "KEEP, ZERO, REPLACE, INVERT, and INCREMENT and DECREMENT that stop at 255 and 0 or go on "
         "modulo 256, each of the whole stored value, once a fragment, in drawing order.",
         "fragops-stencil", "17.12", "ref/stencil/operation.hpp"},
    Rule{rule::stencil_mask, Profile::vulkan,
         "The masks choose bits of what is compared and stored",
         "The compare mask is ANDed to both sides of the test and to nothing else; bits outside "
         "the write mask keep what they were. Of each mask the lowest eight bits count.",
         "fragops-stencil", "17.12", "ref/stencil/operation.hpp"},
    Rule{rule::stencil_faces, Profile::vulkan, "Front and back faces have a stencil state each",
         "Compare operation, operations, masks and reference are those of the face that the "
         "triangle shows, which is the face that culling and gl_FrontFacing see.",
         "fragops-stencil", "17.12", "ref/stencil/operation.hpp"},
    Rule{rule::stencil_depth_outcome, Profile::vulkan,
         "The depth test chooses the operation of what passes the stencil test",
         "What fails the stencil test is not tested for depth; what passes it does depthFailOp or "
         "passOp as it fails or passes the depth test, and passOp where there is no depth.",
         "fragops-stencil", "17.12", "ref/stencil/operation.hpp"},
    Rule{rule::query_occlusion, Profile::vulkan,
         "An occlusion query counts the samples that pass all tests",
         "A precise one counts each sample of each fragment of its draw that is left of scissor, "
         "sample mask, discard, depth bounds, stencil and depth test; any other is 0 where that is "
         "0, and not 0 where it is not. What the shader discards after early tests is counted at "
         "practice and direct3d, and may be at vulkan.",
         "fragops-samplecount", "", "ref/expectation/counted.hpp"},
    Rule{rule::query_statistics, Profile::vulkan,
         "Pipeline statistics count no less than what a draw must do",
         "Vertices and primitives that are assembled, vertices that are shaded, primitives that "
         "reach clipping and that leave it, fragments that are shaded: never fewer than there "
         "must be, from practice on also of samples that are shaded one by one and of fragments "
         "that are discarded after early tests. How many more is free but at direct3d, where "
         "complete primitives of lists and strips and their vertices are counted exactly, what is "
         "incomplete may be counted or not, and the others lie between two numbers, but for "
         "fragments of draws with rasterizer discard.",
         "queries-pipestats", "20.4.7", "ref/expectation/statistics.hpp"},
    Rule{rule::resolve_select, Profile::vulkan, "Resolving by selection takes a sample as it is",
         "SAMPLE_ZERO, MIN and MAX leave one of the pixel's samples, bit for bit.",
         "renderpass-resolve-operations", "", "diff/resolve.hpp"},
    Rule{rule::resolve_average, Profile::vulkan, "Resolving by average stays among the samples",
         "Between the least and the greatest sample of the pixel; from profile practice on the "
         "mean, within one step of the format.",
         "renderpass-resolve-operations", "", "diff/resolve.hpp"},
    Rule{rule::barycentric_value, Profile::vulkan,
         "Barycentric built-ins interpolate the unit vectors",
         "With perspective or, BaryCoordNoPersp, linearly; within the binary32 budget from profile "
         "practice on.",
         "primsrast-barycentric", "", "ref/value/reference.hpp"},
    Rule{
        rule::barycentric_order, Profile::vulkan, "Barycentric vertex order follows the topology",
        "The triangle's vertices turned so that the provoking vertex is the first (or the last, "
        "with the last vertex convention), as the tables for lists, strips and fans say; of strips "
        "as with the first one where the device says "
        "triStripVertexOrderIndependentOfProvokingVertex.",
        "primsrast-barycentric", "", "ref/value/fragment/quantities.cpp"},
    Rule{rule::blit_nearest, Profile::vulkan, "A blit copies the texel whose area holds u",
         "u = (i + 1/2 - d0) (s1 - s0) / (d1 - d0) + s0, likewise v. At 1:1, mirrored and scaled "
         "up by a whole number exactly one texel qualifies; where u is on a border within the "
         "derived error of the coordinate, either side. Same format: bit for bit from practice on; "
         "else either neighbouring code.",
         "copies-imagescaling", "", "ref/blit/blit.hpp"},
    Rule{rule::blit_linear, Profile::vulkan, "A filtered blit weighs the four nearest texels",
         "Weights of the fractions of u - 1/2 and v - 1/2 within 1/16, a step of the 4 "
         "subTexelPrecisionBits that every device has (a device that has more is not held to "
         "them); the edge clamped at the image or at the region, the filter at the source's "
         "precision or better.",
         "copies-imagescaling", "", "ref/blit/blit.hpp"},
    Rule{rule::blit_outside, Profile::vulkan, "A blit leaves everything outside its region alone",
         "Texels outside the destination region keep their bits.", "copies-imagescaling", "",
         "ref/blit/blit.hpp"},
};

}  // namespace

std::span<const Rule> all_rules() {
    return kRules;
}

bool is_of_device(std::string_view id) {
    return id == rule::device_limits;
}

const Rule* find_rule(std::string_view id) {
    const auto it = std::ranges::find(kRules, id, &Rule::id);
    return it == kRules.end() ? nullptr : &*it;
}

}  // namespace cases
