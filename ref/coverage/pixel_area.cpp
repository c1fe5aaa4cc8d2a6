// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/pixel_area.hpp"

#include <algorithm>
#include <cmath>

#include "ref/number/rational.hpp"

namespace ref {

namespace {

// Beyond it a size is no number that a device can mean.
constexpr float kLargestSize = 64;  // pixels

bool is_size(float pixels) {
    return std::isfinite(pixels) && pixels >= 0 && pixels <= kLargestSize;
}

int64_t on_grid_above(const mpq_class& pixels, int64_t step) {
    const mpq_class steps = pixels * kFixedOne / step;
    return ceil_of(steps).get_si() * step;
}

}  // namespace

PixelArea pixel_area_of(const cases::Draw& draw, const Limits& limits, cases::Profile profile) {
    PixelArea out;
    out.mode = draw.conservative;
    if (!out.is_on()) {
        return out;
    }
    const int64_t unit = int64_t{1} << (kFixedBits - limits.subpixel_bits);
    if (!out.is_over()) {
        // The inner uncertainty region of Direct3D is at most a unit of the grid, and no device
        // there has less than half of one. At profile vulkan the positions are free by as much.
        out.least = unit;
        return out;
    }
    out.keeps_degenerates = limits.rasterizes_degenerates;
    out.is_unbounded = profile == cases::Profile::vulkan || !is_size(limits.overestimation) ||
                       !is_size(limits.overestimation_step);
    if (out.is_unbounded) {
        return out;
    }
    out.is_mitred = profile != cases::Profile::direct3d;
    // "In steps of" the granularity: the extra size is one of the two multiples beside it.
    const mpq_class extra = rational(draw.conservative_extra);
    const mpq_class step = rational(limits.overestimation_step);
    const mpq_class above = step > 0 ? mpq_class(ceil_of(extra / step) * step) : extra;
    const mpq_class below = step > 0 ? mpq_class(floor_of(extra / step) * step) : extra;
    // Each size is held on the grid of positions, and the outer uncertainty region of Direct3D is
    // never less than half of a unit.
    out.most =
        on_grid_above(rational(limits.overestimation), unit) + on_grid_above(above, unit) + unit;
    // Nothing says which shape an edge is moved with. Moved by s along x, and by s along y, a
    // triangle spans the sum with a square of s / 2, whatever the device draws beyond.
    out.least = std::max<int64_t>(0, floor_of(mpq_class(below * kFixedOne / 2)).get_si() - unit);
    return out;
}

}  // namespace ref
