// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/fast/fast.hpp"

#include <algorithm>
#include <limits>

#include "ref/coverage/fast/half_plane.hpp"
#include "ref/coverage/fast/rows.hpp"
#include "ref/coverage/fast/snapped.hpp"
#include "ref/coverage/pieces.hpp"

namespace ref::fast {

namespace {

// Largest |position| in S47.16 for which the 64-bit row arithmetic cannot overflow: with |x|, |y|
// and vertex coordinates <= 2^30, |a|, |b| <= 2^31, |c| <= 2^61 + 1, so |a x + b y + c| < 3 * 2^61
// + 1.
constexpr int64_t kNarrowLimit = int64_t{1} << 30;
static_assert(int64_t{cases::kMaxTargetSize} * kFixedOne <= kNarrowLimit,
              "every sample of a target is narrow");
static_assert(3 * (Int128{1} << 61) + 1 < (Int128{1} << 63), "a narrow edge function fits int64_t");
// An edge tested as parallel has |c| <= |a q_x + b q_y| + 1 for a corner q: with vertices within
// 2^29, |a|, |b| <= 2^30 and |c| <= 2^60 + 1, and samples add at most 2^61.
constexpr int64_t kNarrowParallelLimit = int64_t{1} << 29;
static_assert((Int128{1} << 61) + (Int128{1} << 60) + 1 < (Int128{1} << 63));

template <class T>
std::vector<RowPlane<T>> row_planes(const std::vector<HalfPlane>& planes,
                                    const FixedPoint& origin) {
    std::vector<RowPlane<T>> out;
    out.reserve(planes.size());
    for (const HalfPlane& p : planes) {
        out.push_back({static_cast<T>(p.at(origin)), static_cast<T>(p.b * kFixedOne),
                       static_cast<T>(p.a * kFixedOne)});
    }
    return out;
}

template <class T>
void step_row(std::vector<RowPlane<T>>& planes) {
    for (RowPlane<T>& p : planes) {
        p.value += p.row_step;
    }
}

template <class T>
struct RowSet {
    std::vector<RowPlane<T>> planes;
    Columns columns;
    int64_t row_low = 0, row_high = -1;
};

template <class T>
void scan_sets(const CoverageSets& sets, const Grid& g, const Span& base, std::vector<Span>& out) {
    int64_t row_low = std::numeric_limits<int64_t>::max();
    int64_t row_high = std::numeric_limits<int64_t>::min();
    std::vector<RowSet<T>> may(sets.may.size());
    for (size_t k = 0; k < may.size(); ++k) {
        const Box& b = sets.may[k].bounds;
        RowSet<T>& r = may[k];
        r.columns = {std::max(g.may_columns.low, first_at(b.x0, g.offset.x)),
                     std::min(g.may_columns.high, last_at(b.x1, g.offset.x))};
        r.row_low = std::max(g.may_row_low, first_at(b.y0, g.offset.y));
        r.row_high = std::min(g.may_row_high, last_at(b.y1, g.offset.y));
        if (r.columns.is_empty() || r.row_low > r.row_high) {
            r.row_high = r.row_low - 1;
            continue;
        }
        row_low = std::min(row_low, r.row_low);
        row_high = std::max(row_high, r.row_high);
    }
    if (row_low > row_high) {
        return;
    }
    const FixedPoint origin{g.offset.x, g.offset.y + row_low * kFixedOne};
    for (size_t k = 0; k < may.size(); ++k) {
        if (may[k].row_low <= may[k].row_high) {
            may[k].planes = row_planes<T>(sets.may[k].planes, origin);
        }
    }
    std::vector<RowPlane<T>> must;
    // One set with the same planes is must and may at once.
    const bool is_single = sets.has_must && may.size() == 1 && sets.must == sets.may[0].planes;
    if (sets.has_must && !is_single) {
        must = row_planes<T>(sets.must, origin);
    }
    std::vector<Columns> row;
    for (int64_t j = row_low; j <= row_high; ++j) {
        row.clear();
        for (RowSet<T>& r : may) {
            if (j >= r.row_low && j <= r.row_high) {
                Columns c = r.columns;
                for (const RowPlane<T>& p : r.planes) {
                    p.cut(c);
                }
                if (!c.is_empty()) {
                    row.push_back(c);
                }
            }
            step_row(r.planes);
        }
        Columns sure;
        if (!row.empty() && sets.has_must && j >= g.must_row_low && j <= g.must_row_high) {
            sure = g.must_columns;
            if (is_single) {
                sure = {std::max(sure.low, row[0].low), std::min(sure.high, row[0].high)};
            }
            for (const RowPlane<T>& p : must) {
                p.cut(sure);
            }
        }
        step_row(must);
        if (!row.empty()) {
            Span where = base;
            where.y = static_cast<uint32_t>(j);
            emit_row(row, sure, where, out);
        }
    }
}

// Makes what must be covered, from the span `first` on, open where `open` is. The rows of both
// ascend.
void open_spans(std::vector<Span>& spans, size_t first, std::span<const Span> open) {
    std::vector<Span> out;
    size_t row = 0;  // where the row of the span begins in `open`
    for (const Span& s : std::span(spans).subspan(first)) {
        while (row < open.size() && open[row].y < s.y) {
            ++row;
        }
        Span rest = s;
        for (size_t k = row; s.coverage == Coverage::must && k < open.size(); ++k) {
            const Span& o = open[k];
            if (o.y != s.y) {
                break;
            }
            if (o.x0 >= rest.x1 || o.x1 <= rest.x0) {
                continue;
            }
            Span part = rest;
            part.x1 = std::max(rest.x0, o.x0);
            if (part.x0 < part.x1) {
                out.push_back(part);
            }
            part.x0 = part.x1;
            part.x1 = std::min(rest.x1, o.x1);
            part.coverage = Coverage::either;
            out.push_back(part);
            rest.x0 = part.x1;
        }
        if (rest.x0 < rest.x1) {
            out.push_back(rest);
        }
    }
    spans.resize(first);
    spans.insert(spans.end(), out.begin(), out.end());
}

template <class T>
void scan_pieces(const CoverageSets& sets, const Grid& g, const Span& base, size_t first,
                 std::vector<Span>& out) {
    CoverageSets some;
    some.has_must = false;
    for (const std::vector<ConvexSet>& further : sets.further) {
        some.may = further;
        scan_sets<T>(some, g, base, out);
    }
    if (!sets.open.empty()) {
        some.may = sets.open;
        std::vector<Span> open;
        scan_sets<T>(some, g, base, open);
        open_spans(out, first, open);
    }
}

bool is_narrow(const TriangleSetup& setup) {
    for (const Outline* const outline : setup.outlines()) {
        const Outline& o = *outline;
        if (!o.cuts.empty()) {
            return false;
        }
        const bool has_parallel =
            std::any_of(o.must_test.begin(), o.must_test.begin() + o.must_count,
                        [](EdgeTest test) { return test == EdgeTest::parallel; });
        const int64_t limit = has_parallel ? kNarrowParallelLimit : kNarrowLimit;
        for (const Box& b : o.vertices()) {
            if (std::min(b.x0, b.y0) < -limit || std::max(b.x1, b.y1) > limit) {
                return false;
            }
        }
    }
    return true;
}

bool contains(const ConvexSet& set, const FixedPoint& p) {
    return p.x >= set.bounds.x0 && p.x <= set.bounds.x1 && p.y >= set.bounds.y0 &&
           p.y <= set.bounds.y1 &&
           std::all_of(set.planes.begin(), set.planes.end(),
                       [&](const HalfPlane& h) { return h.at(p) >= 0; });
}

}  // namespace

void scan(const TriangleSetup& setup, uint32_t triangle, const cases::Target& target,
          std::vector<Span>& out) {
    if (is_plain_snapped(setup)) {
        scan_snapped(setup, triangle, target, out);
    } else {
        scan_by_sets(setup, triangle, target, out);
    }
}

void scan_by_sets(const TriangleSetup& setup, uint32_t triangle, const cases::Target& target,
                  std::vector<Span>& out) {
    if (setup.kind == TriangleSetup::Kind::nothing) {
        return;
    }
    CoverageSets sets;
    bool is_wide = false;
    if (setup.kind == TriangleSetup::Kind::outlines) {
        sets = coverage_sets(setup);
        sets.has_must = sets.has_must && !setup.may_be_culled && !setup.window.is_open();
        is_wide = !is_narrow(setup);
    } else {
        constexpr int64_t kFar = int64_t{1} << kPositionBits;
        sets.has_must = setup.kind == TriangleSetup::Kind::cleared;
        sets.may.push_back({{}, {-kFar, -kFar, kFar, kFar}});
        sets.further.assign(further_if_undefined(setup.area), sets.may);
    }
    for (uint32_t s = 0; s < target.samples; ++s) {
        if (!setup.window.may_write(s)) {
            continue;
        }
        const FixedPoint offset =
            setup.area.is_on() ? pixel_centre({0, 0}) : sample_position(0, 0, s, target);
        const Grid g = grid_of(setup.window, offset);
        Span base;
        base.sample = s;
        base.triangle = triangle;
        const size_t first = out.size();
        if (is_wide) {
            scan_sets<Int128>(sets, g, base, out);
            scan_pieces<Int128>(sets, g, base, first, out);
        } else {
            scan_sets<int64_t>(sets, g, base, out);
            scan_pieces<int64_t>(sets, g, base, first, out);
        }
    }
}

Coverage classify(const TriangleSetup& setup, const FixedPoint& sample) {
    const FixedPoint p = setup.area.is_on() ? pixel_centre(sample) : sample;
    if (setup.kind == TriangleSetup::Kind::nothing || !setup.window.may_touch(p)) {
        return Coverage::must_not;
    }
    if (setup.kind != TriangleSetup::Kind::outlines) {
        return setup.kind == TriangleSetup::Kind::cleared ? Coverage::must : Coverage::either;
    }
    const CoverageSets sets = coverage_sets(setup);
    if (std::none_of(sets.may.begin(), sets.may.end(),
                     [&](const ConvexSet& s) { return contains(s, p); })) {
        return Coverage::must_not;
    }
    const bool is_must = sets.has_must && !setup.may_be_culled && setup.window.must_touch(p) &&
                         std::all_of(sets.must.begin(), sets.must.end(),
                                     [&](const HalfPlane& h) { return h.at(p) >= 0; }) &&
                         std::none_of(sets.open.begin(), sets.open.end(),
                                      [&](const ConvexSet& s) { return contains(s, p); });
    return is_must ? Coverage::must : Coverage::either;
}

bool is_in_hull(std::span<const Box> boxes, const FixedPoint& p) {
    const auto outside = [&](auto low, auto high, int64_t v) {
        return std::all_of(boxes.begin(), boxes.end(), [&](const Box& b) { return b.*low > v; }) ||
               std::all_of(boxes.begin(), boxes.end(), [&](const Box& b) { return b.*high < v; });
    };
    if (outside(&Box::x0, &Box::x1, p.x) || outside(&Box::y0, &Box::y1, p.y)) {
        return false;
    }
    return contains(hull_set(boxes), p);
}

bool is_inside_whole(const TriangleSetup& setup, const Outline& outline, const FixedPoint& p) {
    CoverageSets sets = coverage_set(outline, setup.grid_step);
    return sets.has_must &&
           std::any_of(sets.may.begin(), sets.may.end(),
                       [&](const ConvexSet& s) { return contains(s, p); }) &&
           std::all_of(sets.must.begin(), sets.must.end(),
                       [&](const HalfPlane& h) { return h.at(p) >= 0; });
}

int winding(std::span<const FixedPoint> polygon, const FixedPoint& p) {
    int turns = 0;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const FixedPoint& a = polygon[i];
        const FixedPoint& b = polygon[(i + 1) % polygon.size()];
        // Edges that a ray from p to the right crosses; p is thought a little to the right and,
        // less, down of where it is, which is the top-left rule.
        if (a.y <= p.y && b.y > p.y) {
            turns += edge_function(a, b, p) > 0 ? 1 : 0;
        } else if (b.y <= p.y && a.y > p.y) {
            turns -= edge_function(a, b, p) < 0 ? 1 : 0;
        }
    }
    return turns;
}

}  // namespace ref::fast
