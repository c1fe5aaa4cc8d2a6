// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/window.hpp"

#include <algorithm>

#include "ref/number/edge_function.hpp"
#include "ref/number/rational.hpp"
#include "ref/position/position_detail.hpp"

namespace ref {

namespace {

// In S47.16 units, as far as positions go.
int64_t saturated(const mpz_class& units) {
    constexpr int64_t kFar = int64_t{1} << kPositionBits;
    return units > kFar ? kFar : (units < -kFar ? -kFar : int64_t{units.get_si()});
}
int64_t floor_units(const mpq_class& pixels) {
    return saturated(floor_of(pixels * kFixedOne));
}
int64_t ceil_units(const mpq_class& pixels) {
    return saturated(ceil_of(pixels * kFixedOne));
}

void axis_window(float origin, float extent, cases::Profile profile, FixedRange& zone,
                 FixedRange& core) {
    const mpq_class end = rational(origin) + rational(extent);
    const mpq_class low = std::min<mpq_class>(rational(origin), end);
    const mpq_class high = std::max<mpq_class>(rational(origin), end);
    if (is_integer(origin) && is_integer(extent)) {
        // Polygon clipping: a sample on the border lies on an edge; only the top-left rule decides
        // it.
        const int64_t open = profile == cases::Profile::direct3d ? 1 : 0;
        zone = {ceil_units(low), floor_units(high) - open};
        core = zone;
        return;
    }
    // viewportSubPixelBits may be 0, and Direct3D 11.3, 15.6.1 has a zone of up to half a pixel:
    // within less than a pixel of a fractional border both answers are left open.
    zone = {floor_units(low - 1) + 1, ceil_units(high + 1) - 1};
    core = {ceil_units(low + 1), floor_units(high - 1)};
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

bool Window::is_in_core(const FixedPoint& p) const {
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
    w.alpha = cases::alpha_coverage(draw, c.target, profile);
    return w;
}

}  // namespace ref
