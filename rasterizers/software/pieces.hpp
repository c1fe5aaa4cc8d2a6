// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The triangles that a clipped polygon is drawn as: a fan around its first vertex, clockwise on
// screen.
#pragma once

#include <memory>
#include <vector>

#include "rasterizers/software/planes.hpp"
#include "rasterizers/software/tiles.hpp"

namespace software {

// Of the area of a polygon's unsnapped positions.
int unsnapped_sign(const std::vector<WindowVertex>& polygon);

// Pixels that hold all of a polygon.
PixelRect box_of(const std::vector<WindowVertex>& polygon, int subpixel_bits);

class Pieces {
  public:
    // `common`: the planes of all, if not null; else each has its own, or takes those that are
    // `kept`, which the first makes. Keeps references.
    Pieces(std::vector<WindowVertex> polygon, const TrianglePlanes* common,
           std::unique_ptr<TrianglePlanes>* kept, const cases::Draw& draw, const Device& device);

    size_t count() const { return own_.size(); }
    const std::vector<WindowVertex>& polygon() const { return polygon_; }
    std::array<WindowVertex, 3> corners(size_t k) const {
        return {polygon_[0], polygon_[k + 1], polygon_[k + 2]};
    }
    const TrianglePlanes& planes(size_t k);
    ScanTriangle triangle(size_t k) const;

  private:
    std::vector<WindowVertex> polygon_;
    bool is_reversed_;
    const TrianglePlanes* common_;
    std::unique_ptr<TrianglePlanes>* kept_;
    const cases::Draw& draw_;
    const Device& device_;
    std::vector<std::unique_ptr<TrianglePlanes>> own_;
};

}  // namespace software
