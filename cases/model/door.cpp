// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/model/door.hpp"

#include <algorithm>
#include <array>

#include "cases/base/float_bits.hpp"
#include "cases/model/case.hpp"
#include "cases/model/door_condition.hpp"
#include "cases/model/rule_ids.hpp"

namespace cases {

namespace {

namespace when = door_condition;

constexpr uint32_t kLargest8 = 0xff, kLargest16 = 0xffff;

template <uint32_t largest>
bool has_indices(const Case& c) {
    return when::has_indices_up_to(c, largest);
}
template <uint32_t largest>
bool can_use(const Case& c) {
    return when::can_use_largest(c, largest);
}

constexpr DoorGroup kVertices = DoorGroup::vertices;
constexpr DoorGroup kState = DoorGroup::state, kRecording = DoorGroup::recording;
constexpr DoorGroup kTargets = DoorGroup::targets, kStages = DoorGroup::stages;
constexpr DoorPromise kSame = DoorPromise::same_bits, kRight = DoorPromise::right_picture;
constexpr DoorPromise kAlone = DoorPromise::right_alone;

constexpr std::array<DoorRow, kDoors - 1> kRows = {{
    {Door::index_8, "index-8", kVertices, kSame, rule::door_index,
     "Vertices are named by indices of 8 bits; a draw without indices gets 0, 1, 2, ...",
     "indices up to 255, 254 with restart", has_indices<kLargest8>},
    {Door::index_16, "index-16", kVertices, kSame, rule::door_index,
     "Vertices are named by indices of 16 bits; a draw without indices gets 0, 1, 2, ...",
     "indices up to 65535, 65534 with restart", has_indices<kLargest16>},
    {Door::index_32, "index-32", kVertices, kSame, rule::door_index,
     "Vertices are named by indices of 32 bits, in draws without indices, too."},
    {Door::index_8_largest, "index-8-largest", kVertices, kSame, rule::door_restart,
     "Restart is off, and the largest index in use is 255, which is then a vertex like any other; "
     "a negative vertexOffset leads back to the vertices.",
     "indices up to 255, no draw with restart", can_use<kLargest8>},
    {Door::index_16_largest, "index-16-largest", kVertices, kSame, rule::door_restart,
     "The same with indices of 16 bits, of which the largest is 65535.",
     "indices up to 65535, no draw with restart", can_use<kLargest16>},
    {Door::restart_extra, "restart-extra", kVertices, kRight, rule::door_restart,
     "Strips and fans are drawn with restart: twice before their first index and once behind their "
     "last one. Indices have 32 bits, and the largest in use is 65535, a vertex like any other.",
     "a strip or a fan", when::has_strip_or_fan},
    {Door::first_vertex, "first-vertex", kVertices, kSame, rule::door_first,
     "Draws begin at firstVertex 5, behind vertices that must not be read.", "no draw with indices",
     when::has_no_indices},
    {Door::first_index, "first-index", kVertices, kSame, rule::door_first,
     "Draws begin at firstIndex 7, behind indices of other vertices."},
    {Door::vertex_offset, "vertex-offset", kVertices, kSame, rule::door_first,
     "vertexOffset is 5, and five vertices that must not be read lie before the others."},
    {Door::vertex_offset_negative, "vertex-offset-negative", kVertices, kSame, rule::door_first,
     "Indices are larger by 9, and vertexOffset is -9."},
    {Door::bind_offset, "bind-offset", kVertices, kSame, rule::door_buffer,
     "Vertex buffers are bound at offsets that are multiples of 4 and of nothing larger, each "
     "binding at another."},
    {Door::index_offset, "index-offset", kVertices, kSame, rule::door_buffer,
     "The index buffer is bound in the middle of other indices, on a multiple of 4 bytes."},
    {Door::separate_buffers, "separate-buffers", kVertices, kSame, rule::door_buffer,
     "Each binding, and the indices, have a buffer and memory of their own."},
    {Door::memory_imported, "memory-imported", kVertices, kSame, rule::door_buffer,
     "Each binding, and the indices, have a buffer of their own, in memory that the application "
     "has allocated itself and the device imports."},
    {Door::stride_padded, "stride-padded", kVertices, kRight, rule::door_layout,
     "Vertices lie further apart than they are long: 12 bytes between them, another number for "
     "each binding."},
    {Door::stride_dynamic, "stride-dynamic", kVertices, kRight, rule::door_layout,
     "The strides are dynamic state, given with the buffers, and those of the pipeline are "
     "others."},
    {Door::interleaved, "interleaved", kVertices, kRight, rule::door_layout,
     "All that a vertex has lies together, in one binding.", "no draw of instances",
     when::has_no_instances},
    {Door::three_components, "three-components", kVertices, kRight, rule::door_layout,
     "Positions whose w is 1 are read as three numbers; the fourth is 1 by the format.",
     "a draw whose positions all have w = 1", when::has_w_one},
    {Door::half_floats, "half-floats", kVertices, kRight, rule::door_layout,
     "Positions that binary16 holds are read as four numbers of it.",
     "a draw whose positions are all numbers of binary16", when::has_half_positions},
    {Door::exact_formats, "exact-formats", kVertices, kRight, rule::door_layout,
     "Inputs are read in other formats that hold their numbers: normalized ones of 0, 1 and -1, "
     "scaled ones of whole numbers, binary16, and fewer components where the others are 0 and 1.",
     "a draw with an input whose numbers another format of vertices holds",
     when::has_exact_formats},
    {Door::instance_rate, "instance-rate", kVertices, kRight, rule::door_instance,
     "What is the same at every vertex is read once an instance, and the only instance is number "
     "2: firstInstance is 2.",
     "a draw with an attribute or distances that are the same at every vertex, no draw of "
     "instances",
     when::has_constant_input},
    {Door::instance_divisor, "divisor", kVertices, kRight, rule::door_instance,
     "What is the same at every vertex is read once for three instances: eight are drawn, of which "
     "only the last has its triangles within the view volume; it reads element 2.",
     "a draw with an attribute or distances that are the same at every vertex, no draw of "
     "instances or with both clip and cull distances",
     when::has_divided_input},
    {Door::instance_divisor_zero, "divisor-zero", kVertices, kRight, rule::door_instance,
     "As divisor, with a divisor of 0: all instances read the first element.",
     "a draw with an attribute or distances that are the same at every vertex, no draw of "
     "instances or with both clip and cull distances",
     when::has_divided_input},
    {Door::vertices_pulled, "vertices-pulled", kVertices, kRight, rule::door_layout,
     "The pipeline has no inputs: the vertex shader reads its vertex from a storage buffer, by "
     "gl_VertexIndex.",
     "no draw of instances or with both clip and cull distances", when::can_be_pulled},
    {Door::indirect, "indirect", kVertices, kSame, rule::door_indirect,
     "Draws are indirect: their parameters are read from a buffer, from firstVertex or "
     "vertexOffset 5 on, behind a draw that is not asked for."},
    {Door::indirect_count, "indirect-count", kVertices, kSame, rule::door_indirect,
     "The number of indirect draws is read from a buffer, too: one, of three that are allowed; "
     "indices are bound at an offset."},
    {Door::multi_indirect, "multi-indirect", kVertices, kSame, rule::door_indirect,
     "One command has three indirect draws, 32 bytes apart, from firstVertex or vertexOffset 5 on: "
     "the first half of a list's triangles, none, the second half. Several instances stay one "
     "draw."},
    {Door::indirect_after_count, "indirect-after-count", kVertices, kSame, rule::door_indirect,
     "The same, directly after a command that reads the number of its draws from a buffer, which "
     "is "
     "0."},
    {Door::multi_draw, "multi-draw", kVertices, kSame, rule::door_indirect,
     "One command has three draws from memory of the application, from firstVertex or vertexOffset "
     "5 "
     "on: the first half of a list's triangles, none, the second half."},
    {Door::multi_draw_empty, "multi-draw-empty", kVertices, kSame, rule::door_indirect,
     "The same, with a draw of no vertices first, then the whole, then another of none."},
    {Door::state_first, "state-first", kState, kSame, rule::door_state,
     "Dynamic state is set and buffers are bound before the pipeline is."},
    {Door::query_first, "query-first", kState, kSame, rule::door_state,
     "Queries begin before the first pipeline of the command buffer is bound.",
     "a draw with an occlusion query", when::has_occlusion_query},
    {Door::state_stale, "state-stale", kState, kSame, rule::door_state,
     "All dynamic state is first set to other values, under which the draw is recorded with "
     "rasterization off, and then to those of the draw."},
    {Door::state_static, "state-static", kState, kRight, rule::door_state,
     "What is dynamic in other pictures is a part of the pipeline.",
     "no list with restart, no bias whose unit is chosen, no discarded draw to several samples",
     when::can_be_all_static},
    {Door::state_after_static, "state-after-static", kState, kSame, rule::door_state,
     "Before each draw a pipeline is bound in which all state is static and another, and the draw "
     "is recorded with it under empty scissors; then come the usual pipeline and its dynamic "
     "state.",
     "no list with restart, no bias whose unit is chosen", when::can_be_static},
    {Door::state_output, "state-output", kState, kRight, rule::door_state,
     "What becomes of a fragment's outputs is dynamic: blending and its equations, write masks, "
     "logical operations, the sample mask, alpha to coverage and to one; by its pipeline nothing "
     "is written."},
    {Door::state_rasterization, "state-rasterization", kState, kRight, rule::door_state,
     "How triangles are rasterized is dynamic: the number of samples and their mask, the polygon "
     "mode, clamping and clipping of depth, the provoking vertex; the pipeline has an empty mask, "
     "clips depth and takes the first vertex."},
    {Door::state_unused, "state-unused", kState, kRight, rule::door_state,
     "State is on that changes nothing: a bias of 0, restart without an index that restarts, tests "
     "that fail and have no attachment to test, blending by ONE and ZERO, logical operations that "
     "copy."},
    {Door::unoptimized, "unoptimized", kState, kRight, rule::door_state,
     "Pipelines are made with VK_PIPELINE_CREATE_DISABLE_OPTIMIZATION_BIT."},
    {Door::pipeline_library, "pipeline-library", kState, kRight, rule::door_state,
     "Pipelines are linked from four libraries: vertex input, the stages before rasterization, the "
     "fragment shader, its outputs."},
    {Door::pipeline_derived, "pipeline-derived", kState, kRight, rule::door_state,
     "Pipelines are derivatives of another one, which writes nothing."},
    {Door::pipeline_cached, "pipeline-cached", kState, kRight, rule::door_state,
     "Pipelines are made a second time, with a cache that was made of the data of a first one."},
    {Door::shader_objects, "shader-objects", kState, kRight, rule::door_state,
     "There are no pipelines: shaders are objects of their own, and all state is dynamic.",
     "no draw that asks for a part of its samples to be shaded", when::has_no_sample_fraction},
    {Door::secondary, "secondary", kRecording, kSame, rule::door_recording,
     "All draws are recorded in a secondary command buffer."},
    {Door::secondary_each, "secondary-each", kRecording, kSame, rule::door_recording,
     "Each draw is recorded in a secondary command buffer of its own; one command executes them.",
     "several draws", when::has_several_draws},
    {Door::secondary_reused, "secondary-reused", kRecording, kSame, rule::door_recording,
     "As secondary, for simultaneous use, and it is executed twice: the second rendering clears "
     "what "
     "the first one has drawn."},
    {Door::pass_split, "pass-split", kRecording, kRight, rule::door_recording,
     "The rendering ends after the clears and after each draw, and the next one loads what was "
     "stored."},
    {Door::pass_suspended, "pass-suspended", kRecording, kRight, rule::door_recording,
     "The rendering is suspended after the clears and after each draw, and resumed."},
    {Door::clear_commands, "clear-commands", kRecording, kRight, rule::door_recording,
     "Nothing is loaded or cleared when the rendering begins; vkCmdClearAttachments clears."},
    {Door::clear_draw, "clear-draw", kRecording, kRight, rule::door_recording,
     "Nothing is loaded or cleared; a triangle over the whole target writes the values to one "
     "attachment after the other.",
     "one layer, and clear values that are neither rounded nor denormal: 0 and 1 of a normalized "
     "format",
     when::can_be_cleared_by_draw},
    {Door::render_pass, "render-pass", kRecording, kRight, rule::door_recording,
     "The rendering is an instance of a render pass object with one subpass."},
    {Door::subpasses, "subpasses", kRecording, kRight, rule::door_recording,
     "As render-pass, with two subpasses: the first clears and has the first of several draws, the "
     "second one the others."},
    {Door::input_attachment, "input-attachment", kRecording, kRight, rule::door_recording,
     "A second subpass reads what the first has drawn as input attachments, and the picture is "
     "what "
     "it has read: instruments, depth but D24, stencil and colours but sRGB and binary16.",
     "one layer, no bias, no number that is infinite, none, or nearer to 0 than 2^-30 and not 0",
     when::can_be_read_as_input},
    {Door::submissions, "submissions", kRecording, kRight, rule::door_recording,
     "As pass-split, and each part is a command buffer and a submission of its own."},
    {Door::target_larger, "target-larger", kTargets, kRight, rule::door_target,
     "Attachments have 29 columns and 19 rows more than the rendering's area."},
    {Door::target_last_tile, "target-last-tile", kTargets, kAlone, rule::door_target,
     "The case lies in the last tile of a larger target: viewport, scissor and the rendering's "
     "area "
     "are 296 columns and 200 rows further, and the attachments end with it.",
     "vertices in the view volume with w = 1 whose window coordinates binary32 holds here and "
     "there, no clip distances",
     when::can_be_moved},
    {Door::image_layer, "image-layer", kTargets, kRight, rule::door_target,
     "Attachments are the last layers of images with two layers more; what they are resolved into "
     "is the layer before the last one."},
    {Door::image_level, "image-level", kTargets, kRight, rule::door_target,
     "Attachments are level 1 of images with more mip levels; of several samples, what they are "
     "resolved into.",
     "one sample a pixel, or a resolve", when::has_levels},
    {Door::image_linear, "image-linear", kTargets, kRight, rule::door_target,
     "Attachments are images of linear tiling, where the device has them for their formats.",
     "one sample a pixel and one layer", when::is_plain_image},
    {Door::image_usages, "image-usages", kTargets, kRight, rule::door_target,
     "Attachments may be used in every way that the device offers for their formats: sampled, "
     "stored to, copied to, as input attachments, seen in other formats."},
    {Door::memory_dedicated, "memory-dedicated", kTargets, kRight, rule::door_target,
     "Each attachment has an allocation that is dedicated to it."},
    {Door::memory_aliased, "memory-aliased", kTargets, kRight, rule::door_target,
     "The memory of each attachment is that of another image, too, where the device has memory for "
     "both; that image is cleared to another colour just before."},
    {Door::multiview, "multiview", kTargets, kRight, rule::door_target,
     "The second view of two is drawn, alone, to the second layer.", "a target of one layer",
     when::has_one_layer},
    {Door::multiview_all, "multiview-all", kTargets, kRight, rule::door_target,
     "The first and the third view of three are drawn together, each to its layer; the third is "
     "looked at, and the second layer is left alone.",
     "a target of one layer, no queries", when::can_be_views},
    {Door::geometry, "geometry", kStages, kAlone, rule::door_stage,
     "A geometry shader hands on each triangle as it is.",
     "no draw with both clip and cull distances, no barycentrics", when::can_take_geometry},
    {Door::geometry_strip, "geometry-strip", kStages, kAlone, rule::door_stage,
     "A geometry shader hands on each triangle as the second one of a strip, of which the first "
     "has "
     "no area.",
     "no draw with both clip and cull distances, no barycentrics, conservative rasterization and "
     "statistics",
     when::can_be_strips},
    {Door::tessellation, "tessellation", kStages, kAlone, rule::door_stage,
     "Each triangle is a patch, which is tessellated into itself.",
     "lists without restart, without distances, layers, viewport indices and barycentrics",
     when::can_be_tessellated},
    {Door::transform_feedback, "transform-feedback", kStages, kRight, rule::door_layout,
     "Vertices are written to a buffer by transform feedback, in a rendering without attachments, "
     "and "
     "drawn from there.",
     "lists without indices, distances and instances, the corners of each triangle in three "
     "places",
     when::are_plain_lists},
    {Door::mesh_shader, "mesh-shader", kStages, kAlone, rule::door_stage,
     "A mesh shader makes the triangles, one a group, of vertices in a storage buffer; those of "
     "strips and fans begin or end with the vertex that provokes.",
     "no draw of instances or with both clip and cull distances, no barycentrics, up to 65535 "
     "triangles",
     when::can_be_meshes},
    {Door::stage_unused, "stage-unused", kStages, kRight, rule::door_state,
     "Shaders have outputs that nobody reads, one of the vertex shader and, where the device has a "
     "location without an attachment, one of the fragment shader; an input is described that no "
     "shader has, and a descriptor set."},
}};

constexpr bool is_in_order() {
    for (size_t k = 0; k < kRows.size(); ++k) {
        if (static_cast<size_t>(kRows[k].door) != k + 1) {
            return false;
        }
    }
    return true;
}
static_assert(is_in_order());

}  // namespace

std::string_view to_string(DoorGroup group) {
    constexpr std::array<std::string_view, 5> kNames = {"feeding vertices", "state", "recording",
                                                        "targets", "stages"};
    return kNames.at(static_cast<size_t>(group));
}

std::span<const DoorRow> all_doors() {
    return kRows;
}

const DoorRow& row_of(Door door) {
    return kRows.at(static_cast<size_t>(door) - 1);
}

std::optional<Door> find_door(std::string_view word) {
    for (const DoorRow& row : kRows) {
        if (row.word == word) {
            return row.door;
        }
    }
    return std::nullopt;
}

std::vector<std::string> door_words() {
    std::vector<std::string> words;
    for (const DoorRow& row : kRows) {
        words.emplace_back(row.word);
    }
    return words;
}

bool can_take(Door door, const Case& c) {
    // Those that render otherwise have load and store operations of their own.
    const DoorGroup group = row_of(door).group;
    if (c.target.has_unknown_contents() ||
        (c.target.has_operations() &&
         (group == DoorGroup::recording || group == DoorGroup::targets))) {
        return false;
    }
    return !c.blit && c.target.frame == Frame::copied &&
           std::ranges::any_of(c.draws, [](const Draw& draw) { return !draw.positions.empty(); }) &&
           std::ranges::none_of(c.draws,
                                [](const Draw& draw) {
                                    return draw.matrix ||
                                           draw.color.from != ColorFrom::push_constant;
                                }) &&
           row_of(door).can_take(c);
}

uint32_t vertex_shift(Door door) {
    switch (door) {
        case Door::first_vertex:
        case Door::vertex_offset:
        case Door::indirect:
        case Door::indirect_count:
        case Door::multi_indirect:
        case Door::indirect_after_count:
        case Door::multi_draw:
        case Door::multi_draw_empty:
            return kMovedVertices;
        default:
            return 0;
    }
}

uint32_t split_of(Door door, const Draw& draw) {
    if ((door != Door::multi_indirect && door != Door::indirect_after_count &&
         door != Door::multi_draw) ||
        draw.topology != Topology::triangle_list || draw.primitive_restart || draw.instances > 1) {
        return 0;
    }
    return static_cast<uint32_t>(draw.element_count() / 3 / 2);
}

bool are_half_floats(std::span<const glm::vec4> positions) {
    return !positions.empty() && std::ranges::all_of(positions, [](const glm::vec4& p) {
        return half_bits(p.x) && half_bits(p.y) && half_bits(p.z) && half_bits(p.w);
    });
}

uint32_t largest_index(const Draw& draw) {
    if (!draw.indices) {
        return draw.positions.empty() ? 0 : static_cast<uint32_t>(draw.vertex_count() - 1);
    }
    uint32_t largest = 0;
    for (const uint32_t index : *draw.indices) {
        if (!draw.primitive_restart || index != kRestartIndex) {
            largest = std::max(largest, index);
        }
    }
    return largest;
}

}  // namespace cases
