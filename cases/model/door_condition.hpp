// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which cases can go through which doors: what the table of doors (door.cpp) asks of a case.
#pragma once

#include <cstdint>

namespace cases {

struct Case;

namespace door_condition {

bool has_strip_or_fan(const Case& c);
bool has_no_indices(const Case& c);
bool has_w_one(const Case& c);
bool has_half_positions(const Case& c);
bool has_levels(const Case& c);
bool has_one_layer(const Case& c);
bool can_be_views(const Case& c);
bool can_be_cleared_by_draw(const Case& c);
bool can_take_geometry(const Case& c);
bool can_be_strips(const Case& c);
bool can_be_tessellated(const Case& c);
bool has_constant_input(const Case& c);  // and no instances
bool has_exact_formats(const Case& c);
bool has_several_draws(const Case& c);

// With restart the largest value of a type is no index.
bool has_indices_up_to(const Case& c, uint32_t largest);
bool can_use_largest(const Case& c, uint32_t largest);

// Linear images of several samples or layers are offered by hardly any device ("Required Format
// Support" demands neither).
bool is_plain_image(const Case& c);

// All that a vertex has lies together where nothing is read once an instance.
bool has_no_instances(const Case& c);

// The shader that reads vertices from a storage buffer is built with distances of one kind, and
// reads nothing by gl_InstanceIndex.
bool can_be_pulled(const Case& c);
bool has_one_kind_of_distances(const Case& c);

// No dynamic state says how many samples are shaded at least.
bool has_no_sample_fraction(const Case& c);

// What is written of them has the order of the draw, so that its vertices keep their numbers.
bool are_plain_lists(const Case& c);

// The shader that draws one instance of several is built with distances of one kind.
bool has_divided_input(const Case& c);

// Without a bias, whose unit is denormal where a triangle's depths are 0 in binary32.
bool can_be_read_as_input(const Case& c);

// Blocks of pixels stay blocks.
bool can_be_moved(const Case& c);

// Of a mesh shader each triangle is a group, of which a device has 65535 at least in a row
// (maxMeshWorkGroupCount).
bool can_be_meshes(const Case& c);

// Statistics are not asked through doors.
bool has_occlusion_query(const Case& c);

// What a pipeline may say of a draw without features that nothing else needs: of the unit of a bias
// it needs an extension, of restarts in a list another one.
bool can_be_static(const Case& c);

// A pipeline that discards says nothing of samples, and a target of several demands that it does.
bool can_be_all_static(const Case& c);

}  // namespace door_condition
}  // namespace cases
