// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/clipper.hpp"

#include <cmath>

namespace software {

namespace {

// band * w + sign * coordinate >= 0, or coordinate >= 0 if band is 0; or a clip distance.
struct Plane {
    int coordinate;
    float sign;
    float band;
    bool is_user = false;
};

float distance(const Plane& plane, const ClipVertex& v) {
    return plane.is_user ? plane.sign * v.distance[plane.coordinate]
                         : plane.band * v.position.w + plane.sign * v.position[plane.coordinate];
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
    if (device.fault == "clip-none"_fault) {
        return {};
    }
    float band_x = 1;
    float band_y = 1;
    if (device.clip == ClipMethod::guard_band || device.fault == "clip-band-unscissored"_fault) {
        band_x = guard_band(draw.viewport.width, draw.viewport.x);
        band_y = guard_band(draw.viewport.height, draw.viewport.y);
    }
    std::vector<Plane> planes{{0, 1, band_x}, {0, -1, band_x}, {1, 1, band_y}, {1, -1, band_y}};
    const bool clips_depth =
        draw.depth.clip.value_or(!draw.depth.clamp) || device.fault == "depth-clamp-clips"_fault;
    const bool is_symmetric =
        draw.depth.negative_one_to_one && device.fault != "depth-volume-ignored"_fault;
    if (clips_depth && device.fault != "clip-no-near"_fault) {
        planes.push_back({2, 1, is_symmetric ? 1.0F : 0.0F});
    }
    if (clips_depth && device.fault != "clip-no-far"_fault) {
        planes.push_back({2, -1, 1});
    }
    if (tests_distances(device)) {
        return planes;
    }
    auto count = static_cast<int>(draw.distances.clip_count);
    if (device.fault == "distance-last-ignored"_fault && count > 0) {
        --count;
    }
    for (int k = 0; k < count; ++k) {
        planes.push_back({k, device.fault == "distance-flipped"_fault ? -1.0F : 1.0F, 0, true});
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

bool is_zero(float w) {
    return std::fpclassify(w) == FP_ZERO;
}

// What is linear in clip space of a value that is linear on screen: the value times w. A cut at
// w = 0, where such a value has no bound, holds that in its place, until a later cut takes it away.
glm::vec4 times_w(const glm::vec4& value, float w) {
    return is_zero(w) ? value : value * w;
}

ClipVertex cut(const ClipVertex& from, const ClipVertex& to, const Plane& plane,
               const cases::Draw& draw, const Device& device) {
    const float d_from = distance(plane, from);
    const float d_to = distance(plane, to);
    float t = d_from / (d_from - d_to);
    if ((plane.is_user && device.fault == "distance-reversed"_fault) ||
        (!plane.is_user && device.fault == "clip-reversed"_fault)) {
        t = 1 - t;
    }
    if (plane.is_user && device.fault == "distance-linear"_fault) {
        // The point whose distance is 0 if distances are linear on screen.
        t = t * from.position.w / (t * from.position.w + (1 - t) * to.position.w);
    }
    ClipVertex out;
    out.position = mix(from.position, to.position, t, device.fused);
    out.distance = mix(from.distance, to.distance, t, device.fused);
    if (plane.is_user) {
        out.distance[plane.coordinate] = 0;
    } else {
        out.position[plane.coordinate] = -plane.sign * plane.band * out.position.w;
    }
    out.source = from.source;
    // The weight of `to` on screen: linear there means weights proportional to w.
    const float t_screen = t * to.position.w / out.position.w;
    for (size_t a = 0; a < draw.attributes.size(); ++a) {
        const auto mode = draw.attributes[a].interpolation;
        const bool is_linear = mode == cases::Interpolation::noperspective ||
                               device.fault == "clip-screen-linear"_fault;
        if (mode == cases::Interpolation::flat || device.fault == "clip-copies-value"_fault) {
            out.values[a] = from.values[a];
        } else if (is_linear && (is_zero(from.position.w) || is_zero(to.position.w) ||
                                 is_zero(out.position.w))) {
            const glm::vec4 scaled = mix(times_w(from.values[a], from.position.w),
                                         times_w(to.values[a], to.position.w), t, device.fused);
            out.values[a] = is_zero(out.position.w) ? scaled : scaled / out.position.w;
        } else {
            out.values[a] =
                mix(from.values[a], to.values[a], is_linear ? t_screen : t, device.fused);
        }
    }
    return out;
}

// An order of positions.
bool is_first(const glm::vec4& a, const glm::vec4& b) {
    for (int k = 0; k < 4; ++k) {
        if (a[k] < b[k] || a[k] > b[k]) {
            return a[k] < b[k];
        }
    }
    return true;
}

}  // namespace

bool tests_distances(const Device& device) {
    return device.tests_distances || device.fault == "distance-plane-twice"_fault ||
           device.fault == "distance-plane-never"_fault;
}

ClippedPolygon clip_triangle(const std::array<ClipVertex, 3>& triangle, const cases::Draw& draw,
                             const Device& device) {
    ClippedPolygon polygon{{triangle.begin(), triangle.end()}, false};
    for (const Plane& plane : planes_of(draw, device)) {
        const auto is_beyond = [&](const ClipVertex& v) { return distance(plane, v) < 0; };
        if (!plane.is_user && plane.coordinate == 2 && device.tests_depth &&
            std::ranges::all_of(triangle, [](const ClipVertex& v) { return v.position.w > 0; }) &&
            !std::ranges::all_of(triangle, is_beyond)) {
            const bool is_cut = std::ranges::any_of(triangle, is_beyond);
            polygon.tests_depth = polygon.tests_depth || is_cut;
            continue;
        }
        std::vector<ClipVertex> kept;
        const size_t count = polygon.vertices.size();
        for (size_t k = 0; k < count; ++k) {
            const ClipVertex& a = polygon.vertices[k];
            const ClipVertex& b = polygon.vertices[(k + 1) % count];
            const bool is_open = plane.is_user && device.fault == "distance-zero-outside"_fault;
            const auto is_inside = [&](const ClipVertex& v) {
                return is_open ? distance(plane, v) > 0 : distance(plane, v) >= 0;
            };
            const bool a_inside = is_inside(a);
            const bool b_inside = is_inside(b);
            if (a_inside) {
                kept.push_back(a);
            } else {
                polygon.was_cut = true;
            }
            if (a_inside != b_inside) {
                // By a clip distance from the same end whichever side is kept, so that negated
                // distances give the same point.
                const bool from_a = plane.is_user ? is_first(a.position, b.position)
                                                  : a_inside || device.fault == "clip-seam"_fault;
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
    if (device.fault == "clip-rejects-any"_fault && polygon.was_cut) {
        polygon.vertices.clear();
    }
    return polygon;
}

}  // namespace software
