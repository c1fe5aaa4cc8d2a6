// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Partial derivatives of a perspective value, Brown's equation 9, for T = float or mpq_class.
#pragma once

#include <array>

#include "rasterizers/algorithms/raster.hpp"

namespace rasterizers {

template <class T>
struct Gradient {
    T dx, dy;  // per pixel
    // Equation 10: the total differential for a step of S pixels in x and in y.
    T total(const T& step) const { return step * (dx + dy); }
};

// du/dx = sum q_i alpha_i (u_i - u) / sum q_i A_i, and du/dy with beta; q_0 = w_1 w_2 and so on.
// `u` is the value at the point and `sum` the denominator of equation 5 there, sum q_i A_i with
// areas as edge_function() has them (units of 2^-16 square pixels) for the vertices in this order.
template <class T>
Gradient<T> brown_gradient(const Corners& t, const std::array<T, 3>& q,
                           const std::array<T, 3>& values, const T& u, const T& sum) {
    Gradient<T> out{T(0), T(0)};
    for (size_t i = 0; i < 3; ++i) {
        const SubpixelPoint& a = t[(i + 1) % 3];
        const SubpixelPoint& b = t[(i + 2) % 3];
        const T weight = q[i] * (values[i] - u);
        // alpha = y_a - y_b and beta = x_b - x_a per pixel of 2^8 units: at most 38 bits, exact in
        // a double.
        out.dx += weight * T(static_cast<double>((a.y - b.y) * kPixel));
        out.dy += weight * T(static_cast<double>((b.x - a.x) * kPixel));
    }
    out.dx /= sum;
    out.dy /= sum;
    return out;
}

}  // namespace rasterizers
