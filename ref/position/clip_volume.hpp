// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What lies in the view volume -w <= x <= w, -w <= y <= w, 0 <= z <= w (or -w <= z <= w) and in the
// half-spaces c_k >= 0 of the clip distances.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>

#include "cases/model/case.hpp"

namespace ref {

enum class ClipPlane : uint8_t {
    x_low,
    x_high,
    y_low,
    y_high,
    z_low,  // 0 <= z
    z_high,
    z_low_symmetric,  // -w <= z, VK_EXT_depth_clip_control
    user_0,           // clip distance 0, ...
    user_1,
    user_2,
    user_3
};
inline constexpr ClipPlane kViewVolume[] = {ClipPlane::x_low, ClipPlane::x_high,
                                            ClipPlane::y_low, ClipPlane::y_high,
                                            ClipPlane::z_low, ClipPlane::z_high};
inline bool is_user(ClipPlane plane) {
    return plane >= ClipPlane::user_0;
}
// The number of a clip distance's plane.
inline size_t user_index(ClipPlane plane) {
    return static_cast<size_t>(plane) - static_cast<size_t>(ClipPlane::user_0);
}
inline constexpr size_t kMaxUserPlanes = 4;
inline constexpr size_t kMaxPlanes = 6 + kMaxUserPlanes;
inline constexpr size_t kMaxClippedVertices = 3 + kMaxPlanes;  // each plane adds at most one

// The half-spaces whose intersection is the clip volume of a draw: the borders of the viewport,
// then near and far plane (none without depth clipping), then the clip distances.
struct ClipVolume {
    std::array<ClipPlane, kMaxPlanes> planes{};
    uint8_t view_count = 0, count = 0;

    std::span<const ClipPlane> all() const { return {planes.data(), count}; }
    std::span<const ClipPlane> view() const { return {planes.data(), view_count}; }
    std::span<const ClipPlane> borders() const { return view().first(4); }
    // Are the planes without the borders, by which a device with a guard band cuts.
    std::span<const ClipPlane> without_borders() const { return all().subspan(4); }
    std::span<const ClipPlane> depth() const { return view().subspan(4); }
    bool has_user_planes() const { return count > view_count; }
};
ClipVolume clip_volume_of(const cases::Draw& draw);

// What is clipped: positions and clip distances of three vertices.
struct ClipInput {
    std::array<glm::vec4, 3> clip{};
    std::array<glm::vec4, 3> distance{};  // component k of vertex i: distance k
    uint32_t distance_count = 0;

    ClipInput() = default;
    ClipInput(const std::array<glm::vec4, 3>& positions) : clip(positions) {}  // no distances
    ClipInput(const cases::Draw& draw, const std::array<uint32_t, 3>& vertex);
};

// True if all components are finite and the vertex lies in the closed view volume.
bool is_inside(const glm::vec4& clip, std::span<const ClipPlane> planes = kViewVolume);

// Vertex i is inside of a plane where `value` is no less than `bound`, and on it where they are
// equal: two numbers of the vertex, or their negatives, whose comparison is exact.
struct PlaneSide {
    float value = 0, bound = 0;
};
PlaneSide plane_side(const ClipInput& triangle, size_t i, ClipPlane plane);

// Says the same of vertex i, with clip distances.
bool is_inside(const ClipInput& triangle, size_t i, std::span<const ClipPlane> planes);

// The same of all three vertices: the planes cut nothing off.
bool is_inside(const ClipInput& triangle, std::span<const ClipPlane> planes);

// True if all three vertices lie strictly outside one and the same plane of the view volume (not a
// clip distance's, which a device may interpolate): nothing can be visible.
bool is_trivially_outside(const std::array<glm::vec4, 3>& triangle,
                          std::span<const ClipPlane> planes = kViewVolume);

}  // namespace ref
