// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Exact homogeneous clipping of one triangle against the clip volume (Vulkan specification,
// "Primitive Clipping"; Sutherland and Hodgman 1974).
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "ref/position/clip_volume.hpp"
#include "ref/position/position.hpp"

namespace ref {

// Names an edge of the triangle (0: v0 v1, 1: v1 v2, 2: v2 v0), or a plane by kFirstClipEdge + it.
using EdgeLabel = uint8_t;
inline constexpr EdgeLabel kFirstClipEdge = 3;

struct ClippedVertex {
    std::array<mpq_class, 3> weights;  // exact: clip position = sum weights[i] * triangle vertex i
    std::array<mpq_class, 4> clip;     // exact clip-space x, y, z, w
    // Exact framebuffer position, z as if the depth volume were 0..w; only if clip w > 0.
    IdealPosition position;
    // Bound on |computed - exact| of the framebuffer position in pixels for arithmetic with the
    // unit roundoff of the profile (clip.cpp derives it); 0 for a vertex of the triangle, where
    // transform_error applies.
    TransformError error;
    bool is_bounded =
        true;  // false if no bound exists or w = 0: the device's vertex may be anywhere
    // c_k / w of clip distance k, and what clipping may make of it; only if clip w > 0.
    std::vector<mpq_class> ratio, ratio_error;
    int original = -1;   // 0..2 if this is a vertex of the triangle
    EdgeLabel edge = 0;  // of the edge from this vertex to the next one
};

// The part of a triangle of finite vertices inside the planes, in the order of its vertices; empty
// if there is none. With profile vulkan errors are those of arithmetic accurate to 1 part in 10^5,
// otherwise those of binary32. `is_sure`: false if nothing is left, and a cut corner whose w may be
// 0 lies so near to the plane that takes it away that these errors might keep it: a device may have
// a polygon anywhere. What they might keep of other corners is as small as they are.
std::vector<ClippedVertex> clip_triangle(const ClipInput& triangle, const cases::Viewport& viewport,
                                         cases::Profile profile,
                                         std::span<const ClipPlane> planes = kViewVolume,
                                         bool* is_sure = nullptr);

}  // namespace ref
