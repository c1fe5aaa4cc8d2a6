// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/area_test.hpp"

#include <algorithm>
#include <cmath>

namespace software {

AreaTest::Enlargement AreaTest::enlargement(const cases::Draw& draw, const Device& device) {
    if (draw.conservative != cases::Conservative::overestimate) {
        return {};
    }
    const double scale = std::ldexp(1.0, device.subpixel_bits);
    const double times = device.fault == "extra-size-ignored"_fault   ? 0.0
                         : device.fault == "extra-size-doubled"_fault ? 2.0
                                                                      : 1.0;
    const auto own = static_cast<int64_t>(static_cast<double>(overestimation(device)) * scale);
    const auto extra = static_cast<int64_t>(
        std::ceil(static_cast<double>(draw.conservative_extra) * scale * times));
    return {own + (device.fault == "extra-size-of-box"_fault ? 0 : extra), own + extra};
}

AreaTest::AreaTest(const std::vector<WindowVertex>& polygon, const cases::Draw& draw,
                   const Device& device)
    : device_(device),
      fills_(draw.conservative == cases::Conservative::underestimate),
      pixel_(int64_t{1} << device.subpixel_bits),
      by_(enlargement(draw, device)) {
    for (size_t k = 0; k < polygon.size(); ++k) {
        const WindowVertex& p = polygon[k];
        const WindowVertex& q = polygon[(k + 1) % polygon.size()];
        const int64_t dx = q.sx - p.sx;
        const int64_t dy = q.sy - p.sy;
        if (dx != 0 || dy != 0) {
            edges_.push_back({-dy, dx, dy * p.sx - dx * p.sy});
        }
        x0_ = std::min(x0_, p.sx);
        y0_ = std::min(y0_, p.sy);
        x1_ = std::max(x1_, p.sx);
        y1_ = std::max(y1_, p.sy);
    }
}

PixelRect AreaTest::within(const PixelRect& rect) const {
    if (device_.mitres_corners || device_.fault == "draws-everything"_fault) {
        return rect;
    }
    const int bits = device_.subpixel_bits;
    return {std::max(rect.x0, ((x0_ - by_.box) >> bits) - 1),
            std::max(rect.y0, ((y0_ - by_.box) >> bits) - 1),
            std::min(rect.x1, ((x1_ + by_.box) >> bits) + 2),
            std::min(rect.y1, ((y1_ + by_.box) >> bits) + 2)};
}

bool AreaTest::covers_sample(int64_t x, int64_t y) const {
    return std::ranges::all_of(edges_, [&](const Edge& e) { return e.at(x, y) >= 0; });
}

bool AreaTest::covers_pixel(int64_t i, int64_t j, std::span<const SampleOffset> samples) const {
    const int64_t x = i * pixel_;
    const int64_t y = j * pixel_;
    const Fault fault = device_.fault;
    if (fault == "draws-everything"_fault) {
        return true;
    }
    if (fault == "conservative-by-samples"_fault) {
        const auto is_covered = [&](const SampleOffset& s) {
            return covers_sample(x + s.x, y + s.y);
        };
        return fills_ ? std::ranges::all_of(samples, is_covered)
                      : std::ranges::any_of(samples, is_covered);
    }
    if (!fills_ && !device_.mitres_corners && !meets_box(x, y)) {
        return false;
    }
    if (fills_ && fault == "underestimate-two-corners"_fault) {
        return is_inside(x, y) && is_inside(x + pixel_, y + pixel_);
    }
    return std::ranges::all_of(edges_, [&](const Edge& e) {
        // The corner that lies farthest inside, or outside.
        const bool is_right = (e.a > 0) != fills_;
        const bool is_lower = (e.b > 0) != fills_;
        int64_t corner_x = is_right ? x + pixel_ + by_.edges : x - by_.edges;
        int64_t corner_y = is_lower ? y + pixel_ + by_.edges : y - by_.edges;
        if (fault == "conservative-edges-in-x"_fault ||
            (fault == "conservative-corner-missed"_fault && !is_right && is_lower)) {
            corner_y = y + pixel_ / 2;
        }
        if (fault == "conservative-corner-missed"_fault && !is_right && is_lower) {
            corner_x = x + pixel_ / 2;
        }
        return counts(e.at(corner_x, corner_y));
    });
}

}  // namespace software
