// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fragment_depth.hpp"

#include <bit>
#include <cmath>

namespace histories {

namespace {

using cases::Profile;

// Depths of triangles that lie less far apart may be computed to lie in any order: those of scenes
// are equal or 1/256 apart, and at profile vulkan they may be off by 1/1000.
constexpr double kNear = 1.0 / 400;

bool has_same_plane(const Triangle& a, const Triangle& b) {
    return corners_of(a) == corners_of(b) && is_same(a.z0, b.z0) && is_same(a.slope, b.slope) &&
           is_same(a.x0, b.x0);
}

// One triangle, drawn with the same state but for tests, masks and what colours do.
bool is_repeat(const Depth& a, const Depth& b) {
    const Draw &first = *a.draw, &second = *b.draw;
    return has_same_plane(*a.triangle, *b.triangle) &&
           first.has_wide_viewport == second.has_wide_viewport &&
           first.culls_front == second.culls_front && first.culls_back == second.culls_back &&
           first.clockwise == second.clockwise && first.layer == second.layer &&
           first.scissor == second.scissor && first.discard == Discard::none &&
           second.discard == Discard::none && first.early == second.early &&
           first.sample_mask == second.sample_mask && first.shader_mask == second.shader_mask &&
           first.has_sample_shading == second.has_sample_shading &&
           first.alpha_to_coverage == second.alpha_to_coverage &&
           first.alpha_to_one == second.alpha_to_one &&
           first.frag_depth.has_value() == second.frag_depth.has_value();
}

}  // namespace

double stored_depth(const Scene& scene, double depth) {
    const DepthFormat format = scene.depth.value_or(DepthFormat::d32);
    if (format == DepthFormat::d32) {
        return static_cast<float>(depth);
    }
    const double all = format == DepthFormat::d24 ? 16777215 : 65535;
    return std::nearbyint(depth * all) / all;
}

double depth_at(const Triangle& triangle, double x) {
    return triangle.z0 + triangle.slope * (x - triangle.x0);
}

Depth computed_depth(const Scene& scene, const Draw& draw, const Triangle& triangle,
                     const Place& place, const Freedom& freedom) {
    const double number = depth_at(triangle, place.at_x);
    double computed = number;
    if (!is_same(triangle.slope, 0)) {
        uint64_t hash = freedom.seed;
        for (const double part :
             {triangle.z0, triangle.slope, triangle.x0, triangle.shape.edge,
              static_cast<double>(triangle.shape.cut), triangle.shape.is_beyond ? 1.0 : 2.0,
              triangle.is_reversed ? 1.0 : 2.0, place.at_x, place.at_y}) {
            hash = (hash ^ std::bit_cast<uint64_t>(part)) * 0x9e3779b97f4a7c15U;
            hash ^= hash >> 29;
        }
        const double error = freedom.profile == Profile::vulkan ? 0x1p-14 : 0x1p-24;
        computed += (static_cast<double>(hash % 3) - 1) * error;
    }
    return {number, stored_depth(scene, computed), false, &draw, &triangle};
}

uint8_t relations(const Scene& scene, const Freedom& freedom, const Depth& a, const Depth& b) {
    if (freedom.is_device) {
        return a.computed < b.computed ? kLess : a.computed > b.computed ? kGreater : kEqual;
    }
    if (std::abs(a.number - b.number) >= kNear) {
        return a.number < b.number ? kLess : kGreater;
    }
    const bool is_float = scene.depth.value_or(DepthFormat::d32) == DepthFormat::d32;
    const bool is_end =
        is_same(a.number, b.number) && (is_same(a.number, 0) || is_same(a.number, 1));
    if (a.triangle != nullptr && b.triangle != nullptr && is_repeat(a, b)) {
        // Write masks have no part in what a fragment is, by the text, and tests none by its
        // suggestion.
        const Profile since = !is_float ? Profile::direct3d
                              : a.draw->compare == b.draw->compare && !a.draw->stencil &&
                                      !b.draw->stencil && !a.draw->bounds && !b.draw->bounds &&
                                      scene.colors.empty()
                                  ? Profile::vulkan
                                  : Profile::practice;
        if (freedom.profile >= since) {
            return kEqual;
        }
    }
    return a.is_exact && b.is_exact && (is_float || is_end) ? kEqual : kAlways;
}

}  // namespace histories
