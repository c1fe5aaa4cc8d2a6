// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/tiles.hpp"

#include <algorithm>

namespace software {

namespace {

constexpr int64_t kTile = 8;  // pixels a side

// Arithmetic of the edge functions: 64 bits, or 32 with wrap-around where a fault says so.
class EdgeArithmetic {
  public:
    explicit EdgeArithmetic(bool narrow) : narrow_(narrow) {}
    int64_t wrap(int64_t value) const {
        return narrow_ ? int64_t{static_cast<int32_t>(
                             static_cast<uint32_t>(static_cast<uint64_t>(value) & 0xffffffffU))}
                       : value;
    }

  private:
    bool narrow_;
};

// Does a triangle own the samples on its edge (dx, dy)? Clockwise on screen, y down: a top edge
// runs right, a left edge runs up.
bool owns(TieRule rule, int64_t dx, int64_t dy) {
    switch (rule) {
        case TieRule::top_left:
            return dy < 0 || (dy == 0 && dx > 0);
        case TieRule::top_right:
            return dy > 0 || (dy == 0 && dx > 0);
        case TieRule::bottom_left:
            return dy < 0 || (dy == 0 && dx < 0);
        case TieRule::bottom_right:
            return dy > 0 || (dy == 0 && dx < 0);
        case TieRule::left_top:
            return dx > 0 || (dx == 0 && dy < 0);
    }
    return false;
}

int64_t bias_of(const Device& device, int64_t dx, int64_t dy, bool reversed, bool inner) {
    switch (device.fault) {
        case "ties-bottom-right"_fault:
            return owns(TieRule::bottom_right, dx, dy) ? 0 : -1;
        case "ties-top-right"_fault:
            return owns(TieRule::top_right, dx, dy) ? 0 : -1;
        case "ties-bottom-left"_fault:
            return owns(TieRule::bottom_left, dx, dy) ? 0 : -1;
        case "ties-left-only"_fault:
            return dy < 0 ? 0 : -1;
        case "ties-bottom-too"_fault:
            return dy == 0 || owns(device.ties, dx, dy) ? 0 : -1;
        case "ties-right-too"_fault:
            return dy != 0 || owns(device.ties, dx, dy) ? 0 : -1;
        case "ties-all-inclusive"_fault:
            return 0;
        case "ties-all-exclusive"_fault:
            return -1;
        case "ties-top-only"_fault:
            return dy == 0 && dx > 0 ? 0 : -1;
        case "ties-by-winding"_fault:
            return owns(device.ties, reversed ? -dx : dx, reversed ? -dy : dy) ? 0 : -1;
        case "clip-diagonal-double"_fault:
            if (inner) {
                return 0;
            }
            break;
        default:
            break;
    }
    return owns(device.ties, dx, dy) ? 0 : -1;
}

// E(p) = a x + b y + c, plus the fill rule's bias: covered if not negative.
struct Edge {
    // With coordinates below 2^15 pixels and 12 subpixel bits, a and b stay below 2^28 and c and E
    // below 2^57.
    int64_t a = 0, b = 0, c = 0;
    // The same in binary32, of unsnapped positions.
    float from_x = 0, from_y = 0, dx = 0, dy = 0;
};

Edge make_edge(const WindowVertex& p, const WindowVertex& q, const ScanTriangle& triangle,
               bool inner, const EdgeArithmetic& arithmetic, const Device& device) {
    const int64_t dx = q.sx - p.sx;
    const int64_t dy = q.sy - p.sy;
    Edge edge;
    edge.a = arithmetic.wrap(-dy);
    edge.b = arithmetic.wrap(dx);
    edge.c =
        arithmetic.wrap(dy * p.sx - dx * p.sy + bias_of(device, dx, dy, triangle.reversed, inner));
    edge.from_x = p.x;
    edge.from_y = p.y;
    edge.dx = q.x - p.x;
    edge.dy = q.y - p.y;
    return edge;
}

// Can the tile with its upper left pixel at (x, y) be left out?
bool rejects(const Edge& edge, int64_t x, int64_t y, int64_t pixel,
             const EdgeArithmetic& arithmetic, Fault fault) {
    int64_t side = kTile * pixel;
    if (fault == "tile-off-by-one"_fault) {
        side -= pixel;
    }
    bool right = edge.a > 0;
    bool lower = edge.b > 0;
    if (fault == "tile-wrong-corner"_fault) {
        right = !right;
        lower = !lower;
    }
    const int64_t corner_x = x * pixel + (right ? side : 0);
    const int64_t corner_y = y * pixel + (lower ? side : 0);
    return arithmetic.wrap(edge.a * corner_x + edge.b * corner_y + edge.c) < 0;
}

bool covers_binary32(const Edge& edge, float x, float y) {
    const float value = edge.dx * (y - edge.from_y) - edge.dy * (x - edge.from_x);
    const bool owner = edge.dy < 0 || (!(edge.dy > 0) && edge.dx > 0);
    return value > 0 || (owner && value >= 0);
}

// Floor division by a power of two.
int64_t floor_pixel(int64_t v, int bits) {
    return v >> bits;
}

PixelRect bounding_box(const ScanTriangle& triangle, const PixelRect& rect, const Device& device) {
    const auto [min_x, max_x] = std::minmax({triangle.v[0].sx, triangle.v[1].sx, triangle.v[2].sx});
    const auto [min_y, max_y] = std::minmax({triangle.v[0].sy, triangle.v[1].sy, triangle.v[2].sy});
    PixelRect box{
        floor_pixel(min_x, device.subpixel_bits), floor_pixel(min_y, device.subpixel_bits),
        floor_pixel(max_x, device.subpixel_bits) + 1, floor_pixel(max_y, device.subpixel_bits) + 1};
    if (device.fault == "box-last-column"_fault) {
        box.x1 -= 1;
    }
    if (device.fault == "box-last-row"_fault) {
        box.y1 -= 1;
    }
    if (device.fault == "box-first-column"_fault) {
        box.x0 += 1;
    }
    if (device.fault == "box-first-row"_fault) {
        box.y0 += 1;
    }
    if (device.fault == "draws-everything"_fault) {
        return rect;
    }
    return {std::max(box.x0, rect.x0), std::max(box.y0, rect.y0), std::min(box.x1, rect.x1),
            std::min(box.y1, rect.y1)};
}

bool is_narrow(const ScanTriangle& triangle, const Device& device) {
    if (device.fault == "edge-int32"_fault) {
        return true;
    }
    if (device.fault != "edge-int32-256"_fault) {
        return false;
    }
    const auto [min_x, max_x] = std::minmax({triangle.v[0].sx, triangle.v[1].sx, triangle.v[2].sx});
    const auto [min_y, max_y] = std::minmax({triangle.v[0].sy, triangle.v[1].sy, triangle.v[2].sy});
    const int64_t limit = int64_t{256} << device.subpixel_bits;
    return max_x - min_x <= limit && max_y - min_y <= limit;
}

}  // namespace

std::vector<SampleOffset> sample_offsets(const cases::Target& target, const Device& device) {
    using Location = std::array<int64_t, 2>;  // 1/16 pixel
    std::vector<Location> locations;
    switch (target.samples) {
        case 2:
            locations = {{12, 12}, {4, 4}};
            break;
        case 4:
            locations = {{6, 2}, {14, 6}, {2, 10}, {10, 14}};
            break;
        case 8:
            locations = {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}};
            break;
        case 16:
            locations = {{9, 9},  {7, 5}, {5, 10}, {12, 7}, {3, 6}, {10, 13}, {13, 11}, {11, 3},
                         {6, 14}, {8, 1}, {4, 2},  {2, 12}, {0, 8}, {15, 4},  {14, 15}, {1, 0}};
            break;
        default:
            locations = {{8, 8}};
            break;
    }
    if (!target.sample_locations.empty() && device.fault != "samples-standard-only"_fault) {
        locations.clear();
        for (const auto& own : target.sample_locations) {
            locations.push_back({own[0], own[1]});
        }
    }
    if (device.fault == "samples-exchanged"_fault && locations.size() > 1) {
        std::swap(locations[0], locations[1]);
    }
    const int shift = device.subpixel_bits - 4;
    std::vector<SampleOffset> offsets;
    for (const Location& at : locations) {
        Location place = at;
        if (device.fault == "sample-corner"_fault) {
            place = {at[0] - 8, at[1] - 8};
        } else if (device.fault == "samples-transposed"_fault) {
            place = {at[1], at[0]};
        } else if (device.fault == "samples-upside-down"_fault && locations.size() > 1) {
            place = {at[0], 16 - at[1]};
        } else if (device.fault == "samples-in-pixel-centres"_fault) {
            place = {8, 8};
        }
        offsets.push_back({place[0] * (int64_t{1} << shift), place[1] * (int64_t{1} << shift)});
    }
    return offsets;
}

int64_t twice_area(std::span<const WindowVertex> v) {
    int64_t sum = 0;
    for (size_t k = 1; k + 1 < v.size(); ++k) {
        sum += (v[k].sx - v[0].sx) * (v[k + 1].sy - v[0].sy) -
               (v[k + 1].sx - v[0].sx) * (v[k].sy - v[0].sy);
    }
    return sum;
}

void scan(const ScanTriangle& triangle, const PixelRect& rect,
          std::span<const SampleOffset> samples, const Device& device,
          const std::function<void(int64_t, int64_t, uint32_t)>& emit) {
    const EdgeArithmetic arithmetic(is_narrow(triangle, device));
    std::array<Edge, 3> edges;
    for (size_t k = 0; k < 3; ++k) {
        edges[k] = make_edge(triangle.v[k], triangle.v[(k + 1) % 3], triangle, triangle.inner[k],
                             arithmetic, device);
    }
    const int64_t pixel = int64_t{1} << device.subpixel_bits;
    const float unit = 1.0F / static_cast<float>(pixel);
    const PixelRect box = bounding_box(triangle, rect, device);
    const bool everything = device.fault == "draws-everything"_fault;
    const bool binary32 = device.fault == "edge-binary32"_fault;

    const auto covered = [&](int64_t x, int64_t y) {
        if (everything) {
            return true;
        }
        if (binary32) {
            const float fx = static_cast<float>(x) * unit;
            const float fy = static_cast<float>(y) * unit;
            return covers_binary32(edges[0], fx, fy) && covers_binary32(edges[1], fx, fy) &&
                   covers_binary32(edges[2], fx, fy);
        }
        return std::ranges::all_of(edges, [&](const Edge& e) {
            const int64_t value = arithmetic.wrap(e.a * x + e.b * y + e.c);
            return (device.fault == "edge-truncated"_fault ? value / pixel : value) >= 0;
        });
    };

    // Tiles lie on a grid of the target, not of the bounding box. kTile is a power of two.
    for (int64_t ty = box.y0 & -kTile; ty < box.y1; ty += kTile) {
        for (int64_t tx = box.x0 & -kTile; tx < box.x1; tx += kTile) {
            const bool rejected = std::ranges::any_of(edges, [&](const Edge& e) {
                return rejects(e, tx, ty, pixel, arithmetic, device.fault);
            });
            if (rejected && !everything && !binary32) {
                continue;
            }
            for (int64_t j = std::max(ty, box.y0); j < std::min(ty + kTile, box.y1); ++j) {
                for (int64_t i = std::max(tx, box.x0); i < std::min(tx + kTile, box.x1); ++i) {
                    for (uint32_t s = 0; s < samples.size(); ++s) {
                        if (covered(i * pixel + samples[s].x, j * pixel + samples[s].y)) {
                            emit(i, j, s);
                        }
                    }
                }
            }
        }
    }
}

}  // namespace software
