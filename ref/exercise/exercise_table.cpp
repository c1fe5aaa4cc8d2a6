// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/exercise/exercise_table.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "cases/format/color_format.hpp"
#include "cases/model/rule.hpp"
#include "cases/model/rule_ids.hpp"
#include "ref/coverage/fast/fast.hpp"
#include "ref/value/fragment/shading_rate.hpp"

namespace ref {

namespace {

namespace rule = cases::rule;
using cases::Profile;
using value::Kind;

// Some triangle that may have written last.
template <class Test>
bool any_writer(const View& view, const Test& test) {
    return std::ranges::any_of(view.sample.writers, test);
}
template <class Test>
bool any_writing_draw(const View& view, const Test& test) {
    return any_writer(view, [&](uint32_t t) { return test(view.facts.draw_of(t)); });
}

// What the triangles cover, or not.

bool is_surely_covered(const View& view, std::string_view) {
    return std::ranges::any_of(view.sample.hits,
                               [](const Hit& hit) { return hit.coverage == Coverage::must; });
}

bool is_hit(const View& view, uint32_t t) {
    return std::ranges::any_of(view.sample.hits, [&](const Hit& hit) { return hit.triangle == t; });
}

// A triangle that may draw in the sample's place, and does not.
bool is_outside_one(const View& view, std::string_view) {
    const JudgedSample& s = view.sample;
    const auto& triangles = view.facts.triangles();
    if (s.hits.size() == triangles.size()) {
        return false;
    }
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        if (view.facts.draw_of(t).layer != s.id.layer || is_hit(view, t)) {
            continue;
        }
        const TriangleSetup& setup = view.setups[t];
        if (setup.kind == TriangleSetup::Kind::outlines && setup.window.may_touch(s.p) &&
            setup.window.may_write(s.id.sample)) {
            return true;
        }
    }
    return false;
}

bool is_in_set(const View& view, std::string_view rule) {
    return std::ranges::any_of(view.sample.reasons.sets, [&](const FixedSet& set) {
        return rule_of(set.why, Profile::vulkan) == rule;
    });
}

bool has_reason_of(const Decision& decision, std::string_view rule) {
    return std::ranges::any_of(decision.reasons, [&](const Reason& r) {
        return rule_of(r.kind, Profile::direct3d) == rule;
    });
}

// Profile practice leaves a triangle open at the sample, and direct3d decides it for this rule.
bool is_settled(const View& view, std::string_view rule) {
    return std::ranges::any_of(view.sample.hits, [&](const Hit& hit) {
        if (hit.coverage != Coverage::either) {
            return false;
        }
        const Decision decision = view.facts.decide(hit.triangle, view.sample);
        return decision.coverage != Coverage::either && has_reason_of(decision, rule);
    });
}

// The same by where its vertices snap, also where the sample is then on an edge.
bool is_settled_by_snapping(const View& view, std::string_view) {
    return std::ranges::any_of(view.sample.hits, [&](const Hit& hit) {
        const std::span<const Box> boxes = view.setups[hit.triangle].unclipped.vertices();
        return hit.coverage == Coverage::either &&
               std::ranges::any_of(
                   boxes, [](const Box& box) { return box.x0 != box.x1 || box.y0 != box.y1; }) &&
               view.facts.decide(hit.triangle, view.sample).coverage != Coverage::either;
    });
}

// Whether this reason may keep a triangle from the sample at all; it is cheap to say.
bool may_keep(ReasonKind kind, const View& view, uint32_t t) {
    const cases::Draw& draw = view.facts.draw_of(t);
    const JudgedSample& s = view.sample;
    switch (kind) {
        case ReasonKind::other_layer:
            return draw.layer != s.id.layer;
        case ReasonKind::discarded:
            return draw.rasterizer_discard;
        case ReasonKind::cull_distance:
            return draw.distances.cull_count > 0;
        case ReasonKind::clip_distance:
            return draw.distances.clip_count > 0;
        case ReasonKind::masked:
            return !view.setups[t].window.may_write(s.id.sample);
        case ReasonKind::scissor:
            return !view.setups[t].window.is_in_scissor(s.p);
        case ReasonKind::viewport:
            return !view.setups[t].window.is_in_zone(s.p);
        case ReasonKind::culled:
            return draw.cull != cases::CullMode::none;
        case ReasonKind::clip_plane:
            return view.setups[t].is_clipped || view.setups[t].kind == TriangleSetup::Kind::nothing;
        default:
            return false;
    }
}

// A triangle that would cover the sample is kept from it by the rule.
bool is_kept_away(const View& view, std::string_view rule) {
    for (auto k = size_t{0}; k <= static_cast<size_t>(kLastReason); ++k) {
        const auto kind = static_cast<ReasonKind>(k);
        if (rule_of(kind, Profile::vulkan) != rule) {
            continue;
        }
        for (uint32_t t = 0; t < view.facts.triangles().size(); ++t) {
            if (!may_keep(kind, view, t) || is_hit(view, t)) {
                continue;
            }
            const Decision decision = view.facts.decide(t, view.sample);
            if (is_suppressed(decision) &&
                std::ranges::any_of(decision.reasons,
                                    [&](const Reason& r) { return r.kind == kind; })) {
                return true;
            }
        }
    }
    return false;
}

bool is_beside_bad_number(const View& view, std::string_view) {
    return !view.sample.hits.empty() && view.facts.has_bad_number();
}

// Facing, order and depth.

bool has_known_facing(const View& view, std::string_view) {
    return any_writer(view, [&](uint32_t t) {
        const TriangleSetup& setup = view.setups[t];
        return setup.can_be_front != setup.can_be_back;
    });
}

bool is_overwritten(const View& view, std::string_view) {
    return view.sample.bounds.total_max >= 2 &&
           view.sample.writers.size() < view.sample.hits.size();
}

bool is_compared(const View& view, std::string_view rule) {
    const DepthResolution& depth = view.sample.reasons.depth;
    for (size_t m = 0; m < depth.outcomes.size(); ++m) {
        const cases::CompareOp op = view.facts.draw_of(view.sample.hits[m].triangle).depth.compare;
        if (depth.outcomes[m] != DepthOutcome::open && op != cases::CompareOp::always &&
            op != cases::CompareOp::never && rule_of(depth.reasons[m], Profile::vulkan) == rule) {
            return true;
        }
    }
    return false;
}

bool is_depth_kept(const View& view, std::string_view) {
    const DepthResolution& depth = view.sample.reasons.depth;
    for (size_t m = 0; m < depth.outcomes.size(); ++m) {
        if (depth.outcomes[m] == DepthOutcome::fails ||
            !view.facts.draw_of(view.sample.hits[m].triangle).depth.write) {
            return true;
        }
    }
    return false;
}

bool is_depth_rounded(const View& view, std::string_view) {
    return view.of().target.depth_format != cases::DepthFormat::d32_float &&
           !view.sample.writers.empty();
}

bool is_biased(const View& view, std::string_view) {
    return any_writing_draw(view, [](const cases::Draw& draw) {
        return draw.depth.bias && (std::fpclassify(draw.depth.bias->constant) != FP_ZERO ||
                                   std::fpclassify(draw.depth.bias->slope) != FP_ZERO);
    });
}

bool is_clamped(const View& view, std::string_view) {
    return any_writer(view, [&](uint32_t t) {
        return view.facts.draw_of(t).depth.clamp && view.facts.is_beyond_range(t, view.sample);
    });
}

// Values.

// Some quantity of a writer for which the test holds.
template <class Test>
bool any_quantity(const View& view, const Test& test) {
    return any_writer(view, [&](uint32_t t) {
        const uint32_t draw = view.facts.triangles()[t].draw;
        return std::ranges::any_of(view.facts.quantities(draw), test);
    });
}

bool has_value(const View& view, std::string_view rule) {
    return any_quantity(view, [&](const value::Quantity& q) { return q.rule == rule; });
}

bool has_interpolated(const View& view, std::string_view) {
    return any_quantity(view, [](const value::Quantity& q) {
        return q.id.is_attribute() && (q.kind == Kind::linear || q.kind == Kind::perspective);
    });
}

bool has_barycentric(const View& view, std::string_view) {
    return any_writing_draw(view, [](const cases::Draw& draw) {
        return std::ranges::any_of(draw.attributes, [](const cases::Attribute& a) {
            return a.source == cases::Source::barycentric;
        });
    });
}

bool is_at_sample(const View& view, std::string_view) {
    return any_quantity(view, [](const value::Quantity& q) {
        return (q.id.is_attribute() && q.at_sample) || q.kind == Kind::sample_position;
    });
}

bool is_sample_shaded(const View& view, std::string_view) {
    return any_writing_draw(view, [&](const cases::Draw& draw) {
        const auto rate = value::shading_rate(draw, view.of().target.samples);
        return rate == value::ShadingRate::some || rate == value::ShadingRate::sample;
    });
}

// What a draw writes, or not.

bool is_inside_scissor(const View& view, std::string_view) {
    const cases::Target& target = view.of().target;
    const cases::Rect whole{0, 0, target.width, target.height};
    return any_writing_draw(view, [&](const cases::Draw& draw) { return draw.scissor != whole; });
}

bool passes_culling(const View& view, std::string_view) {
    return any_writing_draw(
        view, [](const cases::Draw& draw) { return draw.cull != cases::CullMode::none; });
}

bool passes_cull_distance(const View& view, std::string_view) {
    return any_writing_draw(view,
                            [](const cases::Draw& draw) { return draw.distances.cull_count > 0; });
}

bool passes_clip_distance(const View& view, std::string_view) {
    return any_writing_draw(view,
                            [](const cases::Draw& draw) { return draw.distances.clip_count > 0; });
}

// A triangle with a vertex beyond a border of the viewport.
bool crosses_border(const View& view, std::string_view) {
    return any_writer(view, [&](uint32_t t) {
        return std::ranges::any_of(view.facts.triangles()[t].vertex, [&](uint32_t v) {
            const glm::vec4& p = view.facts.draw_of(t).positions[v];
            return std::fabs(p.x) > p.w || std::fabs(p.y) > p.w;
        });
    });
}

// A triangle with a vertex outside the view volume, or on one of its depth planes.
bool reaches_volume(const View& view, std::string_view) {
    return any_writer(view, [&](uint32_t t) {
        const cases::Draw& draw = view.facts.draw_of(t);
        return view.setups[t].is_clipped ||
               std::ranges::any_of(view.facts.triangles()[t].vertex, [&](uint32_t v) {
                   const glm::vec4& p = draw.positions[v];
                   const float low = draw.depth.negative_one_to_one ? -p.w : 0.0F;
                   return p.z <= low || p.z >= p.w;
               });
    });
}

bool passes_mask(const View& view, std::string_view) {
    return any_writing_draw(view, [](const cases::Draw& draw) {
        return draw.multisample.sample_mask != 0xffffffffU || draw.multisample.shader_mask;
    });
}

bool is_in_layers(const View& view, std::string_view) {
    return view.of().target.layers > 1 && !view.sample.writers.empty();
}

template <cases::ProvokingVertex convention>
bool is_provoked_by(const View& view, std::string_view) {
    return any_writing_draw(view,
                            [](const cases::Draw& draw) { return draw.provoking == convention; });
}

template <cases::ComponentKind kind>
bool is_stored_as(const View& view, std::string_view) {
    const std::optional<cases::ColorTarget>& color = view.of().target.color;
    return color && cases::row_of(color->format).kind == kind && !view.sample.writers.empty();
}

bool is_blended(const View& view, std::string_view) {
    return view.of().target.color && any_writing_draw(view, [](const cases::Draw& draw) {
               return draw.color.blend.has_value();
           });
}

bool is_write_masked(const View& view, std::string_view) {
    return view.of().target.color && any_writing_draw(view, [](const cases::Draw& draw) {
               return draw.color.write_mask != 0xf;
           });
}

bool is_written(const View& view, std::string_view) {
    return !view.sample.writers.empty();
}

bool is_counted_by_stencil(const View& view, std::string_view) {
    return view.of().target.has_stencil && !view.sample.hits.empty();
}

template <auto... modes>
bool is_resolved(const View& view, std::string_view) {
    const cases::Target& target = view.of().target;
    return ((target.color_resolve == modes || target.depth_resolve == modes) || ...) &&
           !view.sample.writers.empty();
}

template <cases::RelationKind kind>
bool is_repeated(const View& view, std::string_view) {
    return !view.sample.hits.empty() &&
           std::ranges::any_of(view.of().relations,
                               [](const cases::Relation& r) { return r.kind == kind; });
}

// The case without what a rule is about.

void move_samples_to_centre(cases::Case& c) {
    c.target.sample_locations.assign(c.target.samples, {8, 8});
}

void toggle_depth_clip(cases::Case& c) {
    for (cases::Draw& draw : c.draws) {
        draw.depth.clip = !draw.depth.clip.value_or(!draw.depth.clamp);
    }
}

void toggle_volume(cases::Case& c) {
    for (cases::Draw& draw : c.draws) {
        draw.depth.negative_one_to_one = !draw.depth.negative_one_to_one;
    }
}

void compare_always(cases::Case& c) {
    for (cases::Draw& draw : c.draws) {
        draw.depth.compare = cases::CompareOp::always;
    }
}

bool is_nearest(const cases::Blit& blit) {
    return blit.filter == cases::BlitFilter::nearest;
}
bool is_linear(const cases::Blit& blit) {
    return blit.filter == cases::BlitFilter::linear;
}
bool is_any(const cases::Blit&) {
    return true;
}

using Test = bool (*)(const View&, std::string_view);
constexpr Way at(Profile profile, Test test) {
    return {.profile = profile, .test = test};
}
constexpr Way at_all(Test test) {
    return at(Profile::direct3d, test);
}
constexpr Way without(void (*take_away)(cases::Case&)) {
    return {.take_away = take_away};
}
constexpr Way kInside{.texels = Way::Texels::inside};
constexpr Way kOutside{.texels = Way::Texels::outside};
constexpr auto kPractice = Profile::practice;
constexpr auto kVulkan = Profile::vulkan;

using cases::ComponentKind;
using cases::ProvokingVertex;
using cases::RelationKind;
using cases::Resolve;

constexpr std::string_view kOfValue = "that shows a value of this kind";
constexpr std::string_view kKept = "that a triangle is kept from by it alone, or passes it";
constexpr std::string_view kOfRelation = "that may be covered, in a case with this relation";

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
    {rule::face_area_sign,
     "that shows a face, whichever way the vertices snap",
     {at_all(has_known_facing)}},
    {rule::face_cull, kKept, {at_all(passes_culling), at_all(is_kept_away)}},
    {rule::discard_rasterizer, "that a discarded draw would cover", {at_all(is_kept_away)}},
    {rule::clip_volume,
     "of a triangle that leaves the volume or touches a depth plane, or of what is clipped away",
     {at_all(reaches_volume), at_all(is_kept_away)}},
    {rule::clip_viewport,
     "of a triangle that crosses the viewport's border, within it or beyond",
     {at_all(crosses_border), at_all(is_kept_away)}},
    {rule::layer_select,
     "that is drawn in one of several layers, or would be in another",
     {at_all(is_in_layers), at_all(is_kept_away)}},
    {rule::clip_depth,
     "that would be drawn otherwise with the other state of the depth planes",
     {without(toggle_depth_clip), without(toggle_volume)}},
    {rule::clip_distance, kKept, {at_all(passes_clip_distance), at_all(is_kept_away)}},
    {rule::clip_complement,
     "that a triangle and its complement share out",
     {at(kVulkan, is_in_set), at(kPractice, is_in_set), at_all(is_in_set)}},
    {rule::cull_distance, kKept, {at_all(passes_cull_distance), at_all(is_kept_away)}},
    {rule::number_undefined,
     "that may be covered, in a case with a bad number",
     {at_all(is_beside_bad_number)}},
    {rule::scissor_half_open, kKept, {at_all(is_inside_scissor), at_all(is_kept_away)}},
    {rule::sample_locations,
     "that its place in the pixel matters to",
     {without(move_samples_to_centre), at_all(is_at_sample)}},
    {rule::sample_mask, kKept, {at_all(passes_mask), at_all(is_kept_away)}},
    {rule::sample_mask_in, kOfValue, {at_all(has_value)}},
    {rule::sample_id, kOfValue, {at_all(has_value)}},
    {rule::sample_shading,
     "of a fragment that is shaded for several samples",
     {at_all(is_sample_shaded)}},
    {rule::interp_centroid, kOfValue, {at_all(has_value)}},
    {rule::interp_sample, kOfValue, {at_all(has_value)}},
    {rule::fragcoord_sample, kOfValue, {at_all(has_value)}},
    {rule::order_primitive, "that is written more than once", {at_all(is_overwritten)}},
    {rule::provoking_first,
     "of a draw with this convention",
     {at_all(is_provoked_by<ProvokingVertex::first>)}},
    {rule::provoking_last,
     "of a draw with this convention",
     {at_all(is_provoked_by<ProvokingVertex::last>)}},
    {rule::interp_linear, kOfValue, {at_all(has_value)}},
    {rule::interp_perspective, kOfValue, {at_all(has_value)}},
    {rule::interp_hull, "that shows an interpolated input", {at_all(has_interpolated)}},
    {rule::interp_flat, kOfValue, {at_all(has_value)}},
    {rule::fragcoord_xy, kOfValue, {at_all(has_value)}},
    {rule::fragcoord_w, kOfValue, {at_all(has_value)}},
    {rule::store_unorm, "of a target of this kind", {at_all(is_stored_as<ComponentKind::unorm>)}},
    {rule::store_srgb, "of a target of this kind", {at_all(is_stored_as<ComponentKind::srgb>)}},
    {rule::store_half, "of a target of this kind", {at_all(is_stored_as<ComponentKind::half>)}},
    {rule::store_float,
     "of a target of this kind",
     {at_all(is_stored_as<ComponentKind::binary32>)}},
    {rule::store_integer, "of a target of this kind", {at_all(is_stored_as<ComponentKind::uint>)}},
    {rule::blend_equation, "of a draw that blends", {at_all(is_blended)}},
    {rule::blend_write_mask, "of a draw that masks a component", {at_all(is_write_masked)}},
    {rule::write_consistent, "that a triangle may write", {at_all(is_written)}},
    {rule::write_outside, "that a triangle may write", {at_all(is_written)}},
    {rule::depth_linear, kOfValue, {at_all(has_value)}},
    {rule::repeat_same, kOfRelation, {at_all(is_repeated<RelationKind::same_twice>)}},
    {rule::repeat_scissor, kOfRelation, {at_all(is_repeated<RelationKind::scissor_tiles>)}},
    {rule::repeat_clears, kOfRelation, {at_all(is_repeated<RelationKind::other_clears>)}},
    {rule::repeat_write_masks, kOfRelation, {at_all(is_repeated<RelationKind::write_masks>)}},
    {rule::repeat_attachments,
     kOfRelation,
     {at_all(is_repeated<RelationKind::fewer_attributes>),
      at_all(is_repeated<RelationKind::more_attributes>)}},
    {rule::depth_store, "of a target with fixed-point depth", {at_all(is_depth_rounded)}},
    {rule::depth_bias, "of a draw with a bias", {at_all(is_biased)}},
    {rule::depth_distinct,
     "where the depth test is decided by planes that are r apart",
     {at_all(is_compared)}},
    {rule::depth_clamp, "whose depth is clamped", {at_all(is_clamped)}},
    {rule::depth_compare,
     "where the depth test is decided by the numbers compared",
     {at_all(is_compared), without(compare_always)}},
    {rule::depth_repeat,
     "where the depth test is decided by a triangle being equal to itself",
     {at_all(is_compared)}},
    {rule::depth_write, "where a fragment's depth is not stored", {at_all(is_depth_kept)}},
    {rule::interp_at_offset, kOfValue, {at_all(has_value)}},
    {rule::interp_at_sample, kOfValue, {at_all(has_value)}},
    {rule::interp_at_centroid, kOfValue, {at_all(has_value)}},
    {rule::derivative_fine, kOfValue, {at_all(has_value)}},
    {rule::derivative_coarse, kOfValue, {at_all(has_value)}},
    {rule::derivative_plain, kOfValue, {at_all(has_value)}},
    {rule::lod_query, kOfValue, {at_all(has_value)}},
    {rule::stencil_count, "that may be hit, with a stencil", {at_all(is_counted_by_stencil)}},
    {rule::resolve_select,
     "of a pixel that is drawn to and resolved so",
     {at_all(is_resolved<Resolve::sample_zero, Resolve::min, Resolve::max>)}},
    {rule::resolve_average,
     "of a pixel that is drawn to and resolved so",
     {at_all(is_resolved<Resolve::average>)}},
    {rule::barycentric_value, kOfValue, {at_all(has_value)}},
    {rule::barycentric_order, "that shows barycentric coordinates", {at_all(has_barycentric)}},
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
