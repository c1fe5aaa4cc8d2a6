// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/generate/delaunay.hpp"

namespace cases {

namespace {

__extension__ typedef __int128 int128;

constexpr uint32_t next(uint32_t i) {
    return (i + 1) % 3;
}
constexpr uint32_t previous(uint32_t i) {
    return (i + 2) % 3;
}

}  // namespace

int64_t orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

int in_circle(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
              const LatticePoint& d) {
    const int64_t ax = a.x - d.x;
    const int64_t ay = a.y - d.y;
    const int64_t bx = b.x - d.x;
    const int64_t by = b.y - d.y;
    const int64_t cx = c.x - d.x;
    const int64_t cy = c.y - d.y;
    const int128 determinant = int128{ax * ax + ay * ay} * (bx * cy - by * cx) +
                               int128{bx * bx + by * by} * (cx * ay - cy * ax) +
                               int128{cx * cx + cy * cy} * (ax * by - ay * bx);
    return determinant > 0 ? 1 : determinant < 0 ? -1 : 0;
}

Triangulation::Triangulation(int64_t width, int64_t height)
    : points_{{0, 0}, {width, 0}, {width, height}, {0, height}},
      triangles_{{{0, 1, 2}, {kNone, 1, kNone}}, {{0, 2, 3}, {kNone, kNone, 0}}} {}

std::vector<uint32_t> Triangulation::indices() const {
    std::vector<uint32_t> result;
    result.reserve(3 * triangles_.size());
    for (const Triangle& t : triangles_) {
        result.insert(result.end(), {t.vertex[0], t.vertex[2], t.vertex[1]});
    }
    return result;
}

// Walks toward the point: out of a triangle through an edge that has the point on its other side.
// In a Delaunay triangulation this ends (Devillers, Pion, Teillaud, Walking in a triangulation).
uint32_t Triangulation::locate(const LatticePoint& p) const {
    uint32_t t = last_;
    while (true) {
        const Triangle& triangle = triangles_[t];
        uint32_t beyond = t;
        for (uint32_t i = 0; i < 3; ++i) {
            if (orientation(points_[triangle.vertex[next(i)]],
                            points_[triangle.vertex[previous(i)]], p) < 0) {
                beyond = triangle.neighbour[i];
                break;
            }
        }
        if (beyond == t) {
            return t;
        }
        t = beyond;
    }
}

void Triangulation::insert(const LatticePoint& p) {
    const auto number = static_cast<uint32_t>(points_.size());
    points_.push_back(p);
    const uint32_t t = locate(p);
    last_ = t;
    for (uint32_t i = 0; i < 3; ++i) {
        const Triangle& triangle = triangles_[t];
        if (orientation(points_[triangle.vertex[next(i)]], points_[triangle.vertex[previous(i)]],
                        p) == 0) {
            split_edge(t, i, number);
            return;
        }
    }
    split_triangle(t, number);
}

uint32_t Triangulation::side_of_vertex(uint32_t t, uint32_t vertex) const {
    const Triangle& triangle = triangles_[t];
    return triangle.vertex[0] == vertex ? 0 : triangle.vertex[1] == vertex ? 1 : 2;
}

void Triangulation::replace_neighbour(uint32_t t, uint32_t before, uint32_t after) {
    if (t == kNone) {
        return;
    }
    for (uint32_t& neighbour : triangles_[t].neighbour) {
        if (neighbour == before) {
            neighbour = after;
            return;
        }
    }
}

void Triangulation::split_triangle(uint32_t t, uint32_t p) {
    const auto [a, b, c] = triangles_[t].vertex;
    const auto [across_a, across_b, across_c] = triangles_[t].neighbour;
    const auto u = static_cast<uint32_t>(triangles_.size());
    const uint32_t v = u + 1;
    triangles_[t] = {{p, b, c}, {across_a, u, v}};
    triangles_.push_back({{p, c, a}, {across_b, v, t}});
    triangles_.push_back({{p, a, b}, {across_c, t, u}});
    replace_neighbour(across_b, t, u);
    replace_neighbour(across_c, t, v);
    legalize(t, p);
    legalize(u, p);
    legalize(v, p);
}

// The point lies on the edge b-c of t = (a, b, c); beyond it lies s = (d, c, b) or the border.
void Triangulation::split_edge(uint32_t t, uint32_t side, uint32_t p) {
    const Triangle old = triangles_[t];
    const uint32_t a = old.vertex[side];
    const uint32_t b = old.vertex[next(side)];
    const uint32_t c = old.vertex[previous(side)];
    const uint32_t s = old.neighbour[side];
    const uint32_t across_b = old.neighbour[next(side)];      // beyond c-a
    const uint32_t across_c = old.neighbour[previous(side)];  // beyond a-b
    const auto u = static_cast<uint32_t>(triangles_.size());
    const uint32_t v = s == kNone ? kNone : u + 1;
    // t = (p, a, b), u = (p, c, a); s = (p, b, d), v = (p, d, c).
    triangles_[t] = {{p, a, b}, {across_c, s, u}};
    triangles_.push_back({{p, c, a}, {across_b, t, v}});
    replace_neighbour(across_b, t, u);
    if (s != kNone) {
        const Triangle beyond = triangles_[s];
        uint32_t i = 0;
        while (beyond.neighbour[i] != t) {
            ++i;
        }
        const uint32_t d = beyond.vertex[i];
        const uint32_t across_c_beyond = beyond.neighbour[next(i)];      // beyond b-d
        const uint32_t across_b_beyond = beyond.neighbour[previous(i)];  // beyond d-c
        triangles_[s] = {{p, b, d}, {across_c_beyond, v, t}};
        triangles_.push_back({{p, d, c}, {across_b_beyond, u, s}});
        replace_neighbour(across_b_beyond, s, v);
    }
    legalize(t, p);
    legalize(u, p);
    if (s != kNone) {
        legalize(s, p);
        legalize(v, p);
    }
}

void Triangulation::legalize(uint32_t t, uint32_t p) {
    std::vector<uint32_t> pending = {t};
    while (!pending.empty()) {
        const uint32_t here = pending.back();
        pending.pop_back();
        const uint32_t i = side_of_vertex(here, p);
        const uint32_t there = triangles_[here].neighbour[i];
        if (there == kNone) {
            continue;
        }
        uint32_t k = 0;
        while (triangles_[there].neighbour[k] != here) {
            ++k;
        }
        const Triangle first = triangles_[here];
        const Triangle second = triangles_[there];
        const uint32_t b = first.vertex[next(i)];
        const uint32_t c = first.vertex[previous(i)];
        const uint32_t d = second.vertex[k];
        if (in_circle(points_[p], points_[b], points_[c], points_[d]) <= 0) {
            continue;
        }
        // (p, b, c) and (d, c, b) become (p, b, d) and (p, d, c).
        const uint32_t beyond_pc = first.neighbour[next(i)];
        const uint32_t beyond_pb = first.neighbour[previous(i)];
        const uint32_t beyond_bd = second.neighbour[next(k)];
        const uint32_t beyond_dc = second.neighbour[previous(k)];
        triangles_[here] = {{p, b, d}, {beyond_bd, there, beyond_pb}};
        triangles_[there] = {{p, d, c}, {beyond_dc, beyond_pc, here}};
        replace_neighbour(beyond_bd, there, here);
        replace_neighbour(beyond_pc, here, there);
        pending.push_back(here);
        pending.push_back(there);
    }
}

}  // namespace cases
