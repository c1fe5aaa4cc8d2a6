// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Ways to find the samples of a triangle that rasterizers really use, in plain 64-bit integers.
// They share no arithmetic with the reference; property tests hold each against ref::exact::covers,
// and device.hpp lets them draw whole cases that the suite then judges. docs/algorithms.md compares
// them.
//
// Number format: S23.8 fixed point, unit 2^-8 pixel, sample centre at +128; y points down. All take
// the vertices in either order and decide samples on an edge by the top-left rule.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace rasterizers {

inline constexpr int kSubpixelBits = 8;
inline constexpr int64_t kPixel = int64_t{1} << kSubpixelBits;
// Guard band: |coordinate| <= 2^29 units, 2^21 pixels.
inline constexpr int kCoordinateBits = 29;
inline constexpr int64_t kMaxCoordinate = int64_t{1} << kCoordinateBits;
// Pixels of the target: 0..16384, so samples lie below 2^22 + 2^8 units < kMaxCoordinate.
inline constexpr int64_t kMaxPixel = 16384;
static_assert(kMaxPixel * kPixel + kPixel < kMaxCoordinate);
// Differences of coordinates need 30 bits, their products 60, a cross product 61, and a cross
// product with the bias of a strict edge still 61: the sign fits int64_t with a bit to spare.
static_assert(2 * (kCoordinateBits + 1) + 1 < 62);

struct SubpixelPoint {
    int64_t x = 0, y = 0;  // S23.8, |.| <= kMaxCoordinate
    friend bool operator==(const SubpixelPoint&, const SubpixelPoint&) = default;
};
using Corners = std::array<SubpixelPoint, 3>;

// Half-open, pixels, 0..kMaxPixel.
struct PixelRect {
    int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// Covered pixels [x0, x1) of row y.
struct Span {
    int64_t y = 0, x0 = 0, x1 = 0;
};

// How much was done to find them.
struct Work {
    uint64_t samples = 0;  // points at which the three edges were evaluated
    uint64_t tiles = 0;    // blocks that were accepted or rejected as a whole
};

// Finds the pixels of `rect` whose sample (at `offset` in the pixel, 0..255 each) the triangle
// covers. Spans come in any order, no pixel twice, none empty.
struct Picture {
    std::vector<Span> spans;
    Work work;
};
using Scan = void (*)(const Corners& triangle, const PixelRect& rect, const SubpixelPoint& offset,
                      Picture& out);

// Explicit: the triangle is cut at its middle vertex into one with a flat bottom and one with a
// flat top; two walkers follow the edges in exact integer steps and fill the row between them.
// Source: lecture notes on rasterization, "flat top" and "flat bottom"; rows and ends of rows are
// clipped, samples are never tested.
void scan_flat_parts(const Corners& triangle, const PixelRect& rect, const SubpixelPoint& offset,
                     Picture& out);

// Three edge functions over the bounding box, carried from pixel to pixel and from row to row by
// addition. Source: Pineda 1988, section 3; Scratchapixel, "The Edge Function".
void scan_incremental(const Corners& triangle, const PixelRect& rect, const SubpixelPoint& offset,
                      Picture& out);

// The same in 2x2 quads, of which all four pixels are evaluated: the stamp of graphics processors.
void scan_quads(const Corners& triangle, const PixelRect& rect, const SubpixelPoint& offset,
                Picture& out);

// Tiles of 64, 16 and 4 pixels; each edge rejects (accepts) a tile by the corner where it is
// largest (smallest), and only what is left of the 4x4 blocks is tested by sample. Source: "Raster
// stamp" and Larrabee's hierarchical rasterization.
void scan_tiles(const Corners& triangle, const PixelRect& rect, const SubpixelPoint& offset,
                Picture& out);

// "Either": inside where the three edge functions of the vertices as they are given all have the
// same sign. Needs neither area nor order of the vertices. Every sample of the bounding box is
// tested.
void scan_same_sign(const Corners& triangle, const PixelRect& rect, const SubpixelPoint& offset,
                    Picture& out);

// Inside where the unsigned areas of P with each edge add up to the area of the triangle: the
// barycentric coordinates |A_i| / |A| are not negative and sum to 1.
void scan_areas(const Corners& triangle, const PixelRect& rect, const SubpixelPoint& offset,
                Picture& out);

// Brown's A_i = alpha_i x + beta_i y + gamma_i (equation 2), carried by adding alpha and
// subtracting beta: "if any b_i < 0, the pixel is outside the edge opposite P_i".
void scan_brown(const Corners& triangle, const PixelRect& rect, const SubpixelPoint& offset,
                Picture& out);

}  // namespace rasterizers
