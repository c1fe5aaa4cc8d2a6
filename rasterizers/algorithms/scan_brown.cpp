// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/algorithms/edge.hpp"

namespace rasterizers {

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
