// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Derives the positions that a device may use for a vertex from its clip-space quadruple.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <glm/vec4.hpp>
#include <optional>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "ref/number/edge_function.hpp"
#include "ref/number/fixed_point.hpp"
#include "ref/position/limits.hpp"

namespace ref {

// The exact framebuffer position of a vertex, which needs w != 0 and finite components. Source:
// Vulkan specification, "Controlling the Viewport" (x_f = p_x/2 x_d + o_x, ...).
struct IdealPosition {
    mpq_class x, y;   // pixels
    mpq_class z;      // z_f = p_z z_d + o_z
    mpq_class inv_w;  // 1/w_c
};
IdealPosition ideal_position(const glm::vec4& clip, const cases::Viewport& viewport);

// True if every component is finite and w > 0.
bool is_projectable(const glm::vec4& clip);

// False if a component is NaN, infinite, or so large that the profile promises nothing of a
// triangle with this vertex, not even that it stays inside the viewport: beyond 2^32 at profile
// vulkan (the magnitude that floating-point values must be able to have), beyond FLT_MAX/16
// otherwise (Direct3D 11.3, 15.4: up to there clipping, division and viewport never make NaN or
// infinity).
bool is_representable(const glm::vec4& clip, cases::Profile profile);

// False if the vertex is no longer one of which the profile can ask something: Vulkan guarantees a
// largest magnitude of 2^32 only ("Floating-Point Computation": "at least 2^32"), so at profile
// vulkan 1/w, x/w, y/w and z/w must stay within it. A vertex with w = 0 has no quotients and is
// left to clipping. Other profiles have the range of binary32. Components must be finite.
bool is_in_guaranteed_range(const glm::vec4& clip, cases::Profile profile);

// Bound on |computed - ideal| of x_f and y_f in pixels for a binary32 evaluation of divide and
// viewport transform; 0 if every step is exact in binary32. The derivation stands in position.cpp.
struct TransformError {
    mpq_class x, y;
};
TransformError transform_error(const glm::vec4& clip, const cases::Viewport& viewport);
// A power of two whose reciprocal is normal as well: the biased exponent is neither of the two
// least nor of the three largest. A product with 1/w is exact.
bool is_power_of_two(float w);
// Whether the bound is 0 for a coordinate c, of a viewport from `origin` on, `extent` pixels long.
bool is_transform_exact(float c, float w, float origin, float extent);

// A closed box of positions, S47.16.
struct Box {
    int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool is_point() const { return x0 == x1 && y0 == y1; }
    friend bool operator==(const Box&, const Box&) = default;
};

// Gives the smallest box around two.
inline Box hull_of(const Box& a, const Box& b) {
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

// Holds the corners of a box, each once.
class BoxCorners {
  public:
    explicit BoxCorners(const Box& b) {
        for (const int64_t x : {b.x0, b.x1}) {
            for (const int64_t y : {b.y0, b.y1}) {
                if (std::find(begin(), end(), FixedPoint{x, y}) == end()) {
                    points_[count_++] = {x, y};
                }
            }
        }
    }
    const FixedPoint* begin() const { return points_.data(); }
    const FixedPoint* end() const { return points_.data() + count_; }
    size_t size() const { return count_; }

  private:
    std::array<FixedPoint, 4> points_;
    size_t count_ = 0;
};

// Calls body(a, b, c) for every choice of a point of each list.
template <class Points, class Body>
void for_each_choice(const Points& a_points, const Points& b_points, const Points& c_points,
                     const Body& body) {
    for (const FixedPoint& a : a_points) {
        for (const FixedPoint& b : b_points) {
            for (const FixedPoint& c : c_points) {
                body(a, b, c);
            }
        }
    }
}

// The least and the largest twice the area, signed, of the triangles with one vertex in each box:
// the area is affine in each position, so that its extremes lie at corners.
struct AreaRange {
    Int128 low = 0, high = 0;
};
AreaRange area_range(const Box& a, const Box& b, const Box& c);

// The box of positions that a device may use for a vertex under a profile (docs/design.md,
// "Positions"; docs/rules.md, snap.nearest):
//   direct3d  hull of the subpixel grid points within 0.6 subpixels (plus the transform error) of
//             the ideal position;
//   practice  floor..ceil of the ideal position (widened by the transform error) on the subpixel
//             grid;
//   vulkan    the same, widened before it is snapped by what operations accurate to 1e-5 may be
//             off: 1e-5 (4 |p/2 x_d| + |o| + 2 |x_f| + 1) and higher orders. A vertex on the grid
//             has at least one grid point more on either side: nothing says which way a computed
//             value just beside it is snapped. So samples on or within a unit of an edge that no
//             triangle shares are open.
// There is none if a coordinate's magnitude exceeds 2^32 pixels, or the vertex is beyond the range
// that the profile guarantees (is_in_guaranteed_range).
std::optional<Box> position_box(const glm::vec4& clip, const cases::Viewport& viewport,
                                const Limits& limits, cases::Profile profile);

// The ideal position rounded to the nearest subpixel grid point, ties to even; none beyond 2^32.
std::optional<FixedPoint> snap_nearest(const glm::vec4& clip, const cases::Viewport& viewport,
                                       const Limits& limits);

}  // namespace ref
