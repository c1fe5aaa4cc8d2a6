// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Exact homogeneous clipping of one triangle against the view volume -w <= x <= w, -w <= y <= w,
// 0 <= z <= w (Vulkan specification, "Primitive Clipping"; Sutherland and Hodgman 1974).
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "cases/case.hpp"
#include "cases/profile.hpp"
#include "ref/position.hpp"

namespace ref {

enum class ClipPlane : uint8_t { x_low, x_high, y_low, y_high, z_low, z_high };
inline constexpr ClipPlane kViewVolume[] = {ClipPlane::x_low, ClipPlane::x_high,
                                            ClipPlane::y_low, ClipPlane::y_high,
                                            ClipPlane::z_low, ClipPlane::z_high};
inline constexpr ClipPlane kDepthPlanes[] = {ClipPlane::z_low, ClipPlane::z_high};
inline constexpr size_t kMaxClippedVertices = 9;  // each plane adds at most one

// The edge of the triangle (0: v0 v1, 1: v1 v2, 2: v2 v0), or kFirstClipEdge + plane.
using EdgeLabel = uint8_t;
inline constexpr EdgeLabel kFirstClipEdge = 3;

struct ClippedVertex {
    std::array<mpq_class, 3> weights;  // exact: clip position = sum weights[i] * triangle vertex i
    std::array<mpq_class, 4> clip;     // exact clip-space x, y, z, w
    IdealPosition position;            // exact framebuffer position; only if clip w > 0
    // Bound on |computed - exact| of the framebuffer position in pixels for arithmetic with the
    // unit roundoff of the profile (clip.cpp derives it); 0 for a vertex of the triangle, where
    // transform_error applies.
    TransformError error;
    bool is_bounded =
        true;            // false if no bound exists or w = 0: the device's vertex may be anywhere
    int original = -1;   // 0..2 if this is a vertex of the triangle
    EdgeLabel edge = 0;  // of the edge from this vertex to the next one
};

// True if all components are finite and the vertex lies in the closed view volume.
bool is_inside(const glm::vec4& clip, std::span<const ClipPlane> planes = kViewVolume);

// True if all three vertices lie strictly outside one and the same plane: nothing can be visible.
bool is_trivially_outside(const std::array<glm::vec4, 3>& triangle);

// The part of a triangle of finite vertices inside the planes, in the order of its vertices; empty
// if there is none. With profile vulkan errors are those of arithmetic accurate to 1 part in 10^5,
// otherwise those of binary32.
std::vector<ClippedVertex> clip_triangle(const std::array<glm::vec4, 3>& triangle,
                                         const cases::Viewport& viewport, cases::Profile profile,
                                         std::span<const ClipPlane> planes = kViewVolume);

}  // namespace ref
