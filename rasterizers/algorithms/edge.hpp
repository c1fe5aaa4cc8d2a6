// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Edge functions in int64_t and what all scans share.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>

#include "rasterizers/algorithms/raster.hpp"

namespace rasterizers {

// E_ab(p) = (b-a) x (p-a): positive to the right of a->b on screen (Giesen, with y down). |E| <
// 2^61.
constexpr int64_t edge_function(const SubpixelPoint& a, const SubpixelPoint& b,
                                const SubpixelPoint& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}
// The other convention, (p-a) x (b-a): the first one with its sign changed (Scratchapixel).
constexpr int64_t edge_function_counter(const SubpixelPoint& a, const SubpixelPoint& b,
                                        const SubpixelPoint& p) {
    return (p.x - a.x) * (b.y - a.y) - (p.y - a.y) * (b.x - a.x);
}

// A top or left edge of a triangle with positive area owns the samples on it.
constexpr bool owns_its_samples(const SubpixelPoint& a, const SubpixelPoint& b) {
    return b.y < a.y || (b.y == a.y && b.x > a.x);
}

// Rounding of quotients towards minus and plus infinity; the divisor is positive.
constexpr int64_t floor_div(int64_t a, int64_t b) {
    return a / b - (a % b < 0 ? 1 : 0);
}
constexpr int64_t ceil_div(int64_t a, int64_t b) {
    return a / b + (a % b > 0 ? 1 : 0);
}

constexpr SubpixelPoint sample_of(int64_t i, int64_t j, const SubpixelPoint& offset) {
    return {i * kPixel + offset.x, j * kPixel + offset.y};
}

// Exchanges vertices, if need be, so that the area is positive; nothing if it is zero.
inline std::optional<Corners> clockwise(Corners t) {
    const int64_t area = edge_function(t[0], t[1], t[2]);
    if (area == 0) {
        return std::nullopt;
    }
    if (area < 0) {
        std::swap(t[1], t[2]);
    }
    return t;
}

// The pixels of `rect` whose samples lie in the bounding box of the triangle.
inline PixelRect bounding_box(const Corners& t, const PixelRect& rect,
                              const SubpixelPoint& offset) {
    const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [top, bottom] = std::minmax({t[0].y, t[1].y, t[2].y});
    return {std::max(rect.x0, ceil_div(left - offset.x, kPixel)),
            std::max(rect.y0, ceil_div(top - offset.y, kPixel)),
            std::min(rect.x1, floor_div(right - offset.x, kPixel) + 1),
            std::min(rect.y1, floor_div(bottom - offset.y, kPixel) + 1)};
}

// One edge of a clockwise triangle at the samples of pixels: value(i, j) >= 0 is inside, ties
// included or excluded by a bias of -1. Steps are at most 2^30 * 2^8 = 2^38.
struct PixelEdge {
    int64_t at_origin = 0;  // at the sample of `origin`
    int64_t step_x = 0, step_y = 0;
    PixelEdge() = default;
    PixelEdge(const SubpixelPoint& a, const SubpixelPoint& b, const SubpixelPoint& origin)
        : at_origin(edge_function(a, b, origin) - (owns_its_samples(a, b) ? 0 : 1)),
          step_x(-(b.y - a.y) * kPixel),
          step_y((b.x - a.x) * kPixel) {}
};

struct PixelEdges {
    std::array<PixelEdge, 3> edge;
    // Values at the sample of pixel (i, j).
    PixelEdges(const Corners& t, int64_t i, int64_t j, const SubpixelPoint& offset) {
        for (size_t k = 0; k < 3; ++k) {
            edge[k] = PixelEdge(t[k], t[(k + 1) % 3], sample_of(i, j, offset));
        }
    }
};

// Collects pixels of a row into spans.
class RowWriter {
  public:
    RowWriter(int64_t y, Picture& out) : y_(y), out_(out) {}
    void add(int64_t x) {
        if (!out_.spans.empty()) {
            Span& last = out_.spans.back();
            if (last.y == y_ && last.x1 == x) {
                last.x1 = x + 1;
                return;
            }
        }
        out_.spans.push_back({y_, x, x + 1});
    }

  private:
    int64_t y_;
    Picture& out_;
};

}  // namespace rasterizers
