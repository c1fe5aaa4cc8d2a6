// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The ids of all rules, in the order of the table (rule.cpp).
#pragma once

namespace cases::rule {

inline constexpr char cover_inside[] = "cover.inside";
inline constexpr char cover_outside[] = "cover.outside";
inline constexpr char cover_shared_edge[] = "cover.shared-edge";
inline constexpr char cover_shared_vertex[] = "cover.shared-vertex";
inline constexpr char cover_clipped_edge[] = "cover.clipped-edge";
inline constexpr char cover_degenerate[] = "cover.degenerate";
inline constexpr char snap_nearest[] = "snap.nearest";
inline constexpr char tie_top_left[] = "tie.top-left";
inline constexpr char face_area_sign[] = "face.area-sign";
inline constexpr char face_cull[] = "face.cull";
inline constexpr char discard_rasterizer[] = "discard.rasterizer";
inline constexpr char discard_fragment[] = "discard.fragment";
inline constexpr char discard_early_tests[] = "discard.early-tests";
inline constexpr char clip_volume[] = "clip.volume";
inline constexpr char clip_viewport[] = "clip.viewport";
inline constexpr char layer_select[] = "layer.select";
inline constexpr char clip_depth[] = "clip.depth";
inline constexpr char clip_distance[] = "clip.distance";
inline constexpr char clip_complement[] = "clip.complement";
inline constexpr char cull_distance[] = "cull.distance";
inline constexpr char number_undefined[] = "number.undefined";
inline constexpr char scissor_half_open[] = "scissor.half-open";
inline constexpr char sample_locations[] = "sample.locations";
inline constexpr char sample_mask[] = "sample.mask";
inline constexpr char sample_alpha_to_one[] = "sample.alpha-to-one";
inline constexpr char sample_mask_in[] = "sample.mask-in";
inline constexpr char sample_id[] = "sample.id";
inline constexpr char sample_shading[] = "sample.shading";
inline constexpr char interp_centroid[] = "interp.centroid";
inline constexpr char interp_sample[] = "interp.sample";
inline constexpr char fragcoord_sample[] = "fragcoord.sample";
inline constexpr char order_primitive[] = "order.primitive";
inline constexpr char provoking_first[] = "provoking.first";
inline constexpr char provoking_last[] = "provoking.last";
inline constexpr char interp_linear[] = "interp.linear";
inline constexpr char interp_perspective[] = "interp.perspective";
inline constexpr char interp_hull[] = "interp.hull";
inline constexpr char interp_flat[] = "interp.flat";
inline constexpr char fragcoord_xy[] = "fragcoord.xy";
inline constexpr char fragcoord_w[] = "fragcoord.w";
inline constexpr char store_unorm[] = "store.unorm";
inline constexpr char store_srgb[] = "store.srgb";
inline constexpr char store_half[] = "store.half";
inline constexpr char store_float[] = "store.float";
inline constexpr char store_integer[] = "store.integer";
inline constexpr char blend_equation[] = "blend.equation";
inline constexpr char blend_second_source[] = "blend.second-source";
inline constexpr char logic_operation[] = "logic.operation";
inline constexpr char blend_write_mask[] = "blend.write-mask";
inline constexpr char color_location[] = "color.location";
inline constexpr char write_consistent[] = "write.consistent";
inline constexpr char write_outside[] = "write.outside";
inline constexpr char depth_linear[] = "depth.linear";
inline constexpr char repeat_same[] = "repeat.same";
inline constexpr char repeat_scissor[] = "repeat.scissor";
inline constexpr char repeat_clears[] = "repeat.clears";
inline constexpr char repeat_write_masks[] = "repeat.write-masks";
inline constexpr char repeat_attachments[] = "repeat.attachments";
inline constexpr char door_index[] = "door.index";
inline constexpr char door_restart[] = "door.restart";
inline constexpr char door_first[] = "door.first";
inline constexpr char door_buffer[] = "door.buffer";
inline constexpr char door_layout[] = "door.layout";
inline constexpr char door_instance[] = "door.instance";
inline constexpr char door_indirect[] = "door.indirect";
inline constexpr char door_state[] = "door.state";
inline constexpr char door_recording[] = "door.recording";
inline constexpr char depth_store[] = "depth.store";
inline constexpr char depth_bias[] = "depth.bias";
inline constexpr char depth_distinct[] = "depth.distinct";
inline constexpr char depth_written[] = "depth.written";
inline constexpr char depth_bounds[] = "depth.bounds";
inline constexpr char depth_clamp[] = "depth.clamp";
inline constexpr char depth_compare[] = "depth.compare";
inline constexpr char depth_repeat[] = "depth.repeat";
inline constexpr char depth_write[] = "depth.write";
inline constexpr char interp_at_offset[] = "interp.at-offset";
inline constexpr char interp_at_sample[] = "interp.at-sample";
inline constexpr char interp_at_centroid[] = "interp.at-centroid";
inline constexpr char derivative_fine[] = "derivative.fine";
inline constexpr char derivative_coarse[] = "derivative.coarse";
inline constexpr char derivative_plain[] = "derivative.plain";
inline constexpr char lod_query[] = "lod.query";
inline constexpr char stencil_count[] = "stencil.count";
inline constexpr char stencil_compare[] = "stencil.compare";
inline constexpr char stencil_operation[] = "stencil.operation";
inline constexpr char stencil_mask[] = "stencil.mask";
inline constexpr char stencil_faces[] = "stencil.faces";
inline constexpr char stencil_depth_outcome[] = "stencil.depth-outcome";
inline constexpr char query_occlusion[] = "query.occlusion";
inline constexpr char resolve_select[] = "resolve.select";
inline constexpr char resolve_average[] = "resolve.average";
inline constexpr char barycentric_value[] = "barycentric.value";
inline constexpr char barycentric_order[] = "barycentric.order";
inline constexpr char blit_nearest[] = "blit.nearest";
inline constexpr char blit_linear[] = "blit.linear";
inline constexpr char blit_outside[] = "blit.outside";

}  // namespace cases::rule
