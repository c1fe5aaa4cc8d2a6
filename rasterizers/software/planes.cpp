// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/planes.hpp"

#include <bit>
#include <cmath>

namespace software {

namespace {

// 1/x from a table of 12 bits.
float reciprocal_12(float x) {
    return std::bit_cast<float>(std::bit_cast<uint32_t>(1.0F / x) & 0xfffff800U);
}

}  // namespace

TrianglePlanes::TrianglePlanes(const std::array<WindowVertex, 3>& v, bool positive,
                               const cases::Draw& draw, const Device& device)
    : device_(device), draw_(draw) {
    const float unit = std::ldexp(1.0F, -device.subpixel_bits);
    const auto place = [&](bool snapped) {
        for (size_t k = 0; k < 3; ++k) {
            x_[k] = snapped ? static_cast<float>(v[k].sx) * unit : v[k].x;
            y_[k] = snapped ? static_cast<float>(v[k].sy) * unit : v[k].y;
        }
        const float det = (x_[1] - x_[0]) * (y_[2] - y_[0]) - (x_[2] - x_[0]) * (y_[1] - y_[0]);
        inverse_area_ =
            device.fault == "reciprocal-area-12-bits"_fault ? reciprocal_12(det) : 1.0F / det;
        return positive ? det > 0 : det < 0;
    };
    // Where snapping has turned a sliver over, or a vertex that was cut off onto the line of the
    // others, only the other positions have the triangle's area.
    const auto set_up_from = [&](bool is_snapped) {
        if (!place(is_snapped) && !place(!is_snapped)) {
            place(true);
            if (!std::isfinite(inverse_area_)) {
                inverse_area_ = 0;  // of no area at all: the first vertex's values everywhere
            }
        }
    };
    const bool is_snapped = device.basis == PlaneBasis::snapped;
    set_up_from(device.depth_has_other_basis ? !is_snapped : is_snapped);
    depth_ = make({v[0].z, v[1].z, v[2].z});
    set_up_from(is_snapped);
    inverse_w_ = make({v[0].inv_w, v[1].inv_w, v[2].inv_w});
    depth_over_w_ = make({v[0].z * v[0].inv_w, v[1].z * v[1].inv_w, v[2].z * v[2].inv_w});
    for (uint32_t k = 0; k < draw.distances.clip_count; ++k) {
        const auto c = static_cast<glm::vec4::length_type>(k);
        distances_[k] = make({v[0].distance[c] * v[0].inv_w, v[1].distance[c] * v[1].inv_w,
                              v[2].distance[c] * v[2].inv_w});
    }
    for (size_t a = 0; a < draw.attributes.size(); ++a) {
        const bool linear = is_linear(a);
        for (int k = 0; k < 4; ++k) {
            std::array<float, 3> g{};
            for (size_t n = 0; n < 3; ++n) {
                const float value = v[n].values[a][k];
                g[n] = linear ? value : value * v[n].inv_w;
            }
            attributes_[a][static_cast<size_t>(k)] = make(g);
        }
    }
}

bool TrianglePlanes::is_linear(size_t a) const {
    if (device_.fault == "affine"_fault) {
        return true;
    }
    if (draw_.attributes[a].interpolation == cases::Interpolation::noperspective) {
        return device_.fault != "noperspective-smooth"_fault;
    }
    return false;
}

float TrianglePlanes::mad(float a, float b, float c) const {
    const bool is_other = device_.fault == "depth-by-shader"_fault && !draw_.attributes.empty();
    return device_.fused != is_other ? std::fma(a, b, c) : a * b + c;
}

TrianglePlanes::Plane TrianglePlanes::make(const std::array<float, 3>& g) const {
    Plane plane;
    plane.g = g;
    const float x1 = x_[1] - x_[0];
    const float y1 = y_[1] - y_[0];
    const float x2 = x_[2] - x_[0];
    const float y2 = y_[2] - y_[0];
    const float g1 = g[1] - g[0];
    const float g2 = g[2] - g[0];
    plane.dadx = mad(g1, y2, -(g2 * y1)) * inverse_area_;
    plane.dady = mad(g2, x1, -(g1 * x2)) * inverse_area_;
    plane.a0 = g[0];
    if (device_.fault == "plane-origin-far"_fault) {
        plane.a0 = g[0] - mad(plane.dadx, x_[0] + 0x1p14F, plane.dady * (y_[0] + 0x1p14F));
        return plane;
    }
    if (device_.planes == PlaneForm::origin) {
        plane.a0 = g[0] - mad(plane.dadx, x_[0], plane.dady * y_[0]);
    }
    return plane;
}

// Twice the areas opposite to the vertices, over twice the area of the triangle.
std::array<float, 3> TrianglePlanes::weights(float x, float y) const {
    std::array<float, 3> b{};
    for (size_t k = 0; k < 3; ++k) {
        const size_t m = (k + 1) % 3;
        const size_t n = (k + 2) % 3;
        b[k] = mad(x_[m] - x, y_[n] - y, -((x_[n] - x) * (y_[m] - y))) * inverse_area_;
    }
    return b;
}

float TrianglePlanes::at(const Plane& plane, float x, float y) const {
    if (device_.fault == "weights-8-bits"_fault) {
        const std::array<float, 3> b = weights(x, y);
        const float b1 = std::nearbyint(b[1] * 256) / 256;
        const float b2 = std::nearbyint(b[2] * 256) / 256;
        return plane.g[0] + b1 * (plane.g[1] - plane.g[0]) + b2 * (plane.g[2] - plane.g[0]);
    }
    if (device_.fault == "values-stepped"_fault) {
        float value = plane.a0 + plane.dady * y + plane.dadx * 0.5F;
        for (float step = 0.5F; step + 1 <= x; step += 1) {
            value += plane.dadx;
        }
        return value;
    }
    if (device_.fault == "plane-origin-far"_fault) {
        return mad(y + 0x1p14F, plane.dady, mad(x + 0x1p14F, plane.dadx, plane.a0));
    }
    switch (device_.planes) {
        case PlaneForm::origin:
            return mad(y, plane.dady, mad(x, plane.dadx, plane.a0));
        case PlaneForm::vertex:
            return mad(y - y_[0], plane.dady, mad(x - x_[0], plane.dadx, plane.a0));
        case PlaneForm::barycentric:
            break;
    }
    const std::array<float, 3> b = weights(x, y);
    return mad(b[2], plane.g[2], mad(b[1], plane.g[1], b[0] * plane.g[0]));
}

float TrianglePlanes::depth(float x, float y) const {
    if (device_.fault == "depth-perspective"_fault) {
        return at(depth_over_w_, x, y) / at(inverse_w_, x, y);
    }
    return at(depth_, x, y);
}

float TrianglePlanes::inverse_w(float x, float y) const {
    return at(inverse_w_, x, y);
}

float TrianglePlanes::distance(int k, float x, float y) const {
    return at(distances_[static_cast<size_t>(k)], x, y);
}

glm::vec4 TrianglePlanes::attribute(size_t a, float x, float y) const {
    glm::vec4 value;
    for (int k = 0; k < 4; ++k) {
        value[k] = at(attributes_[a][static_cast<size_t>(k)], x, y);
    }
    if (is_linear(a)) {
        return value;
    }
    float denominator_x = x;
    if (device_.fault == "perspective-spans"_fault) {
        denominator_x = std::floor(x / 8) * 8 + 0.5F;
    }
    const float denominator = at(inverse_w_, denominator_x, y);
    for (int k = 0; k < 4; ++k) {
        value[k] = device_.fault == "reciprocal-12-bits"_fault
                       ? value[k] * reciprocal_12(denominator)
                       : value[k] / denominator;
    }
    return value;
}

}  // namespace software
