// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The part of a draw that works on vertices and whole triangles: projection, facing, culling.
#pragma once

#include <array>
#include <cstdint>

#include "rasterizers/software/assembly.hpp"
#include "rasterizers/software/clipper.hpp"
#include "rasterizers/software/planes.hpp"

namespace software {

class VertexStage {
  public:
    // Keeps references.
    VertexStage(const cases::Draw& draw, const Device& device) : draw_(draw), device_(device) {}

    // The corners of a triangle before clipping.
    std::array<ClipVertex, 3> triangle_of(const Primitive& primitive);
    WindowVertex project(const ClipVertex& v) const;
    bool is_front(int64_t area, const std::array<ClipVertex, 3>& whole) const;
    bool is_culled(bool front) const;
    bool is_distance_culled(const Primitive& primitive) const;

  private:
    uint32_t cached_vertex(uint32_t v);
    glm::vec4 distances_of(uint32_t v, const Primitive& primitive, size_t k) const;
    // Which of the three weights the corner k of a primitive has.
    size_t barycentric_of(const Primitive& primitive, size_t k) const;

    const cases::Draw& draw_;
    const Device& device_;
    std::array<uint32_t, 32> vertex_cache_ = [] {
        std::array<uint32_t, 32> empty{};
        empty.fill(UINT32_MAX);
        return empty;
    }();
};

}  // namespace software
