// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "rasterizers/software/assembly.hpp"
#include "rasterizers/software/choice/device.hpp"
#include "rasterizers/software/clipper.hpp"
#include "rasterizers/software/multisample.hpp"
#include "rasterizers/software/planes.hpp"
#include "rasterizers/software/target/blend_unit.hpp"
#include "rasterizers/software/target/query_unit.hpp"
#include "rasterizers/software/target/resolve_unit.hpp"
#include "rasterizers/software/target/stencil_unit.hpp"
#include "rasterizers/software/tiles.hpp"

namespace software {

// Attachments that are written in drawing order, beside the capture's own planes.
struct Attachments {
    ColorAttachment color;
    StencilAttachment stencil;
    QueryUnit queries;
};

// One draw of a case onto the capture.
class DrawCommand {
  public:
    DrawCommand(const cases::Case& c, uint32_t number, const Device& device, capture::Capture& out,
                Attachments& attachments);

    void run();

  private:
    void rasterize(const Primitive& primitive);
    uint32_t cached_vertex(uint32_t v);
    void rasterize_polygon(const Primitive& primitive, const std::array<ClipVertex, 3>& whole,
                           std::vector<WindowVertex> polygon, bool was_cut);
    void rasterize_line(const Primitive& primitive, std::vector<WindowVertex>& v);
    // Of a conservative draw (draw_area.cpp).
    void cover_area(const Primitive& primitive, const TrianglePlanes& planes,
                    const std::vector<WindowVertex>& polygon, const WindowVertex& first,
                    bool front);
    void cover_degenerate(const Primitive& primitive, const std::vector<WindowVertex>& polygon);
    WindowVertex project(const ClipVertex& v) const;
    std::unique_ptr<TrianglePlanes> planes_in_viewport(const std::array<ClipVertex, 3>& whole,
                                                       bool positive) const;
    bool is_front(int64_t area, const std::array<ClipVertex, 3>& whole) const;
    bool is_culled(bool front) const;
    bool is_distance_culled(const Primitive& primitive) const;
    bool is_distance_clipped(const TrianglePlanes& planes, int64_t i, int64_t j, uint32_t s) const;
    // At a place of the framebuffer.
    bool is_depth_clipped(const TrianglePlanes& planes, float x, float y) const;
    glm::vec4 distances_of(uint32_t v, const Primitive& primitive, size_t k) const;
    bool inside_viewport(double x, double y) const;
    bool is_before_scissor(int64_t i, int64_t j, uint32_t s) const;
    // Sample s of pixel (i,j) is covered: with several samples or pixels the fragment waits until
    // all of its samples are known.
    void cover(const Primitive& primitive, const TrianglePlanes& planes, const WindowVertex& first,
               bool front, int64_t i, int64_t j, uint32_t s);
    void shade_covered(const Primitive& primitive, const WindowVertex& first, bool front);
    void shade(const Primitive& primitive, const TrianglePlanes& planes, const WindowVertex& first,
               bool front, int64_t i, int64_t j, uint32_t s, uint32_t covered);
    // The same in one layer of the target.
    bool is_discarded(const TrianglePlanes& planes, const WindowVertex& first,
                      const Invocation& invocation, int64_t i, int64_t j, uint32_t s,
                      bool front) const;
    bool is_negative(const TrianglePlanes& planes, const WindowVertex& first,
                     const Invocation& invocation, int64_t i, int64_t j) const;
    glm::vec4 attribute_value(const TrianglePlanes& planes, const WindowVertex& first,
                              const Invocation& invocation, size_t a, int64_t i, int64_t j) const;
    std::optional<float> written_depth(const TrianglePlanes& planes, const Invocation& invocation,
                                       int64_t i, int64_t j, uint32_t s) const;
    bool is_in_bounds(float z, size_t at) const;
    void shade_in(uint32_t layer, const Primitive& primitive, const TrianglePlanes& planes,
                  const WindowVertex& first, bool front, int64_t i, int64_t j, uint32_t s,
                  uint32_t covered);
    void shade_coarse(const Primitive& primitive, const WindowVertex& first, bool front);
    size_t index_in(uint32_t layer, int64_t i, int64_t j, uint32_t s) const;
    void write_color(size_t at, uint32_t primitive);
    // Whether alpha to coverage leaves sample s out.
    bool is_left_out_by_alpha(const TrianglePlanes& planes, const WindowVertex& first,
                              const Invocation& invocation, int64_t i, int64_t j, uint32_t s) const;

    const cases::Draw draw_;
    uint32_t number_;
    cases::Discard first_discard_;  // of the first draw,
    bool first_alpha_to_coverage_;
    std::optional<cases::DepthBounds> first_bounds_;  // as these
    std::optional<cases::FragDepth> first_depth_;
    std::vector<float> other_depth_;  // what faults of the depth bounds take for the stored one
    const Device& device_;
    capture::Capture& out_;
    Attachments& attachments_;
    PixelRect rect_;
    std::vector<SampleOffset> samples_;
    // Samples of the fragments of the triangle at hand: by pixel (row first) and planes.
    std::map<std::tuple<int64_t, int64_t, const TrianglePlanes*>, uint32_t> covered_;
    // The same of fragments of several pixels, by their first one; and that which is shaded.
    std::map<std::tuple<int64_t, int64_t, const TrianglePlanes*>, CoarseFragment> coarse_;
    const CoarseFragment* shaded_ = nullptr;
    std::map<std::pair<int64_t, int64_t>, uint32_t> owners_;  // of pixels, where a fault has them
    std::unique_ptr<TrianglePlanes> cached_planes_;
    WindowVertex cached_first_;
    uint32_t culled_ = 0;       // triangles so far
    float largest_z_ = 0;       // of the polygon being drawn
    bool tests_depth_ = false;  // the primitive's samples are tested by depth
    std::array<uint32_t, 32> vertex_cache_ = [] {
        std::array<uint32_t, 32> empty{};
        empty.fill(UINT32_MAX);
        return empty;
    }();
};

}  // namespace software
