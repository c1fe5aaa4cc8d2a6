// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Conservative draws: edge functions at the corner of each pixel that decides.
#include <algorithm>
#include <array>
#include <cmath>

#include "rasterizers/software/draw_command.hpp"

namespace software {

namespace {

// By how many units triangles are enlarged: the edges, and the box around them.
struct Enlargement {
    int64_t edges = 0, box = 0;
};

Enlargement enlargement(const cases::Draw& draw, const Device& device) {
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

// E(x, y) = a x + b y + c of an edge of a polygon that runs clockwise on screen.
struct Edge {
    int64_t a = 0, b = 0, c = 0;
    int64_t at(int64_t x, int64_t y) const { return a * x + b * y + c; }
};

class AreaTest {
  public:
    AreaTest(const std::vector<WindowVertex>& polygon, const cases::Draw& draw,
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

    // Pixels that may be covered.
    PixelRect within(const PixelRect& rect) const {
        if (device_.mitres_corners || device_.fault == "draws-everything"_fault) {
            return rect;
        }
        const int bits = device_.subpixel_bits;
        return {std::max(rect.x0, ((x0_ - by_.box) >> bits) - 1),
                std::max(rect.y0, ((y0_ - by_.box) >> bits) - 1),
                std::min(rect.x1, ((x1_ + by_.box) >> bits) + 2),
                std::min(rect.y1, ((y1_ + by_.box) >> bits) + 2)};
    }

    bool covers_sample(int64_t x, int64_t y) const {
        return std::all_of(edges_.begin(), edges_.end(),
                           [&](const Edge& e) { return e.at(x, y) >= 0; });
    }

    bool covers_pixel(int64_t i, int64_t j, std::span<const SampleOffset> samples) const {
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
            return fills_ ? std::all_of(samples.begin(), samples.end(), is_covered)
                          : std::any_of(samples.begin(), samples.end(), is_covered);
        }
        if (!fills_ && !device_.mitres_corners && !meets_box(x, y)) {
            return false;
        }
        if (fills_ && fault == "underestimate-two-corners"_fault) {
            return is_inside(x, y) && is_inside(x + pixel_, y + pixel_);
        }
        return std::all_of(edges_.begin(), edges_.end(), [&](const Edge& e) {
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

  private:
    bool counts(int64_t value) const { return device_.counts_borders ? value >= 0 : value > 0; }
    bool is_inside(int64_t x, int64_t y) const {
        return std::all_of(edges_.begin(), edges_.end(),
                           [&](const Edge& e) { return counts(e.at(x, y)); });
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

}  // namespace

void DrawCommand::cover_area(const Primitive& primitive, const TrianglePlanes& planes,
                             const std::vector<WindowVertex>& polygon, const WindowVertex& first,
                             bool front) {
    const AreaTest test(polygon, draw_, device_);
    const int64_t pixel = int64_t{1} << device_.subpixel_bits;
    PixelRect rect = rect_;
    if (device_.fault == "conservative-beyond-scissor"_fault) {
        rect = {std::max<int64_t>(rect.x0 - 1, 0), std::max<int64_t>(rect.y0 - 1, 0),
                std::min<int64_t>(rect.x1 + 1, out_.target.width),
                std::min<int64_t>(rect.y1 + 1, out_.target.height)};
    }
    rect = test.within(rect);
    for (int64_t j = rect.y0; j < rect.y1; ++j) {
        for (int64_t i = rect.x0; i < rect.x1; ++i) {
            const double x = static_cast<double>(i) + 0.5;
            const double y = static_cast<double>(j) + 0.5;
            if (!test.covers_pixel(i, j, samples_) || !inside_viewport(x, y) ||
                is_depth_clipped(planes, static_cast<float>(x), static_cast<float>(y))) {
                continue;
            }
            if (device_.fault == "conservative-shared-once"_fault &&
                owners_.try_emplace({i, j}, primitive.id).first->second != primitive.id) {
                continue;
            }
            uint32_t covered = 0;
            for (uint32_t s = 0; s < samples_.size(); ++s) {
                if (test.covers_sample(i * pixel + samples_[s].x, j * pixel + samples_[s].y)) {
                    covered |= 1U << s;
                }
            }
            if (device_.fault != "conservative-mask-partial"_fault || covered == 0) {
                covered = (1U << samples_.size()) - 1;
            }
            for (uint32_t s = 0; s < samples_.size(); ++s) {
                if (((covered >> s) & 1U) != 0) {
                    shade(primitive, planes, first, front, i, j, s, covered);
                }
            }
        }
    }
}

// "The fragment input values for these degenerate triangles take their attribute and depth values
// from the provoking vertex."
void DrawCommand::cover_degenerate(const Primitive& primitive,
                                   const std::vector<WindowVertex>& polygon) {
    const bool is_kept =
        device_.rasterizes_degenerates != (device_.fault == "degenerates-otherwise"_fault);
    if (draw_.conservative != cases::Conservative::overestimate || !is_kept) {
        ++culled_;
        return;
    }
    const bool front = device_.fault == "degenerates-front"_fault;
    if (is_culled(front)) {
        ++culled_;
        return;
    }
    const auto provoking = std::find_if(polygon.begin(), polygon.end(), [&](const WindowVertex& v) {
        return v.source == primitive.provoking;
    });
    const WindowVertex& v = provoking == polygon.end() ? polygon.front() : *provoking;
    std::array<WindowVertex, 3> level{v, v, v};
    level[1].x += 1.0F;  // planes need an area
    level[2].y += 1.0F;
    level[1].sx += int64_t{1} << device_.subpixel_bits;
    level[2].sy += int64_t{1} << device_.subpixel_bits;
    const TrianglePlanes planes(level, true, draw_, device_);
    cover_area(primitive, planes, polygon, v, front);
}

}  // namespace software
