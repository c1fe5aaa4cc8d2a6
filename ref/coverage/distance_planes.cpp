// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// c_k of a point is interpolated "using the perspective interpolation equations" (Vulkan
// specification, "Clipping Shader Outputs"): c_k = N/D with N = sum b_i d_i/w_i, D = sum b_i/w_i.
// Where D is safely positive the sign of c_k is that of N, which is linear in framebuffer
// coordinates. What a device may have instead of N at a sample p of the outline:
//
//   * The vertices moved, by at most (dx, dy) from their ideal positions. With the values g_i at
//     the vertices as they are, N of the moved triangle at p is the ideal N at the point that has
//     the same b_i in the ideal triangle; inside the triangle (b_i >= 0) that point is at most
//     (dx, dy) away, so N is off by at most |N_x| dx + |N_y| dy.
//   * The binary32 budget of a plane through the moved vertices (docs/precision.md):
//     u (2 max(sum |g_i| D_i, max_j sum |g_i - g_j| D_i) + max |g_i|), g_i = d_i/w_i, times K. D_i
//     = |db_i/dx| X + |db_i/dy| Y is |e_y| X + |e_x| Y over twice the area, e the edge opposite to
//     vertex i; a moved edge is longer by at most 2 dx, 2 dy, and the area is at least the least
//     one that corners of the boxes make (the area is multi-affine).
//   * Values at the corners of a clipped polygon off by ClippedVertex::ratio_error. A device that
//     sets planes up from such pieces is taken to lose no more than that and the budget above.
//
// With a vertex behind the eye the b_i of visible points are not within [0,1]. Then N is linear in
// p, and its error is the largest at the corners of the window, over all corners of the boxes of
// positions; the budget is that of the homogeneous planes (ref/number/plane_budget.hpp).
//
// Depth planes. Nothing in the text of "Primitive Clipping" tells how a primitive is cut, and
// tilers discard fragments by their depth instead. What such a device compares at a sample with the
// planes' depth is z/w, interpolated without perspective from g_i = z_i/w_i: the plane of N above
// with these g_i, its budget and the movement of the vertices. Compared in the viewport's depth
// range [a, b] instead, two roundings of a + (b - a) z/w are added, u (|a| + |b|) / |b - a| each of
// z/w, times K.
#include "ref/coverage/distance_planes.hpp"

#include <algorithm>

#include "ref/number/plane_budget.hpp"
#include "ref/number/rational.hpp"

namespace ref {

namespace {

using value::kUnderflow;
using value::kUnitRoundoff;
using value::larger;

// The framebuffer rectangle of the samples, pixels.
struct Region {
    mpq_class x0, y0, x1, y1;
};

struct Spread {
    mpq_class x, y;
};
// How far a device's vertices are from the ideal ones, pixels.
void spread_by(Spread& out, const mpq_class& x, const mpq_class& y, const Box& box) {
    out.x = larger(out.x, larger(abs(x - exact_pixels(box.x0)), abs(exact_pixels(box.x1) - x)));
    out.y = larger(out.y, larger(abs(y - exact_pixels(box.y0)), abs(exact_pixels(box.y1) - y)));
}

// The least |twice the area| of triangles with one vertex in each box, square pixels; 0 if the sign
// is not the same for all.
mpq_class least_area(const std::array<std::optional<Box>, 3>& boxes) {
    const auto [low, high] = area_range(*boxes[0], *boxes[1], *boxes[2]);
    if (low <= 0 && high >= 0) {
        return 0;
    }
    return mpq_class(to_mpz(low > 0 ? low : -high)) / kFixedOne / kFixedOne;
}

// Vertices before the eye: g_i at ideal positions.
struct Projected {
    std::array<mpq_class, 3> x, y, inv_w;
    mpq_class area;                  // twice, of the ideal positions, signed
    mpq_class moved_area;            // the least one of the moved positions
    std::array<mpq_class, 3> reach;  // D_i of the moved triangle
    Spread moved;
};

// Sums over the vertices: u (2 max(...) + max |g_i|) and underflow.
mpq_class projected_budget(const Projected& p, const std::array<mpq_class, 3>& g) {
    mpq_class plain;
    mpq_class differences;
    mpq_class largest;
    for (size_t j = 0; j < 3; ++j) {
        plain += abs(g[j]) * p.reach[j];
        largest = larger(largest, abs(g[j]));
        mpq_class from_j;
        for (size_t i = 0; i < 3; ++i) {
            from_j += abs(g[i] - g[j]) * p.reach[i];
        }
        differences = larger(differences, from_j);
    }
    const mpq_class u(kUnitRoundoff);
    const mpq_class all = p.reach[0] + p.reach[1] + p.reach[2] + 1;
    return u * (2 * larger(plain, differences) + largest) + mpq_class(kUnderflow) * all;
}

LinearBound projected_plane(const Projected& p, const std::array<mpq_class, 3>& g,
                            const mpq_class& factor) {
    LinearBound out;
    for (size_t i = 0; i < 3; ++i) {
        const size_t j = (i + 1) % 3;
        const size_t k = (i + 2) % 3;
        // b_i(p) = (v_k - v_j) x (p - v_j) / area
        const mpq_class bx = (p.y[j] - p.y[k]) / p.area;
        const mpq_class by = (p.x[k] - p.x[j]) / p.area;
        out.x += g[i] * bx;
        out.y += g[i] * by;
        out.c -= g[i] * (bx * p.x[j] + by * p.y[j]);
    }
    out.error = factor * projected_budget(p, g) + abs(out.x) * p.moved.x + abs(out.y) * p.moved.y;
    return out;
}

bool project(const CutSource& s, const Region& region, const Spread& moved, Projected& out) {
    out.moved = moved;
    Region all = region;
    for (size_t i = 0; i < 3; ++i) {
        const IdealPosition at = ideal_position(s.triangle.clip[i], s.viewport);
        out.x[i] = at.x;
        out.y[i] = at.y;
        out.inv_w[i] = at.inv_w;
        // Planes may be anchored at the origin or at a vertex.
        all.x0 = std::min<mpq_class>(all.x0, at.x - moved.x);
        all.y0 = std::min<mpq_class>(all.y0, at.y - moved.y);
        all.x1 = larger(all.x1, at.x + moved.x);
        all.y1 = larger(all.y1, at.y + moved.y);
    }
    out.area = (out.x[1] - out.x[0]) * (out.y[2] - out.y[0]) -
               (out.y[1] - out.y[0]) * (out.x[2] - out.x[0]);
    const mpq_class extent_x = larger(all.x1, 0) - std::min<mpq_class>(all.x0, 0);
    const mpq_class extent_y = larger(all.y1, 0) - std::min<mpq_class>(all.y0, 0);
    const mpq_class least = std::min<mpq_class>(least_area(s.vertex), abs(out.area));
    if (least <= 0) {
        return false;
    }
    for (size_t i = 0; i < 3; ++i) {
        const size_t j = (i + 1) % 3;
        const size_t k = (i + 2) % 3;
        out.reach[i] = ((abs(out.y[k] - out.y[j]) + 2 * moved.y) * extent_x +
                        (abs(out.x[k] - out.x[j]) + 2 * moved.x) * extent_y) /
                       least;
    }
    return true;
}

value::Vertices<mpq_class> at_positions(const CutSource& s, const std::array<FixedPoint, 3>& at) {
    value::Vertices<mpq_class> v;
    for (size_t i = 0; i < 3; ++i) {
        v.w[i] = rational(s.triangle.clip[i].w);
        v.hx[i] = exact_pixels(at[i].x) * v.w[i];
        v.hy[i] = exact_pixels(at[i].y) * v.w[i];
        v.finite[i] = true;
    }
    return v;
}

value::Vertices<mpq_class> at_ideal(const CutSource& s) {
    value::Vertices<mpq_class> v;
    const mpq_class half_x = rational(s.viewport.width) / 2;
    const mpq_class half_y = rational(s.viewport.height) / 2;
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec4& p = s.triangle.clip[i];
        v.w[i] = rational(p.w);
        v.hx[i] = half_x * rational(p.x) + (rational(s.viewport.x) + half_x) * v.w[i];
        v.hy[i] = half_y * rational(p.y) + (rational(s.viewport.y) + half_y) * v.w[i];
        v.finite[i] = p.w > 0 || p.w < 0;
    }
    return v;
}

// Plane k of a basis is h_i = values[k][i]. Largest sum |b_i| over the polygon's corners.
mpq_class spread_of(const value::Basis<mpq_class>& basis, std::span<const ClippedVertex> polygon) {
    mpq_class out = 1;
    for (const ClippedVertex& v : polygon) {
        mpq_class sum;
        for (const auto& b : basis.bary) {
            sum += abs(b.at({v.position.x, v.position.y}));
        }
        out = larger(out, sum);
    }
    return out;
}

mpq_class basis_budget(const value::Basis<mpq_class>& basis, const value::Plane<mpq_class>& plane,
                       const Region& region, const mpq_class& spread) {
    const mpq_class extent_x =
        larger(basis.high_x, region.x1) - std::min<mpq_class>(basis.low_x, region.x0);
    const mpq_class extent_y =
        larger(basis.high_y, region.y1) - std::min<mpq_class>(basis.low_y, region.y0);
    return plane.budget(extent_x, extent_y, spread);
}

// N of every distance and D, where a vertex lies behind the eye; empty if they have no bound.
std::vector<LinearBound> homogeneous_planes(const CutSource& s,
                                            std::span<const ClippedVertex> polygon,
                                            const Region& region, const mpq_class& factor) {
    std::vector<value::PlaneInput<mpq_class>> inputs(s.triangle.distance_count + 1);
    for (size_t i = 0; i < 3; ++i) {
        inputs.back().h[i] = 1;
        for (uint32_t k = 0; k < s.triangle.distance_count; ++k) {
            inputs[k].h[i] =
                rational(s.triangle.distance[i][static_cast<glm::vec4::length_type>(k)]);
        }
    }
    const auto ideal = make_basis(at_ideal(s), inputs, kBudgetFactor);
    if (ideal.orientation == 0) {
        return {};
    }
    std::vector<LinearBound> out(inputs.size());
    const mpq_class ideal_spread = spread_of(ideal, polygon);
    for (size_t k = 0; k < inputs.size(); ++k) {
        const auto& plane = ideal.planes[k];
        out[k].x = plane.form.x;
        out[k].y = plane.form.y;
        out[k].c = plane.form.c;
        out[k].error = factor * basis_budget(ideal, plane, region, ideal_spread);
    }
    if (!s.vertex[0] || !s.vertex[1] || !s.vertex[2]) {
        return out;  // no device has positions for all of them to set planes up from
    }
    for (const FixedPoint& a : BoxCorners(*s.vertex[0])) {
        for (const FixedPoint& b : BoxCorners(*s.vertex[1])) {
            for (const FixedPoint& c : BoxCorners(*s.vertex[2])) {
                const auto basis = make_basis(at_positions(s, {a, b, c}), inputs, kBudgetFactor);
                if (basis.orientation != ideal.orientation) {
                    return {};
                }
                const mpq_class spread = spread_of(basis, polygon);
                for (size_t k = 0; k < inputs.size(); ++k) {
                    const auto& form = basis.planes[k].form;
                    mpq_class worst;
                    for (const mpq_class& x : {region.x0, region.x1}) {
                        for (const mpq_class& y : {region.y0, region.y1}) {
                            worst = larger(worst, abs((form.x - out[k].x) * x +
                                                      (form.y - out[k].y) * y + form.c - out[k].c));
                        }
                    }
                    out[k].error = larger(
                        out[k].error,
                        worst + factor * basis_budget(basis, basis.planes[k], region, spread));
                }
            }
        }
    }
    return out;
}

bool is_before_eye(const CutSource& s) {
    return std::all_of(s.triangle.clip.begin(), s.triangle.clip.end(),
                       [](const glm::vec4& v) { return v.w >= 0x1p-126F; });
}

Region region_of(const Window& w) {
    return {mpq_class(w.pixel_x0), mpq_class(w.pixel_y0), mpq_class(w.pixel_x1),
            mpq_class(w.pixel_y1)};
}

// Of the outline's vertices, and of those of the triangle before the eye.
Spread spread_of_all(const CutSource& source, std::span<const ClippedVertex> polygon,
                     std::span<const Box> boxes) {
    Spread moved;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const IdealPosition& at = polygon[i].position;
        spread_by(moved, at.x, at.y, boxes[i]);
    }
    for (size_t i = 0; i < 3; ++i) {
        if (source.vertex[i] && source.triangle.clip[i].w > 0) {
            const IdealPosition at = ideal_position(source.triangle.clip[i], source.viewport);
            spread_by(moved, at.x, at.y, *source.vertex[i]);
        }
    }
    return moved;
}

}  // namespace

std::vector<LinearBound> distance_planes(const CutSource& s, std::span<const ClippedVertex> polygon,
                                         std::span<const Box> boxes) {
    const Region region = region_of(s.window);
    const Spread moved = spread_of_all(s, polygon, boxes);
    const mpq_class factor = exact_budget_factor(s.profile);
    const uint32_t n = s.triangle.distance_count;
    std::vector<LinearBound> out;
    if (is_before_eye(s)) {
        Projected p;
        if (!s.vertex[0] || !s.vertex[1] || !s.vertex[2] || !project(s, region, moved, p)) {
            return {};
        }
        for (uint32_t k = 0; k < n; ++k) {
            std::array<mpq_class, 3> g;
            for (size_t i = 0; i < 3; ++i) {
                g[i] = rational(s.triangle.distance[i][static_cast<glm::vec4::length_type>(k)]) *
                       p.inv_w[i];
            }
            out.push_back(projected_plane(p, g, factor));
        }
        out.push_back(projected_plane(p, p.inv_w, factor));
    } else {
        out = homogeneous_planes(s, polygon, region, factor);
        for (LinearBound& plane : out) {
            plane.error += abs(plane.x) * moved.x + abs(plane.y) * moved.y;
        }
    }
    for (uint32_t k = 0; k < n && k < out.size(); ++k) {
        mpq_class of_corner;
        for (const ClippedVertex& v : polygon) {
            of_corner = larger(of_corner, v.ratio_error[k]);
        }
        out[k].error += of_corner;
    }
    return out;
}

std::optional<LinearBound> depth_plane(const CutSource& s, std::span<const ClippedVertex> polygon,
                                       std::span<const Box> boxes) {
    Projected p;
    if (!is_before_eye(s) || !s.vertex[0] || !s.vertex[1] || !s.vertex[2] ||
        !project(s, region_of(s.window), spread_of_all(s, polygon, boxes), p)) {
        return std::nullopt;
    }
    std::array<mpq_class, 3> g;
    for (size_t i = 0; i < 3; ++i) {
        g[i] = rational(s.triangle.clip[i].z) * p.inv_w[i];
    }
    const mpq_class factor = exact_budget_factor(s.profile);
    LinearBound depth = projected_plane(p, g, factor);
    const mpq_class low = rational(s.viewport.min_depth);
    const mpq_class high = rational(s.viewport.max_depth);
    if (low != high) {
        depth.error +=
            factor * mpq_class(kUnitRoundoff) * 2 * (abs(low) + abs(high)) / abs(high - low);
    }
    return depth;
}

}  // namespace ref
