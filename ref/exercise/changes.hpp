// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A case as a device sees it that is wrong about a rule: the changes that the table tells a right
// device from a wrong one by. Each says whether it changed anything, and keeps the triangles and
// their numbers, so that the two cases can be compared one by one.
#pragma once

#include <cstdint>

#include "cases/model/case.hpp"

namespace ref {

// What triangles may cover.
bool open_scissors(cases::Case& c);
bool write_all_samples(cases::Case& c);
bool reverse_masks(cases::Case& c);
bool drop_clip_distances(cases::Case& c);
bool put_zero_distances_outside(cases::Case& c);
bool drop_cull_distances(cases::Case& c);
bool cull_nothing(cases::Case& c);
bool cull_other_faces(cases::Case& c);
bool cover_by_samples(cases::Case& c);  // nothing is conservative
bool turn_faces(cases::Case& c);
bool draw_what_is_discarded(cases::Case& c);
bool draw_to_first_layer(cases::Case& c);
bool draw_to_last_layer(cases::Case& c);
bool move_samples_to_centre(cases::Case& c);
bool move_samples_to_first(cases::Case& c);

// Fragments that their shader discards.
bool discard_nothing(cases::Case& c);
bool discard_no_value(cases::Case& c);
bool test_late(cases::Case& c);

// Whatever a query must not count: draws that have one lose their tests, discards, masks and
// culling.
bool show_all_to_queries(cases::Case& c);

// Depth.
bool toggle_depth_clip(cases::Case& c);
bool toggle_volume(cases::Case& c);
bool compare_always(cases::Case& c);
bool drop_bias(cases::Case& c);
bool write_no_depth(cases::Case& c);  // fragment shaders write no depth
bool drop_bounds(cases::Case& c);     // there is no depth bounds test
bool narrow_bounds(cases::Case& c);   // depth bounds do not belong to what lies in them
bool turn_bias(cases::Case& c);       // it has the other sign
// The bias is 256 times as large, as if its steps were those of a depth with eight bits less.
bool enlarge_bias(cases::Case& c);
// Every depth is that of the draw's first vertex.
bool level_depths(cases::Case& c);

// Stencil.
bool pass_every_stencil(cases::Case& c);
// What is compared changes sides: less is greater.
bool turn_stencil_compare(cases::Case& c);
bool keep_stencils(cases::Case& c);
// What clamps wraps, and what wraps clamps.
bool exchange_stencil_clamps(cases::Case& c);
bool ignore_stencil_masks(cases::Case& c);
bool exchange_stencil_faces(cases::Case& c);
// A fragment that fails the depth test does to the stencil what one does that passes it, or that
// fails the stencil test.
bool take_depth_fail_as_pass(cases::Case& c);
bool take_depth_fail_as_fail(cases::Case& c);

// Values.
bool take_centroids_at_centre(cases::Case& c);
bool take_centroids_at_samples(cases::Case& c);
bool ignore_perspective(cases::Case& c);
// f/w is interpolated, and not divided by the interpolated 1/w.
bool forget_division(cases::Case& c);
// Every third vertex has twice its w at the same place of the framebuffer.
bool take_other_w(cases::Case& c);
// Every vertex has the w of the draw's first, at its place of the framebuffer.
bool level_w(cases::Case& c);
// Flat values are interpolated, or those of the other provoking vertex.
bool interpolate_flats(cases::Case& c);
bool take_other_vertex(cases::Case& c);
// Every attribute has the value of the draw's first vertex.
bool level_attributes(cases::Case& c);

bool drop_probes(cases::Case& c, cases::Probe probe);
// The input is looked at in the pixel's upper left corner.
bool probe_at_corner(cases::Case& c, cases::Probe probe);
template <cases::Probe probe>
bool drop_probe(cases::Case& c) {
    return drop_probes(c, probe);
}
template <cases::Probe probe>
bool move_probe_to_corner(cases::Case& c) {
    return probe_at_corner(c, probe);
}

bool turn_provoking(cases::Case& c, cases::ProvokingVertex convention);
template <cases::ProvokingVertex convention>
bool turn_provoking(cases::Case& c) {
    return turn_provoking(c, convention);
}

// Colours.
bool blend_nothing(cases::Case& c);
bool exchange_factors(cases::Case& c);
// Constant alphas that take samples away are at their other end, 0 for 1; integers take all away.
bool exchange_alpha(cases::Case& c);
// Nothing is alpha to one.
bool keep_alpha(cases::Case& c);
// Factors of the second source take the first one.
bool take_first_for_second(cases::Case& c);
// Logical operations are left out; with their operands exchanged.
bool operate_nothing(cases::Case& c);
bool exchange_operands(cases::Case& c);
// Each draw that blends is drawn once more; the triangles get other numbers.
bool blend_twice(cases::Case& c);
bool write_all_components(cases::Case& c);
// Something of the colour target at the next location, or at the first one behind the last.
bool take_state_of_next(cases::Case& c);
bool take_color_of_next(cases::Case& c);
bool clear_as_next(cases::Case& c);

}  // namespace ref
