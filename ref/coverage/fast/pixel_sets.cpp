// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The sum of a convex set and a square is the intersection of the set's half planes and of its
// bounds, each moved outwards until it holds the square (the separating axes of two convex
// polygons); the centres of squares inside the set are those that its half planes hold when they
// are moved inwards.
#include "ref/coverage/fast/pixel_sets.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <optional>

#include "ref/coverage/facing.hpp"
#include "ref/coverage/pieces.hpp"
#include "ref/number/rational.hpp"

namespace ref::fast {

namespace {

constexpr int64_t kFar = int64_t{1} << kPositionBits;

Int128 size_of(Int128 v) {
    return v < 0 ? -v : v;
}

// Moved outwards by `by` along x and y; inwards where it is negative.
HalfPlane moved(HalfPlane h, int64_t by) {
    h.c += (size_of(h.a) + size_of(h.b)) * by;
    return h;
}
Box grown(const Box& b, int64_t by) {
    return {b.x0 - by, b.y0 - by, b.x1 + by, b.y1 + by};
}
ConvexSet grown(ConvexSet set, int64_t by) {
    for (HalfPlane& h : set.planes) {
        h = moved(h, by);
    }
    set.bounds = grown(set.bounds, by);
    return set;
}
ConvexSet everywhere() {
    return {{}, {-kFar, -kFar, kFar, kFar}};
}

// Centres of squares that have more than a side's line in common with what lies within the bounds.
void add_bounds(const Box& b, int64_t reach, std::vector<HalfPlane>& planes) {
    planes.push_back({1, 0, -Int128{b.x0} + reach - 1});
    planes.push_back({-1, 0, Int128{b.x1} + reach - 1});
    planes.push_back({0, 1, -Int128{b.y0} + reach - 1});
    planes.push_back({0, -1, Int128{b.y1} + reach - 1});
}

Box bounds_of(std::span<const Box> boxes) {
    Box all = boxes[0];
    for (const Box& b : boxes) {
        all = hull_of(all, b);
    }
    return all;
}

// A polygon without area.
void add_degenerate(const TriangleSetup& setup, std::span<const Box> points, bool is_fixed,
                    CoverageSets& out) {
    const PixelArea& area = setup.area;
    if (!area.keeps_degenerates) {
        out.has_must = false;
        return;
    }
    const ConvexSet hull = hull_set(points);
    out.may.push_back(area.is_unbounded || area.is_mitred ? everywhere()
                                                          : grown(hull, kHalfPixel + area.most));
    out.has_must = out.has_must && is_fixed && !setup.is_flat && !setup.is_clipped;
    const int64_t reach = kHalfPixel + area.least;
    for (HalfPlane h : hull.planes) {
        h.c -= 1;  // strictly inside
        out.must.push_back(moved(h, reach));
    }
    add_bounds(hull.bounds, reach, out.must);
}

void add_polygon(const TriangleSetup& setup, std::span<const FixedPoint> polygon,
                 CoverageSets& out) {
    const PixelArea& area = setup.area;
    const int sign = area_sign(polygon);
    std::vector<Box> points;
    for (const FixedPoint& p : polygon) {
        points.push_back({p.x, p.y, p.x, p.y});
    }
    if (sign == 0) {
        if (area.is_over()) {
            add_degenerate(setup, points, true, out);
        } else {
            out.has_must = false;
        }
        return;
    }
    const int64_t least = kHalfPixel + area.least;
    out.may.push_back(
        grown(hull_set(points), area.is_over() ? kHalfPixel + area.most : -kHalfPixel));
    for (size_t i = 0; i < polygon.size(); ++i) {
        FixedPoint a = polygon[i];
        FixedPoint b = polygon[(i + 1) % polygon.size()];
        if (a == b) {
            continue;
        }
        if (sign < 0) {
            std::swap(a, b);
        }
        out.must.push_back(moved(right_of(a, b, true), area.is_over() ? least : -least));
    }
    if (area.is_over()) {
        add_bounds(bounds_of(points), least, out.must);
    }
}

// Where all half planes hold without their borders, in bounds of whole units around it; nothing if
// that has no area.
std::optional<Box> bounds_within(const std::vector<HalfPlane>& planes, const Box& start) {
    struct Point {
        mpq_class x, y;
    };
    std::vector<Point> left{{mpq_class(start.x0), mpq_class(start.y0)},
                            {mpq_class(start.x1), mpq_class(start.y0)},
                            {mpq_class(start.x1), mpq_class(start.y1)},
                            {mpq_class(start.x0), mpq_class(start.y1)}};
    for (const HalfPlane& h : planes) {
        const mpq_class a(to_mpz(h.a));
        const mpq_class b(to_mpz(h.b));
        const mpq_class c(to_mpz(h.c + 1));  // strict ones are one less
        std::vector<Point> next;
        for (size_t i = 0; i < left.size(); ++i) {
            const Point& p = left[i];
            const Point& q = left[(i + 1) % left.size()];
            const mpq_class at_p = a * p.x + b * p.y + c;
            const mpq_class at_q = a * q.x + b * q.y + c;
            if (at_p >= 0) {
                next.push_back(p);
            }
            if (sgn(at_p) * sgn(at_q) < 0) {
                const mpq_class t = at_p / (at_p - at_q);
                next.push_back(
                    {mpq_class(p.x + t * (q.x - p.x)), mpq_class(p.y + t * (q.y - p.y))});
            }
        }
        left = std::move(next);
    }
    mpq_class area;
    for (size_t i = 1; i + 1 < left.size(); ++i) {
        area += (left[i].x - left[0].x) * (left[i + 1].y - left[0].y) -
                (left[i].y - left[0].y) * (left[i + 1].x - left[0].x);
    }
    if (area == 0) {
        return std::nullopt;
    }
    const auto [x0, x1] = std::minmax_element(
        left.begin(), left.end(), [](const Point& p, const Point& q) { return p.x < q.x; });
    const auto [y0, y1] = std::minmax_element(
        left.begin(), left.end(), [](const Point& p, const Point& q) { return p.y < q.y; });
    return Box{floor_of(x0->x).get_si(), floor_of(y0->y).get_si(), ceil_of(x1->x).get_si(),
               ceil_of(y1->y).get_si()};
}

// 1 or -1 if all numbers of the range are of that sign, else 0.
int sign_within(int64_t low, int64_t high) {
    return low > 0 ? 1 : (high < 0 ? -1 : 0);
}

// What the triangle has in common with a square wherever its corners lie, edge by edge.
void add_plain_triangle(const Outline& o, int sign, int64_t reach, CoverageSets& out) {
    const std::span<const Box> boxes = o.must_vertices();
    Box bounds{INT64_MAX, INT64_MAX, INT64_MIN, INT64_MIN};
    for (size_t i = 0; i < boxes.size(); ++i) {
        const Box& from = boxes[i];
        const Box& to = boxes[(i + 1) % boxes.size()];
        bounds = {std::min(bounds.x0, from.x1), std::min(bounds.y0, from.y1),
                  std::max(bounds.x1, from.x0), std::max(bounds.y1, from.y0)};
        // Of E_ab, for the polygon with a positive area, x is -dy and y is dx.
        const int down = sign * sign_within(to.x0 - from.x1, to.x1 - from.x0);
        const int across = -sign * sign_within(to.y0 - from.y1, to.y1 - from.y0);
        for (const FixedPoint& a : BoxCorners(from)) {
            for (const FixedPoint& b : BoxCorners(to)) {
                HalfPlane h = sign > 0 ? right_of(a, b, true) : right_of(b, a, true);
                h.c += h.a * (across * reach) + h.b * (down * reach);
                out.must.push_back(h);
            }
        }
    }
    add_bounds(bounds, reach, out.must);
}

std::vector<HalfPlane> inner_planes(const Outline& o, int sign) {
    std::vector<HalfPlane> planes;
    const std::span<const Box> boxes = o.must_vertices();
    for (size_t i = 0; i < boxes.size(); ++i) {
        const EdgeTest test =
            o.must_test[i] == EdgeTest::parallel ? EdgeTest::parallel : EdgeTest::strict;
        add_edge(boxes[i], boxes[(i + 1) % boxes.size()], test, sign, planes);
    }
    return planes;
}

// The polygon's edges moved outwards, those at least whose ends every device has.
ConvexSet moved_edges(const Outline& o, int sign, int64_t reach) {
    ConvexSet out = everywhere();
    for (size_t i = 0; sign != 0 && i < o.count; ++i) {
        const Box& from = o.boxes[i];
        const Box& to = o.boxes[(i + 1) % o.count];
        if (from.is_point() && to.is_point() && !(from == to)) {
            const FixedPoint a{from.x0, from.y0};
            const FixedPoint b{to.x0, to.y0};
            out.planes.push_back(
                moved(sign > 0 ? right_of(a, b, false) : right_of(b, a, false), reach));
        }
    }
    return out;
}

void add_filled(const TriangleSetup& setup, const Outline& o, CoverageSets& out) {
    out.may.push_back(grown(hull_set(o.vertices()), -kHalfPixel));
    const int sign = corner_sign(o.must_vertices());
    if (o.must_count < 3 || sign == 0) {
        out.has_must = false;
        return;
    }
    for (const HalfPlane& h : inner_planes(o, sign)) {
        out.must.push_back(moved(h, -kHalfPixel - setup.area.least));
    }
}

void add_boxes(const TriangleSetup& setup, const Outline& o, CoverageSets& out) {
    const PixelArea& area = setup.area;
    if (!area.is_over()) {
        add_filled(setup, o, out);
        return;
    }
    const AreaSigns signs = area_signs(o.vertices());
    if (!signs.negative && !signs.positive) {
        const bool is_fixed = std::all_of(o.vertices().begin(), o.vertices().end(),
                                          [](const Box& b) { return b.is_point(); });
        add_degenerate(setup, o.vertices(), is_fixed, out);
        return;
    }
    const int64_t most = kHalfPixel + area.most;
    out.may.push_back(area.is_unbounded ? everywhere()
                      : area.is_mitred  ? moved_edges(o, signs.only(), most)
                                        : grown(hull_set(o.vertices()), most));
    const int64_t least = kHalfPixel + area.least;
    if (is_plain_triangle(o)) {
        out.has_must = out.has_must && signs.only() != 0;
        if (signs.only() != 0) {
            add_plain_triangle(o, signs.only(), least, out);
        }
        return;
    }
    const int sign = corner_sign(o.must_vertices());
    if (o.must_count < 3 || sign == 0) {
        out.has_must = false;
        return;
    }
    const std::vector<HalfPlane> planes = inner_planes(o, sign);
    const std::optional<Box> bounds = bounds_within(planes, bounds_of(o.must_vertices()));
    if (!bounds) {
        out.has_must = false;
        return;
    }
    for (const HalfPlane& h : planes) {
        out.must.push_back(moved(h, least));
    }
    add_bounds(*bounds, least, out.must);
}

// What the pieces of an outline leave open, `may`: what it may cover.
void add_pieces(const PixelArea& area, const Outline& o, std::span<const ConvexSet> may,
                CoverageSets& out) {
    std::vector<ConvexSet> sets;
    if (meets_everywhere(area)) {
        sets.assign(may.begin(), may.end());
    } else {
        for (const InnerEdge& edge : inner_edges(o, area)) {
            sets.push_back(grown(hull_set(edge), reach_of_inner_edges(area)));
        }
    }
    if (!area.is_over()) {
        out.open.insert(out.open.end(), sets.begin(), sets.end());
        return;
    }
    for (const DistanceCut& cut : o.cuts) {
        for (ConvexSet& set : sets) {
            set.planes.push_back(moved(cut.may, kHalfPixel));
        }
    }
    const uint32_t pieces = further_pieces(o, area);
    out.further.resize(std::max<size_t>(out.further.size(), pieces));
    for (uint32_t k = 0; k < pieces; ++k) {
        out.further[k].insert(out.further[k].end(), sets.begin(), sets.end());
    }
}

}  // namespace

CoverageSets pixel_sets(const TriangleSetup& setup) {
    CoverageSets out;
    const OutlineList outlines = setup.outlines();
    out.has_must = outlines.size() > 0;
    for (const Outline* const o : outlines) {
        const size_t first = out.may.size();
        switch (o->mode) {
            case OutlineMode::empty:
                out.has_must = false;
                break;
            case OutlineMode::snapped:
                for_each_candidate(*o, setup.grid_step, [&](std::span<const FixedPoint> polygon) {
                    add_polygon(setup, polygon, out);
                });
                break;
            case OutlineMode::boxes:
                add_boxes(setup, *o, out);
                break;
        }
        // The place where a cut is tested may lie anywhere in the pixel.
        for (const DistanceCut& cut : o->cuts) {
            for (size_t i = first; i < out.may.size(); ++i) {
                out.may[i].planes.push_back(moved(cut.may, kHalfPixel));
            }
            out.must.push_back(moved(cut.must, -kHalfPixel));
        }
        if (o->mode != OutlineMode::empty && further_pieces(*o, setup.area) > 0) {
            add_pieces(setup.area, *o, std::span(out.may).subspan(first), out);
        }
    }
    return out;
}

}  // namespace ref::fast
