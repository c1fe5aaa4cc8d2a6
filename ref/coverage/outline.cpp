// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/outline.hpp"

#include <algorithm>
#include <cmath>

#include "ref/number/edge_function.hpp"
#include "ref/position/position_detail.hpp"

namespace ref {

namespace {

bool overlap(const Box& a, const Box& b) {
    return a.x0 <= b.x1 && b.x0 <= a.x1 && a.y0 <= b.y1 && b.y0 <= a.y1;
}

// Why edges may be tested as `parallel`. Two cut vertices may lie so close that the short edge
// between them may point nearly anywhere, and hardly any sample is inside for every choice of its
// ends. That is more than has to hold. Let sample p pass the tests of all edges. However the
// positions are chosen from their boxes, p is on no edge: it is strictly inside a `strict` one, and
// a `parallel` one stays in the hull of its two boxes, which a line separates from p. So the
// winding number around p is the same for all choices. For the middles of the boxes p is strictly
// inside every edge; seen from p each turns by an angle in (0, pi) in the same sense, so the number
// is not zero and p is covered. (On an edge with test top_left, think p moved off it by as little
// as the top-left rule does.)
//
// For a long edge the lines through its corners are close together, and closer to the edge where a
// box is small; edges of a cut outline that are short, or lie on a plane of the view volume, are
// tested as parallel.
bool is_short(const Box& a, const Box& b) {
    constexpr int64_t kShort = 16;
    const int64_t size = std::max({a.x1 - a.x0, a.y1 - a.y0, b.x1 - b.x0, b.y1 - b.y0, int64_t{1}});
    const FixedPoint p = middle_of(a);
    const FixedPoint q = middle_of(b);
    return std::max(std::abs(p.x - q.x), std::abs(p.y - q.y)) < kShort * size;
}

// An edge of the triangle between two vertices that every device puts in the same place is the same
// edge in every outline. If no box reaches across it, all that is drawn lies on one side of it: a
// sample on it is settled by the top-left rule alone.
void test_tie(Outline& o, size_t i) {
    const Box& a = o.must_boxes[i];
    const Box& b = o.must_boxes[(i + 1) % o.must_count];
    if (!a.is_point() || !b.is_point() || a == b) {
        return;
    }
    bool has_positive = false;
    bool has_negative = false;
    for (const Box& c : o.vertices()) {
        for (const FixedPoint& q : BoxCorners(c)) {
            const Int128 e = edge_function({a.x0, a.y0}, {b.x0, b.y0}, q);
            has_positive = has_positive || e > 0;
            has_negative = has_negative || e < 0;
        }
    }
    if (has_positive != has_negative) {
        o.must_test[i] = EdgeTest::top_left;
        o.tie_side[i] = has_positive ? 1 : -1;
    }
}

void draw_together(Outline& o, bool has_tie_rule) {
    if (o.count <= 3 && std::none_of(o.edge.begin(), o.edge.begin() + o.count,
                                     [](EdgeLabel e) { return e >= kFirstClipEdge; })) {
        // A triangle as it is: nothing is drawn together and no edge is cut.
        o.must_count = o.count;
        o.must_boxes = o.boxes;
        for (size_t i = 0; i < o.count; ++i) {
            o.must_test[i] = EdgeTest::strict;
            o.tie_side[i] = 0;
            if (has_tie_rule) {
                test_tie(o, i);
            }
        }
        return;
    }
    std::vector<Box> boxes(o.vertices().begin(), o.vertices().end());
    std::vector<EdgeLabel> labels(o.edge.begin(), o.edge.begin() + o.count);
    bool has_changed = o.count > 3;
    while (has_changed && boxes.size() > 1) {
        has_changed = false;
        for (size_t i = 0; i < boxes.size(); ++i) {
            const size_t next = (i + 1) % boxes.size();
            if (next != i && overlap(boxes[i], boxes[next])) {
                boxes[i] = hull_of(boxes[i], boxes[next]);
                labels[i] = labels[next];
                boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(next));
                labels.erase(labels.begin() + static_cast<std::ptrdiff_t>(next));
                has_changed = true;
                break;
            }
        }
    }
    o.must_count = static_cast<uint32_t>(boxes.size());
    for (size_t i = 0; i < boxes.size(); ++i) {
        o.must_boxes[i] = boxes[i];
    }
    const bool is_cut = std::any_of(o.edge.begin(), o.edge.begin() + o.count,
                                    [](EdgeLabel e) { return e >= kFirstClipEdge; });
    for (size_t i = 0; i < boxes.size(); ++i) {
        o.must_test[i] = EdgeTest::strict;
        o.tie_side[i] = 0;
        const bool is_on_plane = labels[i] >= kFirstClipEdge;
        if (!is_on_plane && has_tie_rule) {
            test_tie(o, i);
        }
        if (o.must_test[i] == EdgeTest::strict && is_cut &&
            (is_on_plane || is_short(boxes[i], boxes[(i + 1) % boxes.size()]))) {
            o.must_test[i] = EdgeTest::parallel;
        }
    }
}

int64_t candidate_count(const Outline& o, int64_t step) {
    int64_t count = 1;
    for (const Box& b : o.vertices()) {
        const int64_t columns = (b.x1 - b.x0) / step + 1;
        const int64_t rows = (b.y1 - b.y0) / step + 1;
        if (columns > kMaxCandidates || rows > kMaxCandidates) {
            return kMaxCandidates + 1;
        }
        count = std::min(count * columns * rows, kMaxCandidates + 1);
    }
    return count;
}

// A polygon of points, each edge of which has all vertices on its inner side, with an area.
bool is_convex(const Outline& o) {
    bool has_positive = false;
    bool has_negative = false;
    for (uint32_t i = 0; i < o.count; ++i) {
        const Box& a = o.boxes[i];
        const Box& b = o.boxes[(i + 1) % o.count];
        for (const Box& c : o.vertices()) {
            const Int128 e = edge_function({a.x0, a.y0}, {b.x0, b.y0}, {c.x0, c.y0});
            has_positive = has_positive || e > 0;
            has_negative = has_negative || e < 0;
        }
    }
    return has_positive != has_negative;
}

}  // namespace

void choose_mode(Outline& o, int64_t step, cases::Profile profile) {
    if (o.count == 0) {
        o.mode = OutlineMode::empty;
        return;
    }
    if (profile == cases::Profile::direct3d && o.count >= 3 && o.is_on_grid) {
        const int64_t candidates = candidate_count(o, step);
        if (o.count == 3 ? candidates <= kMaxCandidates : candidates == 1 && is_convex(o)) {
            o.mode = OutlineMode::snapped;
            o.must_count = 0;
            return;
        }
    }
    draw_together(o, profile == cases::Profile::direct3d);
    o.mode = OutlineMode::boxes;
}

AreaSigns signs_of(const Outline& o, int64_t step, bool may_be_zero) {
    if (o.mode == OutlineMode::empty) {
        return {};
    }
    if (o.mode == OutlineMode::snapped && o.count == 3) {
        AreaSigns signs = snapped_area_signs(o.vertices(), step);
        if (!may_be_zero && (signs.negative || signs.positive)) {
            signs.zero = false;  // a snapped triangle without area covers nothing
        }
        return signs;
    }
    return area_signs(o.vertices());
}

}  // namespace ref
