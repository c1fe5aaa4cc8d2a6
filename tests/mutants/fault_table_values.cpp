// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults of multisampling, scissors, layers, values and depth.
#include "mutants/fault.hpp"

namespace mutants {

namespace {

constexpr FaultInfo kFaults[] = {
    {Fault::samples_exchanged, "samples_exchanged", "Samples 0 and 1 have changed places.", "sample.locations cover.inside cover.outside"},
    {Fault::samples_transposed, "samples_transposed", "x and y of the sample locations are exchanged.", "sample.locations cover.inside cover.outside"},
    {Fault::samples_upside_down, "samples_upside_down", "y of the sample locations counts from below.", "sample.locations cover.inside cover.outside"},
    {Fault::samples_standard_only, "samples_standard_only", "The sample locations of the pipeline are ignored.", "sample.locations cover.inside cover.outside"},
    {Fault::samples_in_pixel_centres, "samples_in_pixel_centres", "Coverage of all samples is decided at the pixel's centre.", "sample.locations cover.inside cover.outside"},
    {Fault::mask_ignored, "mask_ignored", "The sample mask removes nothing.", "sample.mask"},
    {Fault::mask_shifted, "mask_shifted", "The sample mask is shifted by one sample.", "sample.mask cover.inside"},
    {Fault::mask_reversed, "mask_reversed", "Bit 0 of the sample mask is the last sample.", "sample.mask cover.inside"},
    {Fault::shader_mask_ignored, "shader_mask_ignored", "gl_SampleMask removes nothing.", "sample.mask"},
    {Fault::shader_mask_replaces, "shader_mask_replaces", "gl_SampleMask takes the place of the sample mask.", "sample.mask"},
    {Fault::mask_in_full, "mask_in_full", "gl_SampleMaskIn has all bits.", "sample.mask-in"},
    {Fault::centroid_at_centre, "centroid_at_centre", "Centroid inputs are evaluated at the centre, also where it lies outside of the triangle.", "interp.centroid interp.at-centroid"},
    {Fault::centroid_of_uncovered, "centroid_of_uncovered", "Centroid inputs are evaluated at the first sample that is not covered.", "interp.centroid interp.at-centroid"},
    {Fault::sample_at_centre, "sample_at_centre", "Sample inputs are evaluated at the pixel's centre.", "interp.sample interp.at-sample"},
    {Fault::one_over_w_cached, "one_over_w_cached", "1/w of the first input serves those at other places, too.", "interp.sample interp.centroid interp.perspective"},
    {Fault::shading_once, "shading_once", "Sample shading is ignored.", "sample.shading sample.id fragcoord.sample"},
    {Fault::frag_coord_always_centre, "frag_coord_always_centre", "FragCoord is the pixel's centre, also with sample shading.", "fragcoord.sample"},
    {Fault::depth_at_centre, "depth_at_centre", "Depth of every sample is taken at the pixel's centre.", "depth.linear depth.compare depth.bias"},
    {Fault::scissor_closed, "scissor_closed", "The scissor's right and bottom ends are inclusive.", "scissor.half-open"},
    {Fault::scissor_off_by_one, "scissor_off_by_one", "The scissor starts one pixel late.", "cover.inside scissor.half-open"},
    {Fault::scissor_ignored, "scissor_ignored", "The scissor removes nothing.", "scissor.half-open"},
    {Fault::scissor_follows_viewport, "scissor_follows_viewport", "The scissor's origin is taken relative to the viewport.", "scissor.half-open cover.inside"},
    {Fault::layer_ignored, "layer_ignored", "Everything goes to the first layer.", "layer.select cover.inside"},
    {Fault::layer_off_by_one, "layer_off_by_one", "Everything goes to the next layer, the last to the first.", "layer.select cover.inside"},
    {Fault::layer_of_viewport, "layer_of_viewport", "gl_ViewportIndex is taken for gl_Layer.", "layer.select cover.inside"},
    {Fault::layer_of_first_draw, "layer_of_first_draw", "gl_Layer is read once.", "layer.select cover.inside"},
    {Fault::all_layers_written, "all_layers_written", "Every fragment goes to all layers.", "layer.select"},
    {Fault::layer_depth_of_first, "layer_depth_of_first", "The depth test looks at the first layer.", "depth.compare layer.select depth.repeat"},
    {Fault::affine, "affine", "Smooth values are linear on the screen.", "interp.perspective"},
    {Fault::reciprocal_12_bits, "reciprocal_12_bits", "1/w is taken from a table of 12 bits.", "interp.perspective fragcoord.w"},
    {Fault::reciprocal_area_12_bits, "reciprocal_area_12_bits", "1/area is taken from a table of 12 bits.", "interp.linear interp.perspective depth.linear"},
    {Fault::weights_8_bits, "weights_8_bits", "Barycentric weights have 8 bits.", "interp.linear interp.perspective depth.linear"},
    {Fault::values_stepped, "values_stepped", "Values are stepped from pixel to pixel by additions.", "interp.linear interp.perspective depth.linear"},
    {Fault::plane_origin_far, "plane_origin_far", "Planes are anchored 2^14 pixels away.", "interp.linear interp.perspective depth.linear"},
    {Fault::values_clamped, "values_clamped", "Attributes are clamped to 0..1.", "interp.linear interp.perspective interp.flat interp.hull"},
    {Fault::noperspective_smooth, "noperspective_smooth", "noperspective inputs are interpolated as smooth ones.", "interp.linear"},
    {Fault::flat_smooth, "flat_smooth", "flat inputs are interpolated as smooth ones.", "interp.flat"},
    {Fault::smooth_flat, "smooth_flat", "smooth inputs are flat.", "interp.perspective"},
    {Fault::depth_perspective, "depth_perspective", "Depth is interpolated with perspective.", "depth.linear"},
    {Fault::depth_before_divide, "depth_before_divide", "The depth of a vertex is z_c instead of z_c / w_c.", "depth.linear interp.hull"},
    {Fault::attributes_swapped, "attributes_swapped", "Locations 0 and 1 are exchanged.", "interp.linear interp.perspective interp.flat interp.hull"},
    {Fault::components_rotated, "components_rotated", "Components are read as y, z, w, x.", "interp.linear interp.perspective interp.flat interp.hull"},
    {Fault::values_at_corner, "values_at_corner", "Values are evaluated at the pixel's upper left corner.", "interp.linear interp.perspective depth.linear"},
    {Fault::values_half, "values_half", "Attributes are held with 11 bits.", "interp.linear interp.perspective"},
    {Fault::frag_coord_corner, "frag_coord_corner", "FragCoord.xy lacks the half.", "fragcoord.xy fragcoord.sample"},
    {Fault::frag_coord_w, "frag_coord_w", "FragCoord.w is w instead of 1/w.", "fragcoord.w"},
    {Fault::planes_of_last, "planes_of_last", "Planes are kept while the first vertex stays the same.", "interp.linear interp.perspective depth.linear interp.hull"},
    {Fault::derivative_partial, "derivative_partial", "A derivative is the limit at the fragment instead of a difference between pixels.", "derivative.fine derivative.coarse derivative.plain"},
    {Fault::derivative_y_up, "derivative_y_up", "dFdy has the opposite sign.", "derivative.fine derivative.coarse derivative.plain"},
    {Fault::derivative_halved, "derivative_halved", "Differences are divided by two, as over a quad of two pixels' distance.", "derivative.fine derivative.coarse derivative.plain lod.query"},
    {Fault::offset_ignored, "offset_ignored", "interpolateAtOffset evaluates at the centre.", "interp.at-offset"},
    {Fault::lod_one_less, "lod_one_less", "The level of detail is one too fine.", "lod.query"},
    {Fault::lod_norm, "lod_norm", "The level of detail follows from the smaller of the two lengths.", "lod.query"},
    {Fault::barycentric_rotated, "barycentric_rotated", "The order of barycentric coordinates is turned by one vertex.", "barycentric.order barycentric.value"},
    {Fault::perspective_spans, "perspective_spans", "One 1/w serves each span of 8 pixels.", "interp.perspective"},
    {Fault::depth_test_ignored, "depth_test_ignored", "Every fragment passes the depth test.", "depth.compare depth.repeat depth.distinct"},
    {Fault::depth_operands_swapped, "depth_operands_swapped", "The stored depth is compared with the fragment's.", "depth.compare depth.repeat depth.distinct"},
    {Fault::depth_less_or_equal, "depth_less_or_equal", "LESS passes equal depths.", "depth.compare depth.repeat"},
    {Fault::depth_write_ignored, "depth_write_ignored", "Depth is written although the draw's depth writes are off.", "depth.write depth.compare depth.repeat depth.distinct"},
    {Fault::depth_write_before_test, "depth_write_before_test", "A fragment that fails the depth test leaves its depth.", "depth.write depth.compare depth.linear"},
    {Fault::depth_store_scale, "depth_store_scale", "Depth of fixed point is scaled by 2^n instead of 2^n - 1.", "depth.store depth.linear"},
    {Fault::depth_clamp_ignored, "depth_clamp_ignored", "Depth is not clamped.", "depth.clamp depth.linear"},
    {Fault::depth_clamp_unit, "depth_clamp_unit", "Depth is clamped to 0..1 instead of the viewport's range.", "depth.clamp depth.linear depth.bias"},
    {Fault::depth_clamp_unordered, "depth_clamp_unordered", "A reversed depth range is not put in order before the clamp.", "depth.clamp depth.linear depth.bias"},
    {Fault::depth_clamp_before_bias, "depth_clamp_before_bias", "The bias is added after the clamp.", "depth.clamp depth.bias"},
    {Fault::depth_clamp_clips, "depth_clamp_clips", "The near and far planes clip in spite of depth clamp.", "cover.inside depth.clamp clip.depth"},
    {Fault::bias_ignored, "bias_ignored", "There is no depth bias.", "depth.bias depth.distinct"},
    {Fault::bias_sign, "bias_sign", "The depth bias is subtracted.", "depth.bias depth.distinct"},
    {Fault::bias_exponent, "bias_exponent", "r of a floating-point depth is 2^(e-24) instead of 2^(e-23).", "depth.bias"},
    {Fault::bias_exponent_of_sample, "bias_exponent_of_sample", "r follows from the exponent of the fragment's own depth, not of the triangle's largest.", "depth.bias"},
    {Fault::bias_unit_doubled, "bias_unit_doubled", "r of fixed-point depth is four steps.", "depth.bias"},
    {Fault::bias_slope_x_only, "bias_slope_x_only", "The slope of the bias is that along x.", "depth.bias"},
    {Fault::bias_slope_signed, "bias_slope_signed", "The slope of the bias keeps its sign.", "depth.bias"},
    {Fault::bias_slope_sum, "bias_slope_sum", "The slope of the bias is the sum of both.", "depth.bias"},
    {Fault::bias_clamp_ignored, "bias_clamp_ignored", "depthBiasClamp does nothing.", "depth.bias"},
    {Fault::bias_clamp_both_ends, "bias_clamp_both_ends", "depthBiasClamp limits the bias from both ends.", "depth.bias"},
};

}  // namespace

std::span<const FaultInfo> faults_of_values() {
    return kFaults;
}

}  // namespace mutants
