// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/accept/quad.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "ref/number/fixed_point.hpp"

namespace ref::value {

namespace {

using cases::Probe;

Spots corners(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

}  // namespace

std::array<Quad, 8> quads_of(cases::SampleId id) {
    std::array<Quad, 8> out;
    for (int k = 0; k < 8; ++k) {
        const int right = (static_cast<int>(id.x) ^ k) & 1;
        const int bottom = (static_cast<int>(id.y) ^ k >> 1) & 1;
        out[static_cast<size_t>(k)] = {right, bottom, k >= 4};
    }
    // Fine and coarse with even quads first, then the others.
    std::swap(out[1], out[4]);
    return out;
}

std::vector<Spots> probe_spots(const Quantity& q, const ProbePlace& place) {
    const double x = place.id.x + 0.5;
    const double y = place.id.y + 0.5;
    const cases::Attribute& attribute = place.draw->attributes[q.id.attribute];
    if (q.probe == Probe::at_sample) {
        const FixedPoint p =
            sample_position(place.id.x, place.id.y, attribute.probe_sample, *place.target);
        return {{{pixels(p.x), pixels(p.y)}}};
    }
    // "may be rounded to as fixed-point values with" that many fraction bits, no direction given:
    // the offset itself, or a neighbour on the grid.
    const double scale = std::ldexp(1.0, place.limits.interpolation_offset_bits);
    std::array<double, 2> low{}, high{}, exact{};
    for (size_t axis = 0; axis < 2; ++axis) {
        exact[axis] = static_cast<double>(attribute.probe_offset[axis]);
        low[axis] = std::floor(exact[axis] * scale) / scale;
        high[axis] = std::ceil(exact[axis] * scale) / scale;
    }
    if (low == high) {
        return {{{x + exact[0], y + exact[1]}}};
    }
    const Spots grid = corners(x + low[0], y + low[1], x + high[0], y + high[1]);
    if (place.profile != cases::Profile::direct3d) {
        return {grid};
    }
    std::vector<Spots> out = {{{x + exact[0], y + exact[1]}}};
    for (const auto& corner : grid) {
        out.push_back({corner});
    }
    return out;
}

std::vector<Difference> differences_of(const Quad& quad, int axis, bool is_coarse) {
    // The pixel is at (right, bottom) of its quad; (0, 0) is the quad's first pixel then.
    const std::array<int, 2> own = {quad.right, quad.bottom};
    const auto a = static_cast<size_t>(axis);
    const size_t other = 1 - a;
    std::vector<Difference> out;
    for (int line = 0; line < 2; ++line) {
        if (!is_coarse && line != own[other]) {
            continue;
        }
        Difference d;
        d.plus[a] = 1 - own[a];
        d.minus[a] = -own[a];
        d.plus[other] = line - own[other];
        d.minus[other] = line - own[other];
        out.push_back(d);
    }
    return out;
}

namespace {

// The least level of detail that a device holds is `least` or less, the largest one a texture's
// last level plus `most` or more: a bias may move it so far.
struct LevelEnds {
    double least, most;
};
// Vulkan's bias goes as far as maxSamplerLodBias, 2 or more ("Required Limits"), a Direct3D
// sampler's from -16 to 15.99 (Direct3D 11.3 functional specification, 7.18.11).
LevelEnds level_ends(cases::Profile profile) {
    return profile == cases::Profile::vulkan ? LevelEnds{-2, 2} : LevelEnds{-15.99, 16};
}

}  // namespace

Range<double> lod_bounds(const std::array<std::array<double, 2>, 2>& low,
                         const std::array<std::array<double, 2>, 2>& high, int mipmap_bits) {
    double least = 0;
    double most = 0;
    for (size_t axis = 0; axis < 2; ++axis) {
        least = std::max({least, low[0][axis], low[1][axis]});
        most = std::max(most, high[0][axis] + high[1][axis]);
    }
    const double slack = std::ldexp(1.0, -mipmap_bits) + 0x1p-30;
    return {std::log2(least) - slack, std::log2(most) + 0.5 + slack};
}

bool is_lod(const Range<double>& lambda, uint32_t component, uint32_t levels,
            const ProbePlace& place, double device) {
    if (std::isnan(device)) {
        return false;
    }
    const double last = levels - 1;
    if (component == 1) {
        const auto [least, most] = level_ends(place.profile);
        return (device >= lambda.low && device <= lambda.high) ||
               (device <= least && device >= lambda.low) ||
               (device >= last + most && device <= lambda.high);
    }
    // d' = clamp(lambda, 0, levels - 1), to mipmap_bits again.
    const double most =
        place.profile == cases::Profile::vulkan ? std::max(lambda.high, last) : last;
    const double slack = std::ldexp(1.0, -place.limits.mipmap_bits);
    return device >= std::clamp(lambda.low, 0.0, last) - slack &&
           device <= std::clamp(lambda.high, 0.0, most) + slack && device >= 0 && device <= most;
}

uint32_t levels_of(const std::array<uint32_t, 2>& texture) {
    return static_cast<uint32_t>(std::bit_width(std::max(texture[0], texture[1])));
}

namespace {

using Valuation = std::optional<Valued<mpq_class>>;

Valuation value_of(const Basis<mpq_class>& basis, const Quantity& q, uint32_t plane, double x,
                   double y, cases::Profile profile) {
    const mpq_class factor = exact_budget_factor(profile);
    const auto site =
        make_site(basis, basis.planes[kPlaneInvW], {mpq_class(x), mpq_class(y)}, factor);
    const auto v = value_at(site, basis.planes[plane], q.is_perspective, factor);
    return v.exists == Answer::yes ? Valuation(v) : std::nullopt;
}

// The first difference of the likeliest quad.
Valuation difference_of(const Basis<mpq_class>& basis, const Quantity& q, uint32_t plane, int axis,
                        bool is_coarse, const ProbePlace& place) {
    const Difference d = differences_of(quads_of(place.id).front(), axis, is_coarse).front();
    const double x = place.id.x + 0.5;
    const double y = place.id.y + 0.5;
    auto plus = value_of(basis, q, plane, x + d.plus[0], y + d.plus[1], place.profile);
    const auto minus = value_of(basis, q, plane, x + d.minus[0], y + d.minus[1], place.profile);
    if (!plus || !minus) {
        return std::nullopt;
    }
    plus->value -= minus->value;
    plus->budget += minus->budget + mpq_class(kUnitRoundoff) * abs(plus->value);
    return plus;
}

std::optional<ProbeValue> expected_lod(const Basis<mpq_class>& basis, const Quantity& q,
                                       const ProbePlace& place) {
    const std::array<uint32_t, 2>& size = place.draw->attributes[q.id.attribute].texture_size;
    double rho = 0;
    for (int axis = 0; axis < 2; ++axis) {
        double squares = 0;
        for (uint32_t c = 0; c < 2; ++c) {
            const auto d = difference_of(basis, q, q.plane - q.id.component + c, axis, true, place);
            if (!d) {
                return std::nullopt;
            }
            const double m = d->value.get_d() * size[c];
            squares += m * m;
        }
        rho = std::max(rho, std::sqrt(squares));
    }
    ProbeValue out;
    out.nearest = std::log2(rho);
    if (q.id.component == 0) {
        out.nearest = std::clamp(out.nearest, 0.0, static_cast<double>(levels_of(size) - 1));
    }
    out.budget = std::ldexp(1.0, -place.limits.mipmap_bits);
    return out;
}

}  // namespace

std::optional<ProbeValue> expected_probe(const Basis<mpq_class>& basis, const Quantity& q,
                                         const ProbePlace& place) {
    if (q.probe == Probe::lod) {
        return expected_lod(basis, q, place);
    }
    Valuation v;
    if (const auto derivative = derivative_of(q.probe)) {
        const bool is_coarse = derivative->fineness == Fineness::coarse;
        Valuation x, y;
        if (derivative->has_x) {
            x = difference_of(basis, q, q.plane, 0, is_coarse, place);
        }
        if (derivative->has_y) {
            y = difference_of(basis, q, q.plane, 1, is_coarse, place);
        }
        if ((derivative->has_x && !x) || (derivative->has_y && !y)) {
            return std::nullopt;
        }
        v = x ? x : y;
        if (x && y) {
            v->value = abs(x->value) + abs(y->value);
            v->budget += y->budget + mpq_class(kUnitRoundoff) * v->value;
        }
    } else {
        const Spots spots = probe_spots(q, place).front();
        v = value_of(basis, q, q.plane, spots.front()[0], spots.front()[1], place.profile);
        if (!v) {
            return std::nullopt;
        }
    }
    return ProbeValue{v->value.get_d(), v->budget.get_d(), v->value};
}

}  // namespace ref::value
