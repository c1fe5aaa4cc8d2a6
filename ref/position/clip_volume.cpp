// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/position/clip_volume.hpp"

#include <algorithm>
#include <cmath>

namespace ref {

ClipVolume clip_volume_of(const cases::Draw& draw) {
    ClipVolume v;
    const auto add = [&v](ClipPlane plane) { v.planes[v.count++] = plane; };
    add(ClipPlane::x_low);
    add(ClipPlane::x_high);
    add(ClipPlane::y_low);
    add(ClipPlane::y_high);
    // "depthClipEnable ... otherwise the inverse of depthClampEnable".
    if (draw.depth.clip.value_or(!draw.depth.clamp)) {
        add(draw.depth.negative_one_to_one ? ClipPlane::z_low_symmetric : ClipPlane::z_low);
        add(ClipPlane::z_high);
    }
    v.view_count = v.count;
    for (uint32_t k = 0; k < draw.distances.clip_count; ++k) {
        add(static_cast<ClipPlane>(static_cast<uint32_t>(ClipPlane::user_0) + k));
    }
    return v;
}

ClipInput::ClipInput(const cases::Draw& draw, const std::array<uint32_t, 3>& vertex)
    : distance_count(draw.distances.clip_count) {
    for (size_t i = 0; i < 3; ++i) {
        clip[i] = draw.positions[vertex[i]];
        if (distance_count > 0) {
            distance[i] = draw.distances.clip[vertex[i]];
        }
    }
}

bool is_inside(const glm::vec4& clip, std::span<const ClipPlane> planes) {
    ClipInput input;
    input.clip[0] = clip;
    return is_inside(input, 0, planes);
}

PlaneSide plane_side(const ClipInput& triangle, size_t i, ClipPlane plane) {
    const glm::vec4& clip = triangle.clip[i];
    switch (plane) {
        case ClipPlane::x_low:
            return {clip.x, -clip.w};
        case ClipPlane::x_high:
            return {clip.w, clip.x};
        case ClipPlane::y_low:
            return {clip.y, -clip.w};
        case ClipPlane::y_high:
            return {clip.w, clip.y};
        case ClipPlane::z_low:
            return {clip.z, 0};
        case ClipPlane::z_high:
            return {clip.w, clip.z};
        case ClipPlane::z_low_symmetric:
            return {clip.z, -clip.w};
        default:
            return {triangle.distance[i][static_cast<glm::vec4::length_type>(user_index(plane))],
                    0};
    }
}

bool is_inside(const ClipInput& triangle, size_t i, std::span<const ClipPlane> planes) {
    const glm::vec4& clip = triangle.clip[i];
    if (!std::isfinite(clip.x) || !std::isfinite(clip.y) || !std::isfinite(clip.z) ||
        !std::isfinite(clip.w)) {
        return false;
    }
    return std::all_of(planes.begin(), planes.end(), [&](ClipPlane plane) {
        const PlaneSide side = plane_side(triangle, i, plane);
        return side.value >= side.bound;
    });
}

bool is_inside(const ClipInput& triangle, std::span<const ClipPlane> planes) {
    return is_inside(triangle, 0, planes) && is_inside(triangle, 1, planes) &&
           is_inside(triangle, 2, planes);
}

bool is_trivially_outside(const std::array<glm::vec4, 3>& triangle,
                          std::span<const ClipPlane> planes) {
    return std::any_of(planes.begin(), planes.end(), [&](ClipPlane plane) {
        return !is_user(plane) &&
               std::none_of(triangle.begin(), triangle.end(), [&](const glm::vec4& v) {
                   return is_inside(v, {&plane, 1});
               });
    });
}

}  // namespace ref
