// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/vertex_stage.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "rasterizers/software/snapping.hpp"

namespace software {

// Turned so that the provoking vertex is the first, or the last.
size_t VertexStage::barycentric_of(const Primitive& primitive, size_t k) const {
    const auto provoking = static_cast<size_t>(
        std::ranges::find(primitive.vertex, primitive.provoking) - primitive.vertex.begin());
    size_t turn = draw_.provoking == cases::ProvokingVertex::last ? 2 : 3;
    turn += device_.fault == "barycentric-rotated"_fault ? 1 : 0;
    const bool keeps_order =
        device_.first_strip_order && turn == 2 && draw_.topology == cases::Topology::triangle_strip;
    return keeps_order ? k : (k + 3 - provoking + turn) % 3;
}

std::array<ClipVertex, 3> VertexStage::triangle_of(const Primitive& primitive) {
    std::array<ClipVertex, 3> triangle;
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t v = cached_vertex(primitive.vertex[k]);
        const uint32_t value_vertex = cached_vertex(primitive.values[k]);
        triangle[k].position = draw_.positions[v];
        triangle[k].source = v;
        triangle[k].distance = distances_of(v, primitive, k);
        for (size_t a = 0; a < draw_.attributes.size(); ++a) {
            const cases::Attribute& attribute = draw_.attributes[a];
            const bool flat = attribute.interpolation == cases::Interpolation::flat &&
                              device_.fault != "flat-smooth"_fault &&
                              device_.fault != "clip-flat-piece"_fault;
            if (attribute.source == cases::Source::barycentric) {
                const auto number =
                    static_cast<glm::vec4::length_type>(barycentric_of(primitive, k));
                triangle[k].values[a][number] = 1;
            }
            if (attribute.source == cases::Source::vertex) {
                triangle[k].values[a] = attribute.values[flat ? primitive.provoking : value_vertex];
            }
        }
    }
    return triangle;
}

WindowVertex VertexStage::project(const ClipVertex& v) const {
    const auto mad = [&](float a, float b, float c) {
        return device_.fused ? std::fma(a, b, c) : a * b + c;
    };
    const glm::vec4& p = v.position;
    const cases::Viewport& view = draw_.viewport;
    WindowVertex out;
    out.values = v.values;
    out.source = v.source;
    out.distance = v.distance;
    out.w = p.w;
    out.inv_w = 1.0F / p.w;
    float inverse = out.inv_w;
    if (device_.near_reciprocal && (std::bit_cast<uint32_t>(p.w) & 1U) != 0) {
        inverse = std::nextafter(inverse, 0.0F);
    }
    const bool is_multiplied = device_.reciprocal_w || device_.near_reciprocal;
    const auto divide = [&](float a) { return is_multiplied ? a * inverse : a / p.w; };
    const auto place = [&](float a, float scale, float offset) {
        return device_.scales_first ? divide(a * scale) + offset : mad(divide(a), scale, offset);
    };

    float height = view.height;
    float top = view.y;
    if (device_.fault == "height-sign-ignored"_fault && height < 0) {
        top += height;
        height = -height;
    }
    out.x = place(p.x, view.width * 0.5F, view.x + view.width * 0.5F);
    out.y = place(p.y, height * 0.5F, top + height * 0.5F);
    out.z = mad(divide(p.z), view.max_depth - view.min_depth, view.min_depth);
    if (draw_.depth.negative_one_to_one && device_.fault != "depth-scale-ignored"_fault) {
        out.z = mad(divide(p.z), (view.max_depth - view.min_depth) * 0.5F,
                    (view.max_depth + view.min_depth) * 0.5F);
    }
    switch (device_.fault) {
        case "depth-range-ignored"_fault:
            out.z = divide(p.z);
            break;
        case "depth-before-divide"_fault:
            out.z = mad(p.z, view.max_depth - view.min_depth, view.min_depth);
            break;
        case "half-pixel-shift"_fault:
            out.x += 0.5F;
            out.y += 0.5F;
            break;
        case "viewport-nudge"_fault:
            out.x += 0x1p-8F;
            break;
        case "position-half"_fault:
            out.x = to_half_precision(out.x);
            out.y = to_half_precision(out.y);
            break;
        default:
            break;
    }
    out.sx = to_fixed(out.x, device_);
    out.sy = to_fixed(out.y, device_);
    return out;
}

bool VertexStage::is_front(int64_t area, const std::array<ClipVertex, 3>& whole) const {
    bool clockwise = area > 0;
    if (device_.fault == "face-unclipped-w"_fault) {
        int negative = 0;
        for (const ClipVertex& v : whole) {
            negative += v.position.w < 0 ? 1 : 0;
        }
        clockwise = clockwise != (negative % 2 == 1);
    }
    const bool front = clockwise == (draw_.front_face == cases::FrontFace::clockwise);
    return device_.fault == "front-face-inverted"_fault ? !front : front;
}

bool VertexStage::is_culled(bool front) const {
    switch (draw_.cull) {
        case cases::CullMode::none:
            return false;
        case cases::CullMode::front:
            return device_.fault == "cull-inverted"_fault ? !front : front;
        case cases::CullMode::back:
            return device_.fault == "cull-inverted"_fault ? front : !front;
        case cases::CullMode::front_and_back:
            return true;
    }
    return false;
}

// Which vertex's data a reader of vertex v gets.
uint32_t VertexStage::cached_vertex(uint32_t v) {
    if (device_.fault != "vertex-cache-aliased"_fault) {
        return v;
    }
    uint32_t& entry = vertex_cache_[v % vertex_cache_.size()];
    if (entry == UINT32_MAX) {
        entry = v;
    }
    return entry;
}

// What the distances of vertex v are for a primitive.
glm::vec4 VertexStage::distances_of(uint32_t v, const Primitive& primitive, size_t k) const {
    const std::vector<glm::vec4>& all = draw_.distances.clip;
    if (all.empty()) {
        return glm::vec4(0.0F);
    }
    if (device_.fault == "distance-by-order"_fault) {
        // Right for lists without indices only.
        return all[(3 * size_t{primitive.id} + k) % all.size()];
    }
    const glm::vec4& d = all[v];
    return device_.fault == "distance-rotated"_fault ? glm::vec4(d.y, d.z, d.w, d.x) : d;
}

bool VertexStage::is_distance_culled(const Primitive& primitive) const {
    const cases::ClipDistances& d = draw_.distances;
    const auto is_out = [&](uint32_t v, uint32_t k) {
        const float c = d.cull[v][static_cast<glm::vec4::length_type>(k)];
        return device_.fault == "cull-distance-zero"_fault ? c <= 0 : c < 0;
    };
    bool is_mixed = d.cull_count > 0;
    for (const uint32_t v : primitive.vertex) {
        bool is_out_of_some = false;
        for (uint32_t k = 0; k < d.cull_count; ++k) {
            is_out_of_some = is_out_of_some || is_out(v, k);
        }
        is_mixed = is_mixed && is_out_of_some;
    }
    bool is_culled = false;
    for (uint32_t k = 0; k < d.cull_count; ++k) {
        const auto count =
            std::ranges::count_if(primitive.vertex, [&](uint32_t v) { return is_out(v, k); });
        switch (device_.fault) {
            case "cull-distance-any"_fault:
                is_culled = is_culled || count > 0;
                break;
            case "cull-distance-provoking"_fault:
                is_culled = is_culled || is_out(primitive.provoking, k);
                break;
            default:
                is_culled = is_culled || count == 3;
                break;
        }
    }
    if (device_.fault == "cull-distance-mixed"_fault) {
        return is_mixed;
    }
    return is_culled && device_.fault != "cull-distance-ignored"_fault;
}

}  // namespace software
