// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "mutants/fault.hpp"

namespace mutants {

namespace {

constexpr FaultInfo kFaults[] = {
    {Fault::provoking_last, "provoking_last"},
    {Fault::strip_parity, "strip_parity"},
    {Fault::fan_hub_provoking, "fan_hub_provoking"},
    {Fault::restart_ignored, "restart_ignored"},
    {Fault::restart_keeps_one, "restart_keeps_one"},
    {Fault::indices_ignored, "indices_ignored"},
    {Fault::strip_batch_parity, "strip_batch_parity"},
    {Fault::fan_batch_hub, "fan_batch_hub"},
    {Fault::vertex_cache_aliased, "vertex_cache_aliased"},
    {Fault::primitive_id_restarts, "primitive_id_restarts"},
    {Fault::primitive_id_skips_culled, "primitive_id_skips_culled"},
    {Fault::state_of_first_draw, "state_of_first_draw"},
    {Fault::batch_tail_lost, "batch_tail_lost"},
    {Fault::draws_reversed, "draws_reversed"},
    {Fault::primitives_reversed, "primitives_reversed"},
    {Fault::draw_doubled, "draw_doubled"},
    {Fault::draws_nothing, "draws_nothing"},
    {Fault::draws_everything, "draws_everything"},
    {Fault::height_sign_ignored, "height_sign_ignored"},
    {Fault::depth_range_ignored, "depth_range_ignored"},
    {Fault::viewport_rounded, "viewport_rounded"},
    {Fault::half_pixel_shift, "half_pixel_shift"},
    {Fault::viewport_nudge, "viewport_nudge"},
    {Fault::floor_snapping, "floor_snapping"},
    {Fault::coarse_snapping, "coarse_snapping"},
    {Fault::position_half, "position_half"},
    {Fault::clip_none, "clip_none"},
    {Fault::clip_no_near, "clip_no_near"},
    {Fault::clip_no_far, "clip_no_far"},
    {Fault::clip_band_unscissored, "clip_band_unscissored"},
    {Fault::clip_seam, "clip_seam"},
    {Fault::clip_copies_value, "clip_copies_value"},
    {Fault::clip_screen_linear, "clip_screen_linear"},
    {Fault::clip_flat_piece, "clip_flat_piece"},
    {Fault::clip_last_piece_lost, "clip_last_piece_lost"},
    {Fault::clip_rejects_any, "clip_rejects_any"},
    {Fault::cull_inverted, "cull_inverted"},
    {Fault::front_face_inverted, "front_face_inverted"},
    {Fault::face_unclipped_w, "face_unclipped_w"},
    {Fault::degenerate_drawn, "degenerate_drawn"},
    {Fault::small_culled, "small_culled"},
    {Fault::ties_bottom_right, "ties_bottom_right"},
    {Fault::ties_all_inclusive, "ties_all_inclusive"},
    {Fault::ties_all_exclusive, "ties_all_exclusive"},
    {Fault::ties_top_only, "ties_top_only"},
    {Fault::ties_by_winding, "ties_by_winding"},
    {Fault::sample_corner, "sample_corner"},
    {Fault::edge_int32, "edge_int32"},
    {Fault::edge_int32_256, "edge_int32_256"},
    {Fault::edge_binary32, "edge_binary32"},
    {Fault::edge_truncated, "edge_truncated"},
    {Fault::tile_wrong_corner, "tile_wrong_corner"},
    {Fault::tile_off_by_one, "tile_off_by_one"},
    {Fault::box_last_column, "box_last_column"},
    {Fault::box_first_row, "box_first_row"},
    {Fault::clip_diagonal_double, "clip_diagonal_double"},
    {Fault::samples_exchanged, "samples_exchanged"},
    {Fault::samples_transposed, "samples_transposed"},
    {Fault::samples_upside_down, "samples_upside_down"},
    {Fault::samples_standard_only, "samples_standard_only"},
    {Fault::samples_in_pixel_centres, "samples_in_pixel_centres"},
    {Fault::mask_ignored, "mask_ignored"},
    {Fault::mask_shifted, "mask_shifted"},
    {Fault::mask_reversed, "mask_reversed"},
    {Fault::shader_mask_ignored, "shader_mask_ignored"},
    {Fault::shader_mask_replaces, "shader_mask_replaces"},
    {Fault::mask_in_full, "mask_in_full"},
    {Fault::centroid_at_centre, "centroid_at_centre"},
    {Fault::centroid_of_uncovered, "centroid_of_uncovered"},
    {Fault::sample_at_centre, "sample_at_centre"},
    {Fault::one_over_w_cached, "one_over_w_cached"},
    {Fault::shading_once, "shading_once"},
    {Fault::frag_coord_always_centre, "frag_coord_always_centre"},
    {Fault::depth_at_centre, "depth_at_centre"},
    {Fault::scissor_closed, "scissor_closed"},
    {Fault::scissor_off_by_one, "scissor_off_by_one"},
    {Fault::scissor_ignored, "scissor_ignored"},
    {Fault::scissor_follows_viewport, "scissor_follows_viewport"},
    {Fault::affine, "affine"},
    {Fault::reciprocal_12_bits, "reciprocal_12_bits"},
    {Fault::reciprocal_area_12_bits, "reciprocal_area_12_bits"},
    {Fault::weights_8_bits, "weights_8_bits"},
    {Fault::values_stepped, "values_stepped"},
    {Fault::values_clamped, "values_clamped"},
    {Fault::noperspective_smooth, "noperspective_smooth"},
    {Fault::flat_smooth, "flat_smooth"},
    {Fault::smooth_flat, "smooth_flat"},
    {Fault::depth_perspective, "depth_perspective"},
    {Fault::depth_before_divide, "depth_before_divide"},
    {Fault::attributes_swapped, "attributes_swapped"},
    {Fault::components_rotated, "components_rotated"},
    {Fault::values_at_corner, "values_at_corner"},
    {Fault::values_half, "values_half"},
    {Fault::frag_coord_corner, "frag_coord_corner"},
    {Fault::frag_coord_w, "frag_coord_w"},
    {Fault::planes_of_last, "planes_of_last"},
    {Fault::perspective_spans, "perspective_spans"},
};

}  // namespace

std::span<const FaultInfo> all_faults() {
    return kFaults;
}

std::string_view to_string(Fault fault) {
    for (const FaultInfo& info : kFaults) {
        if (info.fault == fault) {
            return info.name;
        }
    }
    return "none";
}

}  // namespace mutants
