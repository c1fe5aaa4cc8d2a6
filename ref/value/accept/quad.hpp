// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Where probes (probe.hpp) look, and what the reference expects them to see first.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "ref/number/plane_budget.hpp"
#include "ref/position/limits.hpp"
#include "ref/value/fragment/depth_path.hpp"
#include "ref/value/fragment/quantities.hpp"

namespace ref::value {

// The fragment that is asked about, and what its device promises.
struct ProbePlace {
    cases::SampleId id;
    const cases::Target* target = nullptr;
    const cases::Draw* draw = nullptr;
    Limits limits;
    cases::Profile profile = cases::Profile::direct3d;
};

// One arrangement of the quad around a pixel.
struct Quad {
    int right = 0, bottom = 0;  // 1: the pixel is in the quad's right column, lower row
    bool is_coarse = false;     // what plain derivatives do
    friend bool operator==(const Quad&, const Quad&) = default;
};
// All arrangements, the likeliest (even alignment, fine) first.
std::array<Quad, 8> quads_of(cases::SampleId id);

// Points of framebuffer space, which are multiples of 2^-8 or finer below 2^15 and so exact in
// binary64. Several of them mean anywhere in their hull.
using Spots = std::vector<std::array<double, 2>>;

// The alternatives of where interpolateAtOffset and interpolateAtSample may evaluate.
std::vector<Spots> probe_spots(const Quantity& q, const ProbePlace& place);

// The value at pixel (x, y) + `plus` less the value at (x, y) + `minus`.
struct Difference {
    std::array<int, 2> plus{}, minus{};
};
// The differences that a derivative of one axis (0: x, 1: y) may be.
std::vector<Difference> differences_of(const Quad& quad, int axis, bool is_coarse);

// What a probe may be: one alternative for each place where it may look, or for each difference
// that a derivative may be. `at` has the value anywhere in the hull of spots, `along` the
// differences of an axis, and `width` the sum of two magnitudes.
template <class Value, class At, class Along, class Width>
std::vector<Value> alternatives_of(const Quantity& q, const Quad& quad, const ProbePlace& place,
                                   const At& at, const Along& along, const Width& width) {
    std::vector<Value> out;
    const std::optional<Derivative> derivative = derivative_of(q.probe);
    if (!derivative) {
        for (const Spots& spots : probe_spots(q, place)) {
            at(spots, out);
        }
        return out;
    }
    const bool is_coarse = derivative->fineness == Fineness::coarse ||
                           (derivative->fineness == Fineness::plain && quad.is_coarse);
    if (!derivative->has_x || !derivative->has_y) {
        return along(derivative->has_x ? 0 : 1, is_coarse);
    }
    const std::vector<Value> ys = along(1, is_coarse);
    for (const Value& x : along(0, is_coarse)) {
        for (const Value& y : ys) {
            out.push_back(width(x, y));
        }
    }
    return out;
}

// The bounds of a level of detail from those of the magnitudes m = |derivative| * texels (Vulkan
// specification, "Scale Factor, Level of Detail and Image Level(s) Selection Operation"):
//   max(all m) <= rho <= sqrt 2 max(m_ux + m_vx, m_uy + m_vy),  lambda = log2 rho.
// `low` and `high`: [0] of u, [1] of v, each by x and y. 2^-mipmap_bits is granted, and 2^-30 for
// the logarithm here, so that the verdict does not rest on its rounding.
Range<double> lod_bounds(const std::array<std::array<double, 2>, 2>& low,
                         const std::array<std::array<double, 2>, 2>& high, int mipmap_bits);

// Whether the device's number may be a texture's level of detail: component 1 lambda' itself,
// component 0 the levels that are accessed, clamped to 0 .. levels - 1. At profile vulkan they may
// also be clamped to 0 alone: the text clamps where it selects levels, and says less of queries.
// lambda' may also be the end of what a device holds, where it is beyond: "These values may be
// subject to implementation-specific maxima and minima for very large, out-of-range values" (Vulkan
// specification, "LOD Query"). What is in range is not said; here it is what a sampler's bias may
// bring back to where it selects a level: a least end is at most -2, which every Vulkan device's
// bias reaches, and from practice on -15.99, as Direct3D's (7.18.11) does; a largest one is as far
// above the texture's last level.
bool is_lod(const Range<double>& lambda, uint32_t component, uint32_t levels,
            const ProbePlace& place, double device);

// How many levels a texture has.
uint32_t levels_of(const std::array<uint32_t, 2>& texture);

// The number that the reference thinks likeliest: it takes even quads, the upper row or left column
// if coarse, offsets without rounding, and the Euclidean level of detail. There is none where the
// denominator vanishes.
struct ProbeValue {
    double nearest = 0;
    double budget = 0;
    std::optional<mpq_class> exact;  // not of a level of detail
};
std::optional<ProbeValue> expected_probe(const Basis<mpq_class>& basis, const Quantity& q,
                                         const ProbePlace& place);

}  // namespace ref::value
