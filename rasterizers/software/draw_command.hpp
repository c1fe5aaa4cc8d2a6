// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "rasterizers/software/fragment_stage.hpp"
#include "rasterizers/software/pieces.hpp"
#include "rasterizers/software/vertex_stage.hpp"

namespace software {

// One draw of a case onto the capture: from its primitives to the samples that they cover.
class DrawCommand {
  public:
    DrawCommand(const cases::Case& c, uint32_t number, const Device& device, capture::Capture& out,
                Attachments& attachments);

    void run();

  private:
    // Clips a triangle, and draws what is left of it.
    void rasterize(const Primitive& primitive);
    void rasterize_polygon(const Primitive& primitive, const std::array<ClipVertex, 3>& whole,
                           std::vector<WindowVertex> polygon, const ClippedPolygon& clipped);
    void rasterize_line(const Facet& facet, const std::vector<WindowVertex>& v);
    // The planes of all pieces of a polygon; null if each has its own.
    std::unique_ptr<TrianglePlanes> common_planes(const std::array<ClipVertex, 3>& whole,
                                                  const ClippedPolygon& clipped, bool positive);
    std::unique_ptr<TrianglePlanes> planes_in_viewport(const std::array<ClipVertex, 3>& whole,
                                                       bool positive) const;
    // Each sample of each piece.
    void cover_pieces(const Facet& facet, Pieces& pieces);
    // Each sample once, whatever the pieces overlap.
    void cover_by_winding(const Facet& facet, Pieces& pieces);
    // Of a conservative draw.
    void cover_areas(const Facet& facet, Pieces& pieces);
    void cover_area(const Facet& facet, const TrianglePlanes& planes,
                    const std::vector<WindowVertex>& polygon);
    void cover_degenerate(const Primitive& primitive, const std::vector<WindowVertex>& polygon,
                          const ClippedPolygon& clipped);
    // Which way it faces is to be told.
    Facet facet_of(const Primitive& primitive, const WindowVertex& first,
                   const std::vector<WindowVertex>& polygon, const ClippedPolygon& clipped) const;

    const cases::Draw draw_;
    uint32_t number_;
    const Device& device_;
    capture::Capture& out_;
    Attachments& attachments_;
    PixelRect rect_;
    VertexStage vertices_;
    FragmentStage fragments_;
    std::map<std::pair<int64_t, int64_t>, uint32_t> owners_;  // of pixels, where a fault has them
    // Where a fault takes planes of the last polygon with the same first vertex.
    std::unique_ptr<TrianglePlanes> cached_planes_;
    uint32_t cached_source_ = 0;
    uint32_t culled_ = 0;  // triangles so far
};

}  // namespace software
