// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Brown's barycentric interpolants in integers ("Barycentric Coordinates as Interpolants", last
// section): w as n-bit integers, their products block-normalised to n bits again, the nine terms of
// equation 11 block-normalised to m bits, and the areas carried from pixel to pixel by addition.
// A block has one exponent; equation 5 is homogeneous in it, so it is thrown away.
//
// What is lost. Let N_i = w_j w_k A_i be the exact numerators of equation 5, scaled as the computed
// ones N^_i = N_i + e_i. Then for any attribute u, since sum N_i (u_i - u) = 0,
//     u^ - u = sum e_i (u_i - u) / sum N^_i          exactly,
// and the largest loss over all attributes whose values span at most 1, half the sum of |b^_i -
// b_i|, is at most
//     sum |e_i| (1 - b_i) / (sum N_i - sum |e_i|).
// With o_i the exact w scaled to n bits (2^(n-1) <= max o < 2^n) and all roundings to nearest:
//     W_i = o_i + 1/2           W_j W_k = o_j o_k + (o_j + o_k)/2 + 1/4
//     Q_i = W_j W_k / 2^s + 1/2, s such that max Q has n bits
//     so |Q_i 2^s - o_j o_k| <= (o_j + o_k)/2 + 1/4 + 2^(s-1)
// and after k steps in x and l in y from the first pixel, each term rounded to a multiple of 2^r,
//     |e_i| <= ((o_j + o_k)/2 + 1/4 + 2^(s-1)) |A_i| + (1 + k + l) 2^(r-1) 2^s.
// The products alone, with r = 0 and w_max = R w_min, lose at most about 2 R 2^-n of the range:
// each Q_i is off by less than 3 R 2^-n of itself, and sum b_i (1 - b_i) <= 2/3.
#pragma once

#include <array>
#include <cstdint>

#include "rasterizers/algorithms/raster.hpp"
#include "ref/number/edge_function.hpp"

namespace rasterizers {

inline constexpr int kMaxBlockBits = 31;

// Three integers with one exponent: value i is q[i] 2^exponent, the largest of q has `bits` bits.
struct Block {
    std::array<int64_t, 3> q{};
    int exponent = 0;
};

// Positive w, binary32, as a block of n bits, rounded to nearest. n is 2..kMaxBlockBits. A w that
// is smaller than the largest by more than 2^n becomes 0.
Block normalise_w(const std::array<float, 3>& w, int n);

// w_1 w_2, w_2 w_0, w_0 w_1 of a block of n bits as a block of n bits; `exponent` is the shift s.
Block normalise_products(const Block& w, int n);

// The two together as numbers; for devices that take the areas from elsewhere.
std::array<float, 3> block_w_products(const std::array<float, 3>& w, int n);

// Equation 11 from a first pixel on. Without normalisation of the nine terms a product of n bits
// and an area of 61 needs 92 bits; with m bits a term needs m and its multiples m + 15 on the
// largest target.
struct NineTerms {
    std::array<ref::Int128, 3> step_x{}, step_y{}, first{};  // in units of 2^shift
    int shift = 0;                                           // r
};
static_assert(kMaxBlockBits + 61 < 127);

// The nine terms of a clockwise triangle; `bits` m is 2..48, or 0 to leave them exact.
NineTerms nine_terms(const Corners& clockwise, const SubpixelPoint& first_sample,
                     const Block& products, int bits);

// N^_i, k pixels right of and l below the first, by l + k additions. In a device each step is one
// addition; here the same integer is had by a product.
std::array<ref::Int128, 3> at_pixel(const NineTerms& terms, int64_t k, int64_t l);

// Equation 5 rounded to integers of n bits: b'_i 2^n. `numerators` must have a positive sum.
std::array<int64_t, 3> quantised_barycentrics(const std::array<ref::Int128, 3>& numerators, int n);

}  // namespace rasterizers
