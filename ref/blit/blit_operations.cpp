// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/blit/blit_operations.hpp"

#include <algorithm>

namespace ref {

namespace {

// Adjusts the rectangle once instead of testing each texel [seed 003, clipping]; then row by row.
template <class Combine>
void blit_rows(const Picture& source, Picture& destination, int64_t x, int64_t y,
               Combine&& combine) {
    const int64_t left = std::max<int64_t>(0, -x);
    const int64_t top = std::max<int64_t>(0, -y);
    const int64_t right = std::min(source.width, destination.width - x);
    const int64_t bottom = std::min(source.height, destination.height - y);
    for (int64_t j = top; j < bottom; ++j) {
        for (int64_t i = left; i < right; ++i) {
            combine(source.at(i, j), destination.at(x + i, y + j));
        }
    }
}

}  // namespace

void copy_blit(const Picture& source, Picture& destination, int64_t x, int64_t y) {
    blit_rows(source, destination, x, y, [](const Rgba& from, Rgba& to) { to = from; });
}

void masked_blit(const Picture& source, Picture& destination, int64_t x, int64_t y,
                 const mpq_class& threshold) {
    blit_rows(source, destination, x, y, [&](const Rgba& from, Rgba& to) {
        if (from[3] > threshold) {
            to = from;
        }
    });
}

void blended_blit(const Picture& source, Picture& destination, int64_t x, int64_t y) {
    blit_rows(source, destination, x, y, [](const Rgba& from, Rgba& to) {
        const mpq_class alpha = from[3];
        for (size_t k = 0; k < 3; ++k) {
            to[k] = alpha * from[k] + (1 - alpha) * to[k];
        }
        to[3] = alpha + (1 - alpha) * to[3];
    });
}

}  // namespace ref
