// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A device's clipper for the tests.
#pragma once

#include <algorithm>
#include <array>
#include <glm/vec4.hpp>
#include <utility>
#include <vector>

#include "ref/position/clip.hpp"

namespace ref::test {

using Triple = std::array<glm::vec4, 3>;

// A clipper in binary32: the order of the planes and the end that a cut starts from are its own.
struct FloatVertex {
    glm::vec4 p{};
    EdgeLabel edge = 0;
};
inline float float_distance(const glm::vec4& p, ClipPlane plane) {
    switch (plane) {
        case ClipPlane::x_low:
            return p.w + p.x;
        case ClipPlane::x_high:
            return p.w - p.x;
        case ClipPlane::y_low:
            return p.w + p.y;
        case ClipPlane::y_high:
            return p.w - p.y;
        case ClipPlane::z_low:
            return p.z;
        case ClipPlane::z_high:
            return p.w - p.z;
        default:
            break;  // no plane of the default view volume
    }
    return 0;
}
inline glm::vec4 float_cut(glm::vec4 a, glm::vec4 b, ClipPlane plane, int style) {
    if (style == 1) {
        std::swap(a, b);
    }
    const float da = float_distance(a, plane);
    const float db = float_distance(b, plane);
    const float t = da / (da - db);
    if (style == 2) {
        return (1 - t) * a + t * b;
    }
    return a + t * (b - a);
}
inline std::vector<FloatVertex> float_clip(const Triple& t, bool is_depth_first, int style) {
    std::vector<FloatVertex> polygon{{t[0], 0}, {t[1], 1}, {t[2], 2}};
    std::vector<ClipPlane> order(std::begin(kViewVolume), std::end(kViewVolume));
    if (is_depth_first) {
        std::rotate(order.begin(), order.begin() + 4, order.end());
    }
    for (const ClipPlane plane : order) {
        std::vector<FloatVertex> out;
        const auto label = static_cast<EdgeLabel>(kFirstClipEdge + static_cast<int>(plane));
        for (size_t i = 0; i < polygon.size(); ++i) {
            const FloatVertex& a = polygon[i];
            const FloatVertex& b = polygon[(i + 1) % polygon.size()];
            const bool is_a_in = float_distance(a.p, plane) >= 0;
            const bool is_b_in = float_distance(b.p, plane) >= 0;
            if (is_a_in) {
                out.push_back(a);
            }
            if (is_a_in != is_b_in) {
                out.push_back({float_cut(a.p, b.p, plane, style), is_a_in ? label : a.edge});
            }
        }
        polygon = out;
    }
    return polygon;
}

}  // namespace ref::test
