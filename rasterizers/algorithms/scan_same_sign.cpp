// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/algorithms/edge.hpp"

namespace rasterizers {

namespace {

// Whether p is inside the three edges of the vertices in the given order.
bool is_inside(const Corners& t, const SubpixelPoint& p) {
    for (size_t k = 0; k < 3; ++k) {
        const SubpixelPoint& a = t[k];
        const SubpixelPoint& b = t[(k + 1) % 3];
        const int64_t e = edge_function(a, b, p);
        if (e < 0 || (e == 0 && !owns_its_samples(a, b))) {
            return false;
        }
    }
    return true;
}

}  // namespace

// A triangle without area covers nothing, and no test is needed for that: the edge functions add up
// to twice the area, so off the line not all are positive, and on it the three edges, which add up
// to nothing, cannot all be top or left edges.
void scan_same_sign(const Corners& triangle, const PixelRect& rect, const SubpixelPoint& offset,
                    Picture& out) {
    const PixelRect box = bounding_box(triangle, rect, offset);
    for (int64_t y = box.y0; y < box.y1; ++y) {
        RowWriter writer(y, out);
        for (int64_t x = box.x0; x < box.x1; ++x) {
            ++out.work.samples;
            const SubpixelPoint p = sample_of(x, y, offset);
            // All negative is all positive with the vertices the other way round:
            // E_ba = -E_ab, the other convention.
            bool is_all_negative = true;
            for (size_t k = 0; k < 3; ++k) {
                const SubpixelPoint& a = triangle[k];
                const SubpixelPoint& b = triangle[(k + 1) % 3];
                const int64_t e = edge_function_counter(a, b, p);
                is_all_negative = is_all_negative && (e > 0 || (e == 0 && owns_its_samples(b, a)));
            }
            if (is_all_negative || is_inside(triangle, p)) {
                writer.add(x);
            }
        }
    }
}

}  // namespace rasterizers
