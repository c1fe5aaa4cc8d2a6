// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/fast/half_plane.hpp"

#include <algorithm>

#include "ref/coverage/fast/pixel_sets.hpp"

namespace ref::fast {

namespace {

Box bounds_of(std::span<const FixedPoint> points) {
    Box b{points[0].x, points[0].y, points[0].x, points[0].y};
    for (const FixedPoint& p : points) {
        b = {std::min(b.x0, p.x), std::min(b.y0, p.y), std::max(b.x1, p.x), std::max(b.y1, p.y)};
    }
    return b;
}

void add_once(std::vector<HalfPlane>& planes, const HalfPlane& plane) {
    if (std::find(planes.begin(), planes.end(), plane) == planes.end()) {
        planes.push_back(plane);
    }
}

// The edge between two points by the top-left rule, for a polygon with the orientation `sign`.
HalfPlane tie_plane(const Box& from, const Box& to, int sign) {
    FixedPoint a{from.x0, from.y0};
    FixedPoint b{to.x0, to.y0};
    if (sign < 0) {
        std::swap(a, b);
    }
    return right_of(a, b, !is_top_left(a, b));
}

// Inside the line parallel to the edge between the middles that has both boxes on its outer side.
HalfPlane parallel_plane(const Box& from, const Box& to, int sign) {
    FixedPoint a = middle_of(from);
    FixedPoint b = middle_of(to);
    if (sign < 0) {
        std::swap(a, b);
    }
    HalfPlane plane = right_of(a, b, true);
    Int128 farthest = 0;  // corners: how far they reach inside
    for (const Box& box : {from, to}) {
        for (const FixedPoint& q : BoxCorners(box)) {
            farthest = std::max(farthest, edge_function(a, b, q));
        }
    }
    plane.c -= farthest;
    return plane;
}

}  // namespace

int corner_sign(std::span<const Box> boxes) {
    Int128 area = 0;
    for (size_t i = 1; i + 1 < boxes.size(); ++i) {
        area += edge_function({boxes[0].x0, boxes[0].y0}, {boxes[i].x0, boxes[i].y0},
                              {boxes[i + 1].x0, boxes[i + 1].y0});
    }
    return sign_of(area);
}

void add_edge(const Box& from, const Box& to, EdgeTest test, int sign,
              std::vector<HalfPlane>& planes) {
    switch (test) {
        case EdgeTest::strict:
            for (const FixedPoint& a : BoxCorners(from)) {
                for (const FixedPoint& b : BoxCorners(to)) {
                    planes.push_back(sign > 0 ? right_of(a, b, true) : right_of(b, a, true));
                }
            }
            return;
        case EdgeTest::parallel:
            planes.push_back(parallel_plane(from, to, sign));
            return;
        case EdgeTest::top_left:
            planes.push_back(tie_plane(from, to, sign));
            return;
    }
}

namespace {

void add_boxes(const Outline& o, CoverageSets& out) {
    out.may.push_back(hull_set(o.vertices()));
    const std::span<const Box> boxes = o.must_vertices();
    for (size_t i = 0; i < boxes.size(); ++i) {
        if (o.must_test[i] == EdgeTest::top_left) {
            out.may.back().planes.push_back(
                tie_plane(boxes[i], boxes[(i + 1) % boxes.size()], o.tie_side[i]));
        }
    }
    const int sign = corner_sign(boxes);
    if (boxes.size() < 3 || sign == 0) {
        out.has_must = false;
        return;
    }
    for (size_t i = 0; i < boxes.size(); ++i) {
        add_edge(boxes[i], boxes[(i + 1) % boxes.size()], o.must_test[i], sign, out.must);
    }
}

// One snapped polygon with the top-left rule.
void add_candidate(std::span<const FixedPoint> polygon, CoverageSets& out) {
    const int sign = area_sign(polygon);
    if (sign == 0) {
        out.has_must = false;
        return;
    }
    ConvexSet set;
    set.bounds = bounds_of(polygon);
    for (size_t i = 0; i < polygon.size(); ++i) {
        FixedPoint a = polygon[i];
        FixedPoint b = polygon[(i + 1) % polygon.size()];
        if (a == b) {
            continue;
        }
        if (sign < 0) {
            std::swap(a, b);
        }
        set.planes.push_back(right_of(a, b, !is_top_left(a, b)));
        add_once(out.must, set.planes.back());
    }
    out.may.push_back(std::move(set));
}

void add_outline(const Outline& o, int64_t step, CoverageSets& out) {
    switch (o.mode) {
        case OutlineMode::empty:
            out.has_must = false;
            break;
        case OutlineMode::snapped:
            for_each_candidate(
                o, step, [&](std::span<const FixedPoint> polygon) { add_candidate(polygon, out); });
            break;
        case OutlineMode::boxes:
            add_boxes(o, out);
            break;
    }
}

}  // namespace

std::vector<FixedPoint> convex_hull(std::vector<FixedPoint> points) {
    std::sort(points.begin(), points.end(), [](const FixedPoint& a, const FixedPoint& b) {
        return a.x != b.x ? a.x < b.x : a.y < b.y;
    });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) {
        return points;
    }
    std::vector<FixedPoint> hull;
    const auto add_chain = [&hull](auto begin, auto end) {
        const size_t start = hull.size();
        for (auto it = begin; it != end; ++it) {
            while (hull.size() >= start + 2 &&
                   edge_function(hull[hull.size() - 2], hull.back(), *it) <= 0) {
                hull.pop_back();
            }
            hull.push_back(*it);
        }
        hull.pop_back();  // begins the other chain
    };
    add_chain(points.begin(), points.end());
    add_chain(points.rbegin(), points.rend());
    return hull;
}

ConvexSet hull_set(std::span<const Box> boxes) {
    std::vector<FixedPoint> points;
    points.reserve(boxes.size() * 4);
    for (const Box& b : boxes) {
        const BoxCorners c(b);
        points.insert(points.end(), c.begin(), c.end());
    }
    ConvexSet set;
    set.bounds = bounds_of(points);
    const std::vector<FixedPoint> hull = convex_hull(std::move(points));
    // A hull on a line has two edges of opposite direction; the bounds end it. A point is its
    // bounds.
    for (size_t i = 0; hull.size() > 1 && i < hull.size(); ++i) {
        set.planes.push_back(right_of(hull[i], hull[(i + 1) % hull.size()], false));
    }
    return set;
}

CoverageSets coverage_set(const Outline& outline, int64_t grid_step) {
    CoverageSets out;
    add_outline(outline, grid_step, out);
    return out;
}

CoverageSets coverage_sets(const TriangleSetup& setup) {
    if (setup.area.is_on()) {
        return pixel_sets(setup);
    }
    CoverageSets out;
    const OutlineList outlines = setup.outlines();
    out.has_must = outlines.size() > 0;
    for (const Outline* const o : outlines) {
        const size_t first = out.may.size();
        add_outline(*o, setup.grid_step, out);
        for (const DistanceCut& cut : o->cuts) {
            for (size_t i = first; i < out.may.size(); ++i) {
                out.may[i].planes.push_back(cut.may);
            }
            out.must.push_back(cut.must);
        }
    }
    return out;
}

}  // namespace ref::fast
