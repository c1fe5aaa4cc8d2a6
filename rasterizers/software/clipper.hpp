// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "cases/model/case.hpp"
#include "rasterizers/software/choice/device.hpp"

namespace software {

using Values = std::array<glm::vec4, cases::kMaxAttributes>;

// A vertex before the perspective division.
struct ClipVertex {
    glm::vec4 position{};
    Values values{};
    uint32_t source = 0;   // number of the vertex that it came from
    glm::vec4 distance{};  // clip distances
};

struct ClippedPolygon {
    std::vector<ClipVertex> vertices;  // fewer than three: nothing is left
    bool was_cut = false;
    bool tests_depth = false;  // not cut by the depth planes: samples beyond them have to go
};

// Sutherland-Hodgman in binary32 against the planes that the device clips to. A cut is computed
// from the inner towards the outer end point, so that two triangles get the same point on a shared
// edge, and put exactly onto its plane.
ClippedPolygon clip_triangle(const std::array<ClipVertex, 3>& triangle, const cases::Draw& draw,
                             const Device& device);

// Whether clip distances are interpolated and tested at each sample instead.
bool tests_distances(const Device& device);

}  // namespace software
