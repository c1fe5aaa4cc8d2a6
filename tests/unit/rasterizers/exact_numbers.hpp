// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the integer algorithms compute, in rationals, and what Brown's block-normalised integers
// lose. The figures of docs/algorithms.md are made with the same functions.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "rasterizers/algorithms/block_integers.hpp"
#include "rasterizers/algorithms/edge.hpp"
#include "rasterizers/algorithms/interpolation.hpp"

namespace rasterizers::test {

inline mpz_class to_mpz(ref::Int128 v) {
    const ref::Int128 magnitude = v < 0 ? -v : v;
    mpz_class out(static_cast<unsigned long>(static_cast<uint64_t>(magnitude >> 64)));
    out <<= 64;
    out += static_cast<unsigned long>(static_cast<uint64_t>(magnitude));
    return v < 0 ? mpz_class(-out) : out;
}

inline mpq_class power_of_two(int exponent) {
    mpz_class power = 1;
    power <<= static_cast<unsigned long>(std::abs(exponent));
    return exponent < 0 ? mpq_class(1, power) : mpq_class(power);
}

// l_i = A_i / A.
inline std::array<mpq_class, 3> exact_barycentrics(const Areas& areas) {
    std::array<mpq_class, 3> out;
    for (size_t k = 0; k < 3; ++k) {
        out[k] = mpq_class(mpz_class(areas.part[k]), mpz_class(areas.whole));
        out[k].canonicalize();
    }
    return out;
}

// b'_i of equation 5, with exact w.
inline std::array<mpq_class, 3> exact_perspective(const Areas& areas,
                                                  const std::array<float, 3>& w) {
    std::array<mpq_class, 3> out;
    mpq_class sum = 0;
    for (size_t k = 0; k < 3; ++k) {
        out[k] = mpq_class(static_cast<double>(w[(k + 1) % 3])) *
                 mpq_class(static_cast<double>(w[(k + 2) % 3])) * mpz_class(areas.part[k]);
        sum += out[k];
    }
    for (mpq_class& b : out) {
        b /= sum;
    }
    return out;
}

// The largest loss over all attributes whose vertex values span at most 1, and its bound
// (block_integers.hpp derives it). No bound if the error may make the denominator vanish.
struct BlockLoss {
    double measured = 0;
    std::optional<double> bound;
};

// A clockwise triangle with a pixel that is k columns and l rows from the first; n bits for w and
// its products, m for the nine terms (0: exact).
inline BlockLoss block_loss(const Corners& t, const SubpixelPoint& first, int64_t k, int64_t l,
                            const std::array<float, 3>& w, int n, int m) {
    const Areas areas = areas_at(t, {first.x + k * kPixel, first.y + l * kPixel});
    const Block w_block = normalise_w(w, n);
    const Block products = normalise_products(w_block, n);
    const NineTerms terms = nine_terms(t, first, products, m);
    const std::array<ref::Int128, 3> computed = at_pixel(terms, k, l);

    const std::array<mpq_class, 3> b = exact_perspective(areas, w);
    const mpz_class sum = to_mpz(computed[0]) + to_mpz(computed[1]) + to_mpz(computed[2]);
    BlockLoss out;
    if (sgn(sum) <= 0) {
        out.measured = HUGE_VAL;
        return out;
    }
    std::array<mpq_class, 3> o;  // exact w, scaled to n bits
    for (size_t i = 0; i < 3; ++i) {
        o[i] = mpq_class(static_cast<double>(w[i])) * power_of_two(-w_block.exponent);
    }
    const int s = products.exponent;
    const mpq_class drift =
        terms.shift == 0 ? mpq_class(0) : (1 + k + l) * power_of_two(terms.shift - 1 + s);
    mpq_class loss = 0;
    mpq_class total = 0;     // sum N_i
    mpq_class errors = 0;    // sum |e_i|
    mpq_class weighted = 0;  // sum |e_i| (1 - b_i)
    for (size_t i = 0; i < 3; ++i) {
        const mpq_class& oj = o[(i + 1) % 3];
        const mpq_class& ok = o[(i + 2) % 3];
        const mpz_class area = abs(mpz_class(areas.part[i]));
        const mpq_class e = ((oj + ok) / 2 + mpq_class(1, 4) + power_of_two(s - 1)) * area + drift;
        errors += e;
        weighted += e * (1 - b[i]);
        total += oj * ok * mpz_class(areas.part[i]);
        mpq_class computed_b(to_mpz(computed[i]), sum);
        computed_b.canonicalize();
        loss += abs(computed_b - b[i]);
    }
    out.measured = mpq_class(loss / 2).get_d();
    if (total > errors) {
        out.bound = mpq_class(weighted / (total - errors)).get_d();
    }
    return out;
}

}  // namespace rasterizers::test
