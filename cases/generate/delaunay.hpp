// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes exact Delaunay triangulations of lattice points in a rectangle.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace cases {

struct LatticePoint {
    int64_t x = 0, y = 0;
};

inline constexpr int64_t kMaxLattice = int64_t{1} << 26U;  // steps a side

// Positive if a, b, c run clockwise on screen (y down). Coordinates below 2^27 in magnitude: the
// products have at most 54 bits.
int64_t orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c);

// Positive if d lies strictly inside the circle through a, b, c, which run with positive
// orientation. Differences below 2^27, so the determinant has at most 27*4 + 4 bits: __int128.
int in_circle(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
              const LatticePoint& d);

// Starts as the rectangle [0, width] x [0, height] cut in two; points are inserted one by one.
class Triangulation {
  public:
    Triangulation(int64_t width, int64_t height);

    // Inserts a point of the rectangle that is not yet there.
    void insert(const LatticePoint& p);

    const std::vector<LatticePoint>& points() const { return points_; }
    // Three indices a triangle, which is counter-clockwise on screen.
    std::vector<uint32_t> indices() const;

  private:
    static constexpr uint32_t kNone = UINT32_MAX;
    // Vertices in positive orientation; neighbour[i] lies opposite vertex[i].
    struct Triangle {
        std::array<uint32_t, 3> vertex{};
        std::array<uint32_t, 3> neighbour{};
    };

    uint32_t locate(const LatticePoint& p) const;
    void split_triangle(uint32_t t, uint32_t p);
    void split_edge(uint32_t t, uint32_t side, uint32_t p);
    // Restores the Delaunay property across the edge opposite vertex p of triangle t, and onward.
    void legalize(uint32_t t, uint32_t p);
    uint32_t side_of_vertex(uint32_t t, uint32_t vertex) const;
    void replace_neighbour(uint32_t t, uint32_t before, uint32_t after);

    std::vector<LatticePoint> points_;
    std::vector<Triangle> triangles_;
    uint32_t last_ = 0;  // where the next search starts
};

}  // namespace cases
