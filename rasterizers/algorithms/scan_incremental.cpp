// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/algorithms/edge.hpp"

namespace rasterizers {

void scan_incremental(const Corners& triangle, const PixelRect& rect, const SubpixelPoint& offset,
                      Picture& out) {
    const std::optional<Corners> t = clockwise(triangle);
    if (!t) {
        return;
    }
    const PixelRect box = bounding_box(*t, rect, offset);
    if (box.x0 >= box.x1 || box.y0 >= box.y1) {
        return;
    }
    const PixelEdges edges(*t, box.x0, box.y0, offset);
    std::array<int64_t, 3> row{edges.edge[0].at_origin, edges.edge[1].at_origin,
                               edges.edge[2].at_origin};
    for (int64_t y = box.y0; y < box.y1; ++y) {
        RowWriter writer(y, out);
        std::array<int64_t, 3> e = row;
        for (int64_t x = box.x0; x < box.x1; ++x) {
            ++out.work.samples;
            // The sign bit of the disjunction is set if that of any is.
            if ((e[0] | e[1] | e[2]) >= 0) {
                writer.add(x);
            }
            for (size_t k = 0; k < 3; ++k) {
                e[k] += edges.edge[k].step_x;
            }
        }
        for (size_t k = 0; k < 3; ++k) {
            row[k] += edges.edge[k].step_y;
        }
    }
}

}  // namespace rasterizers
