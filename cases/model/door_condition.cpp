// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/model/door_condition.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "cases/base/float_bits.hpp"
#include "cases/format/color_format.hpp"
#include "cases/format/vertex_format.hpp"
#include "cases/model/case.hpp"
#include "cases/model/derive.hpp"
#include "cases/model/door.hpp"
#include "cases/model/instances.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/triangle.hpp"

namespace cases::door_condition {

namespace {

template <class Predicate>
bool all_draws(const Case& c, Predicate holds) {
    return std::ranges::all_of(c.draws, [&](const Draw& d) { return d.clear || holds(d); });
}

template <class Predicate>
bool any_draw(const Case& c, Predicate holds) {
    return std::ranges::any_of(c.draws, [&](const Draw& d) { return !d.clear && holds(d); });
}

bool is_one(float value) {
    return value >= 1 && value <= 1;
}

// Whether a shader that writes the number leaves what clearing to it leaves: neither is rounded.
// Denormal numbers a shader may flush.
bool is_written_as_cleared(const ComponentFormat& component, float value) {
    if (component.bits == 0 || is_integer(component.kind)) {
        return true;
    }
    if (component.kind == ComponentKind::half) {
        constexpr uint32_t kSign = 0x8000U;
        const std::optional<uint32_t> bits = half_bits(value);
        const uint32_t lost = component.bits < 16 ? kSign | ((1U << (15 - component.bits)) - 1) : 0;
        return bits && (*bits & lost) == 0;
    }
    if (component.kind == ComponentKind::binary32) {
        return std::isnormal(value) || std::fpclassify(value) == FP_ZERO;
    }
    return std::fpclassify(value) == FP_ZERO || is_one(value);  // in between it is a conversion
}

// In which order a stage gets and hands on the vertices of a triangle, barycentrics would tell.
bool has_barycentrics(const Draw& draw) {
    return std::ranges::any_of(draw.attributes,
                               [](const Attribute& a) { return a.source == Source::barycentric; });
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

bool is_constant(const std::vector<glm::vec4>& values) {
    return !values.empty() && std::ranges::all_of(values, [&values](const glm::vec4& value) {
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
        return std::ranges::any_of(attributes, [&](const Attribute& a) { return holds(a.values); });
    });
}

bool has_other_format(const std::vector<glm::vec4>& values) {
    return other_vertex_format(values, kAllVertexFormats, 0) != VertexFormat::rgba32_float;
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
        if (draw.clear) {
            return true;
        }
        double x = 0, y = 0;  // the largest, in pixels
        for (const uint32_t k : t.vertex) {
            const glm::vec4& p = draw.positions[k];
            x = std::max(x, double{v.x} + double{v.width} / 2 * (1 + double{p.x}));
            y = std::max(y, double{v.y} + double{v.height} / 2 * (1 + double{p.y}));
        }
        return x >= kReach && y >= kReach;
    });
}

}  // namespace

bool has_indices_up_to(const Case& c, uint32_t largest) {
    return all_draws(c, [=](const Draw& draw) {
        return largest_index(draw) <= largest - (draw.primitive_restart ? 1 : 0);
    });
}

bool can_use_largest(const Case& c, uint32_t largest) {
    return all_draws(c, [=](const Draw& draw) {
        return !draw.primitive_restart && largest_index(draw) <= largest;
    });
}

bool has_strip_or_fan(const Case& c) {
    return any_draw(c, [](const Draw& draw) { return draw.topology != Topology::triangle_list; });
}

bool has_no_indices(const Case& c) {
    return all_draws(c, [](const Draw& draw) { return !draw.indices; });
}

bool has_w_one(const Case& c) {
    return any_draw(c, [](const Draw& draw) {
        return !draw.positions.empty() &&
               std::ranges::all_of(draw.positions, [](const glm::vec4& p) { return is_one(p.w); });
    });
}

bool has_half_positions(const Case& c) {
    return any_draw(c, [](const Draw& draw) { return are_half_floats(draw.positions); });
}

bool has_levels(const Case& c) {
    return c.target.samples == 1 || c.target.color_resolve != Resolve::none ||
           c.target.depth_resolve != Resolve::none || c.target.stencil_resolve != Resolve::none;
}

bool has_one_layer(const Case& c) {
    return c.target.layers == 1;
}

// A query of several views has a number for each.
bool can_be_views(const Case& c) {
    return has_one_layer(c) &&
           all_draws(c, [](const Draw& draw) { return draw.query == Query::none; });
}

bool is_plain_image(const Case& c) {
    return c.target.samples == 1 && c.target.layers == 1;
}

bool can_be_pulled(const Case& c) {
    return has_one_kind_of_distances(c) && has_no_instances(c);
}

bool has_one_kind_of_distances(const Case& c) {
    return all_draws(c, [](const Draw& draw) {
        return draw.distances.clip_count == 0 || draw.distances.cull_count == 0;
    });
}

bool has_no_sample_fraction(const Case& c) {
    return all_draws(
        c, [](const Draw& draw) { return !draw.multisample.min_sample_shading.has_value(); });
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

bool can_take_geometry(const Case& c) {
    return has_one_kind_of_distances(c) && !any_draw(c, has_barycentrics);
}

// A triangle without an area is counted, and conservative rasterization may draw it.
bool can_be_strips(const Case& c) {
    return can_take_geometry(c) && all_draws(c, [](const Draw& draw) {
               return draw.conservative == Conservative::none &&
                      (draw.query == Query::none || is_occlusion(draw.query));
           });
}

bool can_be_tessellated(const Case& c) {
    return c.target.layers == 1 && all_draws(c, [](const Draw& draw) {
               return draw.topology == Topology::triangle_list && !draw.primitive_restart &&
                      draw.distances.clip_count == 0 && draw.distances.cull_count == 0 &&
                      draw.viewport_index == 0 && !has_barycentrics(draw);
           });
}

bool are_plain_lists(const Case& c) {
    return all_draws(c, [](const Draw& draw) {
        return draw.topology == Topology::triangle_list && !draw.indices && !is_instanced(draw) &&
               draw.distances.clip_count == 0 && draw.distances.cull_count == 0 &&
               are_corners_apart(draw.positions);
    });
}

bool has_no_instances(const Case& c) {
    return all_draws(c, [](const Draw& draw) { return !is_instanced(draw); });
}

bool has_constant_input(const Case& c) {
    return any_input(c, is_constant) && has_no_instances(c);
}

bool has_divided_input(const Case& c) {
    return has_constant_input(c) && has_one_kind_of_distances(c);
}

bool has_exact_formats(const Case& c) {
    return any_draw(c, [](const Draw& draw) { return has_other_format(draw.positions); }) ||
           any_input(c, has_other_format);
}

bool can_be_read_as_input(const Case& c) {
    const auto are_handed_on = [](const glm::vec4& v) {
        return is_handed_on(v.x) && is_handed_on(v.y) && is_handed_on(v.z) && is_handed_on(v.w);
    };
    const Target& t = c.target;
    const bool has_clears = (!t.color || are_handed_on(t.color_at(t.judged_color).clear)) &&
                            (!t.has_depth || is_handed_on(t.depth_clear));
    // Clears are read, too.
    return has_one_layer(c) && has_clears && std::ranges::all_of(c.draws, [&](const Draw& draw) {
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

static_assert(kMovedColumns % kMaxFragmentSide == 0 && kMovedRows % kMaxFragmentSide == 0);

bool can_be_moved(const Case& c) {
    return has_exact_window(c) && reaches_into_target(c);
}

bool can_be_meshes(const Case& c) {
    return can_take_geometry(c) && has_no_instances(c) && all_draws(c, [](const Draw& draw) {
               constexpr size_t kMostGroups = 65535;
               const size_t elements = draw.element_count();
               const bool is_list = draw.topology == Topology::triangle_list;
               return (is_list ? elements / 3 : elements) <= kMostGroups;
           });
}

bool has_occlusion_query(const Case& c) {
    return any_draw(c, [](const Draw& draw) { return is_occlusion(draw.query); });
}

bool has_several_draws(const Case& c) {
    return std::ranges::count_if(c.draws,
                                 [](const Draw& draw) { return !draw.positions.empty(); }) > 1;
}

bool can_be_static(const Case& c) {
    return all_draws(c, [](const Draw& draw) {
        const bool is_list = draw.topology == Topology::triangle_list;
        return !(is_list && draw.primitive_restart) &&
               !(draw.depth.bias && draw.depth.bias->is_controlled());
    });
}

bool can_be_all_static(const Case& c) {
    return can_be_static(c) && (c.target.samples == 1 || all_draws(c, [](const Draw& draw) {
                                    return !draw.rasterizer_discard;
                                }));
}

}  // namespace cases::door_condition
