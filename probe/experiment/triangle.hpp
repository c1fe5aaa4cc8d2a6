// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A triangle in the framebuffer as a rasterizer sets it up, in binary64: its own rounding, some
// 2^-50, is far below what the experiments tell apart.
#pragma once

#include <array>
#include <cmath>

#include "probe/base/scene.hpp"
#include "probe/experiment/snapping.hpp"

namespace probe {

struct Point {
    double x = 0, y = 0;
};
using Points = std::array<Point, 3>;

inline double doubled_area(const Points& p) {
    return (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
}
// Adds a triangle of corners that are made anew until twice its area is at least this large.
template <class MakeCorner>
void add_triangle(Scene& scene, double doubled, MakeCorner corner) {
    std::array<Corner, 3> c;
    do {
        c = {corner(0), corner(1), corner(2)};
    } while (std::fabs(doubled_area({{{c[0].x, c[0].y}, {c[1].x, c[1].y}, {c[2].x, c[2].y}}})) <
             doubled);
    scene.add(c[0], c[1], c[2]);
}
// The barycentric coordinates of a point [Vulkan, "Basic Polygon Rasterization"].
inline std::array<double, 3> barycentrics(const Points& p, const Point& at) {
    const double area = doubled_area(p);
    return {doubled_area({at, p[1], p[2]}) / area, doubled_area({p[0], at, p[2]}) / area,
            doubled_area({p[0], p[1], at}) / area};
}
// sum b_i g_i, and the quotient of sum b_i g_i / w_i and sum b_i / w_i [ibid., equations of
// "linear" and "perspective" interpolation].
inline double linear(const std::array<double, 3>& b, const std::array<double, 3>& g) {
    return b[0] * g[0] + b[1] * g[1] + b[2] * g[2];
}
inline double perspective(const std::array<double, 3>& b, const std::array<double, 3>& g,
                          const std::array<double, 3>& w) {
    const std::array<double, 3> over{b[0] / w[0], b[1] / w[1], b[2] / w[2]};
    return linear(over, g) / (over[0] + over[1] + over[2]);
}

// Where a position of clip space lies in the framebuffer.
inline Point in_framebuffer(const glm::vec4& p, const cases::Viewport& v) {
    const auto at = [](float x, float w, float low, float size) {
        const double half = static_cast<double>(size) / 2;
        return static_cast<double>(x) / static_cast<double>(w) * half + static_cast<double>(low) +
               half;
    };
    return {at(p.x, p.w, v.x, v.width), at(p.y, p.w, v.y, v.height)};
}
inline Point snapped(const Point& p, const Grid& grid) {
    return {ref::pixels(grid.x(fixed(p.x))), ref::pixels(grid.y(fixed(p.y)))};
}
inline Points snapped(const Points& p, const Grid& grid) {
    return {snapped(p[0], grid), snapped(p[1], grid), snapped(p[2], grid)};
}

}  // namespace probe
