// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/model/door.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>

#include "cases/base/float_bits.hpp"
#include "cases/format/color_format.hpp"
#include "cases/format/vertex_format.hpp"
#include "cases/model/case.hpp"
#include "cases/model/derive.hpp"
#include "cases/model/rule_ids.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/triangle.hpp"

namespace cases {

namespace {

constexpr uint32_t kLargest8 = 0xff, kLargest16 = 0xffff;

template <class Predicate>
bool all_draws(const Case& c, Predicate holds) {
    return std::all_of(c.draws.begin(), c.draws.end(), holds);
}
template <class Predicate>
bool any_draw(const Case& c, Predicate holds) {
    return std::any_of(c.draws.begin(), c.draws.end(), holds);
}

bool is_any(const Case&) {
    return true;
}

// With restart the largest value of a type is no index.
template <uint32_t largest>
bool has_indices_up_to(const Case& c) {
    return all_draws(c, [](const Draw& draw) {
        return largest_index(draw) <= largest - (draw.primitive_restart ? 1 : 0);
    });
}

template <uint32_t largest>
bool can_use_largest(const Case& c) {
    return all_draws(c, [](const Draw& draw) {
        return !draw.primitive_restart && largest_index(draw) <= largest;
    });
}

bool has_strip_or_fan(const Case& c) {
    return any_draw(c, [](const Draw& draw) { return draw.topology != Topology::triangle_list; });
}

bool has_no_indices(const Case& c) {
    return all_draws(c, [](const Draw& draw) { return !draw.indices; });
}

bool is_one(float value) {
    return value >= 1 && value <= 1;
}

bool has_w_one(const Case& c) {
    return any_draw(c, [](const Draw& draw) {
        return !draw.positions.empty() &&
               std::all_of(draw.positions.begin(), draw.positions.end(),
                           [](const glm::vec4& p) { return is_one(p.w); });
    });
}

bool has_half_positions(const Case& c) {
    return any_draw(c, [](const Draw& draw) { return are_half_floats(draw.positions); });
}

bool has_one_sample(const Case& c) {
    return c.target.samples == 1;
}

bool has_one_layer(const Case& c) {
    return c.target.layers == 1;
}

// Linear images of several samples or layers are offered by hardly any device ("Required Format
// Support" demands neither).
bool is_plain_image(const Case& c) {
    return c.target.samples == 1 && c.target.layers == 1;
}

// The shader that reads vertices from a storage buffer is built with distances of one kind.
bool has_one_kind_of_distances(const Case& c) {
    return all_draws(c, [](const Draw& draw) {
        return draw.distances.clip_count == 0 || draw.distances.cull_count == 0;
    });
}

// No dynamic state says how many samples are shaded at least.
bool has_no_sample_fraction(const Case& c) {
    return all_draws(
        c, [](const Draw& draw) { return !draw.multisample.min_sample_shading.has_value(); });
}

// Whether a shader that writes the number leaves what clearing to it leaves: neither is rounded.
// Denormal numbers a shader may flush.
bool is_written_as_cleared(const ComponentFormat& component, float value) {
    if (component.bits == 0 || component.kind == ComponentKind::uint) {
        return true;
    }
    if (component.kind == ComponentKind::half) {
        return half_bits(value).has_value();
    }
    if (component.kind == ComponentKind::binary32) {
        return std::isnormal(value) || std::fpclassify(value) == FP_ZERO;
    }
    return std::fpclassify(value) == FP_ZERO || is_one(value);  // in between it is a conversion
}

bool can_be_cleared_by_draw(const Case& c) {
    const Target& t = c.target;
    for (uint32_t location = 0; t.color && location < t.color_count(); ++location) {
        const ColorTarget& color = t.color_at(location);
        for (int k = 0; k < 4; ++k) {
            if (!is_written_as_cleared(component_of(color.format, static_cast<uint32_t>(k)),
                                       color.clear[k])) {
                return false;
            }
        }
    }
    const ComponentKind depth =
        t.depth_format == DepthFormat::d32_float ? ComponentKind::binary32 : ComponentKind::unorm;
    return t.layers == 1 && (!t.has_depth || is_written_as_cleared({depth, 32}, t.depth_clear));
}

// In which order a stage gets and hands on the vertices of a triangle, barycentrics would tell.
bool has_barycentrics(const Draw& draw) {
    return std::any_of(draw.attributes.begin(), draw.attributes.end(),
                       [](const Attribute& a) { return a.source == Source::barycentric; });
}

bool can_take_geometry(const Case& c) {
    return all_draws(c, [](const Draw& draw) {
        return (draw.distances.clip_count == 0 || draw.distances.cull_count == 0) &&
               !has_barycentrics(draw);
    });
}

bool can_be_tessellated(const Case& c) {
    return c.target.layers == 1 && all_draws(c, [](const Draw& draw) {
               return draw.topology == Topology::triangle_list && !draw.primitive_restart &&
                      draw.distances.clip_count == 0 && draw.distances.cull_count == 0 &&
                      draw.viewport_index == 0 && !has_barycentrics(draw);
           });
}

// Whether no triangle of a list has two vertices in one place, which a device may drop before they
// are written ("Transform Feedback").
bool are_corners_apart(const std::vector<glm::vec4>& p) {
    for (size_t k = 0; k + 2 < p.size(); k += 3) {
        if (p[k] == p[k + 1] || p[k + 1] == p[k + 2] || p[k] == p[k + 2]) {
            return false;
        }
    }
    return true;
}

// What is written of them has the order of the draw, so that its vertices keep their numbers.
bool are_plain_lists(const Case& c) {
    return all_draws(c, [](const Draw& draw) {
        return draw.topology == Topology::triangle_list && !draw.indices &&
               draw.distances.clip_count == 0 && draw.distances.cull_count == 0 &&
               are_corners_apart(draw.positions);
    });
}

bool is_constant(const std::vector<glm::vec4>& values) {
    return !values.empty() &&
           std::all_of(values.begin(), values.end(), [&values](const glm::vec4& value) {
               return std::memcmp(&value, &values.front(), sizeof value) == 0;
           });
}

// Whether it holds of the distances or of an attribute of some draw. Without instruments the only
// attributes that are drawn are colours and what discards.
template <class Predicate>
bool any_input(const Case& c, Predicate holds) {
    return any_draw(c, [&](const Draw& draw) {
        const auto& attributes = draw.attributes;
        if (holds(draw.distances.clip) || holds(draw.distances.cull)) {
            return true;
        }
        if (!c.target.has_instruments) {
            return std::ranges::any_of(drawn_attributes(c.target, draw), [&](uint32_t k) {
                return k < attributes.size() && holds(attributes[k].values);
            });
        }
        return std::any_of(attributes.begin(), attributes.end(),
                           [&](const Attribute& a) { return holds(a.values); });
    });
}

bool has_constant_input(const Case& c) {
    return any_input(c, is_constant);
}

// The shader that draws one instance of several is built with distances of one kind.
bool has_divided_input(const Case& c) {
    return has_constant_input(c) && has_one_kind_of_distances(c);
}

bool has_other_format(const std::vector<glm::vec4>& values) {
    return other_vertex_format(values, kAllVertexFormats, 0) != VertexFormat::rgba32_float;
}

bool has_exact_formats(const Case& c) {
    return any_draw(c, [](const Draw& draw) { return has_other_format(draw.positions); }) ||
           any_input(c, has_other_format);
}

// What a shader hands on may lose a denormal number, or the payload of a NaN. A number that is
// drawn from numbers like these is 0 or normal: 1/w and z/w are 2^-60 or more, a depth of the
// viewport's range and a product of two colours 2^-120 or more, and a value that is interpolated
// through 0 is 0 or off by a rounding of its vertices.
constexpr float kLeast = 0x1p-30F, kMost = 0x1p30F;
bool is_handed_on(float value) {
    return std::isfinite(value) && (std::abs(value) >= kLeast || std::fpclassify(value) == FP_ZERO);
}

bool is_vertex_handed_on(const glm::vec4& p) {
    return is_handed_on(p.z) && is_handed_on(p.w) && std::abs(p.z) <= kMost &&
           std::abs(p.w) <= kMost;
}

bool is_depth_handed_on(const std::optional<FragDepth>& depth) {
    return !depth || (is_handed_on(depth->value) && is_handed_on(depth->other));
}

// Without a bias, whose unit is denormal where a triangle's depths are 0 in binary32.
bool can_be_read_as_input(const Case& c) {
    const auto are_handed_on = [](const glm::vec4& v) {
        return is_handed_on(v.x) && is_handed_on(v.y) && is_handed_on(v.z) && is_handed_on(v.w);
    };
    const Target& t = c.target;
    const bool has_clears = (!t.color || are_handed_on(t.color_at(t.judged_color).clear)) &&
                            (!t.has_depth || is_handed_on(t.depth_clear));
    return has_one_layer(c) && has_clears && all_draws(c, [&](const Draw& draw) {
               return (!t.color || are_handed_on(output_at(t, draw, t.judged_color).value)) &&
                      !draw.depth.bias && is_depth_handed_on(draw.frag_depth) &&
                      is_handed_on(draw.viewport.min_depth) &&
                      is_handed_on(draw.viewport.max_depth) &&
                      std::ranges::all_of(draw.positions, is_vertex_handed_on) &&
                      std::ranges::all_of(draw.attributes, [&](const Attribute& a) {
                          return std::ranges::all_of(a.values, are_handed_on);
                      });
           });
}

// Whether binary32 holds each step on the way to a window coordinate: half of the size, the centre,
// their product with the coordinate and the sum ("Controlling the Viewport").
bool is_exact_in_window(float coordinate, float begin, float size) {
    const auto is_held = [](double number) {
        return std::equal_to<>()(static_cast<double>(static_cast<float>(number)), number);
    };
    // Products and sums of two numbers of binary32 of this size are exact in binary64.
    const double half = double{size} / 2, centre = double{begin} + half;
    const double product = half * double{coordinate};
    return std::abs(product) < 0x1p20 && std::abs(centre) < 0x1p20 && is_held(half) &&
           is_held(centre) && is_held(product) && is_held(product + centre);
}

// Vertices that lie in the view volume stay vertices of what is drawn. Where those that clipping
// makes lie in the window depends on how large their coordinates are.
bool has_exact_window(const Case& c) {
    return all_draws(c, [](const Draw& draw) {
        const Viewport& v = draw.viewport;
        constexpr auto kColumns = static_cast<float>(kMovedColumns);
        constexpr auto kRows = static_cast<float>(kMovedRows);
        return draw.distances.clip_count == 0 &&
               std::ranges::all_of(draw.positions, [&](const glm::vec4& p) {
                   return is_one(p.w) && std::abs(p.x) <= 1 && std::abs(p.y) <= 1 && p.z >= 0 &&
                          p.z <= 1 && is_exact_in_window(p.x, v.x, v.width) &&
                          is_exact_in_window(p.y, v.y, v.height) &&
                          is_exact_in_window(p.x, v.x + kColumns, v.width) &&
                          is_exact_in_window(p.y, v.y + kRows, v.height);
               });
    });
}

// Whether each triangle reaches two pixels or more to the right of the target's left edge, and
// below its upper one. It is held to the budgets of its own place, whose extents X and Y begin at
// the target's corner (docs/precision.md, "The budget"); a plane that the device anchors in the
// corner of the larger target has extents of X + 296 and Y + 200, 149 and 101 times as large at
// most. What binary32 makes of it is within 8 budgets, so within 8 x 149 = 1192 of the case's own,
// and vulkan has 1342.
bool reaches_into_target(const Case& c) {
    constexpr double kReach = 2;
    return std::ranges::all_of(assemble(c), [&](const Triangle& t) {
        const Draw& draw = c.draws[t.draw];
        const Viewport& v = draw.viewport;
        double x = 0, y = 0;  // the largest, in pixels
        for (const uint32_t k : t.vertex) {
            const glm::vec4& p = draw.positions[k];
            x = std::max(x, double{v.x} + double{v.width} / 2 * (1 + double{p.x}));
            y = std::max(y, double{v.y} + double{v.height} / 2 * (1 + double{p.y}));
        }
        return x >= kReach && y >= kReach;
    });
}

// Blocks of pixels stay blocks.
static_assert(kMovedColumns % kMaxFragmentSide == 0 && kMovedRows % kMaxFragmentSide == 0);

bool can_be_moved(const Case& c) {
    return has_exact_window(c) && reaches_into_target(c);
}

// Of a mesh shader each triangle is a group, of which a device has 65535 at least in a row
// (maxMeshWorkGroupCount).
bool can_be_meshes(const Case& c) {
    return all_draws(c, [](const Draw& draw) {
        constexpr size_t kMostGroups = 65535;
        const size_t elements = draw.indices ? draw.indices->size() : draw.positions.size();
        const size_t triangles = draw.topology == Topology::triangle_list ? elements / 3 : elements;
        return (draw.distances.clip_count == 0 || draw.distances.cull_count == 0) &&
               !has_barycentrics(draw) && triangles <= kMostGroups;
    });
}

// Statistics are not asked through doors.
bool has_occlusion_query(const Case& c) {
    return any_draw(c, [](const Draw& draw) { return is_occlusion(draw.query); });
}

bool has_several_draws(const Case& c) {
    return std::count_if(c.draws.begin(), c.draws.end(),
                         [](const Draw& draw) { return !draw.positions.empty(); }) > 1;
}

// What a pipeline may say of a draw without features that nothing else needs: of the unit of a bias
// it needs an extension, of restarts in a list another one.
bool can_be_static(const Case& c) {
    return all_draws(c, [](const Draw& draw) {
        const bool is_list = draw.topology == Topology::triangle_list;
        return !(is_list && draw.primitive_restart) &&
               !(draw.depth.bias && draw.depth.bias->is_controlled());
    });
}

// A pipeline that discards says nothing of samples, and a target of several demands that it does.
bool can_be_all_static(const Case& c) {
    return can_be_static(c) && (c.target.samples == 1 || all_draws(c, [](const Draw& draw) {
                                    return !draw.rasterizer_discard;
                                }));
}

constexpr DoorGroup kVertices = DoorGroup::vertices;
constexpr DoorGroup kState = DoorGroup::state, kRecording = DoorGroup::recording;
constexpr DoorGroup kTargets = DoorGroup::targets, kStages = DoorGroup::stages;
constexpr DoorPromise kSame = DoorPromise::same_bits, kRight = DoorPromise::right_picture;
constexpr DoorPromise kAlone = DoorPromise::right_alone;
constexpr std::string_view kAny = "every case that draws";

constexpr std::array<DoorRow, kDoors - 1> kRows = {{
    {Door::index_8, "index-8", kVertices, kSame, rule::door_index,
     "Vertices are named by indices of 8 bits; a draw without indices gets 0, 1, 2, ...",
     "indexTypeUint8 (VK_EXT_index_type_uint8)", "indices up to 255, 254 with restart",
     has_indices_up_to<kLargest8>},
    {Door::index_16, "index-16", kVertices, kSame, rule::door_index,
     "Vertices are named by indices of 16 bits; a draw without indices gets 0, 1, 2, ...", "",
     "indices up to 65535, 65534 with restart", has_indices_up_to<kLargest16>},
    {Door::index_32, "index-32", kVertices, kSame, rule::door_index,
     "Vertices are named by indices of 32 bits, in draws without indices, too.", "", kAny, is_any},
    {Door::index_8_largest, "index-8-largest", kVertices, kSame, rule::door_restart,
     "Restart is off, and the largest index in use is 255, which is then a vertex like any other; "
     "a negative vertexOffset leads back to the vertices.",
     "indexTypeUint8 (VK_EXT_index_type_uint8)", "indices up to 255, no draw with restart",
     can_use_largest<kLargest8>},
    {Door::index_16_largest, "index-16-largest", kVertices, kSame, rule::door_restart,
     "The same with indices of 16 bits, of which the largest is 65535.", "",
     "indices up to 65535, no draw with restart", can_use_largest<kLargest16>},
    {Door::restart_extra, "restart-extra", kVertices, kRight, rule::door_restart,
     "Strips and fans are drawn with restart: twice before their first index and once behind their "
     "last one.",
     "", "a strip or a fan", has_strip_or_fan},
    {Door::first_vertex, "first-vertex", kVertices, kSame, rule::door_first,
     "Draws begin at firstVertex 5, behind vertices that must not be read.", "",
     "no draw with indices", has_no_indices},
    {Door::first_index, "first-index", kVertices, kSame, rule::door_first,
     "Draws begin at firstIndex 7, behind indices of other vertices.", "", kAny, is_any},
    {Door::vertex_offset, "vertex-offset", kVertices, kSame, rule::door_first,
     "vertexOffset is 5, and five vertices that must not be read lie before the others.", "", kAny,
     is_any},
    {Door::vertex_offset_negative, "vertex-offset-negative", kVertices, kSame, rule::door_first,
     "Indices are larger by 9, and vertexOffset is -9.", "", kAny, is_any},
    {Door::bind_offset, "bind-offset", kVertices, kSame, rule::door_buffer,
     "Vertex buffers are bound at offsets that are multiples of 4 and of nothing larger, each "
     "binding at another.",
     "", kAny, is_any},
    {Door::index_offset, "index-offset", kVertices, kSame, rule::door_buffer,
     "The index buffer is bound in the middle of other indices, on a multiple of 4 bytes.", "",
     kAny, is_any},
    {Door::separate_buffers, "separate-buffers", kVertices, kSame, rule::door_buffer,
     "Each binding, and the indices, have a buffer and memory of their own.", "", kAny, is_any},
    {Door::memory_imported, "memory-imported", kVertices, kSame, rule::door_buffer,
     "Each binding, and the indices, have a buffer of their own, in memory that the application "
     "has allocated itself and the device imports.",
     "the import of memory of the host for vertices and indices (VK_EXT_external_memory_host)",
     kAny, is_any},
    {Door::stride_padded, "stride-padded", kVertices, kRight, rule::door_layout,
     "Vertices lie further apart than they are long: 12 bytes between them, another number for "
     "each binding.",
     "", kAny, is_any},
    {Door::stride_dynamic, "stride-dynamic", kVertices, kRight, rule::door_layout,
     "The strides are dynamic state, given with the buffers, and those of the pipeline are others.",
     "", kAny, is_any},
    {Door::interleaved, "interleaved", kVertices, kRight, rule::door_layout,
     "All that a vertex has lies together, in one binding.", "", kAny, is_any},
    {Door::three_components, "three-components", kVertices, kRight, rule::door_layout,
     "Positions whose w is 1 are read as three numbers; the fourth is 1 by the format.", "",
     "a draw whose positions all have w = 1", has_w_one},
    {Door::half_floats, "half-floats", kVertices, kRight, rule::door_layout,
     "Positions that binary16 holds are read as four numbers of it.", "",
     "a draw whose positions are all numbers of binary16", has_half_positions},
    {Door::exact_formats, "exact-formats", kVertices, kRight, rule::door_layout,
     "Inputs are read in other formats that hold their numbers: normalized ones of 0, 1 and -1, "
     "scaled ones of whole numbers, binary16, and fewer components where the others are 0 and 1.",
     "", "a draw with an input whose numbers another format of vertices holds", has_exact_formats},
    {Door::instance_rate, "instance-rate", kVertices, kRight, rule::door_instance,
     "What is the same at every vertex is read once an instance, and the only instance is number "
     "2: firstInstance is 2.",
     "", "a draw with an attribute or distances that are the same at every vertex",
     has_constant_input},
    {Door::instance_divisor, "divisor", kVertices, kRight, rule::door_instance,
     "What is the same at every vertex is read once for three instances: eight are drawn, of which "
     "only the last has its triangles within the view volume; it reads element 2.",
     "vertexAttributeInstanceRateDivisor (VK_EXT_vertex_attribute_divisor)",
     "a draw with an attribute or distances that are the same at every vertex, no draw with both "
     "clip and cull distances",
     has_divided_input},
    {Door::instance_divisor_zero, "divisor-zero", kVertices, kRight, rule::door_instance,
     "As divisor, with a divisor of 0: all instances read the first element.",
     "vertexAttributeInstanceRateDivisor and vertexAttributeInstanceRateZeroDivisor "
     "(VK_EXT_vertex_attribute_divisor)",
     "a draw with an attribute or distances that are the same at every vertex, no draw with both "
     "clip and cull distances",
     has_divided_input},
    {Door::vertices_pulled, "vertices-pulled", kVertices, kRight, rule::door_layout,
     "The pipeline has no inputs: the vertex shader reads its vertex from a storage buffer, by "
     "gl_VertexIndex.",
     "", "no draw with both clip and cull distances", has_one_kind_of_distances},
    {Door::indirect, "indirect", kVertices, kSame, rule::door_indirect,
     "Draws are indirect: their parameters are read from a buffer, from firstVertex or "
     "vertexOffset 5 on, behind a draw that is not asked for.",
     "", kAny, is_any},
    {Door::indirect_count, "indirect-count", kVertices, kSame, rule::door_indirect,
     "The number of indirect draws is read from a buffer, too: one, of three that are allowed; "
     "indices are bound at an offset.",
     "drawIndirectCount", kAny, is_any},
    {Door::multi_indirect, "multi-indirect", kVertices, kSame, rule::door_indirect,
     "One command has three indirect draws, 32 bytes apart, from firstVertex or vertexOffset 5 on: "
     "the first half of a list's triangles, none, the second half.",
     "multiDrawIndirect", kAny, is_any},
    {Door::indirect_after_count, "indirect-after-count", kVertices, kSame, rule::door_indirect,
     "The same, directly after a command that reads the number of its draws from a buffer, which "
     "is "
     "0.",
     "drawIndirectCount and multiDrawIndirect", kAny, is_any},
    {Door::multi_draw, "multi-draw", kVertices, kSame, rule::door_indirect,
     "One command has three draws from memory of the application, from firstVertex or vertexOffset "
     "5 "
     "on: the first half of a list's triangles, none, the second half.",
     "multiDraw (VK_EXT_multi_draw)", kAny, is_any},
    {Door::multi_draw_empty, "multi-draw-empty", kVertices, kSame, rule::door_indirect,
     "The same, with a draw of no vertices first, then the whole, then another of none.",
     "multiDraw (VK_EXT_multi_draw)", kAny, is_any},
    {Door::state_first, "state-first", kState, kSame, rule::door_state,
     "Dynamic state is set and buffers are bound before the pipeline is.", "", kAny, is_any},
    {Door::query_first, "query-first", kState, kSame, rule::door_state,
     "Queries begin before the first pipeline of the command buffer is bound.", "",
     "a draw with an occlusion query", has_occlusion_query},
    {Door::state_stale, "state-stale", kState, kSame, rule::door_state,
     "All dynamic state is first set to other values, under which the draw is recorded with "
     "rasterization off, and then to those of the draw.",
     "", kAny, is_any},
    {Door::state_static, "state-static", kState, kRight, rule::door_state,
     "What is dynamic in other pictures is a part of the pipeline.", "",
     "no list with restart, no bias whose unit is chosen, no discarded draw to several samples",
     can_be_all_static},
    {Door::state_after_static, "state-after-static", kState, kSame, rule::door_state,
     "Before each draw a pipeline is bound in which all state is static and another, and the draw "
     "is recorded with it under empty scissors; then come the usual pipeline and its dynamic "
     "state.",
     "", "no list with restart, no bias whose unit is chosen", can_be_static},
    {Door::state_output, "state-output", kState, kRight, rule::door_state,
     "What becomes of a fragment's outputs is dynamic: blending and its equations, write masks, "
     "logical operations, the sample mask, alpha to coverage and to one; by its pipeline nothing "
     "is written.",
     "the states of blending, logical operations, sample masks and alpha to coverage and to one of "
     "VK_EXT_extended_dynamic_state3, and extendedDynamicState2LogicOp",
     kAny, is_any},
    {Door::state_unused, "state-unused", kState, kRight, rule::door_state,
     "State is on that changes nothing: a bias of 0, restart without an index that restarts, tests "
     "that fail and have no attachment to test, blending by ONE and ZERO, logical operations that "
     "copy.",
     "", kAny, is_any},
    {Door::unoptimized, "unoptimized", kState, kRight, rule::door_state,
     "Pipelines are made with VK_PIPELINE_CREATE_DISABLE_OPTIMIZATION_BIT.", "", kAny, is_any},
    {Door::pipeline_library, "pipeline-library", kState, kRight, rule::door_state,
     "Pipelines are linked from four libraries: vertex input, the stages before rasterization, the "
     "fragment shader, its outputs.",
     "graphicsPipelineLibrary (VK_EXT_graphics_pipeline_library)", kAny, is_any},
    {Door::pipeline_derived, "pipeline-derived", kState, kRight, rule::door_state,
     "Pipelines are derivatives of another one, which writes nothing.", "", kAny, is_any},
    {Door::pipeline_cached, "pipeline-cached", kState, kRight, rule::door_state,
     "Pipelines are made a second time, with a cache that was made of the data of a first one.", "",
     kAny, is_any},
    {Door::shader_objects, "shader-objects", kState, kRight, rule::door_state,
     "There are no pipelines: shaders are objects of their own, and all state is dynamic.",
     "shaderObject (VK_EXT_shader_object)",
     "no draw that asks for a part of its samples to be shaded", has_no_sample_fraction},
    {Door::secondary, "secondary", kRecording, kSame, rule::door_recording,
     "All draws are recorded in a secondary command buffer.", "", kAny, is_any},
    {Door::secondary_each, "secondary-each", kRecording, kSame, rule::door_recording,
     "Each draw is recorded in a secondary command buffer of its own; one command executes them.",
     "", "several draws", has_several_draws},
    {Door::secondary_reused, "secondary-reused", kRecording, kSame, rule::door_recording,
     "As secondary, for simultaneous use, and it is executed twice: the second rendering clears "
     "what "
     "the first one has drawn.",
     "", kAny, is_any},
    {Door::pass_split, "pass-split", kRecording, kRight, rule::door_recording,
     "The rendering ends after the clears and after each draw, and the next one loads what was "
     "stored.",
     "", kAny, is_any},
    {Door::pass_suspended, "pass-suspended", kRecording, kRight, rule::door_recording,
     "The rendering is suspended after the clears and after each draw, and resumed.", "", kAny,
     is_any},
    {Door::clear_commands, "clear-commands", kRecording, kRight, rule::door_recording,
     "Nothing is loaded or cleared when the rendering begins; vkCmdClearAttachments clears.", "",
     kAny, is_any},
    {Door::clear_draw, "clear-draw", kRecording, kRight, rule::door_recording,
     "Nothing is loaded or cleared; a triangle over the whole target writes the values to one "
     "attachment after the other.",
     "",
     "one layer, and clear values that are neither rounded nor denormal: 0 and 1 of a normalized "
     "format",
     can_be_cleared_by_draw},
    {Door::render_pass, "render-pass", kRecording, kRight, rule::door_recording,
     "The rendering is an instance of a render pass object with one subpass.", "", kAny, is_any},
    {Door::subpasses, "subpasses", kRecording, kRight, rule::door_recording,
     "As render-pass, with two subpasses: the first clears and has the first of several draws, the "
     "second one the others.",
     "", kAny, is_any},
    {Door::input_attachment, "input-attachment", kRecording, kRight, rule::door_recording,
     "A second subpass reads what the first has drawn as input attachments, and the picture is "
     "what "
     "it has read: instruments, depth but D24, stencil and colours but sRGB and binary16.",
     "fragmentStoresAndAtomics",
     "one layer, no bias, no number that is infinite, none, or nearer to 0 than 2^-30 and not 0",
     can_be_read_as_input},
    {Door::submissions, "submissions", kRecording, kRight, rule::door_recording,
     "As pass-split, and each part is a command buffer and a submission of its own.", "", kAny,
     is_any},
    {Door::target_larger, "target-larger", kTargets, kRight, rule::door_target,
     "Attachments have 29 columns and 19 rows more than the rendering's area.", "", kAny, is_any},
    {Door::target_last_tile, "target-last-tile", kTargets, kAlone, rule::door_target,
     "The case lies in the last tile of a larger target: viewport, scissor and the rendering's "
     "area "
     "are 296 columns and 200 rows further, and the attachments end with it.",
     "",
     "vertices in the view volume with w = 1 whose window coordinates binary32 holds here and "
     "there, no clip distances",
     can_be_moved},
    {Door::image_layer, "image-layer", kTargets, kRight, rule::door_target,
     "Attachments are the last layers of images with two layers more.", "", kAny, is_any},
    {Door::image_level, "image-level", kTargets, kRight, rule::door_target,
     "Attachments are level 1 of images with more mip levels.", "", "one sample a pixel",
     has_one_sample},
    {Door::image_linear, "image-linear", kTargets, kRight, rule::door_target,
     "Attachments are images of linear tiling, where the device has them for their formats.",
     "images of linear tiling for any of its attachments", "one sample a pixel and one layer",
     is_plain_image},
    {Door::image_usages, "image-usages", kTargets, kRight, rule::door_target,
     "Attachments may be used in every way that the device offers for their formats: sampled, "
     "stored to, copied to, as input attachments, seen in other formats.",
     "", kAny, is_any},
    {Door::memory_dedicated, "memory-dedicated", kTargets, kRight, rule::door_target,
     "Each attachment has an allocation that is dedicated to it.", "", kAny, is_any},
    {Door::memory_aliased, "memory-aliased", kTargets, kRight, rule::door_target,
     "The memory of each attachment is that of another image, too, where the device has memory for "
     "both; that image is cleared to another colour just before.",
     "", kAny, is_any},
    {Door::multiview, "multiview", kTargets, kRight, rule::door_target,
     "The second view of two is drawn, alone, to the second layer.", "multiview",
     "a target of one layer", has_one_layer},
    {Door::geometry, "geometry", kStages, kAlone, rule::door_stage,
     "A geometry shader hands on each triangle as it is.", "geometryShader",
     "no draw with both clip and cull distances, no barycentrics", can_take_geometry},
    {Door::tessellation, "tessellation", kStages, kAlone, rule::door_stage,
     "Each triangle is a patch, which is tessellated into itself.", "tessellationShader",
     "lists without restart, without distances, layers, viewport indices and barycentrics",
     can_be_tessellated},
    {Door::transform_feedback, "transform-feedback", kStages, kRight, rule::door_layout,
     "Vertices are written to a buffer by transform feedback, in a rendering without attachments, "
     "and "
     "drawn from there.",
     "transformFeedback (VK_EXT_transform_feedback)",
     "lists without indices and distances, the corners of each triangle in three places",
     are_plain_lists},
    {Door::mesh_shader, "mesh-shader", kStages, kAlone, rule::door_stage,
     "A mesh shader makes the triangles, one a group, of vertices in a storage buffer; those of "
     "strips and fans begin or end with the vertex that provokes.",
     "meshShader (VK_EXT_mesh_shader)",
     "no draw with both clip and cull distances, no barycentrics, up to 65535 triangles",
     can_be_meshes},
    {Door::stage_unused, "stage-unused", kStages, kRight, rule::door_state,
     "Shaders have outputs that nobody reads, one of the vertex shader and, where the device has a "
     "location without an attachment, one of the fragment shader; an input is described that no "
     "shader has, and a descriptor set.",
     "", kAny, is_any},
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
    return !c.blit && any_draw(c, [](const Draw& draw) { return !draw.positions.empty(); }) &&
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
        draw.topology != Topology::triangle_list) {
        return 0;
    }
    const size_t elements = draw.indices ? draw.indices->size() : draw.positions.size();
    return static_cast<uint32_t>(elements / 3 / 2);
}

bool are_half_floats(std::span<const glm::vec4> positions) {
    return !positions.empty() &&
           std::all_of(positions.begin(), positions.end(), [](const glm::vec4& p) {
               return half_bits(p.x) && half_bits(p.y) && half_bits(p.z) && half_bits(p.w);
           });
}

uint32_t largest_index(const Draw& draw) {
    if (!draw.indices) {
        return draw.positions.empty() ? 0 : static_cast<uint32_t>(draw.positions.size() - 1);
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
