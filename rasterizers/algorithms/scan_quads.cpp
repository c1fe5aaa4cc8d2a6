// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/algorithms/edge.hpp"

namespace rasterizers {

void scan_quads(const Corners& triangle, const PixelRect& rect, const SubpixelPoint& offset,
                Picture& out) {
    const std::optional<Corners> t = clockwise(triangle);
    if (!t) {
        return;
    }
    const PixelRect box = bounding_box(*t, rect, offset);
    if (box.x0 >= box.x1 || box.y0 >= box.y1) {
        return;
    }
    const int64_t first_x = box.x0 & ~int64_t{1};
    const int64_t first_y = box.y0 & ~int64_t{1};
    const PixelEdges edges(*t, first_x, first_y, offset);
    for (int64_t y = first_y; y < box.y1; y += 2) {
        for (int64_t x = first_x; x < box.x1; x += 2) {
            for (int64_t lane = 0; lane < 4; ++lane) {  // helper pixels outside of the box, too
                const int64_t i = x + (lane & 1);
                const int64_t j = y + (lane >> 1);
                ++out.work.samples;
                int64_t signs = 0;
                for (const PixelEdge& e : edges.edge) {
                    signs |= e.at_origin + (i - first_x) * e.step_x + (j - first_y) * e.step_y;
                }
                if (signs >= 0 && i >= box.x0 && i < box.x1 && j >= box.y0 && j < box.y1) {
                    out.spans.push_back({j, i, i + 1});
                }
            }
        }
    }
}

}  // namespace rasterizers
