// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/exact/exact.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <vector>

#include "ref/coverage/exact/reason_names.hpp"
#include "ref/coverage/pieces.hpp"

namespace ref::exact {

namespace {

struct Vector {
    mpz_class x, y;
};

Vector between(const FixedPoint& from, const FixedPoint& to) {
    return {mpz_class(to.x) - mpz_class(from.x), mpz_class(to.y) - mpz_class(from.y)};
}

mpz_class cross(const Vector& a, const Vector& b) {
    return a.x * b.y - a.y * b.x;
}
mpz_class dot(const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y;
}

// E_ab(p) = (b-a) x (p-a)
mpz_class edge(const FixedPoint& a, const FixedPoint& b, const FixedPoint& p) {
    return cross(between(a, b), between(a, p));
}

std::vector<FixedPoint> corners(std::span<const Box> boxes) {
    std::vector<FixedPoint> out;
    for (const Box& b : boxes) {
        out.insert(out.end(), {{b.x0, b.y0}, {b.x1, b.y0}, {b.x0, b.y1}, {b.x1, b.y1}});
    }
    return out;
}

bool is_outside_bounds(std::span<const Box> boxes, const FixedPoint& p) {
    Box all = boxes[0];
    for (const Box& b : boxes) {
        all = {std::min(all.x0, b.x0), std::min(all.y0, b.y0), std::max(all.x1, b.x1),
               std::max(all.y1, b.y1)};
    }
    return p.x < all.x0 || p.x > all.x1 || p.y < all.y0 || p.y > all.y1;
}

// Whether p lies on the inner side of edge a->b of a triangle that runs clockwise on screen.
bool is_inside_edge(const FixedPoint& a, const FixedPoint& b, const FixedPoint& p) {
    const int e = sgn(edge(a, b, p));
    const bool is_top = a.y == b.y && a.x < b.x;
    const bool is_left = b.y < a.y;
    return e > 0 || (e == 0 && (is_top || is_left));
}

bool is_inside_tie(const Box& from, const Box& to, const FixedPoint& p, int sign) {
    const FixedPoint a{from.x0, from.y0};
    const FixedPoint b{to.x0, to.y0};
    return sign > 0 ? is_inside_edge(a, b, p) : is_inside_edge(b, a, p);
}

// Inside one edge as its test asks (setup.cpp says why the tests suffice).
bool is_inside(const Box& from, const Box& to, EdgeTest test, const FixedPoint& p, int sign) {
    if (test == EdgeTest::top_left) {
        return is_inside_tie(from, to, p, sign);
    }
    if (test == EdgeTest::parallel) {
        const Vector along = between(middle_of(from), middle_of(to));
        const std::array<Box, 2> both{from, to};
        const auto is_farther = [&](const FixedPoint& q) {
            return sgn(cross(along, between(q, p))) == sign;
        };
        const std::vector<FixedPoint> points = corners(both);
        return std::all_of(points.begin(), points.end(), is_farther);
    }
    for (const FixedPoint& a : corners({&from, 1})) {
        for (const FixedPoint& b : corners({&to, 1})) {
            if (sgn(edge(a, b, p)) != sign) {
                return false;
            }
        }
    }
    return true;
}

// Inside all edges, in one of the two directions.
bool is_inside_all(const Outline& o, const FixedPoint& p, int sign) {
    const std::span<const Box> boxes = o.must_vertices();
    for (size_t i = 0; i < boxes.size(); ++i) {
        const Box& next = boxes[(i + 1) % boxes.size()];
        if (!is_inside(boxes[i], next, o.must_test[i], p, sign)) {
            return false;
        }
    }
    return boxes.size() >= 3;
}

// What all and some of the snapped polygons say.
Coverage by_snapping(const Outline& o, int64_t step, const FixedPoint& p) {
    bool is_in_all = true;
    bool is_in_some = false;
    const auto add = [&](bool is_covered) {
        is_in_all = is_in_all && is_covered;
        is_in_some = is_in_some || is_covered;
    };
    if (is_outside_bounds(o.vertices(), p)) {
        return Coverage::must_not;
    }
    if (o.count == 3) {
        for (const FixedPoint& a : grid_points(o.boxes[0], step)) {
            for (const FixedPoint& b : grid_points(o.boxes[1], step)) {
                for (const FixedPoint& c : grid_points(o.boxes[2], step)) {
                    add(covers(a, b, c, p));
                }
            }
        }
    } else {
        std::vector<FixedPoint> polygon;
        for (const Box& b : o.vertices()) {
            polygon.push_back({b.x0, b.y0});
        }
        add(winding(polygon, p) != 0);
    }
    return is_in_all ? Coverage::must : (is_in_some ? Coverage::either : Coverage::must_not);
}

Coverage by_boxes(const Outline& o, const FixedPoint& p) {
    if (!is_in_hull(o.vertices(), p)) {
        return Coverage::must_not;
    }
    const std::span<const Box> boxes = o.must_vertices();
    for (size_t i = 0; i < boxes.size(); ++i) {
        if (o.must_test[i] == EdgeTest::top_left &&
            !is_inside_tie(boxes[i], boxes[(i + 1) % boxes.size()], p, o.tie_side[i])) {
            return Coverage::must_not;
        }
    }
    return is_inside_all(o, p, 1) || is_inside_all(o, p, -1) ? Coverage::must : Coverage::either;
}

bool is_inside(const HalfPlane& h, const FixedPoint& p) {
    return to_mpz(h.a) * p.x + to_mpz(h.b) * p.y + to_mpz(h.c) >= 0;
}

// What the clip distances that are tested at the sample leave of the outline's coverage.
// Of a pixel that is covered whole the place where they are tested may lie anywhere in it.
Coverage after_cuts(Coverage c, const Outline& o, const FixedPoint& p, int64_t reach) {
    const std::vector<FixedPoint> places =
        corners(std::array{Box{p.x - reach, p.y - reach, p.x + reach, p.y + reach}});
    for (const DistanceCut& cut : o.cuts) {
        if (std::none_of(places.begin(), places.end(),
                         [&](const FixedPoint& q) { return is_inside(cut.may, q); })) {
            return Coverage::must_not;
        }
        if (c == Coverage::must &&
            !std::all_of(places.begin(), places.end(),
                         [&](const FixedPoint& q) { return is_inside(cut.must, q); })) {
            c = Coverage::either;
        }
    }
    return c;
}

}  // namespace

bool covers(const FixedPoint& a, const FixedPoint& b, const FixedPoint& c, const FixedPoint& p) {
    const int area = sgn(edge(a, b, c));
    if (area == 0) {
        return false;
    }
    const FixedPoint& second = area > 0 ? b : c;
    const FixedPoint& third = area > 0 ? c : b;
    return is_inside_edge(a, second, p) && is_inside_edge(second, third, p) &&
           is_inside_edge(third, a, p);
}

bool is_in_hull(std::span<const Box> boxes, const FixedPoint& p) {
    if (boxes.empty() || is_outside_bounds(boxes, p)) {
        return false;
    }
    const std::vector<FixedPoint> points = corners(boxes);
    if (std::find(points.begin(), points.end(), p) != points.end()) {
        return true;
    }
    // If p is outside, some q comes first as seen from p: all others lie to one side of the ray
    // through q or on it, none behind p.
    return std::none_of(points.begin(), points.end(), [&](const FixedPoint& q) {
        const Vector to_q = between(p, q);
        return std::all_of(points.begin(), points.end(), [&](const FixedPoint& r) {
            const Vector to_r = between(p, r);
            const int side = sgn(cross(to_q, to_r));
            return side > 0 || (side == 0 && sgn(dot(to_q, to_r)) > 0);
        });
    });
}

int winding(std::span<const FixedPoint> polygon, const FixedPoint& p) {
    int turns = 0;
    for (size_t i = 1; i + 1 < polygon.size(); ++i) {
        if (covers(polygon[0], polygon[i], polygon[i + 1], p)) {
            turns += sgn(edge(polygon[0], polygon[i], polygon[i + 1]));
        }
    }
    return turns;
}

bool is_inside_whole(const TriangleSetup& setup, const Outline& outline, const FixedPoint& p) {
    if (outline.mode == OutlineMode::snapped) {
        return by_snapping(outline, setup.grid_step, p) == Coverage::must;
    }
    return outline.mode == OutlineMode::boxes && by_boxes(outline, p) == Coverage::must;
}

Coverage coverage_of(const TriangleSetup& setup, const Outline& o, const FixedPoint& p) {
    if (setup.area.is_on()) {
        return pixel_coverage(setup, setup.area, o, p);
    }
    switch (o.mode) {
        case OutlineMode::empty:
            break;
        case OutlineMode::snapped:
            return by_snapping(o, setup.grid_step, p);
        case OutlineMode::boxes:
            return by_boxes(o, p);
    }
    return Coverage::must_not;
}

Decision decide(const TriangleSetup& setup, const FixedPoint& sample, bool is_told) {
    const FixedPoint p = setup.area.is_on() ? pixel_centre(sample) : sample;
    const Window& window = setup.window;
    const bool may_draw = setup.kind != TriangleSetup::Kind::nothing && window.may_touch(p);
    if (!may_draw && !is_told) {
        return {};
    }
    Decision out;
    if (setup.kind == TriangleSetup::Kind::anywhere) {
        out.coverage = Coverage::either;
        out.further = further_if_undefined(setup.area);
    } else if (setup.kind == TriangleSetup::Kind::cleared) {
        out.coverage = Coverage::must;
    } else {
        const OutlineList outlines = setup.outlines();
        const size_t count = outlines.size();
        std::array<Coverage, OutlineList::kMaxOutlines> each{};
        for (size_t k = 0; k < count; ++k) {
            each[k] = after_cuts(coverage_of(setup, *outlines[k], p), *outlines[k], p,
                                 setup.area.is_on() ? kHalfPixel : 0);
            if (each[k] != Coverage::must_not) {
                out.further = std::max(out.further, further_pieces_at(setup, *outlines[k], p));
            }
        }
        const auto [least, most] = std::minmax_element(each.begin(), each.begin() + count);
        out.coverage = count == 0 || *most == Coverage::must_not ? Coverage::must_not
                       : *least == Coverage::must                ? Coverage::must
                                                                 : Coverage::either;
        for (size_t k = 0; is_told && k < count; ++k) {
            name_reasons(setup, *outlines[k], p, each[k], out);
        }
    }
    if (!may_draw) {
        if (out.coverage != Coverage::must_not) {
            out.reasons.clear();
        }
        out.coverage = Coverage::must_not;
        out.further = 0;
    } else if (out.coverage == Coverage::must && (setup.may_be_culled || !window.must_touch(p))) {
        out.reasons.clear();
        out.coverage = Coverage::either;
    }
    if (is_told) {
        name_setup_reasons(setup, p, out);
    }
    return out;
}

Coverage classify(const TriangleSetup& setup, const FixedPoint& p) {
    return decide(setup, p, false).coverage;
}

}  // namespace ref::exact
