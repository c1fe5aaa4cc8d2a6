// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/fast/rows.hpp"

#include <limits>

namespace ref::fast {

Grid grid_of(const Window& w, const FixedPoint& offset) {
    Grid g;
    g.offset = offset;
    g.may_columns = {w.pixel_x0, w.pixel_x1 - 1};
    g.may_row_low = w.pixel_y0;
    g.may_row_high = w.pixel_y1 - 1;
    if (w.is_viewport_ignored) {
        return g;  // nothing must be drawn
    }
    const auto limit = [](const FixedRange& r, int64_t at, int64_t& low, int64_t& high) {
        low = std::max(low, first_at(r.low, at));
        high = std::min(high, last_at(r.high, at));
    };
    limit(w.zone_x, g.offset.x, g.may_columns.low, g.may_columns.high);
    limit(w.zone_y, g.offset.y, g.may_row_low, g.may_row_high);
    g.must_columns = g.may_columns;
    g.must_row_low = g.may_row_low;
    g.must_row_high = g.may_row_high;
    limit(w.core_x, g.offset.x, g.must_columns.low, g.must_columns.high);
    limit(w.core_y, g.offset.y, g.must_row_low, g.must_row_high);
    return g;
}

void emit_row(std::span<Columns> may, const Columns& must, const Span& where,
              std::vector<Span>& out) {
    const auto emit = [&](int64_t low, int64_t high, Coverage coverage) {
        if (low <= high) {
            Span s = where;
            s.x0 = static_cast<uint32_t>(low);
            s.x1 = static_cast<uint32_t>(high + 1);
            s.coverage = coverage;
            out.push_back(s);
        }
    };
    if (may.size() > 1) {
        std::sort(may.begin(), may.end(),
                  [](const Columns& a, const Columns& b) { return a.low < b.low; });
    }
    int64_t next = std::numeric_limits<int64_t>::min();  // first column not yet done
    for (const Columns& c : may) {
        const int64_t low = std::max(c.low, next);
        if (must.is_empty() || must.high < low || must.low > c.high) {
            emit(low, c.high, Coverage::either);
        } else {
            emit(low, must.low - 1, Coverage::either);
            emit(std::max(low, must.low), std::min(c.high, must.high), Coverage::must);
            emit(must.high + 1, c.high, Coverage::either);
        }
        next = std::max(next, c.high + 1);
    }
}

}  // namespace ref::fast
