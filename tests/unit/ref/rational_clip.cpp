// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/ref/rational_clip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ref/number/rational.hpp"
#include "ref/position/position_detail.hpp"

namespace ref::test {

namespace {

constexpr size_t kX = 0, kY = 1, kZ = 2, kW = 3;

// Rounded up to a binary64, so that bounds stay short numbers.
mpq_class round_up(const mpq_class& q) {
    if (q == 0) {
        return q;
    }
    // get_d truncates.
    const double d = std::nextafter(q.get_d(), std::numeric_limits<double>::infinity());
    return std::isfinite(d) ? mpq_class(d) : q;
}

struct Work {
    ClippedVertex v;
    std::array<mpq_class, 4> error;  // of the clip coordinates
    // Clip distances are clipped like a fifth coordinate.
    std::vector<mpq_class> distance, distance_error;
};

// The component that a plane of the view volume bounds; the distance is w + c (low), w - c (high),
// z (z_low).
size_t component_of(ClipPlane plane) {
    return plane == ClipPlane::z_low_symmetric ? kZ : static_cast<size_t>(plane) / 2;
}

mpq_class distance(const Work& p, ClipPlane plane) {
    if (is_user(plane)) {
        return p.distance[user_index(plane)];
    }
    const std::array<mpq_class, 4>& clip = p.v.clip;
    switch (plane) {
        case ClipPlane::x_low:
        case ClipPlane::y_low:
        case ClipPlane::z_low_symmetric:
            return clip[kW] + clip[component_of(plane)];
        case ClipPlane::z_low:
            return clip[kZ];
        default:
            return clip[kW] - clip[component_of(plane)];
    }
}

mpq_class distance_error(const Work& p, const mpq_class& d, ClipPlane plane, const mpq_class& u) {
    if (is_user(plane)) {
        return p.distance_error[user_index(plane)];
    }
    if (plane == ClipPlane::z_low) {
        return p.error[kZ];
    }
    return (p.error[kW] + p.error[component_of(plane)] + u * abs(d)) * (1 + u);
}

Work cut(const Work& p1, const Work& p2, const mpq_class& d1, const mpq_class& d2, ClipPlane plane,
         const mpq_class& u) {
    Work out;
    const mpq_class span = abs(d1) + abs(d2);
    const mpq_class t = abs(d1) / span;
    const mpq_class rest = 1 - t;
    const mpq_class larger = std::max(t, rest);
    for (size_t i = 0; i < 3; ++i) {
        out.v.weights[i] = rest * p1.v.weights[i] + t * p2.v.weights[i];
    }
    const mpq_class eta1 = distance_error(p1, d1, plane, u);
    const mpq_class eta2 = distance_error(p2, d2, plane, u);
    const mpq_class sure = span - eta1 - eta2;
    out.v.is_bounded = p1.v.is_bounded && p2.v.is_bounded && sure > 0;
    mpq_class dt = 1;  // t stays in [0,1]
    if (out.v.is_bounded) {
        dt = std::min<mpq_class>(dt, (rest * eta1 + t * eta2) / sure + 4 * u * larger);
    }
    const auto interpolate = [&](const mpq_class& a, const mpq_class& b, const mpq_class& ea,
                                 const mpq_class& eb, mpq_class& value, mpq_class& error) {
        value = rest * a + t * b;
        const mpq_class difference = abs(b - a);
        const mpq_class rounding =
            2 * u * std::max<mpq_class>(larger * difference, rest * abs(a) + t * abs(b));
        const mpq_class own = dt * (difference + ea + eb) + rounding + u * abs(value);
        error = round_up(std::max(ea, eb) + own * (1 + 16 * u));
    };
    for (size_t c = 0; c < 4; ++c) {
        interpolate(p1.v.clip[c], p2.v.clip[c], p1.error[c], p2.error[c], out.v.clip[c],
                    out.error[c]);
    }
    out.distance.resize(p1.distance.size());
    out.distance_error.resize(p1.distance.size());
    for (size_t k = 0; k < p1.distance.size(); ++k) {
        interpolate(p1.distance[k], p2.distance[k], p1.distance_error[k], p2.distance_error[k],
                    out.distance[k], out.distance_error[k]);
    }
    return out;
}

// `d`: the vertices' distances from the plane.
std::vector<Work> clip_by(const std::vector<Work>& polygon, const std::vector<mpq_class>& d,
                          ClipPlane plane, const mpq_class& u) {
    std::vector<Work> out;
    const size_t n = polygon.size();
    out.reserve(n + 1);
    const auto label = static_cast<EdgeLabel>(kFirstClipEdge + static_cast<EdgeLabel>(plane));
    for (size_t i = 0; i < n; ++i) {
        const Work& a = polygon[i];
        const size_t next = (i + 1) % n;
        if (d[i] >= 0) {
            out.push_back(a);
            if (d[next] < 0) {
                if (d[i] == 0) {
                    out.back().v.edge = label;  // leaves at a itself
                } else {
                    out.push_back(cut(a, polygon[next], d[i], d[next], plane, u));
                    out.back().v.edge = label;
                }
            }
        } else if (d[next] > 0) {
            out.push_back(cut(a, polygon[next], d[i], d[next], plane, u));
            out.back().v.edge = a.v.edge;
        }
    }
    return out;
}

std::vector<Work> clip_in_order(const std::vector<Work>& triangle, std::span<const ClipPlane> order,
                                const mpq_class& u) {
    std::vector<Work> polygon = triangle;
    for (const ClipPlane plane : order) {
        if (polygon.empty()) {
            break;
        }
        // An earlier plane may have cut off all that is outside of this one.
        std::vector<mpq_class> d;
        d.reserve(polygon.size());
        for (const Work& p : polygon) {
            d.push_back(distance(p, plane));
        }
        if (std::any_of(d.begin(), d.end(), [](const mpq_class& each) { return each < 0; })) {
            polygon = clip_by(polygon, d, plane, u);
        }
    }
    return polygon;
}

// The planes that cut something off, in their order. All points of the polygon, which is exact, are
// convex combinations of the triangle's vertices: a plane with these inside has all of them inside.
std::vector<ClipPlane> cutting_planes(const ClipInput& triangle,
                                      std::span<const ClipPlane> planes) {
    std::vector<ClipPlane> out;
    for (const ClipPlane& plane : planes) {
        if (!is_inside(triangle, std::span(&plane, 1))) {
            out.push_back(plane);
        }
    }
    return out;
}

void raise(mpq_class& bound, const mpq_class& other) {
    if (bound < other) {
        bound = other;
    }
}

// Takes the larger bound of the vertex of `other` between the same two edges.
void widen_by(std::vector<Work>& polygon, const std::vector<Work>& other) {
    const size_t n = polygon.size();
    const size_t m = other.size();
    for (size_t i = 0; i < n; ++i) {
        Work& p = polygon[i];
        const EdgeLabel in = polygon[(i + n - 1) % n].v.edge;
        for (size_t k = 0; k < m; ++k) {
            if (other[k].v.edge != p.v.edge || other[(k + m - 1) % m].v.edge != in) {
                continue;
            }
            p.v.is_bounded = p.v.is_bounded && other[k].v.is_bounded;
            for (size_t c = 0; c < 4; ++c) {
                raise(p.error[c], other[k].error[c]);
            }
            for (size_t c = 0; c < p.distance_error.size(); ++c) {
                raise(p.distance_error[c], other[k].distance_error[c]);
            }
        }
    }
}

mpq_class axis_error(const Work& p, size_t c, float extent, float origin, const mpq_class& u) {
    const mpq_class half = rational(extent) / 2;
    const mpq_class offset = rational(origin) + half;
    const mpq_class normalized = p.v.clip[c] / p.v.clip[kW];
    const mpq_class divided =
        (p.error[c] + abs(normalized) * p.error[kW]) / (p.v.clip[kW] - p.error[kW]);
    const mpq_class t = (abs(normalized) + divided) * abs(half);
    return round_up(divided * abs(half) + rounding_bound<mpq_class>(t, offset, t + abs(offset), u));
}

void project(Work& p, const cases::Viewport& viewport, const mpq_class& u) {
    ClippedVertex& v = p.v;
    if (v.clip[kW] <= 0) {
        v.is_bounded = false;
        return;
    }
    IdealPosition& out = v.position;
    out.inv_w = 1 / v.clip[kW];
    const mpq_class half_x = rational(viewport.width) / 2;
    const mpq_class half_y = rational(viewport.height) / 2;
    out.x = half_x * v.clip[kX] * out.inv_w + rational(viewport.x) + half_x;
    out.y = half_y * v.clip[kY] * out.inv_w + rational(viewport.y) + half_y;
    const mpq_class range = rational(viewport.max_depth) - rational(viewport.min_depth);
    out.z = range * v.clip[kZ] * out.inv_w + rational(viewport.min_depth);
    v.ratio_error.resize(p.distance.size());
    for (const mpq_class& d : p.distance) {
        v.ratio.emplace_back(d * out.inv_w);
    }
    if (v.original >= 0) {
        return;
    }
    if (p.error[kW] >= v.clip[kW]) {
        v.is_bounded = false;
        return;
    }
    v.error.x = axis_error(p, kX, viewport.width, viewport.x, u);
    v.error.y = axis_error(p, kY, viewport.height, viewport.y, u);
    for (size_t k = 0; k < p.distance.size(); ++k) {
        v.ratio_error[k] = round_up((p.distance_error[k] + abs(v.ratio[k]) * p.error[kW]) /
                                    (v.clip[kW] - p.error[kW]));
    }
}

}  // namespace

std::vector<ClippedVertex> rational_clip(const ClipInput& triangle, const cases::Viewport& viewport,
                                         cases::Profile profile,
                                         std::span<const ClipPlane> planes) {
    const mpq_class u =
        profile == cases::Profile::vulkan ? mpq_class(1, 100000) : mpq_class(1, int64_t{1} << 24);
    std::vector<Work> start(3);
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec4& p = triangle.clip[i];
        start[i].v.clip = {rational(p.x), rational(p.y), rational(p.z), rational(p.w)};
        start[i].v.weights[i] = 1;
        start[i].v.original = static_cast<int>(i);
        start[i].v.edge = static_cast<EdgeLabel>(i);
        for (uint32_t k = 0; k < triangle.distance_count; ++k) {
            start[i].distance.push_back(
                rational(triangle.distance[i][static_cast<glm::vec4::length_type>(k)]));
        }
        start[i].distance_error.resize(triangle.distance_count);
    }
    // An order that has been cut in before gives the same polygon again.
    const std::vector<ClipPlane> order = cutting_planes(triangle, planes);
    std::vector<Work> polygon = clip_in_order(start, order, u);
    std::vector<ClipPlane> other_order = order;
    std::stable_partition(other_order.begin(), other_order.end(),
                          [](ClipPlane p) { return !is_user(p) && component_of(p) == kZ; });
    if (other_order != order) {
        widen_by(polygon, clip_in_order(start, other_order, u));
    }
    std::vector<ClipPlane> user_first = other_order;
    std::stable_partition(user_first.begin(), user_first.end(), is_user);
    if (user_first != other_order && user_first != order) {
        widen_by(polygon, clip_in_order(start, user_first, u));
    }
    std::vector<ClippedVertex> out;
    out.reserve(polygon.size());
    for (Work& p : polygon) {
        project(p, viewport, u);
        out.push_back(std::move(p.v));
    }
    return out;
}

}  // namespace ref::test
