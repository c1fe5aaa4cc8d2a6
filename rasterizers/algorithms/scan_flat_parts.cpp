// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/algorithms/edge.hpp"

namespace rasterizers {

namespace {

// Follows one edge downwards. At each row it knows the first pixel whose sample lies on or right of
// the edge, ceil((x_e - o_x) / 2^8) with x_e = x_a + (x_b - x_a)(y_s - y_a) / (y_b - y_a), as
// quotient and remainder: numerator (x_a - o_x) dy + dx (y_s - y_a) over dy 2^8. The first product
// is below (2^29 + 2^8) 2^30, the second at most 2^30 2^30, so the numerator stays below 2^61; the
// denominator is at most 2^38.
class EdgeWalker {
  public:
    // From the upper end a to the lower end b, a.y < b.y, starting at row `row`.
    EdgeWalker(const SubpixelPoint& a, const SubpixelPoint& b, int64_t row,
               const SubpixelPoint& offset)
        : denominator_((b.y - a.y) * kPixel) {
        const int64_t dy = b.y - a.y;
        const int64_t dx = b.x - a.x;
        const int64_t down = row * kPixel + offset.y - a.y;
        const int64_t numerator = (a.x - offset.x) * dy + dx * down;
        // ceil(n/d) = floor((n - 1)/d) + 1: the remainder is that of n - 1.
        pixel_ = floor_div(numerator - 1, denominator_) + 1;
        remainder_ = numerator - 1 - (pixel_ - 1) * denominator_;
        // One row further the numerator grows by dx 2^8.
        step_ = floor_div(dx * kPixel, denominator_);
        step_remainder_ = dx * kPixel - step_ * denominator_;
    }
    int64_t pixel() const { return pixel_; }
    void next_row() {
        pixel_ += step_;
        remainder_ += step_remainder_;
        if (remainder_ >= denominator_) {
            remainder_ -= denominator_;
            ++pixel_;
        }
    }

  private:
    int64_t denominator_;
    int64_t pixel_ = 0, remainder_ = 0;  // 0 <= remainder < denominator
    int64_t step_ = 0, step_remainder_ = 0;
};
static_assert(2 * (kCoordinateBits + 1) + 1 < 62 && kCoordinateBits + 1 + kSubpixelBits < 62);

// The first row whose sample is not above y. A sample on the upper end belongs to the part, one on
// the lower end to what follows: that is the top-left rule for horizontal edges.
int64_t first_row(int64_t y, const SubpixelPoint& offset) {
    return ceil_div(y - offset.y, kPixel);
}

// Rows [first, last) between two edges; a sample on the left edge is in, one on the right edge not.
void fill(const Corners& left_edge_first, int64_t y_begin, int64_t y_end,
          const SubpixelPoint& left_a, const SubpixelPoint& left_b, const PixelRect& rect,
          const SubpixelPoint& offset, Picture& out) {
    const SubpixelPoint& right_a = left_edge_first[0];
    const SubpixelPoint& right_b = left_edge_first[1];
    const int64_t first = std::max(rect.y0, first_row(y_begin, offset));
    const int64_t last = std::min(rect.y1, first_row(y_end, offset));
    if (first >= last) {
        return;  // also if an edge is horizontal: no row is between its ends
    }
    EdgeWalker left(left_a, left_b, first, offset);
    EdgeWalker right(right_a, right_b, first, offset);
    for (int64_t y = first; y < last; ++y) {
        const int64_t x0 = std::max(rect.x0, left.pixel());
        const int64_t x1 = std::min(rect.x1, right.pixel());
        if (x0 < x1) {
            out.spans.push_back({y, x0, x1});
        }
        left.next_row();
        right.next_row();
    }
}

}  // namespace

void scan_flat_parts(const Corners& triangle, const PixelRect& rect, const SubpixelPoint& offset,
                     Picture& out) {
    Corners t = triangle;
    std::ranges::sort(t, [](const SubpixelPoint& a, const SubpixelPoint& b) {
        return std::pair(a.y, a.x) < std::pair(b.y, b.x);
    });
    const SubpixelPoint& top = t[0];
    const SubpixelPoint& middle = t[1];
    const SubpixelPoint& bottom = t[2];
    // The middle vertex is right of the long edge top->bottom if it is on its negative side.
    const int64_t side = edge_function(top, bottom, middle);
    if (side == 0) {
        return;
    }
    const bool is_middle_right = side < 0;
    const auto part = [&](const SubpixelPoint& from, const SubpixelPoint& to) {
        if (is_middle_right) {
            fill({from, to, {}}, from.y, to.y, top, bottom, rect, offset, out);
        } else {
            fill({top, bottom, {}}, from.y, to.y, from, to, rect, offset, out);
        }
    };
    part(top, middle);     // flat bottom
    part(middle, bottom);  // flat top
}

}  // namespace rasterizers
