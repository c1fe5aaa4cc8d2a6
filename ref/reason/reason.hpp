// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Why anything is decided as it is. What decides the coverage of a sample, the depth test of a
// fragment or one of its values names its reason; one table (reason.cpp) says of each reason which
// rule it is and how it is told.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "cases/model/profile.hpp"

namespace ref {

// In the order in which several reasons for one answer are told. `which` of a Reason is what stands
// behind the name, if anything.
enum class ReasonKind : uint8_t {
    // A triangle must cover the sample.
    top_left_in,           // it lies on an edge that owns it; the edge's label
    passes_cull_distance,  // it lies inside, and no cull distance is negative at all vertices
    passes_clip_distance,  // it lies inside, and no clip distance is negative
    kept_by_alpha,         // the same, and alpha to coverage keeps all samples of the fragment
    inside,                // it lies inside wherever the vertices may lie
    touches_pixel,    // of a conservative draw: it has an area in common with the sample's pixel
    extra_reached,    // the extra size of the draw makes it do so
    fills_pixel,      // it holds the whole pixel
    degenerate_kept,  // it has no area once it is snapped, and meets the pixel
    cleared,          // of a clear: the rectangle holds the pixel
    // A triangle must not cover the sample.
    other_layer,         // the draw goes to another layer
    masked,              // a sample mask of the draw leaves the sample out
    no_alpha,            // alpha to coverage leaves nothing of the fragment
    beside_clear,        // of a clear: it lies outside the rectangle
    scissor,             // it lies outside the scissor rectangle or the target
    viewport,            // it lies outside the viewport
    discarded,           // the draw has rasterizer discard
    fragment_discarded,  // the fragment shader discards the fragment
    value_discarded,     // the same, since an attribute is negative
    discarded_late,      // it does, and depth and stencil have been tested and stored before
    outside,             // it lies outside an edge, wherever its ends may lie; the edge, 0 to 2
    outside_hull,        // it lies outside all that the positions of the vertices span
    no_area,             // it lies on a triangle that has no area once it is snapped
    top_left_out,        // it lies on an edge that does not own it; the edge's label
    culled,              // the triangle's face is culled
    cull_distance,       // a cull distance is negative at all vertices; its number
    clip_distance,       // a clip distance cuts it off; its number
    clip_plane,          // a plane of the view volume cuts it off; a ClipPlane
    beyond_size,         // of a conservative draw: enlarged, it does not reach the pixel
    unfilled_pixel,      // it does not hold the whole pixel
    degenerate_culled,   // it has no area once it is snapped, and the device culls what has none
    // A triangle may cover the sample.
    undefined,        // a vertex is beyond what the profile promises anything of
    unbounded,        // a vertex of the clipped polygon may be anywhere
    flushed,          // a denormal z may be taken for 0
    near_zero,        // the shader discards by a value that is 0 within its error
    near_distance,    // a clip distance is 0 within its error; its number
    near_plane,       // its depth is at a depth plane within its error; a ClipPlane
    open_facing,      // the triangle is culled or not, as its vertices snap
    open_alpha,       // alpha to coverage may leave the sample out
    viewport_border,  // it lies within a pixel of a viewport's fractional border
    on_edge,          // it lies on an edge, and no rule of the profile decides; the edge's label
    may_reach,        // of a conservative draw: enlarged, it may reach the pixel
    may_fill,         // it may hold the whole pixel
    between_pieces,   // an edge between pieces of the clipped triangle may touch the pixel
    vertex_boxes,  // it is inside for some positions of the vertices; an edge's label or kNothing
    // A triangle may cover the sample, but those of a set share a number of hits.
    complement,     // of clip distances and their negatives
    clipped_edge,   // along shared edges that are clipped
    shared_vertex,  // at a vertex that all of them have
    shared_edge,    // along shared edges
    // What a wrong number of hits contradicts, where no reason of one triangle does.
    nearest_positions,  // no triangle owns a tie, and none covers the sample once it is snapped
    snapped_owner,      // which of several triangles covers the sample
    none_near,          // no triangle is near the sample
    none_may,           // none of those near it may cover it
    once_alone,         // one triangle may cover it, and once
    once_each,          // each of several may, and once
    once_pieces,        // the same, pieces of clipped triangles of a conservative draw among them
    area_sign,          // which face shows
    // What else a finding says of the fragments of a sample, whatever a single one of them is.
    writer_not_last,     // another triangle than the last wrote it
    writer_other_first,  // the right triangle wrote it by another vertex than the provoking one,
    writer_other_last,   // which is the first, or the last
    writer_none_first,   // no triangle of the draw has the provoking vertex that wrote it,
    writer_none_last,    // by a draw whose provoking vertex is the first, or the last
    depth_unwritten,     // its depth is none of those that were written before
    depth_of_discarded,  // the same, where fragments are discarded once theirs is stored
    depth_of_cleared,    // the same, where a clear among the draws may have stored it
    depth_of_bounded,    // the same, where fragments are tested by depth bounds
    depth_of_taken,      // its depth is that of a fragment that leaves no trace
    depth_of_none,       // its depth is none of the fragments' that its colour allows
    color_order,         // its colour is that of another order of blending
    color_none,          // its colour is that of no allowed fragments
    planes_contradict,   // its planes were not written by the same fragments
    // A fragment passes the depth test, or fails it, or may do either.
    depth_ranges,  // by the numbers that its depth and the stored one may be
    depth_same,    // the same triangle was drawn before by a state that makes the same depths
    depth_apart,   // the same triangle was drawn before, biased apart
    bounds_test,   // a fragment lies in its depth bounds or not, by what is stored
    // A fragment fails the stencil test, or passes it, or may do either; and what the stencil of a
    // sample would be otherwise.
    stencil_test,      // by its reference, its mask and the stencil
    stencil_compared,  // if the test came out otherwise
    stencil_operated,  // if an operation did something else
    stencil_masked,    // without the masks
    stencil_faced,     // with the state of the other face
    stencil_by_depth,  // if the depth test chose another operation
    stencil_bounded,   // without the depth bounds test
    // A fragment must not have a value.
    value_set_up,         // no basis explains the fragment
    value_hull,           // the value is outside all that interpolation can make
    value_flat,           // it is none of the vertices' numbers
    value_of_not_first,   // it is that of another vertex than the first, the provoking one
    value_of_not_last,    // it is that of another vertex than the last, the provoking one
    value_other_weight,   // it is the barycentric of another vertex
    value_exact,          // it is none of a few exact numbers
    value_coord_depth,    // it is not the gl_FragCoord.z that the shader wrote
    value_not_discarded,  // the shader ought to have discarded the fragment for it
    value_clamped_depth,  // the depth ought to have been clamped
    value_biased_depth,   // the depth ought to have been biased
    value_stored_depth    // a fixed-point format does not make that of it
};
inline constexpr ReasonKind kLastReason = ReasonKind::value_stored_depth;

inline constexpr uint8_t kNothing = 0xff;

struct Reason {
    ReasonKind kind = ReasonKind::outside_hull;
    uint8_t which = kNothing;
    friend auto operator<=>(const Reason&, const Reason&) = default;
};

// Each once, in the order of telling. Of a sample that must not be covered each one alone is
// enough, of one that may be covered each one alone leaves it open, and one that must be covered
// has one.
using Reasons = std::vector<Reason>;

inline void add_reason(Reasons& reasons, Reason reason) {
    for (const Reason& r : reasons) {
        if (r == reason) {
            return;
        }
    }
    reasons.push_back(reason);
}

// The rule that a device breaks which decides otherwise. At profile direct3d: of a device that
// looser profiles allow to do so. Empty where each quantity has a rule of its own.
std::string_view rule_of(ReasonKind kind, cases::Profile level);

// One sentence, in which names in braces stand for what reason_text.cpp puts there.
std::string_view text_of(ReasonKind kind);

// The sentence where the reason keeps every draw from the sample: of other_layer, scissor and
// viewport.
std::string_view text_of_all(ReasonKind kind);

}  // namespace ref
