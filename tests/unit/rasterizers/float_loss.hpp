// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What interpolation loses, and at most may lose, at one point of a clockwise triangle.
#pragma once

#include "rasterizers/algorithms/float_areas.hpp"
#include "tests/unit/rasterizers/exact_numbers.hpp"

namespace rasterizers::test {

// g(k) = k u / (1 - k u), u = 2^-24
inline mpq_class rounding_bound(int k) {
    const mpq_class ku = mpq_class(k) * power_of_two(-24);
    return ku / (1 - ku);
}

struct FormLoss {
    mpq_class measured, bound;
};
struct FloatLoss {
    FormLoss three, two;              // areas in binary32
    FormLoss exact_three, exact_two;  // areas exact
    bool is_bounded = false;          // of the first two
};

inline FloatLoss float_loss(const Corners& t, const SubpixelPoint& p, const Values& values) {
    const Areas areas = areas_at(t, p);
    const auto l = exact_barycentrics(areas);
    std::array<mpq_class, 3> z;
    for (size_t k = 0; k < 3; ++k) {
        z[k] = mpq_class(static_cast<double>(values[k]));
    }
    const mpq_class exact = l[0] * z[0] + l[1] * z[1] + l[2] * z[2];
    const auto error = [&](float v) {
        return mpq_class(abs(mpq_class(static_cast<double>(v)) - exact));
    };
    const mpq_class d1 = abs(z[1] - z[0]);
    const mpq_class d2 = abs(z[2] - z[0]);

    FloatLoss out;
    mpq_class sum = 0;
    for (size_t k = 0; k < 3; ++k) {
        sum += abs(l[k] * z[k]);
    }
    out.exact_three = {error(three_multiplies(areas, values)), rounding_bound(6) * sum};
    out.exact_two = {
        error(two_multiplies(areas, values)),
        rounding_bound(7) * (abs(l[1]) * d1 + abs(l[2]) * d2) + rounding_bound(2) * abs(z[0])};

    // M of the header, in units of areas.
    const auto magnitude = [](const SubpixelPoint& a, const SubpixelPoint& b,
                              const SubpixelPoint& q) {
        return mpq_class(abs(mpz_class((b.x - a.x) * (q.y - a.y))) +
                         abs(mpz_class((b.y - a.y) * (q.x - a.x))));
    };
    const mpq_class whole_error = rounding_bound(2) * magnitude(t[0], t[1], t[2]);
    const mpq_class room = mpz_class(areas.whole) - whole_error;
    out.is_bounded = room > 0;
    const FloatAreas computed = float_areas_at(t, p);
    out.three.measured = out.two.measured = 0;
    if (!out.is_bounded) {
        return out;
    }
    const mpq_class u = power_of_two(-24);
    std::array<mpq_class, 3> d;
    for (size_t k = 0; k < 3; ++k) {
        const mpq_class part_error =
            rounding_bound(2) * magnitude(t[(k + 1) % 3], t[(k + 2) % 3], p);
        d[k] = (part_error + abs(l[k]) * whole_error) / room * (1 + u) + u * abs(l[k]);
    }
    out.three = {error(three_multiplies(computed, values)), 0};
    for (size_t k = 0; k < 3; ++k) {
        out.three.bound += (d[k] + rounding_bound(3) * (abs(l[k]) + d[k])) * abs(z[k]);
    }
    out.two = {error(two_multiplies(computed, values)),
               (d[1] + rounding_bound(4) * (abs(l[1]) + d[1])) * d1 +
                   (d[2] + rounding_bound(4) * (abs(l[2]) + d[2])) * d2 +
                   rounding_bound(2) * abs(z[0])};
    return out;
}

}  // namespace rasterizers::test
