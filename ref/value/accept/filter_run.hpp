// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// filter_accepts() for neighbours in a row at once. Each number is computed by the same operations
// in the same order, so both have the same bits; only the loops run the other way, value by value
// along the row, which compilers turn into vector instructions.
#pragma once

#include <cstddef>
#include <span>

#include "ref/value/accept/filter.hpp"

namespace ref::value {

// What a device has of one quantity, from pixel to pixel.
struct RunValue {
    const Quantity* quantity = nullptr;  // linear or perspective
    const float* at = nullptr;
    size_t step = 1;  // floats from one pixel to the next
};

inline constexpr size_t kRunLength = 128;  // the most pixels of one call

// Where the first pixel's inputs are evaluated; the others are 1, 2, ... pixels to the right.
// Multiples of 1/16 within a target: exact in binary64.
struct RunPoints {
    Point<double> centre, sample;
};

// Of each pixel: the largest error of its values in budgets, as filter_accepts() tells it in
// `worst`, or infinity where it does not accept all of them.
void filter_run(const Filter& filter, std::span<const RunValue> values, const RunPoints& points,
                double factor, std::span<double> ratios);

}  // namespace ref::value
