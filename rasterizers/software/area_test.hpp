// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Conservative draws: edge functions at the corner of each pixel that decides.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rasterizers/software/choice/device.hpp"
#include "rasterizers/software/tiles.hpp"

namespace software {

class AreaTest {
  public:
    AreaTest(const std::vector<WindowVertex>& polygon, const cases::Draw& draw,
             const Device& device);

    // Pixels that may be covered.
    PixelRect within(const PixelRect& rect) const;
    bool covers_sample(int64_t x, int64_t y) const;
    bool covers_pixel(int64_t i, int64_t j, std::span<const SampleOffset> samples) const;

  private:
    // By how many units triangles are enlarged: the edges, and the box around them.
    struct Enlargement {
        int64_t edges = 0, box = 0;
    };
    // E(x, y) = a x + b y + c of an edge of a polygon that runs clockwise on screen.
    struct Edge {
        int64_t a = 0, b = 0, c = 0;
        int64_t at(int64_t x, int64_t y) const { return a * x + b * y + c; }
    };
    static Enlargement enlargement(const cases::Draw& draw, const Device& device);
    bool counts(int64_t value) const { return device_.counts_borders ? value >= 0 : value > 0; }
    bool is_inside(int64_t x, int64_t y) const {
        return std::ranges::all_of(edges_, [&](const Edge& e) { return counts(e.at(x, y)); });
    }
    bool meets_box(int64_t x, int64_t y) const {
        return counts(x + pixel_ + by_.box - x0_) && counts(x1_ - x + by_.box) &&
               counts(y + pixel_ + by_.box - y0_) && counts(y1_ - y + by_.box);
    }

    const Device& device_;
    bool fills_;
    int64_t pixel_;
    Enlargement by_;
    std::vector<Edge> edges_;
    int64_t x0_ = INT64_MAX, y0_ = INT64_MAX, x1_ = INT64_MIN, y1_ = INT64_MIN;
};

}  // namespace software
