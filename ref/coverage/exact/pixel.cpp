// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The oracle of conservative coverage: polygons and squares are cut by each other, point by point
// and edge by edge, in numbers of unlimited size.
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <vector>

#include "ref/coverage/exact/exact.hpp"
#include "ref/coverage/facing.hpp"
#include "ref/coverage/pieces.hpp"

namespace ref::exact {

namespace {

struct Point {
    mpq_class x, y;
};
// Inside is a x + b y + c >= 0.
struct Side {
    mpz_class a, b, c;
    mpq_class at(const Point& p) const { return a * p.x + b * p.y + c; }
};

mpz_class edge_value(const FixedPoint& a, const FixedPoint& b, const FixedPoint& p) {
    return mpz_class(b.x - a.x) * mpz_class(p.y - a.y) -
           mpz_class(b.y - a.y) * mpz_class(p.x - a.x);
}
int side(const FixedPoint& a, const FixedPoint& b, const FixedPoint& p) {
    return sgn(edge_value(a, b, p));
}
// Where sign * E_ab >= 0.
Side side_of(const FixedPoint& a, const FixedPoint& b, int sign) {
    const mpz_class dx = b.x - a.x;
    const mpz_class dy = b.y - a.y;
    return {mpz_class(-dy * sign), mpz_class(dx * sign),
            mpz_class((dy * mpz_class(a.x) - dx * mpz_class(a.y)) * sign)};
}

std::array<FixedPoint, 4> square(const FixedPoint& centre, int64_t reach) {
    return {{{centre.x - reach, centre.y - reach},
             {centre.x + reach, centre.y - reach},
             {centre.x + reach, centre.y + reach},
             {centre.x - reach, centre.y + reach}}};
}

// Whether what is left of the square by all sides has an area.
bool has_area_within(const FixedPoint& centre, int64_t reach, const std::vector<Side>& sides) {
    std::vector<Point> left;
    for (const FixedPoint& p : square(centre, reach)) {
        left.push_back({mpq_class(p.x), mpq_class(p.y)});
    }
    for (const Side& s : sides) {
        std::vector<Point> next;
        for (size_t i = 0; i < left.size(); ++i) {
            const Point& a = left[i];
            const Point& b = left[(i + 1) % left.size()];
            const mpq_class at_a = s.at(a);
            const mpq_class at_b = s.at(b);
            if (at_a >= 0) {
                next.push_back(a);
            }
            if (sgn(at_a) * sgn(at_b) < 0) {
                const mpq_class t = at_a / (at_a - at_b);
                next.push_back(
                    {mpq_class(a.x + t * (b.x - a.x)), mpq_class(a.y + t * (b.y - a.y))});
            }
        }
        left = std::move(next);
    }
    mpq_class area;
    for (size_t i = 1; i + 1 < left.size(); ++i) {
        area += (left[i].x - left[0].x) * (left[i + 1].y - left[0].y) -
                (left[i].y - left[0].y) * (left[i + 1].x - left[0].x);
    }
    return area != 0;
}

bool is_on_segment(const FixedPoint& a, const FixedPoint& b, const FixedPoint& p) {
    return side(a, b, p) == 0 && p.x >= std::min(a.x, b.x) && p.x <= std::max(a.x, b.x) &&
           p.y >= std::min(a.y, b.y) && p.y <= std::max(a.y, b.y);
}

bool segments_meet(const FixedPoint& a, const FixedPoint& b, const FixedPoint& c,
                   const FixedPoint& d) {
    if (is_on_segment(a, b, c) || is_on_segment(a, b, d) || is_on_segment(c, d, a) ||
        is_on_segment(c, d, b)) {
        return true;
    }
    return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

bool is_in_square(const FixedPoint& centre, int64_t reach, const FixedPoint& p, bool is_open) {
    const int64_t within = reach - (is_open ? 1 : 0);
    return std::abs(p.x - centre.x) <= within && std::abs(p.y - centre.y) <= within;
}

// Whether a segment, its ends included, meets the square without its border.
bool enters_square(const FixedPoint& centre, int64_t reach, const FixedPoint& a,
                   const FixedPoint& b) {
    // In the middle of the part that lies within the closed square.
    mpq_class low = 0;
    mpq_class high = 1;
    const auto cut = [&](const mpq_class& from, const mpq_class& by, const mpq_class& least,
                         const mpq_class& most) {
        if (by == 0) {
            return from > least && from < most;
        }
        const mpq_class t0 = (least - from) / by;
        const mpq_class t1 = (most - from) / by;
        low = std::max<mpq_class>(low, std::min<mpq_class>(t0, t1));
        high = std::min<mpq_class>(high, std::max<mpq_class>(t0, t1));
        return true;
    };
    if (a == b) {
        return is_in_square(centre, reach, a, true);
    }
    const bool is_near = cut(mpq_class(a.x), mpq_class(b.x - a.x), mpq_class(centre.x - reach),
                             mpq_class(centre.x + reach)) &&
                         cut(mpq_class(a.y), mpq_class(b.y - a.y), mpq_class(centre.y - reach),
                             mpq_class(centre.y + reach));
    return is_near && low < high;
}

std::vector<FixedPoint> corners_of(std::span<const Box> boxes) {
    std::vector<FixedPoint> out;
    for (const Box& b : boxes) {
        const BoxCorners points(b);
        out.insert(out.end(), points.begin(), points.end());
    }
    return out;
}
std::vector<Box> boxes_at(std::span<const FixedPoint> points) {
    std::vector<Box> out;
    for (const FixedPoint& p : points) {
        out.push_back({p.x, p.y, p.x, p.y});
    }
    return out;
}

// Whether the closed square and the closed convex hull of the boxes have a point in common.
bool touches(const FixedPoint& centre, int64_t reach, std::span<const Box> boxes) {
    const std::vector<FixedPoint> points = corners_of(boxes);
    if (std::any_of(points.begin(), points.end(),
                    [&](const FixedPoint& p) { return is_in_square(centre, reach, p, false); })) {
        return true;
    }
    const auto ends = square(centre, reach);
    if (std::any_of(ends.begin(), ends.end(),
                    [&](const FixedPoint& q) { return is_in_hull(boxes, q); })) {
        return true;
    }
    for (size_t k = 0; k < ends.size(); ++k) {
        for (const FixedPoint& p : points) {
            for (const FixedPoint& q : points) {
                if (segments_meet(ends.at(k), ends.at((k + 1) % ends.size()), p, q)) {
                    return true;
                }
            }
        }
    }
    return false;
}

bool is_filled_by_hull(const FixedPoint& centre, std::span<const Box> boxes) {
    const auto ends = square(centre, kHalfPixel);
    return std::all_of(ends.begin(), ends.end(),
                       [&](const FixedPoint& q) { return is_in_hull(boxes, q); });
}

Coverage between(bool may, bool must) {
    return must ? Coverage::must : (may ? Coverage::either : Coverage::must_not);
}

// What a polygon without area covers, that of a triangle which may have had one.
Coverage degenerate(const TriangleSetup& setup, const PixelArea& area,
                    std::span<const FixedPoint> points, const FixedPoint& centre) {
    if (!area.keeps_degenerates) {
        return Coverage::must_not;
    }
    bool enters = false;
    for (const FixedPoint& p : points) {
        for (const FixedPoint& q : points) {
            enters = enters || enters_square(centre, kHalfPixel + area.least, p, q);
        }
    }
    const bool may = area.is_unbounded || area.is_mitred ||
                     touches(centre, kHalfPixel + area.most, boxes_at(points));
    return between(may, enters && !setup.is_flat && !setup.is_clipped);
}

Coverage of_polygon(const TriangleSetup& setup, const PixelArea& area,
                    std::span<const FixedPoint> polygon, const FixedPoint& centre) {
    const int sign = area_sign(polygon);
    if (sign == 0) {
        return area.is_over() ? degenerate(setup, area, polygon, centre) : Coverage::must_not;
    }
    std::vector<Side> sides;
    bool is_inside = true;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const FixedPoint& a = polygon[i];
        const FixedPoint& b = polygon[(i + 1) % polygon.size()];
        if (a == b) {
            continue;
        }
        sides.push_back(side_of(a, b, sign));
        for (const FixedPoint& q : square(centre, kHalfPixel + area.least)) {
            is_inside = is_inside && sign * side(a, b, q) > 0;
        }
    }
    const std::vector<Box> boxes = boxes_at(polygon);
    if (!area.is_over()) {
        return between(is_filled_by_hull(centre, boxes), is_inside);
    }
    return between(touches(centre, kHalfPixel + area.most, boxes),
                   has_area_within(centre, kHalfPixel + area.least, sides));
}

Coverage of_snapped(const TriangleSetup& setup, const PixelArea& area, const Outline& o,
                    const FixedPoint& centre) {
    bool may = false;
    bool must = true;
    for_each_candidate(o, setup.grid_step, [&](std::span<const FixedPoint> polygon) {
        const Coverage one = of_polygon(setup, area, polygon, centre);
        may = may || one != Coverage::must_not;
        must = must && one == Coverage::must;
    });
    return between(may, must);
}

// The lines that a point has to lie within, strictly, to be covered wherever the corners lie.
std::vector<Side> inner_sides(const Outline& o, int sign) {
    std::vector<Side> out;
    const std::span<const Box> boxes = o.must_vertices();
    for (size_t i = 0; i < boxes.size(); ++i) {
        const Box& from = boxes[i];
        const Box& to = boxes[(i + 1) % boxes.size()];
        if (o.must_test.at(i) != EdgeTest::parallel) {
            for (const FixedPoint& a : BoxCorners(from)) {
                for (const FixedPoint& b : BoxCorners(to)) {
                    out.push_back(side_of(a, b, sign));
                }
            }
            continue;
        }
        Side line = side_of(middle_of(from), middle_of(to), sign);
        mpq_class farthest = 0;
        for (const Box& box : {from, to}) {
            for (const FixedPoint& q : BoxCorners(box)) {
                farthest = std::max<mpq_class>(farthest, line.at({mpq_class(q.x), mpq_class(q.y)}));
            }
        }
        line.c -= farthest.get_num();
        out.push_back(line);
    }
    return out;
}

// Whether the triangle has an area in common with the square wherever its corners lie: no line
// along one of its edges, or along a side of the square, comes between. Along an edge the point of
// the square that lies farthest inside has to lie inside, wherever the ends are: a corner, or,
// where it depends on the ends which, the middle of the side between.
bool overlaps_triangle(const Outline& o, const FixedPoint& centre, int64_t reach, int sign) {
    const std::span<const Box> boxes = o.must_vertices();
    int64_t left = INT64_MAX;
    int64_t right = INT64_MIN;
    int64_t top = INT64_MAX;
    int64_t bottom = INT64_MIN;
    for (const Box& b : boxes) {
        left = std::min(left, b.x1);
        right = std::max(right, b.x0);
        top = std::min(top, b.y1);
        bottom = std::max(bottom, b.y0);
    }
    if (centre.x + reach <= left || centre.x - reach >= right || centre.y + reach <= top ||
        centre.y - reach >= bottom) {
        return false;
    }
    for (size_t i = 0; i < boxes.size(); ++i) {
        const std::vector<FixedPoint> from = corners_of({&boxes[i], 1});
        const std::vector<FixedPoint> to = corners_of({&boxes[(i + 1) % boxes.size()], 1});
        std::vector<int> across, down;
        for (const FixedPoint& a : from) {
            for (const FixedPoint& b : to) {
                across.push_back(-sign * (b.y > a.y ? 1 : b.y < a.y ? -1 : 0));
                down.push_back(sign * (b.x > a.x ? 1 : b.x < a.x ? -1 : 0));
            }
        }
        const auto common = [](const std::vector<int>& signs) {
            return std::all_of(signs.begin(), signs.end(), [&](int s) { return s == signs[0]; })
                       ? signs[0]
                       : 0;
        };
        const FixedPoint q{centre.x + common(across) * reach, centre.y + common(down) * reach};
        for (const FixedPoint& a : from) {
            for (const FixedPoint& b : to) {
                if (sign * side(a, b, q) <= 0) {
                    return false;
                }
            }
        }
    }
    return true;
}

// Whether the pixel may be reached by a triangle whose edges are moved, those at least whose ends
// every device has.
bool is_within_moved_edges(const Outline& o, const FixedPoint& centre, int64_t reach, int sign) {
    for (size_t i = 0; i < o.count; ++i) {
        const Box& from = o.boxes[i];
        const Box& to = o.boxes[(i + 1) % o.count];
        if (sign == 0 || !from.is_point() || !to.is_point() || from == to) {
            continue;
        }
        const auto ends = square(centre, reach);
        if (std::none_of(ends.begin(), ends.end(), [&](const FixedPoint& q) {
                return sign * side({from.x0, from.y0}, {to.x0, to.y0}, q) >= 0;
            })) {
            return false;
        }
    }
    return true;
}

Coverage of_boxes(const TriangleSetup& setup, const PixelArea& area, const Outline& o,
                  const FixedPoint& centre) {
    const AreaSigns signs = area_signs(o.vertices());
    if (!area.is_over()) {
        bool must = false;
        for (const int sign : {1, -1}) {
            bool is_inside = o.must_count >= 3;
            for (const Side& s : inner_sides(o, sign)) {
                for (const FixedPoint& q : square(centre, kHalfPixel + area.least)) {
                    is_inside = is_inside && s.at({mpq_class(q.x), mpq_class(q.y)}) > 0;
                }
            }
            must = must || is_inside;
        }
        return between(is_filled_by_hull(centre, o.vertices()), must);
    }
    if (!signs.negative && !signs.positive) {
        const bool is_fixed = std::all_of(o.vertices().begin(), o.vertices().end(),
                                          [](const Box& b) { return b.is_point(); });
        const Coverage flat = degenerate(setup, area, corners_of(o.vertices()), centre);
        return is_fixed || flat != Coverage::must ? flat : Coverage::either;
    }
    const int sign = signs.only();
    const bool may =
        area.is_unbounded ||
        (area.is_mitred && is_within_moved_edges(o, centre, kHalfPixel + area.most, sign)) ||
        (!area.is_mitred && touches(centre, kHalfPixel + area.most, o.vertices()));
    bool must = false;
    const int64_t reach = kHalfPixel + area.least;
    if (is_plain_triangle(o)) {
        must = sign != 0 && overlaps_triangle(o, centre, reach, sign);
    } else if (o.must_count >= 3) {
        must = has_area_within(centre, reach, inner_sides(o, 1)) ||
               has_area_within(centre, reach, inner_sides(o, -1));
    }
    return between(may || must, must);
}

// What all pieces of the outline come to.
Coverage of_pieces(const PixelArea& area, const Outline& o, const FixedPoint& centre,
                   Coverage whole) {
    const bool is_open = whole == Coverage::must && !area.is_over();
    return is_open && meets_inner_edge(area, o, centre) ? Coverage::either : whole;
}

}  // namespace

Coverage pixel_coverage(const TriangleSetup& setup, const PixelArea& area, const Outline& o,
                        const FixedPoint& centre) {
    switch (o.mode) {
        case OutlineMode::empty:
            break;
        case OutlineMode::snapped:
            return of_pieces(area, o, centre, of_snapped(setup, area, o, centre));
        case OutlineMode::boxes:
            return of_pieces(area, o, centre, of_boxes(setup, area, o, centre));
    }
    return Coverage::must_not;
}

bool meets_inner_edge(const PixelArea& area, const Outline& o, const FixedPoint& centre) {
    const std::vector<InnerEdge> edges = inner_edges(o, area);
    return std::any_of(edges.begin(), edges.end(), [&](const InnerEdge& edge) {
        return touches(centre, reach_of_inner_edges(area), edge);
    });
}

uint32_t further_pieces_at(const TriangleSetup& setup, const Outline& o, const FixedPoint& p) {
    const PixelArea& area = setup.area;
    if (o.mode == OutlineMode::empty || further_pieces(o, area) == 0) {
        return 0;
    }
    const bool may_meet =
        area.is_over() && (meets_everywhere(area) || meets_inner_edge(area, o, p));
    return may_meet ? further_pieces(o, area) : 0;
}

}  // namespace ref::exact
