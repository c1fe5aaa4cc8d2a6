// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/algorithms/float_areas.hpp"

#include "rasterizers/algorithms/edge.hpp"

namespace rasterizers {

namespace {

float pixels(int64_t v) {
    return static_cast<float>(v) / static_cast<float>(kPixel);  // exact
}

float edge_in_float(const SubpixelPoint& a, const SubpixelPoint& b, const SubpixelPoint& p) {
    return (pixels(b.x) - pixels(a.x)) * (pixels(p.y) - pixels(a.y)) -
           (pixels(b.y) - pixels(a.y)) * (pixels(p.x) - pixels(a.x));
}

}  // namespace

FloatAreas float_areas_at(const Corners& t, const SubpixelPoint& p) {
    FloatAreas out;
    out.whole = edge_in_float(t[0], t[1], t[2]);
    for (size_t k = 0; k < 3; ++k) {
        out.part[k] = edge_in_float(t[(k + 1) % 3], t[(k + 2) % 3], p);
    }
    return out;
}

float three_multiplies(const FloatAreas& areas, const Values& z) {
    return areas.part[0] / areas.whole * z[0] + areas.part[1] / areas.whole * z[1] +
           areas.part[2] / areas.whole * z[2];
}

float two_multiplies(const FloatAreas& areas, const Values& z) {
    return z[0] + areas.part[1] / areas.whole * (z[1] - z[0]) +
           areas.part[2] / areas.whole * (z[2] - z[0]);
}

bool covers_in_float(const Corners& t, const SubpixelPoint& p) {
    for (size_t k = 0; k < 3; ++k) {
        const SubpixelPoint& a = t[k];
        const SubpixelPoint& b = t[(k + 1) % 3];
        const float e = edge_in_float(a, b, p);
        if (!(e > 0) && (e < 0 || !owns_its_samples(a, b))) {
            return false;
        }
    }
    return true;
}

}  // namespace rasterizers
