// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/algorithms/edge.hpp"

namespace rasterizers {

namespace {

constexpr int64_t kLevels[] = {64, 16, 4};  // pixels a side, aligned to multiples of themselves

class TileScan {
  public:
    TileScan(const Corners& t, const PixelRect& box, const SubpixelPoint& offset, Picture& out)
        : box_(box),
          base_x_(box.x0 & ~(kLevels[0] - 1)),
          base_y_(box.y0 & ~(kLevels[0] - 1)),
          edges_(t, base_x_, base_y_, offset),
          out_(out) {}

    void run() {
        for (int64_t y = base_y_; y < box_.y1; y += kLevels[0]) {
            for (int64_t x = base_x_; x < box_.x1; x += kLevels[0]) {
                descend(x, y, 0);
            }
        }
    }

  private:
    int64_t value(const PixelEdge& e, int64_t x, int64_t y) const {
        return e.at_origin + (x - base_x_) * e.step_x + (y - base_y_) * e.step_y;
    }

    // The tile at (x, y) of kLevels[level].
    void descend(int64_t x, int64_t y, size_t level) {
        const int64_t size = kLevels[level];
        const int64_t x0 = std::max(x, box_.x0);
        const int64_t y0 = std::max(y, box_.y0);
        const int64_t x1 = std::min(x + size, box_.x1);
        const int64_t y1 = std::min(y + size, box_.y1);
        if (x0 >= x1 || y0 >= y1) {
            return;
        }
        // From the value at the first sample to those at the corners with the largest and with the
        // smallest one: an affine function is extreme at corners.
        bool is_accepted = true;
        for (const PixelEdge& e : edges_.edge) {
            const int64_t first = value(e, x, y);
            const int64_t across = (size - 1) * e.step_x;
            const int64_t down = (size - 1) * e.step_y;
            if (first + std::max<int64_t>(across, 0) + std::max<int64_t>(down, 0) < 0) {
                ++out_.work.tiles;
                return;
            }
            is_accepted = is_accepted &&
                          first + std::min<int64_t>(across, 0) + std::min<int64_t>(down, 0) >= 0;
        }
        if (is_accepted) {
            ++out_.work.tiles;
            for (int64_t j = y0; j < y1; ++j) {
                out_.spans.push_back({j, x0, x1});
            }
        } else if (level + 1 < std::size(kLevels)) {
            const int64_t part = kLevels[level + 1];
            for (int64_t j = y; j < y + size; j += part) {
                for (int64_t i = x; i < x + size; i += part) {
                    descend(i, j, level + 1);
                }
            }
        } else {
            test_samples({x0, y0, x1, y1});
        }
    }

    void test_samples(const PixelRect& rect) {
        for (int64_t j = rect.y0; j < rect.y1; ++j) {
            RowWriter writer(j, out_);
            for (int64_t i = rect.x0; i < rect.x1; ++i) {
                ++out_.work.samples;
                if ((value(edges_.edge[0], i, j) | value(edges_.edge[1], i, j) |
                     value(edges_.edge[2], i, j)) >= 0) {
                    writer.add(i);
                }
            }
        }
    }

    PixelRect box_;
    int64_t base_x_, base_y_;
    PixelEdges edges_;
    Picture& out_;
};
// A corner of a tile lies at most 64 pixels beyond the samples of the box: |E| < 2^30 (2^29 + 2^22
// + 2^14) * 2 < 2^61.
static_assert(kMaxPixel * kPixel + 2 * 64 * kPixel < kMaxCoordinate);

}  // namespace

void scan_tiles(const Corners& triangle, const PixelRect& rect, const SubpixelPoint& offset,
                Picture& out) {
    const std::optional<Corners> t = clockwise(triangle);
    if (!t) {
        return;
    }
    const PixelRect box = bounding_box(*t, rect, offset);
    if (box.x0 < box.x1 && box.y0 < box.y1) {
        TileScan(*t, box, offset, out).run();
    }
}

}  // namespace rasterizers
