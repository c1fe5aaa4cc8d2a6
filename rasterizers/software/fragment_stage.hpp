// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The part of a draw that works on samples: what is left of them, and what is written.
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "rasterizers/software/fragment_shader.hpp"
#include "rasterizers/software/target/blend_unit.hpp"
#include "rasterizers/software/target/query_unit.hpp"
#include "rasterizers/software/target/stencil_unit.hpp"

namespace software {

// Attachments that are written in drawing order, beside the capture's own planes.
struct Attachments {
    ColorAttachment color;
    StencilAttachment stencil;
    QueryUnit queries;
};

class FragmentStage {
  public:
    // Keeps references; of the case's draws this is number `number`.
    FragmentStage(const cases::Draw& draw, const cases::Case& c, uint32_t number,
                  const Device& device, const PixelRect& rect, capture::Capture& out,
                  Attachments& attachments);

    const std::vector<SampleOffset>& samples() const { return samples_; }
    // Whether what is at a place of the framebuffer is neither clipped nor beyond the viewport.
    bool is_seen(const Facet& facet, const TrianglePlanes& planes, double x, double y) const;
    // Sample s of pixel (i,j) is covered: with several samples or pixels the fragment waits until
    // all of its samples are known.
    void cover(const Facet& facet, const TrianglePlanes& planes, int64_t i, int64_t j, uint32_t s);
    // They are.
    void shade_covered(const Facet& facet);
    // Shades these samples of a pixel.
    void shade_pixel(const Facet& facet, const TrianglePlanes& planes, int64_t i, int64_t j,
                     uint32_t covered);

  private:
    struct Depths {
        float z = 0, own = 0, bias = 0;  // that is tested, that of the triangle, what it holds
    };
    bool inside_viewport(double x, double y) const;
    bool is_distance_clipped(const TrianglePlanes& planes, int64_t i, int64_t j, uint32_t s) const;
    bool is_depth_clipped(const Facet& facet, const TrianglePlanes& planes, float x, float y) const;
    bool is_before_scissor(double x, double y) const;
    void shade(Fragment fragment);
    void shade_in_layer(Fragment at);
    float plane_depth(const Fragment& at) const;
    Depths depths_of(const Fragment& at) const;
    bool is_in_bounds(float z, size_t at) const;
    Ending test(const Fragment& at, const Depths& depths, bool hidden);
    void show(const Fragment& at, float bias);
    void write_color(size_t at, uint32_t primitive);
    size_t index_in(uint32_t layer, const Fragment& at) const;

    const cases::Draw& draw_;
    uint32_t number_;
    const cases::Draw& first_;  // of the case's draws
    const Device& device_;
    PixelRect rect_;
    capture::Capture& out_;
    Attachments& attachments_;
    std::vector<SampleOffset> samples_;
    FragmentShader shader_;
    std::vector<float> other_depth_;  // what faults of the depth bounds take for the stored one
    // Samples of the fragments of the triangle at hand: by pixel (row first) and planes.
    std::map<std::tuple<int64_t, int64_t, const TrianglePlanes*>, uint32_t> covered_;
    // The same of fragments of several pixels, by their first one; and that which is shaded.
    std::map<std::tuple<int64_t, int64_t, const TrianglePlanes*>, CoarseFragment> coarse_;
    const CoarseFragment* shaded_ = nullptr;
};

}  // namespace software
