// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The fragment shader of a draw: what it has of its inputs, discards and writes.
#pragma once

#include <glm/vec4.hpp>
#include <optional>
#include <span>

#include "cases/model/case.hpp"
#include "rasterizers/software/assembly.hpp"
#include "rasterizers/software/multisample.hpp"
#include "rasterizers/software/planes.hpp"

namespace software {

// What all fragments of a triangle, clipped or not, have in common.
struct Facet {
    const Primitive& primitive;
    const WindowVertex& first;  // of the polygon that is left: flat values
    bool front = false;
    float largest_z = 0;       // of that polygon
    bool tests_depth = false;  // its samples are tested by depth
    uint32_t id = 0;           // gl_PrimitiveID as the device counts
};

// A fragment at one sample.
struct Fragment {
    const Facet& facet;
    const TrianglePlanes& planes;
    int64_t i = 0, j = 0;
    uint32_t s = 0, covered = 0;  // the sample, and all of its pixel
    uint32_t layer = 0;
    Invocation invocation = {};
};

class FragmentShader {
  public:
    // Keeps references. `first`: of the case's draws.
    FragmentShader(const cases::Draw& draw, const cases::Draw& first, const cases::Target& target,
                   const Device& device, std::span<const SampleOffset> samples)
        : draw_(draw), first_(first), target_(target), device_(device), samples_(samples) {}

    // What it has of attribute a.
    glm::vec4 attribute_value(const Fragment& at, size_t a) const;
    bool is_discarded(const Fragment& at) const;
    // What it writes to gl_FragDepth, if that replaces the fragment's own depth.
    std::optional<float> written_depth(const Fragment& at) const;
    // Whether alpha to coverage leaves the sample out, by the alpha that it writes.
    bool is_left_out_by_alpha(const Fragment& at) const;
    // Where the sample is evaluated.
    Place sample_place(const Fragment& at) const;

  private:
    // Whether it discards by the sign of an attribute.
    bool is_negative(Fragment at) const;

    const cases::Draw& draw_;
    const cases::Draw& first_;
    const cases::Target& target_;
    const Device& device_;
    std::span<const SampleOffset> samples_;
};

}  // namespace software
