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
    coarse_snapping,      // vertices snap to 1/16 pixel whatever the limit says
    position_half,        // window positions are held in 11-bit floats
    // clipping
    clip_none,              // nothing is clipped
    clip_no_near,           // the near plane is missing
    clip_no_far,            // the far plane is missing
    clip_band_unscissored,  // guard band, but the viewport's rectangle does not bound
    clip_seam,              // the cut is computed from the first end point, not from the inner one
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
    ties_all_inclusive,
    ties_all_exclusive,
    ties_top_only,      // the left edge lost its bias
    ties_by_winding,    // the bias is taken before the vertices are put in clockwise order
    sample_corner,      // the sample is the pixel's upper left corner
    edge_int32,         // edge functions in 32 bits
    edge_int32_256,     // 32 bits up to a bounding box of 256 pixels (128 would be right)
    edge_binary32,      // edge functions of unsnapped positions in binary32
    edge_truncated,     // edge functions are divided down, towards zero
    tile_wrong_corner,  // trivial reject looks at the corner that is nearest to the edge's outside
    tile_off_by_one,    // trivial reject looks at the last pixel but one
    box_last_column,    // bounding box: last column lost
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
    offset_ignored,       // interpolateAtOffset at the centre
    lod_one_less,         // one level too fine
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
};

// One line of the table of faults.
struct FaultInfo {
    Fault fault;
    std::string_view name;  // the enumerator
};
std::span<const FaultInfo> all_faults();  // without none
std::string_view to_string(Fault fault);

}  // namespace mutants
