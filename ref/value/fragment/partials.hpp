// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Analytic derivatives of an interpolated value: Brown, "Barycentric Coordinates as Interpolants",
// equations 7 to 10. With A_i = alpha_i x + beta_i y + gamma_i twice the area opposite vertex i
// (eq. 2) and the products w_j w_k,
//
//   du/dx = (w1 w2 alpha_0 (u_0 - u) + w2 w0 alpha_1 (u_1 - u) + w0 w1 alpha_2 (u_2 - u))
//           / (w1 w2 A_0 + w2 w0 A_1 + w0 w1 A_2)                                  (eq. 9)
//
// and for y with beta; the total differential (eq. 10) takes alpha + beta times the pixel spacing
// S. What devices compute is a difference between pixels, not this limit: it is shown beside it.
// The two are connected exactly, without a remainder: with D the denominator of eq. 9, (u(x + h) -
// u(x)) / h = du/dx (x) D(x) / D(x + h).
#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>

namespace ref {

// A vertex in framebuffer coordinates with its clip w (not 0) and one attribute u.
struct PartialVertex {
    mpq_class x, y, w, u;
};

struct Partials {
    mpq_class u;       // the value itself, eq. 5 and 6
    mpq_class dx, dy;  // eq. 9
    mpq_class total;   // eq. 10
};

// Computes them exactly at the point (x, y), with the pixel spacing S. There are none where the
// denominator is zero: for a triangle without area, or on the horizon.
std::optional<Partials> partials_at(const std::array<PartialVertex, 3>& vertices,
                                    const mpq_class& x, const mpq_class& y,
                                    const mpq_class& spacing);

}  // namespace ref
