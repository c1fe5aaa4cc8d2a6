// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults that a rasterizer's author could really make; each is a variation of the code path of
// device.cpp and its neighbours, never of the picture.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace mutants {

enum class Fault : uint8_t {
    none,
    // input assembly
    provoking_last,             // last-vertex convention for flat values
    strip_parity,               // odd triangles of a strip keep the order i, i+1, i+2
    fan_hub_provoking,          // the hub is the provoking vertex of a fan
    restart_ignored,            // the restart index ends nothing
    restart_keeps_one,          // after a restart the strip still remembers its last vertex
    indices_ignored,            // an indexed draw reads vertices in order
    strip_batch_parity,         // parity starts anew after 9 triangles
    fan_batch_hub,              // a fan of more than 9 triangles goes on round another hub
    vertex_cache_aliased,       // transformed vertices are found by index modulo 32
    primitive_id_restarts,      // gl_PrimitiveID is reset by a restart
    primitive_id_skips_culled,  // gl_PrimitiveID counts what was drawn
    state_of_first_draw,        // viewport, scissor, culling and front face stay as first set
    batch_tail_lost,            // the last triangle of a draw is lost
    draws_reversed,             // later draws are rendered first
    primitives_reversed,        // later triangles of a draw are rendered first
    primitives_paired,          // of two triangles the second is rendered first
    draw_doubled,               // each triangle is rasterized twice
    draws_nothing,
    draws_everything,  // every triangle covers the whole target
    // vertices
    height_sign_ignored,  // a negative viewport height mirrors nothing
    depth_range_ignored,  // minDepth and maxDepth are taken as 0 and 1
    viewport_rounded,     // the viewport is taken in whole pixels
    half_pixel_shift,     // the pixel centre is added twice
    viewport_nudge,       // the viewport's origin is 1/256 pixel off
    floor_snapping,       // vertices snap downwards
    ceil_snapping,        // vertices snap upwards
    coarse_snapping,      // vertices snap to 1/16 pixel whatever the limit says
    position_half,        // window positions are held in 11-bit floats
    // clipping
    clip_none,              // nothing is clipped
    clip_no_near,           // the near plane is missing
    clip_no_far,            // the far plane is missing
    clip_band_unscissored,  // guard band, but the viewport's rectangle does not bound
    clip_seam,              // the cut is computed from the first end point, not from the inner one
    clip_reversed,          // the cut is at 1 - t
    clip_copies_value,      // a new vertex takes the values of the inner vertex
    clip_screen_linear,     // a new vertex's values are interpolated as if w were constant
    clip_flat_piece,        // flat values come from the clipped polygon's first vertex
    clip_last_piece_lost,   // the last triangle of the clipped polygon's fan is lost
    clip_rejects_any,       // a triangle with a vertex outside is dropped
    // clip and cull distances
    distance_flipped,       // the half-space is c <= 0
    distance_reversed,      // the cut is at 1 - t
    distance_linear,        // distances are interpolated linearly on screen
    distance_last_ignored,  // the last plane does not clip
    distance_rotated,       // components y, z, w, x
    distance_zero_outside,  // a vertex at distance 0 is outside
    distance_by_order,      // distances are fetched by position in the index list
    distance_plane_twice,   // c >= 0 is tested at each sample, on the plane by either side
    distance_plane_never,   // c > 0 is tested at each sample
    cull_distance_any,      // one negative vertex culls
    cull_distance_mixed,    // a triangle is culled if each vertex is outside of some plane
    cull_distance_zero,     // 0 counts as negative
    cull_distance_ignored,
    cull_distance_provoking,  // the provoking vertex decides
    depth_volume_ignored,     // 0 <= z in spite of depth clip control
    depth_scale_ignored,      // depth clip control moves the plane, but not the transform
    // provoking vertex
    provoking_mode_ignored,  // the first vertex in last-vertex mode
    provoking_strip_odd,     // in last-vertex mode an odd triangle of a strip takes i+1
    provoking_fan_last_hub,  // in last-vertex mode a fan takes the hub
    provoking_turns,         // last-vertex mode turns the triangles round
    // facing and culling
    cull_inverted,
    front_face_inverted,
    face_unclipped_w,  // facing from the vertices divided by |w|
    degenerate_drawn,  // a triangle without area covers its line
    small_culled,      // a triangle whose bounding box is less than a pixel is dropped
    // coverage
    ties_bottom_right,
    ties_top_right,
    ties_bottom_left,
    ties_all_inclusive,
    ties_all_exclusive,
    ties_top_only,      // the left edge lost its bias
    ties_left_only,     // the top edge lost its bias
    ties_bottom_too,    // horizontal edges own their samples from both sides
    ties_right_too,     // right edges, too
    ties_by_winding,    // the bias is taken before the vertices are put in clockwise order
    sample_corner,      // the sample is the pixel's upper left corner
    edge_int32,         // edge functions in 32 bits
    edge_int32_256,     // 32 bits up to a bounding box of 256 pixels (128 would be right)
    edge_binary32,      // edge functions of unsnapped positions in binary32
    edge_truncated,     // edge functions are divided down, towards zero
    tile_wrong_corner,  // trivial reject looks at the corner that is nearest to the edge's outside
    tile_off_by_one,    // trivial reject looks at the last pixel but one
    box_last_column,    // bounding box: last column lost
    box_last_row,       // bounding box: last row lost
    box_first_column,   // bounding box: first column lost
    box_first_row,      // bounding box: first row lost
    clip_diagonal_double,  // the inner diagonals of a clipped polygon are drawn by both pieces
    // multisampling
    samples_exchanged,         // samples 0 and 1 have changed places
    samples_transposed,        // x and y of the locations are exchanged
    samples_upside_down,       // y of the locations counts from below
    samples_standard_only,     // locations of the pipeline are ignored
    samples_in_pixel_centres,  // coverage is decided at the pixel centre, for all samples
    mask_ignored,
    mask_shifted,   // by one sample
    mask_reversed,  // bit 0 is the last sample
    shader_mask_ignored,
    shader_mask_replaces,      // the shader's mask takes the place of the sample mask
    mask_in_full,              // gl_SampleMaskIn has all bits
    centroid_at_centre,        // also where the centre is outside of the triangle
    centroid_of_uncovered,     // the first sample that is not covered
    sample_at_centre,          // inputs decorated with Sample are evaluated at the centre
    one_over_w_cached,         // 1/w of the first input serves those at other places, too
    shading_once,              // sample shading is ignored
    frag_coord_always_centre,  // also with sample shading
    depth_at_centre,           // of every sample
    // scissor
    scissor_closed,      // right and bottom edge inclusive
    scissor_off_by_one,  // starts one pixel late
    scissor_ignored,
    scissor_follows_viewport,  // the scissor's origin is taken relative to the viewport
    // layers
    layer_ignored,         // everything goes to the first layer
    layer_off_by_one,      // everything goes to the next layer, the last to the first
    layer_of_viewport,     // gl_ViewportIndex is taken for gl_Layer
    layer_of_first_draw,   // gl_Layer is read once
    all_layers_written,    // every fragment goes to all layers
    layer_depth_of_first,  // the depth test looks at the first layer
    // values
    affine,                   // smooth is linear on screen
    reciprocal_12_bits,       // 1/w by a table of 12 bits
    reciprocal_area_12_bits,  // 1/area by a table of 12 bits
    weights_8_bits,           // barycentric weights in 8 bits
    values_stepped,           // values are stepped from pixel to pixel by additions
    plane_origin_far,         // planes are anchored 2^14 pixels away
    values_clamped,           // attributes are clamped to [0, 1]
    noperspective_smooth,
    flat_smooth,
    smooth_flat,
    depth_perspective,
    depth_before_divide,  // z_c instead of z_c/w_c
    attributes_swapped,   // locations 0 and 1
    components_rotated,   // .yzwx
    values_at_corner,     // evaluated at the pixel's upper left corner
    values_half,          // attributes held with 11 bits
    frag_coord_corner,    // FragCoord.xy without the half
    frag_coord_w,         // w instead of 1/w
    planes_of_last,       // planes are kept while the first vertex stays the same
    // probes
    derivative_partial,   // the limit instead of a difference between pixels
    derivative_y_up,      // dFdy with the opposite sign
    derivative_halved,    // over a quad of two pixels' distance
    offset_ignored,       // interpolateAtOffset at the centre
    lod_one_less,         // one level too fine
    lod_norm,             // the smaller of the two lengths
    barycentric_rotated,  // vertex order turned by one
    perspective_spans,    // one 1/w for each span of 8 pixels
    // depth
    depth_test_ignored,       // every fragment passes
    depth_operands_swapped,   // the stored depth is compared with the fragment's
    depth_less_or_equal,      // LESS passes equal depths
    depth_write_ignored,      // depth is written although the draw does not
    depth_write_before_test,  // a fragment that fails leaves its depth
    depth_store_scale,        // fixed point by 2^n instead of 2^n - 1
    depth_clamp_ignored,      // no depth clamp
    depth_clamp_unit,         // clamped to 0..1 instead of the viewport's range
    depth_clamp_unordered,    // a reversed range is not put in order before the clamp
    depth_clamp_before_bias,  // the bias is added after the clamp
    depth_clamp_clips,        // near and far plane clip in spite of depth clamp
    bias_ignored,             // no depth bias
    bias_sign,                // the bias is subtracted
    bias_exponent,            // r is 2^(e-24)
    bias_exponent_of_sample,  // e of the fragment's own depth
    bias_unit_doubled,        // r of fixed point is four steps
    bias_slope_x_only,        // the slope is that along x
    bias_slope_signed,        // the slope keeps its sign
    bias_slope_sum,           // the slope is the sum of both
    bias_clamp_ignored,       // no depthBiasClamp
    bias_clamp_both_ends,     // depthBiasClamp limits both ends
    // the colour target
    blend_ignored,                  // written as if blending were off
    blend_twice,                    // a blended fragment is blended again
    blend_factors_exchanged,        // source and destination factor
    blend_alpha_for_color,          // red, green and blue by the equation of alpha
    blend_color_for_alpha,          // alpha by the equation of the colours
    blend_complement_forgotten,     // ONE_MINUS_X is X
    blend_saturate_ignored,         // SRC_ALPHA_SATURATE is SRC_ALPHA
    blend_saturate_alpha,           // SRC_ALPHA_SATURATE is min(As, 1 - Ad) for alpha, too
    blend_dst_alpha_one,            // the destination's alpha is never read
    blend_missing_alpha_zero,       // a target without alpha has alpha 0
    blend_constants_ignored,        // they are 0
    blend_constants_alpha,          // CONSTANT_COLOR is CONSTANT_ALPHA
    blend_constants_of_first_draw,  // dynamic state that is not sent again
    blend_op_ignored,               // every operation adds
    blend_subtract_exchanged,       // SUBTRACT and REVERSE_SUBTRACT
    blend_min_max_scaled,           // factors are applied before MIN and MAX
    blend_premultiplies,            // the source is multiplied by its alpha once more
    blend_shift_only,               // products of 8 bits are shifted by 8, 255 * 255 is 254
    blend_source_unclamped,  // source and constants keep values beyond 0 and 1 in fixed point
    blend_floats_clamped,    // the source is clamped for float targets, too
    blend_stale,             // the destination is read before the triangle before is stored
    blend_merges,            // a fragment on top of the triangle before's is dropped
    blend_everywhere,        // FragCoord's attachment is blended, too
    blend_stays_on,          // a draw without blending is blended as the one before
    blend_of_first_draw,     // equations stay as first set
    color_reloaded,          // each draw starts with the load operation
    color_per_pixel,         // unblended colours go to all samples of the pixel
    write_mask_ignored,
    write_mask_ignored_blending,  // of blended draws
    write_mask_shifted,           // by one component
    write_mask_unswizzled,        // bit 0 is the first component in memory, blue of BGRA
    write_mask_of_first_draw,
    bgra_swapped,          // BGRA is written as RGBA
    store_truncates,       // UNORM rounds down
    store_wraps,           // UNORM without a clamp
    store_scale,           // f * 2^b
    store_through_8_bits,  // narrower UNORM is cut from 8 bits
    float_store_clamped,   // floats are clamped to [0, 1]
    float_store_half,      // binary32 is stored with the precision of binary16
    half_exponent_wraps,   // binary16's exponent overflows into small numbers
    integer_8_bits,        // integers pass through 8 bits
    srgb_not_encoded,
    srgb_not_decoded,    // the destination is blended as it is stored
    srgb_alpha_encoded,  // alpha, too
    srgb_gamma,          // a power of 1/2.2
    // stencil
    stencil_faces_exchanged,  // operations of front and back
    stencil_front_only,       // the back operation is never used
    stencil_own_facing,       // clockwise is front whatever frontFace says
    stencil_saturates,        // ..._AND_WRAP stops at 0 and 255
    stencil_seven_bits,       // the write mask lacks the highest bit
    stencil_per_pixel,        // each covered sample counts for the whole pixel
    stencil_sample_zero,      // only sample 0 is written
    stencil_before_depth,     // fragments that fail the depth test count
    stencil_never_written,
    // resolves
    resolve_one_sample,         // the average is sample 0
    resolve_sample_lost,        // the last sample does not take part in the average
    resolve_weights,            // means of means
    resolve_drawn_only,         // samples that hold the clear value do not take part
    resolve_averages_integers,  // sample 0 is the average
    resolve_min_max_exchanged,
    resolve_always_zero,  // MIN and MAX are sample 0
    resolve_last_sample,  // sample 0 is the last one
    resolve_shifted,      // pixels are resolved from their right neighbours
    resolve_row_lost,     // the last row is not resolved
    resolve_early,        // before the last draw
    resolve_ignored,
};

// One line of the table of faults.
struct FaultInfo {
    Fault fault;
    std::string_view name;  // the enumerator
};
std::span<const FaultInfo> all_faults();  // without none
std::string_view to_string(Fault fault);

}  // namespace mutants
