// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>

#include "cases/model/case.hpp"
#include "rasterizers/software/choice/device.hpp"
#include "rasterizers/software/clipper.hpp"

namespace software {

// A vertex in framebuffer coordinates.
struct WindowVertex {
    float x = 0, y = 0;      // pixels
    float z = 0;             // depth
    float inv_w = 0;         // 1/w_c
    float w = 1;             // w_c
    int64_t sx = 0, sy = 0;  // snapped, in units of 2^-subpixel_bits pixel
    Values values{};
    uint32_t source = 0;
    glm::vec4 distance{};  // clip distances
};

// The values of one triangle as functions of framebuffer coordinates, binary32 throughout.
class TrianglePlanes {
  public:
    // `positive` is the sign of the snapped area; unsnapped positions of another sign would give
    // planes of the wrong triangle and are replaced by the snapped ones.
    TrianglePlanes(const std::array<WindowVertex, 3>& v, bool positive, const cases::Draw& draw,
                   const Device& device);

    // Depth at (x, y).
    float depth(float x, float y) const;
    // Its gradients.
    float depth_dx() const { return depth_.dadx; }
    float depth_dy() const { return depth_.dady; }
    // 1/w at (x, y).
    float inverse_w(float x, float y) const;
    // Numerator of clip distance k at (x, y): its sign is the distance's.
    float distance(int k, float x, float y) const;
    // Attribute a at (x, y); not for flat ones.
    glm::vec4 attribute(size_t a, float x, float y) const;

  private:
    struct Plane {
        std::array<float, 3> g{};          // vertex values
        float a0 = 0, dadx = 0, dady = 0;  // a0 at the anchor
    };
    Plane make(const std::array<float, 3>& g) const;
    float at(const Plane& plane, float x, float y) const;
    float mad(float a, float b, float c) const;
    std::array<float, 3> weights(float x, float y) const;
    bool is_linear(size_t a) const;

    const Device& device_;
    const cases::Draw& draw_;
    std::array<float, 3> x_{}, y_{};
    float inverse_area_ = 0;
    Plane depth_, inverse_w_, depth_over_w_;
    std::array<Plane, 4> distances_;
    std::array<std::array<Plane, 4>, cases::kMaxAttributes> attributes_;
};

}  // namespace software
