// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/set_ups.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "cases/model/sample.hpp"

namespace ref::value {

using cases::Profile;

namespace {

constexpr size_t kKeptTriangles = 16384;

// Whether two coordinates are not provably the same.
bool is_other(const Ball& a, const Ball& b) {
    return std::fabs(a.v - b.v) > 0 || a.e > std::fabs(a.v) * 0x1p-40;
}

// Whether the fragment has an input whose place depends on the samples that it covers.
bool has_centroid_places(const Fragment& f) {
    return (f.target->samples > 1 || has_large_fragments(*f.draw)) && has_centroid(*f.draw);
}

// Holds all points that may be asked for: they lie in pixels that the triangle reaches, and in the
// target, or in fragments that have some of their pixels there.
PixelBox box_of(const Primitive& primitive, const cases::Target& target) {
    const double beyond = cases::has_large_fragments(*primitive.draw) ? cases::kMaxFragmentSide : 0;
    const double margin = 2 + beyond;
    PixelBox box{0, 0, target.width + beyond, target.height + beyond};
    if (!primitive.is_projectable) {
        return box;
    }
    const auto v = ideal_vertices<Ball>(primitive);
    const auto shrink = [&](const Triple<Ball>& h, double& low, double& high) {
        const auto [least, most] =
            std::minmax({h[0].v / v.w[0].v, h[1].v / v.w[1].v, h[2].v / v.w[2].v});
        low = std::max(low, std::floor(least) - margin);
        high = std::min(high, std::ceil(most) + margin);
    };
    shrink(v.hx, box.low_x, box.high_x);
    shrink(v.hy, box.low_y, box.high_y);
    return box;
}

}  // namespace

bool is_plain_depth(const Primitive& primitive) {
    const cases::DepthState& depth = primitive.draw->depth;
    return primitive.depth_format == cases::DepthFormat::d32_float && !depth.bias && !depth.clamp &&
           !replaces_depth(*primitive.draw);
}

float provoking_value(const Primitive& primitive, const QuantityId& id) {
    const auto component = static_cast<glm::vec4::length_type>(id.component);
    return primitive.draw->attributes[id.attribute].values[primitive.triangle.provoking][component];
}

SetUps::SetUps(const cases::Case& c, const Limits& limits, Profile profile)
    : case_(c), limits_(limits), profile_(profile), triangles_(assemble(c)) {
    for (const cases::Draw& draw : c.draws) {
        quantities_.push_back(value::quantities(draw, c.target));
    }
    loaded_.resize(triangles_.size());
}

SetUps::Loaded& SetUps::load(uint32_t t) {
    std::unique_ptr<Loaded>& slot = loaded_[t];
    if (slot) {
        return *slot;
    }
    slot = std::make_unique<Loaded>();
    // Samples come row by row: what was not asked for longest is not asked for soon.
    order_.push_back(t);
    if (order_.size() > kKeptTriangles) {
        loaded_[order_.front()].reset();
        order_.pop_front();
    }
    slot->primitive = make_primitive(case_, triangles_[t], limits_);
    return *slot;
}

const Filters& SetUps::filters(uint32_t t) {
    Loaded& slot = load(t);
    if (slot.filters) {
        return *slot.filters;
    }
    const auto inputs = plane_inputs<Ball>(slot.primitive, quantities_of(t));
    const auto ideal = ideal_vertices<Ball>(slot.primitive);
    Filters& filters = slot.filters.emplace();
    filters.unsnapped = make_filter(make_basis(ideal, inputs, kBudgetFactor));
    if (const auto at = snapped_positions(slot.primitive, limits_)) {
        const auto moved = moved_vertices<Ball>(slot.primitive, *at);
        if (!std::ranges::equal(moved.hx, ideal.hx, std::not_fn(is_other)) ||
            !std::ranges::equal(moved.hy, ideal.hy, std::not_fn(is_other))) {
            filters.snapped = make_filter(make_basis(moved, inputs, kBudgetFactor));
        }
    }
    return filters;
}

const Promise& SetUps::promise(uint32_t t, size_t index) {
    Loaded& triangle = load(t);
    if (!triangle.promises) {
        triangle.promises = promises_of(triangle.primitive, quantities_of(t));
    }
    return (*triangle.promises)[index];
}

bool SetUps::is_asked(uint32_t t, size_t index, Profile at) {
    const Promise& of = promise(t, index);
    return of.is_number && (at != Profile::vulkan || of.is_guaranteed);
}

std::optional<size_t> SetUps::asked_plane(uint32_t t, const QuantityId& id) {
    const std::vector<Quantity>& all = quantities_of(t);
    const auto found = std::ranges::find(all, id, &Quantity::id);
    const auto index = static_cast<size_t>(found - all.begin());
    return found != all.end() && is_numeric(*found) && is_asked(t, index, profile_)
               ? std::optional(index)
               : std::nullopt;
}

FragmentCoverage& SetUps::coverage_at(Profile at) {
    auto& slot = coverage_.at(static_cast<size_t>(at));
    if (!slot) {
        slot = std::make_unique<FragmentCoverage>(case_, limits_, at, triangles_);
    }
    return *slot;
}

Fragment SetUps::fragment(uint32_t t, cases::SampleId id, Profile at, bool is_exact) {
    Fragment f = covered_fragment(t, id, at, is_exact);
    if (at != Profile::direct3d && has_centroid_places(f)) {
        f.region = coverage_at(at).region(t, id.x, id.y);
    }
    return f;
}

Fragment SetUps::covered_fragment(uint32_t t, cases::SampleId id, Profile at, bool is_exact) {
    Fragment f;
    f.id = id;
    f.target = &case_.target;
    f.draw = &case_.draws[draw_of(t)];
    f.block = cases::fragment_block(*f.draw, id.x, id.y);
    const bool has_mask = std::ranges::find(quantities_of(t), Kind::sample_mask, &Quantity::kind) !=
                          quantities_of(t).end();
    if (has_mask || has_centroid_places(f)) {
        FragmentCoverage& cover = coverage_at(at);
        f.coverage = is_exact ? cover.exact(t, id.x, id.y) : cover.of(t, id.x, id.y);
    }
    return f;
}

const std::vector<Evaluation<Ball>>& SetUps::kept_places(uint32_t t, cases::SampleId id) {
    return places_.get({t, id}, [&] { return places<Ball>(t, id, profile_); });
}

ProbePlace SetUps::probe_place(uint32_t t, cases::SampleId id, Profile at) const {
    return {id, &case_.target, &case_.draws[draw_of(t)], limits_, at};
}

const SetBounds& SetUps::bounds(uint32_t t, Profile at) {
    Loaded& triangle = load(t);
    std::optional<SetBounds>& slot = triangle.bounds.at(static_cast<size_t>(at));
    if (!slot) {
        slot.emplace(candidates<Ball>(t, at), box_of(triangle.primitive, case_.target));
    }
    return *slot;
}

}  // namespace ref::value
