// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The samples that a draw may touch at all.
#include <algorithm>
#include <cmath>

#include "ref/coverage/setup.hpp"

namespace ref {

namespace {

mpq_class exact(float f) {
    return mpq_class(static_cast<double>(f));
}

mpz_class floor_units(const mpq_class& pixels) {
    const mpq_class units = pixels * kFixedOne;
    mpz_class r;
    mpz_fdiv_q(r.get_mpz_t(), units.get_num_mpz_t(), units.get_den_mpz_t());
    return r;
}

mpz_class ceil_units(const mpq_class& pixels) {
    return -floor_units(-pixels);
}

int64_t saturate(const mpz_class& v) {
    constexpr int64_t kFar = int64_t{1} << kPositionBits;
    return v > kFar ? kFar : (v < -kFar ? -kFar : int64_t{v.get_si()});
}

bool is_integer(float f) {
    return !(std::floor(f) < f);
}

void axis_window(float origin, float extent, cases::Profile profile, FixedRange& zone,
                 FixedRange& core) {
    const mpq_class end = exact(origin) + exact(extent);
    const mpq_class low = std::min<mpq_class>(exact(origin), end);
    const mpq_class high = std::max<mpq_class>(exact(origin), end);
    if (is_integer(origin) && is_integer(extent)) {
        // Polygon clipping: a sample on the border lies on an edge; only the top-left rule decides
        // it.
        const int64_t open = profile == cases::Profile::direct3d ? 1 : 0;
        zone = {saturate(ceil_units(low)), saturate(floor_units(high)) - open};
        core = zone;
        return;
    }
    // viewportSubPixelBits may be 0, and Direct3D 11.3, 15.6.1 has a zone of up to half a pixel:
    // within less than a pixel of a fractional border both answers are left open.
    zone = {saturate(floor_units(low - 1)) + 1, saturate(ceil_units(high + 1)) - 1};
    core = {saturate(ceil_units(low + 1)), saturate(floor_units(high - 1))};
}

}  // namespace

bool Window::is_in_scissor(const FixedPoint& p) const {
    const int64_t i = p.x >> kFixedBits;  // arithmetic shift: floor
    const int64_t j = p.y >> kFixedBits;
    return i >= pixel_x0 && i < pixel_x1 && j >= pixel_y0 && j < pixel_y1;
}

bool Window::is_in_zone(const FixedPoint& p) const {
    return is_viewport_ignored || (zone_x.contains(p.x) && zone_y.contains(p.y));
}

bool Window::must_touch(const FixedPoint& p) const {
    return may_touch(p) && core_x.contains(p.x) && core_y.contains(p.y);
}

Window window_of(const cases::Case& c, const cases::Draw& draw, cases::Profile profile) {
    Window w;
    const cases::Rect& r = draw.scissor;
    w.pixel_x0 = std::max<int64_t>(0, r.x);
    w.pixel_y0 = std::max<int64_t>(0, r.y);
    w.pixel_x1 = std::min<int64_t>(c.target.width, int64_t{r.x} + r.width);
    w.pixel_y1 = std::min<int64_t>(c.target.height, int64_t{r.y} + r.height);
    axis_window(draw.viewport.x, draw.viewport.width, profile, w.zone_x, w.core_x);
    axis_window(draw.viewport.y, draw.viewport.height, profile, w.zone_y, w.core_y);
    const cases::Multisample& m = draw.multisample;
    w.sample_mask = m.sample_mask & m.shader_mask.value_or(0xffffffffU);
    return w;
}

}  // namespace ref
