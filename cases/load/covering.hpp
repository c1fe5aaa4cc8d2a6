// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace cases {

// A covering array of strength 2: combinations of one value an axis such that every pair of values
// of every two axes is in at least one of them. `sizes` are the numbers of values, each at least 1;
// a combination is its index in the full product, whose first axis is the slowest. The result is
// sorted, names nothing twice, and is a function of `sizes` alone.
//
// The first and the last combination are always chosen, so that every axis has both of its ends in
// them. Then, until no pair is missing, the combination with most missing pairs follows, of those
// the one whose pairs were chosen least often (so that values of which nothing is missing take
// turns), of those the first: the greedy step of D. Cohen, S. Dalal, M. Fredman, G. Patton, "The
// AETG System: An Approach to Testing Based on Combinatorial Design", IEEE TSE 23(7), 1997, made
// over the whole product instead of random candidates.
//
// How many: at least v1 v2, the product of the two largest sizes, as no combination has two pairs
// of one couple of axes. At most v1 v2 H(k (k - 1) / 2) for k axes, H(n) = 1 + 1/2 + ... + 1/n:
// taking each combination of the product with weight v1 v2 / product covers every pair at least
// once, a combination has k (k - 1) / 2 pairs, and greedy covers are within that H of a weighted
// one (V. Chvatal, "A Greedy Heuristic for the Set-Covering Problem", 1979; the last combination
// has as many missing pairs after the first as any). So with three axes or more of several values
// something is left out: H(3) = 11/6 < 2, and each further axis at least doubles the product.
std::vector<size_t> cover_pairs(std::span<const size_t> sizes);

}  // namespace cases
