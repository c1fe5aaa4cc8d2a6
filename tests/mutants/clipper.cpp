// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "mutants/clipper.hpp"

#include <cmath>

namespace mutants {

namespace {

// band * w + sign * coordinate >= 0, or coordinate >= 0 if band is 0.
struct Plane {
    int coordinate;
    float sign;
    float band;
};

float distance(const Plane& plane, const glm::vec4& p) {
    return plane.band * p.w + plane.sign * p[plane.coordinate];
}

// The widest power of two that keeps window coordinates below 2^15 pixels.
float guard_band(float extent, float origin) {
    const float reach = std::fabs(extent) * 0.5F;
    float band = 1;
    while (band < 1024 && band * 2 * reach + std::fabs(origin) + reach < 0x1p15F) {
        band *= 2;
    }
    return band;
}

std::vector<Plane> planes_of(const cases::Draw& draw, const Device& device) {
    if (device.fault == Fault::clip_none) {
        return {};
    }
    float band_x = 1;
    float band_y = 1;
    if (device.clip == ClipMethod::guard_band || device.fault == Fault::clip_band_unscissored) {
        band_x = guard_band(draw.viewport.width, draw.viewport.x);
        band_y = guard_band(draw.viewport.height, draw.viewport.y);
    }
    std::vector<Plane> planes{{0, 1, band_x}, {0, -1, band_x}, {1, 1, band_y}, {1, -1, band_y}};
    const bool clips_depth = draw.depth.clip.value_or(!draw.depth.clamp) ||
                             device.fault == Fault::depth_clamp_clips;
    if (clips_depth && device.fault != Fault::clip_no_near) {
        planes.push_back({2, 1, 0});
    }
    if (clips_depth && device.fault != Fault::clip_no_far) {
        planes.push_back({2, -1, 1});
    }
    return planes;
}

glm::vec4 mix(const glm::vec4& a, const glm::vec4& b, float t, bool fused) {
    glm::vec4 out;
    for (int k = 0; k < 4; ++k) {
        out[k] = fused ? std::fma(t, b[k] - a[k], a[k]) : a[k] + t * (b[k] - a[k]);
    }
    return out;
}

ClipVertex cut(const ClipVertex& from, const ClipVertex& to, const Plane& plane,
               const cases::Draw& draw, const Device& device) {
    const float d_from = distance(plane, from.position);
    const float d_to = distance(plane, to.position);
    const float t = d_from / (d_from - d_to);
    ClipVertex out;
    out.position = mix(from.position, to.position, t, device.fused);
    out.position[plane.coordinate] = -plane.sign * plane.band * out.position.w;
    out.source = from.source;
    // The weight of `to` on screen: linear there means weights proportional to w.
    const float t_screen = t * to.position.w / out.position.w;
    for (size_t a = 0; a < draw.attributes.size(); ++a) {
        const auto mode = draw.attributes[a].interpolation;
        float weight = t;
        if (mode == cases::Interpolation::noperspective ||
            device.fault == Fault::clip_screen_linear) {
            weight = t_screen;
        }
        if (mode == cases::Interpolation::flat || device.fault == Fault::clip_copies_value) {
            out.values[a] = from.values[a];
        } else {
            out.values[a] = mix(from.values[a], to.values[a], weight, device.fused);
        }
    }
    return out;
}

}  // namespace

ClippedPolygon clip_triangle(const std::array<ClipVertex, 3>& triangle, const cases::Draw& draw,
                             const Device& device) {
    ClippedPolygon polygon{{triangle.begin(), triangle.end()}, false};
    for (const Plane& plane : planes_of(draw, device)) {
        std::vector<ClipVertex> kept;
        const size_t count = polygon.vertices.size();
        for (size_t k = 0; k < count; ++k) {
            const ClipVertex& a = polygon.vertices[k];
            const ClipVertex& b = polygon.vertices[(k + 1) % count];
            const bool a_inside = distance(plane, a.position) >= 0;
            const bool b_inside = distance(plane, b.position) >= 0;
            if (a_inside) {
                kept.push_back(a);
            } else {
                polygon.was_cut = true;
            }
            if (a_inside != b_inside) {
                const bool from_a = a_inside || device.fault == Fault::clip_seam;
                kept.push_back(from_a ? cut(a, b, plane, draw, device)
                                      : cut(b, a, plane, draw, device));
            }
        }
        polygon.vertices = std::move(kept);
        if (polygon.vertices.size() < 3) {
            polygon.vertices.clear();
            break;
        }
    }
    if (device.fault == Fault::clip_rejects_any && polygon.was_cut) {
        polygon.vertices.clear();
    }
    return polygon;
}

}  // namespace mutants
