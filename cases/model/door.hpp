// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Doors: other ways of the API by which the triangles of a case reach the rasterizer. A picture
// through a door must be that of the case as it stands.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/base/fields.hpp"

namespace cases {

struct Case;

// In the order of the table in door.cpp, which says what each of them does.
enum class Door : uint8_t {
    none,  // as a case is drawn without relations
    index_8,
    index_16,
    index_32,
    index_8_largest,
    index_16_largest,
    restart_extra,
    first_vertex,
    first_index,
    vertex_offset,
    vertex_offset_negative,
    bind_offset,
    index_offset,
    separate_buffers,
    memory_imported,
    stride_padded,
    stride_dynamic,
    interleaved,
    three_components,
    half_floats,
    exact_formats,
    instance_rate,
    instance_divisor,
    instance_divisor_zero,
    vertices_pulled,
    indirect,
    indirect_count,
    multi_indirect,
    indirect_after_count,
    multi_draw,
    multi_draw_empty,
    state_first,
    query_first,
    state_stale,
    state_static,
    state_after_static,
    state_output,
    state_rasterization,
    state_unused,
    unoptimized,
    pipeline_library,
    pipeline_derived,
    pipeline_cached,
    shader_objects,
    secondary,
    secondary_each,
    secondary_reused,
    pass_split,
    pass_suspended,
    clear_commands,
    clear_draw,
    render_pass,
    subpasses,
    input_attachment,
    submissions,
    target_larger,
    target_last_tile,
    image_layer,
    image_level,
    image_linear,
    image_usages,
    memory_dedicated,
    memory_aliased,
    multiview,
    multiview_all,
    geometry,
    geometry_strip,
    tessellation,
    transform_feedback,
    mesh_shader,
    stage_unused,
};
inline constexpr Door kLastDoor = Door::stage_unused;
inline constexpr size_t kDoors = static_cast<size_t>(kLastDoor) + 1;  // `none` among them
template <>
inline constexpr size_t kValueCount<Door> = kDoors;

enum class DoorGroup : uint8_t { vertices, state, recording, targets, stages };
std::string_view to_string(DoorGroup group);

// What equal bits follow from.
enum class DoorPromise : uint8_t {
    // The pipeline, the state and the vertices that reach it are those of the plain picture
    // (Invariance, Rule 4): other bits are a finding at `vulkan`.
    same_bits,
    // Another pipeline, or state that no rule of invariance names: at `vulkan` the picture has to
    // be right by the rules of every picture, and only from `practice` on it has to be the same, if
    // the plain picture is right itself.
    right_picture,
    // Another stage hands on the vertices of a triangle in an order that is its own: at every
    // profile the picture has to be right by the rules of `vulkan`, and other bits are no finding.
    right_alone,
};

struct DoorRow {
    Door door;
    std::string_view word;  // in files and on the command line
    DoorGroup group;
    DoorPromise promise;
    std::string_view rule;  // what a finding names
    std::string_view does;  // one sentence
    // Which cases can go through it.
    std::string_view takes = "every case that draws";
    bool (*can_take)(const Case&) = [](const Case&) { return true; };
};

// All doors but `none`, in the order of the enumeration.
std::span<const DoorRow> all_doors();
const DoorRow& row_of(Door door);
std::optional<Door> find_door(std::string_view word);
std::vector<std::string> door_words();  // of all doors, in their order

// Whether the case can go through the door; a case without draws goes through none.
bool can_take(Door door, const Case& c);

// Vertices that some doors put before those of a draw. gl_VertexIndex is as much larger there.
inline constexpr uint32_t kMovedVertices = 5;
uint32_t vertex_shift(Door door);

// Some doors draw a list of several triangles as two draws: how many triangles the first one has,
// after which gl_PrimitiveID may begin again; 0 if the door does not split the draw.
uint32_t split_of(Door door, const struct Draw& draw);

// How many pixels to the right and down the door target_last_tile draws a case: even numbers, so
// that quads and chequers lie as they do at the origin, and no multiples of a tile's size, so that
// tiles end elsewhere in the case.
inline constexpr uint32_t kMovedColumns = 296, kMovedRows = 200;

// Whether there are positions and binary16 holds every one of their numbers exactly.
bool are_half_floats(std::span<const glm::vec4> positions);

// The largest index of a draw's vertices, written out or counted; 0 without vertices.
uint32_t largest_index(const struct Draw& draw);

}  // namespace cases
