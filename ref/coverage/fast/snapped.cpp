// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/fast/snapped.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "ref/coverage/fast/rows.hpp"

namespace ref::fast {

namespace {

// Largest |position| in S47.16. Vertices within 2^29 and samples within 2^30 differ by less than
// 2^31 in x and y, the vertices by at most 2^30: an edge function of a sample is a difference of
// two products below 2^61, one of a vertex of two within 2^60, and a step of one row adds 2^46.
constexpr int64_t kLimit = int64_t{1} << 29;
static_assert(int64_t{cases::kMaxTargetSize} * kFixedOne <= int64_t{1} << 30,
              "every sample of a target is within 2^30");

int64_t narrow_edge(const FixedPoint& a, const FixedPoint& b, const FixedPoint& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// The corners of a candidate, clockwise on screen.
using Corners = std::array<FixedPoint, 3>;

struct Candidate {
    Corners corners;
    std::array<RowPlane<int64_t>, 3> planes;
    Columns columns;
    int64_t row_low, row_high;
};

// The columns and rows of samples in the candidate's bounds; false if there are none.
bool bound(const Grid& g, Candidate& out) {
    const Corners& v = out.corners;
    const auto [x0, x1] = std::minmax({v[0].x, v[1].x, v[2].x});
    const auto [y0, y1] = std::minmax({v[0].y, v[1].y, v[2].y});
    out.columns = {std::max(g.may_columns.low, first_at(x0, g.offset.x)),
                   std::min(g.may_columns.high, last_at(x1, g.offset.x))};
    out.row_low = std::max(g.may_row_low, first_at(y0, g.offset.y));
    out.row_high = std::min(g.may_row_high, last_at(y1, g.offset.y));
    return !out.columns.is_empty() && out.row_low <= out.row_high;
}

// The edges at the first sample of the row.
void set_planes(const FixedPoint& origin, Candidate& out) {
    for (size_t i = 0; i < 3; ++i) {
        const FixedPoint& a = out.corners.at(i);
        const FixedPoint& b = out.corners.at((i + 1) % 3);
        out.planes.at(i) = {narrow_edge(a, b, origin) - (is_top_left(a, b) ? 0 : 1),
                            (b.x - a.x) * kFixedOne, (a.y - b.y) * kFixedOne};
    }
}

void scan_rows(std::vector<Candidate>& candidates, const Grid& g, bool has_must, int64_t row_low,
               int64_t row_high, const Span& base, std::vector<Span>& out) {
    std::array<Columns, kMaxCandidates> row;
    for (int64_t j = row_low; j <= row_high; ++j) {
        size_t count = 0;
        Columns sure;
        if (has_must && j >= g.must_row_low && j <= g.must_row_high) {
            sure = g.must_columns;
        }
        for (Candidate& k : candidates) {
            Columns c;
            if (j >= k.row_low && j <= k.row_high) {
                c = k.columns;
                for (const RowPlane<int64_t>& p : k.planes) {
                    p.cut(c);
                }
            }
            for (RowPlane<int64_t>& p : k.planes) {
                p.value += p.row_step;
            }
            sure = {std::max(sure.low, c.low), std::min(sure.high, c.high)};
            if (!c.is_empty()) {
                row.at(count++) = c;
            }
        }
        if (count > 0) {
            Span where = base;
            where.y = static_cast<uint32_t>(j);
            emit_row({row.data(), count}, sure, where, out);
        }
    }
}

void scan_candidates(std::span<const Corners> corners, const Grid& g, bool has_must,
                     const Span& base, std::vector<Span>& out) {
    int64_t row_low = std::numeric_limits<int64_t>::max();
    int64_t row_high = std::numeric_limits<int64_t>::min();
    std::vector<Candidate> candidates;
    for (const Corners& v : corners) {
        Candidate c{v, {}, {}, 0, 0};
        if (!bound(g, c)) {
            has_must = false;  // covers nothing here
            continue;
        }
        row_low = std::min(row_low, c.row_low);
        row_high = std::max(row_high, c.row_high);
        candidates.push_back(c);
    }
    for (Candidate& c : candidates) {
        set_planes({g.offset.x, g.offset.y + row_low * kFixedOne}, c);
    }
    scan_rows(candidates, g, has_must, row_low, row_high, base, out);
}

}  // namespace

bool is_plain_snapped(const TriangleSetup& setup) {
    const Outline& o = setup.unclipped;
    if (setup.area.is_on() || setup.kind != TriangleSetup::Kind::outlines || !setup.has_outline ||
        setup.is_clipped || !setup.tested.empty() || o.mode != OutlineMode::snapped ||
        o.count != 3 || !o.cuts.empty()) {
        return false;
    }
    return std::all_of(o.vertices().begin(), o.vertices().end(), [](const Box& b) {
        return std::min(b.x0, b.y0) >= -kLimit && std::max(b.x1, b.y1) <= kLimit;
    });
}

void scan_snapped(const TriangleSetup& setup, uint32_t triangle, const cases::Target& target,
                  std::vector<Span>& out) {
    const Outline& o = setup.unclipped;
    std::array<Corners, kMaxCandidates> corners;
    size_t count = 0;
    bool has_must = !setup.may_be_culled && !setup.window.is_open();
    const auto for_each = [step = setup.grid_step](const Box& b, const auto& body) {
        for (int64_t y = b.y0; y <= b.y1; y += step) {
            for (int64_t x = b.x0; x <= b.x1; x += step) {
                body(FixedPoint{x, y});
            }
        }
    };
    for_each(o.boxes[0], [&](const FixedPoint& a) {
        for_each(o.boxes[1], [&](const FixedPoint& b) {
            for_each(o.boxes[2], [&](const FixedPoint& c) {
                const int64_t area = narrow_edge(a, b, c);
                if (area == 0) {
                    has_must = false;
                } else {
                    corners.at(count++) = area > 0 ? Corners{a, b, c} : Corners{a, c, b};
                }
            });
        });
    });
    for (uint32_t s = 0; s < target.samples; ++s) {
        if (setup.window.may_write(s)) {
            Span base;
            base.sample = s;
            base.triangle = triangle;
            scan_candidates({corners.data(), count},
                            grid_of(setup.window, sample_position(0, 0, s, target)), has_must, base,
                            out);
        }
    }
}

}  // namespace ref::fast
