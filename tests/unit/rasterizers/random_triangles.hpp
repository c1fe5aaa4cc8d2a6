// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Random triangles of the kinds that rasterizers get wrong; everything follows from the seed.
#pragma once

#include <random>

#include "rasterizers/algorithms/edge.hpp"

namespace rasterizers::test {

class RandomTriangles {
  public:
    explicit RandomTriangles(uint64_t seed) : engine_(seed) {}

    int64_t integer(int64_t low, int64_t high) {
        return low + static_cast<int64_t>(engine_() % static_cast<uint64_t>(high - low + 1));
    }

    static constexpr int64_t kKinds = 9;
    // A triangle near the square of `size` pixels at the origin.
    Corners triangle(int64_t kind, int64_t size) {
        const int64_t reach = size * kPixel;
        Corners t;
        const SubpixelPoint home{integer(0, reach), integer(0, reach)};
        const int64_t slope = integer(-300, 300);
        for (SubpixelPoint& p : t) {
            switch (kind) {
                case 0:  // sample centres: every edge is full of ties
                    p = {integer(0, size - 1) * kPixel + 128, integer(0, size - 1) * kPixel + 128};
                    break;
                case 1:  // half pixels
                    p = {integer(0, 2 * size) * 128, integer(0, 2 * size) * 128};
                    break;
                case 2:  // anywhere on the grid
                    p = {integer(0, reach), integer(0, reach)};
                    break;
                case 3:  // negative coordinates, beyond the target on all sides
                    p = {integer(-reach, 2 * reach), integer(-reach, 2 * reach)};
                    break;
                case 4: {  // slivers
                    const int64_t s = integer(-reach, reach);
                    p = {home.x + s, home.y + s * slope / 256 + integer(-2, 2)};
                    break;
                }
                case 5:  // a few subpixels, near a sample
                    p = {(home.x & ~int64_t{255}) + integer(120, 136),
                         (home.y & ~int64_t{255}) + integer(120, 136)};
                    break;
                case 6:  // as large as the guard band
                    p = {integer(-kMaxCoordinate, kMaxCoordinate),
                         integer(-kMaxCoordinate, kMaxCoordinate)};
                    break;
                case 7:  // long and through the target
                    p = {home.x + integer(-1, 1) * integer(0, kMaxCoordinate / 2),
                         home.y + integer(-1, 1) * integer(0, kMaxCoordinate / 2)};
                    break;
                default:  // horizontal and vertical edges, repeated vertices, lines
                    p = {integer(0, 3) * 64 + 64 * size, integer(0, 3) * 64 + 64 * size};
                    break;
            }
        }
        return t;
    }

    // A clockwise triangle in a square of `size` pixels with an edge that passes a sample, its
    // middle, within 1/256 pixel in x and in y.
    struct BesideEdge {
        Corners triangle;
        SubpixelPoint sample;
    };
    BesideEdge beside_edge(int64_t size) {
        const int64_t reach = size * kPixel;
        for (;;) {
            const SubpixelPoint p{integer(0, size - 1) * kPixel + 128,
                                  integer(0, size - 1) * kPixel + 128};
            const SubpixelPoint a{integer(0, reach), integer(0, reach)};
            const SubpixelPoint b{2 * p.x - a.x + integer(-1, 1), 2 * p.y - a.y + integer(-1, 1)};
            if (std::min(b.x, b.y) < 0 || std::max(b.x, b.y) > reach) {
                continue;
            }
            const Corners t{{a, b, {integer(0, reach), integer(0, reach)}}};
            if (const std::optional<Corners> ordered = clockwise(t)) {
                return {*ordered, p};
            }
        }
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace rasterizers::test
