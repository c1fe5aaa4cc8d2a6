// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/algorithms/block_integers.hpp"

#include <algorithm>
#include <cmath>

#include "rasterizers/algorithms/edge.hpp"

namespace rasterizers {

namespace {

int bit_length(ref::Int128 v) {
    int bits = 0;
    for (ref::Int128 rest = v < 0 ? -v : v; rest != 0; rest >>= 1) {
        ++bits;
    }
    return bits;
}

// v / 2^shift to nearest, ties upwards. An arithmetic shift rounds down.
ref::Int128 shift_to_nearest(ref::Int128 v, int shift) {
    return shift == 0 ? v : (v + (ref::Int128{1} << (shift - 1))) >> shift;
}

}  // namespace

Block normalise_w(const std::array<float, 3>& w, int n) {
    Block out;
    const float largest = std::max({w[0], w[1], w[2]});
    out.exponent = std::ilogb(largest) - (n - 1);
    const auto scale = [&] {
        for (size_t k = 0; k < 3; ++k) {
            // binary32 to binary64 and a power of two: exact, then one rounding.
            out.q[k] = std::llrint(std::ldexp(static_cast<double>(w[k]), -out.exponent));
        }
    };
    scale();
    if (std::max({out.q[0], out.q[1], out.q[2]}) >> n != 0) {  // rounded up to 2^n
        ++out.exponent;
        scale();
    }
    return out;
}

Block normalise_products(const Block& w, int n) {
    Block out;
    const std::array<int64_t, 3> p{w.q[1] * w.q[2], w.q[2] * w.q[0], w.q[0] * w.q[1]};  // 2n bits
    static_assert(2 * kMaxBlockBits < 63);
    out.exponent = std::max(0, bit_length(std::max({p[0], p[1], p[2]})) - n);
    const auto shift = [&] {
        for (size_t k = 0; k < 3; ++k) {
            out.q[k] = static_cast<int64_t>(shift_to_nearest(p[k], out.exponent));
        }
    };
    shift();
    if (std::max({out.q[0], out.q[1], out.q[2]}) >> n != 0) {
        ++out.exponent;
        shift();
    }
    return out;
}

std::array<float, 3> block_w_products(const std::array<float, 3>& w, int n) {
    const Block products = normalise_products(normalise_w(w, n), n);
    std::array<float, 3> out{};
    for (size_t k = 0; k < 3; ++k) {
        // The largest near 1, as w_products has it.
        out[k] = std::ldexp(static_cast<float>(products.q[k]), -n);
    }
    return out;
}

NineTerms nine_terms(const Corners& t, const SubpixelPoint& first_sample, const Block& products,
                     int bits) {
    NineTerms out;
    ref::Int128 largest = 0;
    for (size_t k = 0; k < 3; ++k) {
        const SubpixelPoint& a = t[(k + 1) % 3];
        const SubpixelPoint& b = t[(k + 2) % 3];
        // alpha and beta of a step of one pixel, and the area at the first sample instead of gamma.
        out.step_x[k] = ref::Int128{products.q[k]} * ((a.y - b.y) * kPixel);
        out.step_y[k] = ref::Int128{products.q[k]} * ((b.x - a.x) * kPixel);
        out.first[k] = ref::Int128{products.q[k]} * edge_function(a, b, first_sample);
        for (const ref::Int128 v : {out.step_x[k], out.step_y[k], out.first[k]}) {
            largest = std::max(largest, v < 0 ? -v : v);
        }
    }
    if (bits == 0) {
        return out;
    }
    out.shift = std::max(0, bit_length(largest) - bits);
    for (auto* terms : {&out.step_x, &out.step_y, &out.first}) {
        for (ref::Int128& v : *terms) {
            v = shift_to_nearest(v, out.shift);
        }
    }
    return out;
}

std::array<ref::Int128, 3> at_pixel(const NineTerms& terms, int64_t k, int64_t l) {
    std::array<ref::Int128, 3> out{};
    for (size_t i = 0; i < 3; ++i) {
        out[i] = terms.first[i] + k * terms.step_x[i] + l * terms.step_y[i];
    }
    return out;
}

std::array<int64_t, 3> quantised_barycentrics(const std::array<ref::Int128, 3>& numerators, int n) {
    const ref::Int128 sum = numerators[0] + numerators[1] + numerators[2];
    std::array<int64_t, 3> out{};
    for (size_t i = 0; i < 3; ++i) {
        // Floor of (2 N 2^n + sum) / (2 sum).
        const ref::Int128 a = (numerators[i] << (n + 1)) + sum;
        const ref::Int128 b = 2 * sum;
        out[i] = static_cast<int64_t>(a / b - (a % b < 0 ? 1 : 0));
    }
    return out;
}

}  // namespace rasterizers
