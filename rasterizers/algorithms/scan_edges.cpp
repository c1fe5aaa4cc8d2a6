// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The scans that evaluate edge functions pixel by pixel.
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

void scan_brown(const Corners& triangle, const PixelRect& rect, const SubpixelPoint& offset,
                Picture& out) {
    const std::optional<Corners> t = clockwise(triangle);
    if (!t) {
        return;
    }
    const PixelRect box = bounding_box(*t, rect, offset);
    if (box.x0 >= box.x1 || box.y0 >= box.y1) {
        return;
    }
    // Equation 2: A_0 = alpha_0 x + beta_0 y + gamma_0 belongs to the edge opposite P_0, and so on
    // cyclically. |gamma| <= 2 * 2^58. From the bottom row upwards: "subtraction of beta".
    std::array<int64_t, 3> alpha{};
    std::array<int64_t, 3> beta{};
    std::array<int64_t, 3> row{};
    const SubpixelPoint first = sample_of(box.x0, box.y1 - 1, offset);
    for (size_t k = 0; k < 3; ++k) {
        const SubpixelPoint& a = (*t)[(k + 1) % 3];
        const SubpixelPoint& b = (*t)[(k + 2) % 3];
        alpha[k] = a.y - b.y;
        beta[k] = b.x - a.x;
        const int64_t gamma = a.x * b.y - b.x * a.y;
        row[k] = alpha[k] * first.x + beta[k] * first.y + gamma - (owns_its_samples(a, b) ? 0 : 1);
    }
    for (int64_t y = box.y1 - 1; y >= box.y0; --y) {
        RowWriter writer(y, out);
        std::array<int64_t, 3> area = row;
        for (int64_t x = box.x0; x < box.x1; ++x) {
            ++out.work.samples;
            if (area[0] >= 0 && area[1] >= 0 && area[2] >= 0) {
                writer.add(x);
            }
            for (size_t k = 0; k < 3; ++k) {
                area[k] += alpha[k] * kPixel;
            }
        }
        for (size_t k = 0; k < 3; ++k) {
            row[k] -= beta[k] * kPixel;
        }
    }
}
// alpha x, beta y <= 2^30 * 2^22 each, gamma <= 2^59.
static_assert(2 * kCoordinateBits + 1 < 62 && kCoordinateBits + 1 + 23 < 60);

}  // namespace rasterizers
