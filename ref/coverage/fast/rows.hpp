// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Rows of samples are cut by half planes here.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "ref/coverage/fast/fast.hpp"
#include "ref/coverage/setup.hpp"
#include "ref/number/edge_function.hpp"

namespace ref::fast {

// The columns low to high of a row, both included.
struct Columns {
    int64_t low = 0, high = -1;
    bool is_empty() const { return low > high; }
};

template <class T>
T floor_divide(T n, T d) {
    const T q = n / d;
    return n % d != 0 && (n < 0) != (d < 0) ? q - 1 : q;
}

inline int64_t floor_pixel(int64_t units) {
    return units >> kFixedBits;
}
inline int64_t ceil_pixel(int64_t units) {
    return -((-units) >> kFixedBits);
}

// A half plane as the rows of one sample number meet it: its value at column 0, and its steps.
template <class T>
struct RowPlane {
    T value = 0, row_step = 0, column_step = 0;

    void cut(Columns& c) const {
        if (column_step > 0) {
            // value + i step >= 0  <=>  i >= ceil(-value / step)
            c.low = std::max(c.low, clamp(-floor_divide<T>(value, column_step)));
        } else if (column_step < 0) {
            c.high = std::min(c.high, clamp(floor_divide<T>(value, -column_step)));
        } else if (value < 0) {
            c.high = c.low - 1;
        }
    }
    static int64_t clamp(T column) {
        constexpr T kFar = int64_t{1} << 40;
        return static_cast<int64_t>(std::clamp<T>(column, -kFar, kFar));
    }
};

struct Grid {
    FixedPoint offset;  // of the sample in its pixel
    Columns may_columns, must_columns;
    int64_t may_row_low = 0, may_row_high = -1;
    int64_t must_row_low = 0, must_row_high = -1;
};

inline int64_t first_at(int64_t low, int64_t offset) {
    return ceil_pixel(low - offset);
}
inline int64_t last_at(int64_t high, int64_t offset) {
    return floor_pixel(high - offset);
}

// The rows and columns of pixels in a window whose sample at this offset may, and must, be touched.
Grid grid_of(const Window& w, const FixedPoint& offset);

// Appends one row: what is in `may` but not in `must` is either. The may intervals may overlap;
// must lies inside them.
void emit_row(std::span<Columns> may, const Columns& must, const Span& where,
              std::vector<Span>& out);

}  // namespace ref::fast
