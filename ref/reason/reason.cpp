// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/reason/reason.hpp"

#include <array>

#include "cases/model/rule_ids.hpp"

namespace ref {

namespace {

namespace rule = cases::rule;
using enum ReasonKind;

struct Row {
    ReasonKind kind;
    std::string_view rule;
    std::string_view text;
    std::string_view direct3d = {};  // the rule of what only profile direct3d demands, if another
    std::string_view text_of_all = {};
};

constexpr std::string_view kOtherVertex =
    "the right triangle, but its flat inputs come from another vertex";
constexpr std::string_view kNoVertex = "no triangle of that draw has this provoking vertex";

// In the order of ReasonKind.
constexpr std::array kRows = {
    Row{top_left_in, rule::tie_top_left, "{ties}: covered under the top-left rule"},
    Row{passes_cull_distance, rule::cull_distance,
        "{inside}, and no cull distance is negative at all vertices", rule::snap_nearest},
    Row{passes_clip_distance, rule::clip_distance, "{inside}, and no clip distance is negative",
        rule::snap_nearest},
    Row{kept_by_alpha, rule::sample_alpha_to_coverage,
        "inside the triangle, and alpha to coverage keeps all samples of a fragment whose output "
        "is {kept}"},
    Row{inside, rule::cover_inside, "{inside}", rule::snap_nearest},
    Row{touches_pixel, rule::conservative_overestimate,
        "the triangle has an area in common with the pixel, of which every sample is covered",
        rule::snap_nearest},
    Row{extra_reached, rule::conservative_size,
        "enlarged by the extra size of the draw, the triangle has an area in common with the "
        "pixel"},
    Row{fills_pixel, rule::conservative_underestimate,
        "the triangle holds the whole pixel, with its edges and corners", rule::snap_nearest},
    Row{degenerate_kept, rule::conservative_degenerate,
        "the triangle has no area after snapping, and meets the pixel; the device draws such "
        "triangles (degenerateTrianglesRasterized)"},
    Row{cleared, rule::clear_attachments, "the pixel lies in the rectangle of a clear, {scissor}"},
    Row{other_layer,
        rule::layer_select,
        "the draw goes to layer {layer}",
        {},
        "no draw goes to this layer"},
    Row{masked, rule::sample_mask,
        "the sample mask {mask:#x} of the draw leaves sample {sample} out"},
    Row{no_alpha, rule::sample_alpha_to_coverage,
        "alpha to coverage leaves no sample of a fragment whose alpha is {alpha}"},
    Row{beside_clear, rule::clear_attachments,
        "the pixel lies outside the rectangle of a clear, {scissor}"},
    Row{scissor,
        rule::scissor_half_open,
        "the sample lies outside the scissor rectangle, {scissor}",
        {},
        "the sample lies outside every scissor rectangle"},
    Row{viewport,
        rule::clip_viewport,
        "the sample lies outside the viewport, {viewport}",
        {},
        "the sample lies outside every viewport"},
    Row{discarded, rule::discard_rasterizer, "the draw has rasterizer discard"},
    Row{fragment_discarded, rule::discard_fragment,
        "the fragment shader of the draw discards {discarded}"},
    Row{value_discarded, rule::discard_value,
        "the fragment shader of the draw discards where attribute {attribute} is negative, as it "
        "is here"},
    Row{discarded_late, rule::discard_fragment,
        "the fragment shader of the draw discards {discarded}, once depth and stencil are stored"},
    Row{outside, rule::cover_outside, "{edge}: outside that edge", rule::snap_nearest},
    Row{outside_hull, rule::cover_outside,
        "outside all that the vertices can span, wherever they are snapped", rule::snap_nearest},
    Row{no_area, rule::cover_degenerate, "the triangle has no area after snapping"},
    Row{top_left_out, rule::tie_top_left, "{ties}: not covered under the top-left rule"},
    Row{culled, rule::face_cull, "the triangle is culled: it faces {facing}"},
    Row{cull_distance, rule::cull_distance,
        "cull distance {number} is negative at all three vertices"},
    Row{clip_distance, rule::clip_distance, "clip distance {number} is negative at the sample"},
    Row{clip_plane, rule::clip_volume, "clipped away by the plane {plane} of the view volume"},
    Row{beyond_size, rule::conservative_size,
        "the triangle does not reach the pixel, enlarged by the sizes of the device and the draw"},
    Row{unfilled_pixel, rule::conservative_underestimate,
        "the triangle does not hold the whole pixel, with its edges and corners"},
    Row{degenerate_culled, rule::conservative_degenerate,
        "the triangle has no area after snapping, and the device culls such triangles "
        "(degenerateTrianglesRasterized)"},
    Row{undefined, rule::number_undefined,
        "a vertex has a NaN, an infinity or a number beyond the guaranteed range: the triangle may "
        "cover any sample or none"},
    Row{unbounded, rule::number_undefined,
        "a vertex lies behind the eye or beyond 2^32 pixels, and nothing bounds where the corners "
        "of the clipped polygon may lie"},
    Row{flushed, rule::number_undefined,
        "a denormal z may be taken for 0, which lies inside the view volume"},
    Row{near_zero, rule::discard_value,
        "the fragment shader of the draw discards where attribute {attribute} is negative, which "
        "is 0 here within its error"},
    Row{near_distance, rule::clip_distance,
        "inside the triangle, but clip distance {number} is 0 within its error at the sample"},
    Row{near_plane, rule::clip_volume,
        "its depth at the sample is at the plane {plane} of the view volume within the error of a "
        "device that discards samples by their depth"},
    Row{open_facing, rule::face_area_sign,
        "which way the triangle faces depends on where its vertices are snapped ({boxes}), and one "
        "of its faces is culled or discarded"},
    Row{open_alpha, rule::sample_alpha_to_coverage,
        "alpha to coverage may leave the sample out, by an algorithm of the device's own"},
    Row{viewport_border, rule::clip_viewport,
        "the sample lies within a pixel of a border of the viewport that is no whole number, "
        "{viewport}"},
    Row{on_edge, rule::tie_top_left,
        "{ties}: only the top-left rule, between fixed points at profile direct3d, would decide"},
    Row{may_reach, rule::conservative_size,
        "the triangle may reach the pixel: by its border alone, for some positions of its "
        "vertices, or as far as the device enlarges it"},
    Row{may_fill, rule::conservative_underestimate,
        "the triangle may hold the pixel, for some positions of its vertices or with its border"},
    Row{between_pieces, rule::conservative_underestimate,
        "what clipping leaves may be drawn in pieces, none of which fills a pixel on an edge "
        "between two of them"},
    Row{vertex_boxes, rule::cover_inside, "inside for some positions of the vertices only: {boxes}",
        rule::snap_nearest},
    Row{complement, rule::clip_complement,
        "{number} of {triangles} covers the sample: a clip distance and its negative are 0 here "
        "within their error"},
    Row{clipped_edge, rule::cover_clipped_edge,
        "{number} of {triangles} covers the sample: they meet here along edges they share, clipped",
        rule::snap_nearest},
    Row{shared_vertex, rule::cover_shared_vertex,
        "{number} of {triangles} covers the sample: they meet here in a vertex they share",
        rule::snap_nearest},
    Row{shared_edge, rule::cover_shared_edge,
        "{number} of {triangles} covers the sample: they meet here along edges they share with "
        "identical end points",
        rule::snap_nearest},
    Row{nearest_positions, rule::snap_nearest,
        "no vertex position within the rounding of Direct3D explains this number"},
    Row{snapped_owner, rule::cover_outside,
        "where the vertices snap decides which triangle covers the sample", rule::snap_nearest},
    Row{none_near, rule::cover_outside, "no triangle is within two pixels of the sample"},
    Row{none_may, rule::cover_outside, "no triangle near the sample may cover it"},
    Row{once_alone, rule::cover_outside, "{triangle} alone may cover the sample, and only once"},
    Row{once_each, rule::cover_outside, "{number} triangles may cover the sample, each only once"},
    Row{once_pieces, rule::cover_outside,
        "{number} triangles and pieces of clipped ones may cover the sample, each only once"},
    Row{area_sign, rule::face_area_sign, "the sign of its area decides which face shows"},
    Row{writer_not_last, rule::order_primitive,
        "another triangle than the last one that may cover the sample wrote it"},
    Row{writer_other_first, rule::provoking_first, kOtherVertex},
    Row{writer_other_last, rule::provoking_last, kOtherVertex},
    Row{writer_none_first, rule::provoking_first, kNoVertex},
    Row{writer_none_last, rule::provoking_last, kNoVertex},
    Row{depth_unwritten, rule::depth_write,
        "the last fragment's draw does not write depth; no older one left this"},
    Row{depth_of_discarded, rule::discard_early_tests,
        "the depth is none of those that fragments stored, the discarded ones among them"},
    Row{depth_of_cleared, rule::clear_attachments,
        "neither a clear among the draws nor a triangle that may have stored its depth has this "
        "depth here"},
    Row{depth_of_bounded, rule::depth_bounds,
        "the depth is none of those that fragments left where the stored depth was in their "
        "bounds"},
    Row{depth_of_taken, rule::discard_fragment,
        "a depth without a hit, where the fragment shader discards fragments"},
    Row{depth_of_none, rule::depth_linear,
        "no triangle that may have written last has this depth here"},
    Row{color_order, rule::order_primitive,
        "the fragments were blended in another order than they were drawn"},
    Row{color_none, {}, "no allowed set of fragments leaves this colour"},
    Row{planes_contradict, rule::write_consistent,
        "the attachments of one sample contradict each other"},
    Row{depth_ranges, rule::depth_compare, "{outcome} the depth test {compare}, {depths}"},
    Row{depth_same, rule::depth_repeat,
        "{outcome} the depth test {compare}, {depths}: the same triangle was drawn before, by a "
        "state that makes the same depths, so they are equal"},
    Row{depth_apart, rule::depth_distinct,
        "{outcome} the depth test {compare}, {depths}: the same triangle was drawn before, biased "
        "apart by whole units of r"},
    Row{bounds_test, rule::depth_bounds,
        "{outcome} the depth bounds test: the depth that is stored here {lies} in {bounds}"},
    Row{stencil_test, rule::stencil_compare,
        "{outcome} the stencil test of {face} faces, {reference} {compare} {stencil}"},
    Row{stencil_compared, rule::stencil_compare,
        "it is the stencil of fragments whose stencil test comes out otherwise"},
    Row{stencil_operated, rule::stencil_operation,
        "the operations of these fragments, in drawing order, do not leave it"},
    Row{stencil_masked, rule::stencil_mask, "it is the stencil that is left without the masks"},
    Row{stencil_faced, rule::stencil_faces,
        "it is the stencil that is left if front and back faces exchange their state"},
    Row{stencil_by_depth, rule::stencil_depth_outcome,
        "it is the stencil that is left if the depth test chooses another operation"},
    Row{stencil_bounded, rule::depth_bounds,
        "it is the stencil that is left without the depth bounds test"},
    Row{value_set_up, {}, "no set-up from snapped or unsnapped vertices explains the fragment"},
    Row{value_hull, rule::interp_hull, "the value lies outside all that the vertices' values span"},
    Row{value_flat, rule::interp_flat, "a flat input has the bits of the provoking vertex"},
    Row{value_of_not_first, rule::provoking_first,
        "the flat input is that of another vertex than the first, which is the provoking one"},
    Row{value_of_not_last, rule::provoking_last,
        "the flat input is that of another vertex than the last, which is the provoking one"},
    Row{value_other_weight, rule::barycentric_order, "this is the barycentric of another vertex"},
    Row{value_exact, {}, "the sample and its fragment leave these exact numbers only"},
    Row{value_coord_depth, rule::depth_written,
        "the fragment shader wrote gl_FragCoord.z to gl_FragDepth, and another depth is stored"},
    Row{value_not_discarded, rule::discard_value,
        "the fragment shader discards where this value is negative, and the fragment is drawn"},
    Row{value_clamped_depth, rule::depth_clamp,
        "the depth of its plane is outside the viewport's range, to which it is clamped"},
    Row{value_biased_depth, rule::depth_bias,
        "no set-up explains the depth, biased as the draw asks for"},
    Row{value_stored_depth, rule::depth_store,
        "no set-up explains the depth, rounded to the steps of its format"},
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

const Row& row_of(ReasonKind kind) {
    return kRows.at(static_cast<size_t>(kind));
}

}  // namespace

std::string_view rule_of(ReasonKind kind, cases::Profile level) {
    const Row& row = row_of(kind);
    const bool is_direct3d = level == cases::Profile::direct3d && !row.direct3d.empty();
    return is_direct3d ? row.direct3d : row.rule;
}

std::string_view text_of(ReasonKind kind) {
    return row_of(kind).text;
}

std::string_view text_of_all(ReasonKind kind) {
    return row_of(kind).text_of_all;
}

}  // namespace ref
