// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/algorithms/edge.hpp"

namespace rasterizers {

void scan_areas(const Corners& triangle, const PixelRect& rect, const SubpixelPoint& offset,
                Picture& out) {
    const std::optional<Corners> t = clockwise(triangle);
    if (!t) {
        return;
    }
    const int64_t area = edge_function((*t)[0], (*t)[1], (*t)[2]);
    const PixelRect box = bounding_box(*t, rect, offset);
    for (int64_t y = box.y0; y < box.y1; ++y) {
        RowWriter writer(y, out);
        for (int64_t x = box.x0; x < box.x1; ++x) {
            ++out.work.samples;
            const SubpixelPoint p = sample_of(x, y, offset);
            // In the bounding box |E| is at most width times height, 2^60; three of them stay below
            // 2^62.
            int64_t sum = 0;
            bool is_owned = true;
            for (size_t k = 0; k < 3; ++k) {
                const SubpixelPoint& a = (*t)[k];
                const SubpixelPoint& b = (*t)[(k + 1) % 3];
                const int64_t e = edge_function(a, b, p);
                sum += e < 0 ? -e : e;
                is_owned = is_owned && (e != 0 || owns_its_samples(a, b));
            }
            if (sum == area && is_owned) {
                writer.add(x);
            }
        }
    }
}

}  // namespace rasterizers
