// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults of the colour target, the stencil and resolves.
#include "mutants/fault.hpp"

namespace mutants {

namespace {

constexpr FaultInfo kFaults[] = {
    {Fault::blend_ignored, "blend_ignored", "Colours are written as if blending were off.", "blend.equation"},
    {Fault::blend_twice, "blend_twice", "A blended fragment is blended again.", "blend.equation"},
    {Fault::blend_factors_exchanged, "blend_factors_exchanged", "Source and destination factor are exchanged.", "blend.equation"},
    {Fault::blend_alpha_for_color, "blend_alpha_for_color", "Red, green and blue are blended by the equation of alpha.", "blend.equation"},
    {Fault::blend_color_for_alpha, "blend_color_for_alpha", "Alpha is blended by the equation of the colours.", "blend.equation"},
    {Fault::blend_complement_forgotten, "blend_complement_forgotten", "ONE_MINUS_X is X.", "blend.equation"},
    {Fault::blend_saturate_ignored, "blend_saturate_ignored", "SRC_ALPHA_SATURATE is SRC_ALPHA.", "blend.equation"},
    {Fault::blend_saturate_alpha, "blend_saturate_alpha", "SRC_ALPHA_SATURATE is min(As, 1 - Ad) for alpha, too.", "blend.equation"},
    {Fault::blend_dst_alpha_one, "blend_dst_alpha_one", "The destination's alpha is never read.", "blend.equation"},
    {Fault::blend_missing_alpha_zero, "blend_missing_alpha_zero", "A target without alpha has alpha 0.", "blend.equation"},
    {Fault::blend_constants_ignored, "blend_constants_ignored", "The blend constants are 0.", "blend.equation"},
    {Fault::blend_constants_alpha, "blend_constants_alpha", "CONSTANT_COLOR is CONSTANT_ALPHA.", "blend.equation"},
    {Fault::blend_constants_of_first_draw, "blend_constants_of_first_draw", "The blend constants stay as the first draw set them.", "blend.equation"},
    {Fault::blend_op_ignored, "blend_op_ignored", "Every blend operation adds.", "blend.equation"},
    {Fault::blend_subtract_exchanged, "blend_subtract_exchanged", "SUBTRACT and REVERSE_SUBTRACT are exchanged.", "blend.equation"},
    {Fault::blend_min_max_scaled, "blend_min_max_scaled", "Factors are applied before MIN and MAX.", "blend.equation"},
    {Fault::blend_premultiplies, "blend_premultiplies", "The source is multiplied by its alpha once more.", "blend.equation"},
    {Fault::blend_shift_only, "blend_shift_only", "Products of 8 bits are shifted by 8: 255 * 255 is 254.", "blend.equation"},
    {Fault::blend_source_unclamped, "blend_source_unclamped", "Source and constants keep values beyond 0 and 1 in fixed point.", "blend.equation"},
    {Fault::blend_floats_clamped, "blend_floats_clamped", "The source is clamped for float targets, too.", "blend.equation"},
    {Fault::blend_stale, "blend_stale", "The destination is read before the previous triangle is stored.", "blend.equation order.primitive"},
    {Fault::blend_merges, "blend_merges", "A fragment on top of the previous triangle's is dropped.", "blend.equation order.primitive"},
    {Fault::blend_everywhere, "blend_everywhere", "FragCoord's attachment is blended, too.", "fragcoord.xy fragcoord.w fragcoord.sample blend.equation write.consistent depth.linear"},
    {Fault::blend_stays_on, "blend_stays_on", "A draw without blending is blended as the one before.", "blend.equation store.unorm store.float"},
    {Fault::blend_of_first_draw, "blend_of_first_draw", "Blend equations stay as the first draw set them.", "blend.equation"},
    {Fault::color_reloaded, "color_reloaded", "Each draw starts with the load operation again.", "blend.equation store.unorm"},
    {Fault::color_per_pixel, "color_per_pixel", "Unblended colours go to all samples of the pixel.", "store.unorm store.float store.integer resolve.average resolve.select blend.equation"},
    {Fault::write_mask_ignored, "write_mask_ignored", "Write masks are ignored.", "blend.write-mask"},
    {Fault::write_mask_ignored_blending, "write_mask_ignored_blending", "Write masks of blended draws are ignored.", "blend.write-mask"},
    {Fault::write_mask_shifted, "write_mask_shifted", "Write masks are shifted by one component.", "blend.write-mask"},
    {Fault::write_mask_unswizzled, "write_mask_unswizzled", "Bit 0 of a write mask is the first component in memory: blue of BGRA.", "blend.write-mask"},
    {Fault::write_mask_of_first_draw, "write_mask_of_first_draw", "Write masks stay as the first draw set them.", "blend.write-mask"},
    {Fault::bgra_swapped, "bgra_swapped", "BGRA is written as RGBA.", "store.unorm blend.equation"},
    {Fault::store_truncates, "store_truncates", "UNORM rounds down.", "store.unorm"},
    {Fault::store_wraps, "store_wraps", "UNORM is stored without a clamp.", "store.unorm"},
    {Fault::store_scale, "store_scale", "UNORM is f * 2^b.", "store.unorm"},
    {Fault::store_through_8_bits, "store_through_8_bits", "Narrower UNORM is cut from 8 bits.", "store.unorm"},
    {Fault::float_store_clamped, "float_store_clamped", "Floats are clamped to 0..1 when they are stored.", "store.float store.half"},
    {Fault::float_store_half, "float_store_half", "binary32 is stored with the precision of binary16.", "store.float"},
    {Fault::half_exponent_wraps, "half_exponent_wraps", "binary16's exponent overflows into small numbers.", "store.half"},
    {Fault::integer_8_bits, "integer_8_bits", "Integers pass through 8 bits.", "store.integer"},
    {Fault::srgb_not_encoded, "srgb_not_encoded", "Colours are not encoded to sRGB.", "store.srgb"},
    {Fault::srgb_not_decoded, "srgb_not_decoded", "The destination is blended as it is stored, in sRGB's codes.", "blend.equation"},
    {Fault::srgb_alpha_encoded, "srgb_alpha_encoded", "Alpha is encoded to sRGB, too.", "store.srgb store.unorm blend.equation"},
    {Fault::srgb_gamma, "srgb_gamma", "sRGB is a power of 1/2.2.", "store.srgb"},
    {Fault::stencil_faces_exchanged, "stencil_faces_exchanged", "The stencil operations of front and back are exchanged.", "stencil.count"},
    {Fault::stencil_front_only, "stencil_front_only", "The stencil operation of the back is never used.", "stencil.count"},
    {Fault::stencil_own_facing, "stencil_own_facing", "Clockwise is front for the stencil, whatever frontFace says.", "stencil.count"},
    {Fault::stencil_saturates, "stencil_saturates", "INCREMENT_AND_WRAP and DECREMENT_AND_WRAP stop at 255 and 0.", "stencil.count"},
    {Fault::stencil_seven_bits, "stencil_seven_bits", "The stencil's write mask lacks the highest bit.", "stencil.count"},
    {Fault::stencil_per_pixel, "stencil_per_pixel", "Each covered sample counts for the stencil of the whole pixel.", "stencil.count"},
    {Fault::stencil_sample_zero, "stencil_sample_zero", "Only the stencil of sample 0 is written.", "stencil.count"},
    {Fault::stencil_before_depth, "stencil_before_depth", "Fragments that fail the depth test count as ones that pass.", "stencil.count"},
    {Fault::stencil_never_written, "stencil_never_written", "The stencil is never written.", "stencil.count"},
    {Fault::resolve_one_sample, "resolve_one_sample", "The average of a resolve is sample 0.", "resolve.average"},
    {Fault::resolve_sample_lost, "resolve_sample_lost", "The last sample does not take part in the average.", "resolve.average"},
    {Fault::resolve_weights, "resolve_weights", "The average is a mean of means: later samples weigh more.", "resolve.average"},
    {Fault::resolve_drawn_only, "resolve_drawn_only", "Samples that hold the clear value do not take part in the average.", "resolve.average"},
    {Fault::resolve_averages_integers, "resolve_averages_integers", "Integers are averaged.", "resolve.select"},
    {Fault::resolve_min_max_exchanged, "resolve_min_max_exchanged", "The minimum and the maximum of a resolve are exchanged.", "resolve.select"},
    {Fault::resolve_always_zero, "resolve_always_zero", "MIN and MAX of a resolve are sample 0.", "resolve.select"},
    {Fault::resolve_last_sample, "resolve_last_sample", "Sample 0 of a resolve is the last one.", "resolve.select"},
    {Fault::resolve_shifted, "resolve_shifted", "Pixels are resolved from their right neighbours.", "resolve.average resolve.select"},
    {Fault::resolve_row_lost, "resolve_row_lost", "The last row is not resolved.", "resolve.average resolve.select"},
    {Fault::resolve_early, "resolve_early", "The resolve runs before the last draw.", "resolve.average resolve.select"},
    {Fault::resolve_ignored, "resolve_ignored", "Nothing is resolved.", "resolve.average resolve.select"},
};

}  // namespace

std::span<const FaultInfo> faults_of_targets() {
    return kFaults;
}

}  // namespace mutants
