// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/pieces.hpp"

#include <algorithm>

namespace software {

int unsnapped_sign(const std::vector<WindowVertex>& polygon) {
    double area = 0;
    for (size_t k = 0; k < polygon.size(); ++k) {
        const WindowVertex& a = polygon[k];
        const WindowVertex& b = polygon[(k + 1) % polygon.size()];
        const auto relative = [&](float v, float origin) {
            return static_cast<double>(v) - static_cast<double>(origin);
        };
        area += relative(a.x, polygon[0].x) * relative(b.y, polygon[0].y) -
                relative(b.x, polygon[0].x) * relative(a.y, polygon[0].y);
    }
    return area > 0 ? 1 : area < 0 ? -1 : 0;
}

PixelRect box_of(const std::vector<WindowVertex>& polygon, int subpixel_bits) {
    PixelRect box{INT64_MAX, INT64_MAX, INT64_MIN, INT64_MIN};
    for (const WindowVertex& v : polygon) {
        box = {std::min(box.x0, v.sx >> subpixel_bits), std::min(box.y0, v.sy >> subpixel_bits),
               std::max(box.x1, (v.sx >> subpixel_bits) + 1),
               std::max(box.y1, (v.sy >> subpixel_bits) + 1)};
    }
    return box;
}

Pieces::Pieces(std::vector<WindowVertex> polygon, const TrianglePlanes* common,
               std::unique_ptr<TrianglePlanes>* kept, const cases::Draw& draw, const Device& device)
    : polygon_(std::move(polygon)),
      is_reversed_(twice_area(polygon_) < 0),
      common_(common),
      kept_(kept),
      draw_(draw),
      device_(device),
      own_(polygon_.size() - 2) {
    if (is_reversed_) {  // keep the first vertex, walk the others backwards
        std::reverse(polygon_.begin() + 1, polygon_.end());
    }
}

const TrianglePlanes& Pieces::planes(size_t k) {
    if (common_ != nullptr) {
        return *common_;
    }
    std::unique_ptr<TrianglePlanes>& planes = kept_ != nullptr ? *kept_ : own_[k];
    if (!planes) {
        planes = std::make_unique<TrianglePlanes>(corners(k), true, draw_, device_);
    }
    return *planes;
}

ScanTriangle Pieces::triangle(size_t k) const {
    return {corners(k), {k > 0, false, k + 1 < count()}, is_reversed_};
}

}  // namespace software
