// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/exercise/exercise_table.hpp"

#include <algorithm>
#include <iterator>

#include "cases/fault/fault.hpp"
#include "cases/model/rule_ids.hpp"
#include "ref/exercise/coverage_tests.hpp"
#include "ref/exercise/depth_tests.hpp"
#include "ref/exercise/value_tests.hpp"

namespace ref {

namespace {

namespace rule = cases::rule;
using cases::operator""_fault;
using cases::Profile;

bool is_nearest(const cases::Blit& blit) {
    return blit.filter == cases::BlitFilter::nearest;
}
bool is_linear(const cases::Blit& blit) {
    return blit.filter == cases::BlitFilter::linear;
}
bool is_any(const cases::Blit&) {
    return true;
}

constexpr Way at(Profile profile, ExerciseTest test) {
    return {.profile = profile, .test = test};
}
constexpr Way at_all(ExerciseTest test) {
    return at(Profile::direct3d, test);
}
constexpr Way by(cases::Fault fault, Differ differ = Differ::hits) {
    return {.fault = fault, .differ = differ};
}
constexpr Way kInside{.texels = Way::Texels::inside};
constexpr Way kOutside{.texels = Way::Texels::outside};
constexpr auto kPractice = Profile::practice;
constexpr auto kVulkan = Profile::vulkan;

using cases::ComponentKind;
using cases::ProvokingVertex;
using cases::RelationKind;
using cases::Resolve;

constexpr std::string_view kOfValue = "that must show a value of this kind";
constexpr std::string_view kLevel =
    "whose value would be another if all vertices had that of the draw's first";
constexpr std::string_view kOfRelation = "that must be covered, in a case with this relation";

// In the order of the rules (cases/model/rule.cpp).
constexpr ExerciseRow kRows[] = {
    {rule::cover_inside,
     "that a triangle covers wherever its vertices may lie",
     {at(kVulkan, is_surely_covered)}},
    {rule::cover_outside,
     "that a triangle, whose draw may write there, must not cover",
     {at(kVulkan, is_outside_one)}},
    {rule::cover_shared_edge,
     "that triangles share out along edges they have in common",
     {at(kVulkan, is_in_set), at(kPractice, is_in_set), at_all(is_in_set)}},
    {rule::cover_shared_vertex,
     "that triangles share out at a vertex they have in common",
     {at(kPractice, is_in_set), at_all(is_in_set)}},
    {rule::cover_clipped_edge,
     "that triangles share out along clipped edges they have in common",
     {at(kPractice, is_in_set), at_all(is_in_set)}},
    {rule::cover_degenerate, "that lies on a triangle without area", {at(kPractice, is_settled)}},
    {rule::snap_nearest,
     "that is open until vertices are rounded to nearest",
     {at(kPractice, is_settled_by_snapping)}},
    {rule::tie_top_left,
     "that lies on an edge and is open without the rule",
     {at(kPractice, is_settled)}},
    {rule::conservative_overestimate,
     "that must be covered, and would not be without overestimation",
     {at_all(is_overestimated)}},
    {rule::conservative_size,
     "near a triangle that, enlarged, must not reach its pixel, or that must be covered by the "
     "extra size alone",
     {at(kPractice, has_reason_of_area), at_all(has_reason_of_area)}},
    {rule::conservative_underestimate,
     "that would be drawn otherwise without underestimation",
     {by("conservative-ignored"_fault), at_all(has_reason_of_area)}},
    {rule::conservative_degenerate,
     "near a triangle without area that is overestimated",
     {at(kPractice, has_reason_of_area), at_all(has_reason_of_area)}},
    {rule::fragment_size_area, kOfValue, {at_all(has_value)}},
    {rule::fragment_size_rate,
     "that must show the rate of a fragment of several pixels",
     {at_all(has_rate_of_several)}},
    {rule::fragment_size_shared,
     "of a fragment of several pixels, of which the triangle covers another one, too",
     {at_all(is_of_shared_fragment)}},
    {rule::face_area_sign,
     "that shows a face, whichever way the vertices snap",
     {at_all(shows_face), by("front-face-inverted"_fault)}},
    {rule::face_cull,
     "that would be drawn otherwise without culling, or if the other faces were culled",
     {by("cull-none"_fault), by("cull-inverted"_fault)}},
    {rule::discard_rasterizer,
     "that would be drawn otherwise if nothing were discarded",
     {by("discard-ignored"_fault)}},
    {rule::discard_fragment,
     "that would be drawn otherwise if the fragment shader discarded nothing",
     {by("discard-fragment-ignored"_fault)}},
    {rule::discard_value,
     "that would be drawn otherwise if no attribute's sign discarded",
     {by("discard-value-ignored"_fault)}},
    {rule::discard_early_tests,
     "whose depth or stencil would be another if what is discarded stored nothing",
     {by("discard-tests-late"_fault)}},
    {rule::clip_volume,
     "of a triangle that leaves the volume or touches a depth plane, or of what is clipped away",
     {at_all(reaches_volume), at_all(is_kept_away)}},
    {rule::clip_viewport,
     "of a triangle that crosses the viewport's border, within it or beyond",
     {at_all(crosses_border), at_all(is_kept_away)}},
    {rule::layer_select,
     "that would be drawn otherwise if everything went to the first layer, or to the last",
     {by("layer-ignored"_fault), by("layer-always-last"_fault)}},
    {rule::clip_depth,
     "that would be drawn otherwise with the other state of the depth planes",
     {by("depth-clip-flipped"_fault), by("depth-volume-flipped"_fault)}},
    {rule::clip_distance,
     "that would be drawn otherwise without clip distances, or if a vertex at distance 0 were "
     "outside",
     {by("clip-distances-ignored"_fault), by("distance-zero-outside"_fault)}},
    {rule::clip_complement,
     "that a triangle and its complement share out",
     {at(kVulkan, is_in_set), at(kPractice, is_in_set), at_all(is_in_set)}},
    {rule::cull_distance,
     "that would be drawn otherwise without cull distances",
     {by("cull-distance-ignored"_fault)}},
    {rule::number_undefined,
     "that must be covered, in a case with a bad number",
     {at_all(is_beside_bad_number)}},
    {rule::scissor_half_open,
     "that would be drawn otherwise without the scissor",
     {by("scissor-ignored"_fault)}},
    {rule::sample_locations,
     "that its place in the pixel matters to",
     {by("samples-at-centre"_fault), at_all(is_at_sample)}},
    {rule::sample_mask,
     "that would be drawn otherwise without the mask, or if its bits stood for the samples in "
     "reverse",
     {by("sample-masks-ignored"_fault), by("mask-reversed"_fault)}},
    {rule::sample_mask_in, kOfValue, {at_all(has_value)}},
    {rule::sample_id, "that must show its number, which is not 0", {at_all(has_sample_number)}},
    {rule::sample_shading,
     "of a fragment that is shaded for several samples",
     {at_all(is_sample_shaded)}},
    {rule::interp_centroid,
     "whose centroid value would be another at the pixel's centre, at the sample, or in the place "
     "of sample 0",
     {by("centroid-at-centre"_fault, Differ::values),
      by("centroid-as-sample"_fault, Differ::values),
      by("samples-at-first"_fault, Differ::values)}},
    {rule::interp_sample,
     "whose value at the sample would be another at the pixel's centre, or in the place of sample "
     "0",
     {by("samples-at-centre"_fault, Differ::values), by("samples-at-first"_fault, Differ::values)}},
    {rule::fragcoord_sample,
     "whose value would be another at the pixel's centre, or in the place of sample 0",
     {by("samples-at-centre"_fault, Differ::values), by("samples-at-first"_fault, Differ::values)}},
    {rule::order_primitive,
     "that is written more than once, and shows what was written last",
     {at_all(is_overwritten)}},
    {rule::instance_input,
     "that an instance writes which reads an offset or an attribute of its own",
     {at_all(is_of_instance)}},
    {rule::provoking_first,
     "of a draw with this convention that shows the vertex",
     {at_all(is_provoked_by<ProvokingVertex::first>), by("provoking-last"_fault, Differ::colors)}},
    {rule::provoking_last,
     "of a draw with this convention that shows the vertex",
     {at_all(is_provoked_by<ProvokingVertex::last>),
      by("provoking-mode-ignored"_fault, Differ::colors)}},
    {rule::interp_linear, kLevel, {by("attributes-of-first-vertex"_fault, Differ::values)}},
    {rule::interp_perspective,
     "whose value would be another without perspective, without the division by 1/w, or with "
     "another w at one vertex",
     {by("smooth-as-noperspective"_fault, Differ::values),
      by("division-forgotten"_fault, Differ::values), by("w-doubled"_fault, Differ::values)}},
    {rule::interp_hull, "that must show an interpolated input", {at_all(has_interpolated)}},
    {rule::interp_flat,
     "whose flat value would be another if it were interpolated, or the other provoking vertex's",
     {by("flat-as-noperspective"_fault, Differ::values),
      by("provoking-flipped"_fault, Differ::values)}},
    {rule::fragcoord_xy, kOfValue, {at_all(has_value)}},
    {rule::fragcoord_w,
     "whose 1/w would be another if all vertices had the w of the draw's first",
     {by("w-of-first-vertex"_fault, Differ::values)}},
    {rule::store_unorm, "of a target of this kind", {at_all(is_stored_as<ComponentKind::unorm>)}},
    {rule::store_snorm, "of a target of this kind", {at_all(is_stored_as<ComponentKind::snorm>)}},
    {rule::store_srgb, "of a target of this kind", {at_all(is_stored_as<ComponentKind::srgb>)}},
    {rule::store_half, "of a target of this kind", {at_all(is_stored_as<ComponentKind::half>)}},
    {rule::store_float,
     "of a target of this kind",
     {at_all(is_stored_as<ComponentKind::binary32>)}},
    {rule::store_integer,
     "of a target of this kind",
     {at_all(is_stored_as<ComponentKind::uint, ComponentKind::sint>)}},
    {rule::blend_equation,
     "whose colour would be another without blending, with the factors exchanged, or blended twice",
     {by("blend-ignored"_fault, Differ::colors),
      by("blend-factors-exchanged"_fault, Differ::colors),
      by("blend-twice"_fault, Differ::colors)}},
    {rule::sample_alpha_to_coverage,
     "whose coverage would be another with an alpha of 0 for 1, or of 1 for 0, or if integers were "
     "an alpha of 0",
     {by("alpha-to-coverage-opposite"_fault)}},
    {rule::sample_alpha_to_one,
     "whose colour would be another with the alpha that the shader wrote",
     {by("alpha-to-one-ignored"_fault, Differ::colors)}},
    {rule::blend_second_source,
     "whose colour would be another if factors of the second source took the first one",
     {by("second-as-first"_fault, Differ::colors)}},
    {rule::logic_operation,
     "whose colour would be another without logical operations, or with the operands exchanged, or "
     "if floating-point or sRGB targets took them, too",
     {at_all(is_passed_by_logic), by("logic-ignored"_fault, Differ::colors),
      by("logic-operands-exchanged"_fault, Differ::colors)}},
    {rule::blend_write_mask,
     "whose colour would be another if all components were written",
     {by("write-mask-ignored"_fault, Differ::colors)}},
    {rule::color_location,
     "whose colour would be another with the state, the colour or the clear colour of the target "
     "at "
     "the next location",
     {by("targets-state-of-next"_fault, Differ::colors),
      by("targets-color-of-next"_fault, Differ::colors),
      by("targets-clear-of-next"_fault, Differ::colors)}},
    {rule::load_operation,
     "that would come out otherwise if what is to be loaded held something else, or if depth had "
     "the load operation of the stencil",
     {by("load-as-clear"_fault), by("load-color-as-clear"_fault, Differ::colors),
      by("load-depth-as-stencil"_fault)}},
    {rule::clear_attachments,
     "that would come out otherwise if nothing were cleared among the draws",
     {by("clear-ignored"_fault), by("clear-ignored"_fault, Differ::colors)}},
    {rule::write_consistent, "that a triangle must write", {at_all(is_written)}},
    {rule::write_outside, "that a triangle must write", {at_all(is_written)}},
    {rule::depth_linear, kLevel, {by("depth-of-first-vertex"_fault, Differ::values)}},
    {rule::repeat_same, kOfRelation, {at_all(is_repeated<RelationKind::same_twice>)}},
    {rule::repeat_scissor, kOfRelation, {at_all(is_repeated<RelationKind::scissor_tiles>)}},
    {rule::repeat_clears, kOfRelation, {at_all(is_repeated<RelationKind::other_clears>)}},
    {rule::repeat_write_masks, kOfRelation, {at_all(is_repeated<RelationKind::write_masks>)}},
    {rule::repeat_attachments,
     kOfRelation,
     {at_all(is_repeated<RelationKind::fewer_attributes>),
      at_all(is_repeated<RelationKind::more_attributes>)}},
    {rule::door_index, kOfRelation, {at_all(goes_through_door)}},
    {rule::door_restart, kOfRelation, {at_all(goes_through_door)}},
    {rule::door_first, kOfRelation, {at_all(goes_through_door)}},
    {rule::door_buffer, kOfRelation, {at_all(goes_through_door)}},
    {rule::door_layout, kOfRelation, {at_all(goes_through_door)}},
    {rule::door_instance, kOfRelation, {at_all(goes_through_door)}},
    {rule::door_indirect, kOfRelation, {at_all(goes_through_door)}},
    {rule::door_state, kOfRelation, {at_all(goes_through_door)}},
    {rule::door_recording, kOfRelation, {at_all(goes_through_door)}},
    {rule::door_target, kOfRelation, {at_all(goes_through_door)}},
    {rule::door_stage, kOfRelation, {at_all(goes_through_door)}},
    {rule::depth_store, "of a target with fixed-point depth", {at_all(is_depth_rounded)}},
    {rule::depth_bias,
     "whose depth, or depth test, would come out otherwise without the bias, with its sign turned "
     "or with 256 times as much of it",
     {by("bias-ignored"_fault, Differ::depths), by("bias-sign"_fault, Differ::depths),
      by("bias-enlarged"_fault, Differ::depths)}},
    {rule::depth_distinct,
     "where the depth test is decided by planes that are r apart",
     {at_all(is_compared)}},
    {rule::depth_written,
     "whose depth, or its test, would come out otherwise if the fragment shader wrote no depth, or "
     "that has the gl_FragCoord.z which it wrote",
     {at_all(has_coord_depth), by("frag-depth-ignored"_fault, Differ::depths),
      by("frag-depth-ignored"_fault)}},
    {rule::depth_bounds,
     "that would come out otherwise without the depth bounds test, or if the bounds did not belong "
     "to what lies in them",
     {by("bounds-ignored"_fault), by("bounds-exclusive"_fault)}},
    {rule::depth_clamp, "whose depth is clamped", {at_all(is_clamped)}},
    {rule::depth_compare,
     "where the depth test is decided by the numbers compared",
     {at_all(is_compared), by("depth-test-ignored"_fault)}},
    {rule::depth_repeat,
     "where the depth test is decided by a triangle being equal to itself",
     {at_all(is_compared)}},
    {rule::depth_write, "where a fragment's depth is not stored", {at_all(is_depth_kept)}},
    {rule::interp_at_offset,
     "whose value there is another than where its input is evaluated",
     {by("offset-ignored"_fault, Differ::values)}},
    {rule::interp_at_sample,
     "whose value there is another than where its input is evaluated, or in the pixel's corner",
     {by("at-sample-ignored"_fault, Differ::values),
      by("at-sample-in-corner"_fault, Differ::values)}},
    {rule::interp_at_centroid,
     "whose value there is another than where its input is evaluated, or in the pixel's corner",
     {by("at-centroid-ignored"_fault, Differ::values),
      by("at-centroid-in-corner"_fault, Differ::values)}},
    {rule::derivative_fine, kLevel, {by("attributes-of-first-vertex"_fault, Differ::values)}},
    {rule::derivative_coarse, kLevel, {by("attributes-of-first-vertex"_fault, Differ::values)}},
    {rule::derivative_plain, kLevel, {by("attributes-of-first-vertex"_fault, Differ::values)}},
    {rule::lod_query, kLevel, {by("attributes-of-first-vertex"_fault, Differ::values)}},
    {rule::stencil_count,
     "that may be hit, with a stencil that only counts the hits",
     {at_all(is_counted_by_stencil)}},
    {rule::stencil_compare,
     "that would come out otherwise if every fragment passed the stencil test, or if less were "
     "greater",
     {by("stencil-test-passes"_fault), by("stencil-compare-turned"_fault)}},
    {rule::stencil_operation,
     "that would come out otherwise if every operation kept the stencil, or if clamps wrapped and "
     "wraps clamped",
     {by("stencil-never-written"_fault), by("stencil-clamps-exchanged"_fault)}},
    {rule::stencil_mask,
     "that would come out otherwise without the masks",
     {by("stencil-masks-ignored"_fault)}},
    {rule::stencil_faces,
     "that would come out otherwise if front and back faces exchanged their stencil state",
     {by("stencil-faces-exchanged"_fault)}},
    {rule::stencil_depth_outcome,
     "that would come out otherwise if a fragment that fails the depth test did what one does that "
     "passes it, or that fails the stencil test",
     {by("stencil-before-depth"_fault), by("stencil-depth-fail-fails"_fault)}},
    {rule::query_occlusion,
     "that the query of a draw must count, or must not count though a triangle is there",
     {at_all(is_counted_by_query), by("queried-draws-unhidden"_fault)}},
    {rule::query_statistics,
     "that a triangle of a draw with such a query covers",
     {at_all(is_of_statistics)}},
    {rule::resolve_select,
     "of a pixel that is drawn to and resolved so",
     {at_all(is_resolved<Resolve::sample_zero, Resolve::min, Resolve::max>)}},
    {rule::resolve_average,
     "of a pixel that is drawn to and resolved so",
     {at_all(is_resolved<Resolve::average>)}},
    {rule::barycentric_value, kOfValue, {at_all(has_value)}},
    {rule::barycentric_order, "that must show barycentric coordinates", {at_all(has_barycentric)}},
    {rule::blit_nearest, "inside the region of a blit with this filter", {kInside}, is_nearest},
    {rule::blit_linear, "inside the region of a blit with this filter", {kInside}, is_linear},
    {rule::blit_outside, "outside the region of a blit", {kOutside}, is_any},
};

}  // namespace

const ExerciseRow* find_exercise(std::string_view rule) {
    const auto* row = std::ranges::find(kRows, rule, &ExerciseRow::rule);
    return row == std::end(kRows) ? nullptr : row;
}

}  // namespace ref
