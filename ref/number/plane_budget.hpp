// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The planes of one basis and the binary32 budget around them. They are written once for exact and
// for filtered numbers (ball.hpp). The derivation stands in docs/precision.md.
//
// Homogeneous set-up: with X_i = x_f,i w_i and Y_i = y_f,i w_i the functions beta_i = b_i / w_i are
// the rows of the inverse of the matrix with columns (X_i, Y_i, w_i), valid for w_i <= 0 too
// (Olano and Greer 1997; Brown, eq. 4). A plane with the homogeneous vertex values h_i = g_i w_i is
// sum beta_i h_i: h = f gives N of a smooth value, h = 1 gives D = 1/w, h = w f a linear value.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cases/model/profile.hpp"
#include "ref/number/ball.hpp"

namespace ref {

// K is how many budgets of error are accepted at practice and direct3d. docs/precision.md has the
// largest error measured on every driver.
inline constexpr int kBudgetFactor = 2;

// So many budgets are proven, to first order, to hold the evaluations of docs/precision.md.
inline constexpr int kProvenFactor = 8;

// K of a profile. At vulkan an operation may be wrong by about 1 part in 10^5
// (value::kVulkanRoundoff) instead of u = 2^-24 (value::kUnitRoundoff), of which the budget is
// made, and K is the proven factor: 8 x 10^-5 / u, about 1342.
inline mpq_class exact_budget_factor(cases::Profile profile) {
    constexpr int64_t kParts = 100000;
    constexpr int64_t kUnits = 1 << 24;
    return profile == cases::Profile::vulkan ? mpq_class(kProvenFactor * kUnits) / kParts
                                             : mpq_class(kBudgetFactor);
}
// Is the same, rounded, for texts.
inline double budget_factor(cases::Profile profile) {
    return exact_budget_factor(profile).get_d();
}

}  // namespace ref

namespace ref::value {

inline constexpr double kUnitRoundoff = 0x1p-24;  // u of binary32
// The absolute error that arises where a device flushes results below 2^-126 to zero, a few times.
inline constexpr double kUnderflow = 0x1p-123;
// One rounding at profile vulkan: "about 1 part in 10^5".
inline constexpr double kVulkanRoundoff = 1e-5;

template <class T>
struct Point {
    T x, y;
};

template <class T>
using Triple = std::array<T, 3>;

// The three vertices, at the positions that the basis takes.
template <class T>
struct Vertices {
    Triple<T> hx, hy, w;           // X_i, Y_i, w_i
    std::array<bool, 3> finite{};  // w_i != 0
    Triple<T> ex, ey;              // bounds on the rounding of the device's x_f and y_f, pixels
};

// The values that one plane interpolates.
template <class T>
struct PlaneInput {
    Triple<T> h;   // g_i w_i
    T rounding{};  // proven bound on the error of the g_i beyond one rounding of g_i, absolute
};

template <class T>
struct Form {
    T x, y, c;  // x px + y py + c
    T at(const Point<T>& p) const { return x * p.x + y * p.y + c; }
};

template <class T>
struct Plane {
    Form<T> form;
    // 2u max_k (bx_k X + by_k Y) + constant: k = 0 is sum |g_i| D_i, k = 1 + j is
    // sum_{i != j} |g_i - g_j| D_i.
    std::array<T, 4> bx{}, by{};
    T constant{};

    // `spread` is sum |b_i| at the point, 1 inside the triangle: errors of the vertex values,
    // positions and the determinant grow by it where the plane is extrapolated.
    T budget(const T& extent_x, const T& extent_y, const T& spread) const {
        T worst = bx[0] * extent_x + by[0] * extent_y;
        for (size_t k = 1; k < bx.size(); ++k) {
            worst = larger(worst, T(bx[k] * extent_x + by[k] * extent_y));
        }
        return (T(2 * kUnitRoundoff) * worst + constant) * spread;
    }
};

template <class T>
struct Basis {
    Triple<Form<T>> bary;  // b_i
    // Least and largest x_f,i and y_f,i, the origin included, because a plane may be anchored
    // there.
    T low_x{}, high_x{}, low_y{}, high_y{};
    int orientation = 0;  // sign of the determinant, 2 if unknown, 0 if there is no basis
    std::vector<Plane<T>> planes;
};

// The plane of `in`, given the functions beta_i. `factor`: as below.
template <class T>
Plane<T> plane_of(const Triple<Form<T>>& betas, const Vertices<T>& v, const PlaneInput<T>& in,
                  int factor) {
    Plane<T> plane;
    T largest{};
    for (size_t i = 0; i < 3; ++i) {
        const Form<T>& beta = betas[i];
        plane.form.x = plane.form.x + beta.x * in.h[i];
        plane.form.y = plane.form.y + beta.y * in.h[i];
        plane.form.c = plane.form.c + beta.c * in.h[i];
        plane.bx[0] = plane.bx[0] + magnitude(T(beta.x * in.h[i]));
        plane.by[0] = plane.by[0] + magnitude(T(beta.y * in.h[i]));
    }
    for (size_t j = 0; j < 3; ++j) {
        if (!v.finite[j]) {
            continue;
        }
        const T g = in.h[j] / v.w[j];
        largest = larger(largest, T(magnitude(g)));
        for (size_t i = 0; i < 3; ++i) {
            if (i != j) {
                const T d = magnitude(T(in.h[i] - g * v.w[i]));
                plane.bx[1 + j] = plane.bx[1 + j] + magnitude(betas[i].x) * d;
                plane.by[1 + j] = plane.by[1 + j] + magnitude(betas[i].y) * d;
            }
        }
    }
    T moved{};  // max_i |grad g . (ex_i, ey_i)|
    for (size_t i = 0; i < 3; ++i) {
        moved =
            larger(moved, T(magnitude(plane.form.x) * v.ex[i] + magnitude(plane.form.y) * v.ey[i]));
    }
    for (size_t k = 0; k < plane.bx.size(); ++k) {
        plane.bx[k] = plane.bx[k] + T(kUnderflow / (2 * kUnitRoundoff));
        plane.by[k] = plane.by[k] + T(kUnderflow / (2 * kUnitRoundoff));
    }
    plane.constant = T(kUnitRoundoff) * largest + T(kUnderflow) +
                     (moved + in.rounding) / T(static_cast<double>(factor));
    return plane;
}

// Planes through the vertices. orientation is 0 (no planes) if the triangle has no area, and 2
// (no planes) if T cannot tell. `factor` is K: proven input errors enter the budget as 1/K of
// themselves, so that K budgets hold them once.
template <class T>
Basis<T> make_basis(const Vertices<T>& v, const std::vector<PlaneInput<T>>& inputs, int factor) {
    Basis<T> basis;
    Triple<Triple<T>> row;  // cross products of two columns
    for (size_t i = 0; i < 3; ++i) {
        const size_t j = (i + 1) % 3;
        const size_t k = (i + 2) % 3;
        row[i] = {T(v.hy[j] * v.w[k] - v.hy[k] * v.w[j]), T(v.w[j] * v.hx[k] - v.w[k] * v.hx[j]),
                  T(v.hx[j] * v.hy[k] - v.hx[k] * v.hy[j])};
    }
    const T det = v.hx[0] * row[0][0] + v.hy[0] * row[0][1] + v.w[0] * row[0][2];
    basis.orientation = sign_of(det);
    if (basis.orientation == 0 || basis.orientation == 2) {
        return basis;
    }
    const T inverse = T(1.0) / det;
    Triple<Form<T>> betas;
    for (size_t i = 0; i < 3; ++i) {
        betas[i] = {T(row[i][0] * inverse), T(row[i][1] * inverse), T(row[i][2] * inverse)};
        basis.bary[i] = {T(betas[i].x * v.w[i]), T(betas[i].y * v.w[i]), T(betas[i].c * v.w[i])};
        if (v.finite[i]) {
            const T x = v.hx[i] / v.w[i];
            const T y = v.hy[i] / v.w[i];
            basis.low_x = smaller(basis.low_x, x);
            basis.high_x = larger(basis.high_x, x);
            basis.low_y = smaller(basis.low_y, y);
            basis.high_y = larger(basis.high_y, y);
        }
    }
    basis.planes.reserve(inputs.size());
    for (const PlaneInput<T>& in : inputs) {
        basis.planes.push_back(plane_of(betas, v, in, factor));
    }
    return basis;
}

// A value of a basis at a point, with one budget, and the accepted deviation `reach` (K budgets;
// for a quotient also the second-order term of a denominator that is itself in error).
template <class T>
struct Valued {
    Answer exists = Answer::no;  // no: the denominator is not safely positive, nothing is claimed
    T value{}, budget{}, reach{};
};

// What all values of a basis at one point share.
template <class T>
struct Site {
    Point<T> p;
    T extent_x{}, extent_y{}, spread{};
    T d{}, bd{}, safe{};            // 1/w, its budget, the smallest 1/w that the device may have
    Answer exists = Answer::no;     // safe > 0
    Answer is_inside = Answer::no;  // p is in the closed triangle of the basis
};

template <class T>
Site<T> make_site(const Basis<T>& basis, const Plane<T>& inv_w, const Point<T>& p,
                  const T& factor) {
    Site<T> s;
    s.p = p;
    s.extent_x = larger(basis.high_x, p.x) - smaller(basis.low_x, p.x);
    s.extent_y = larger(basis.high_y, p.y) - smaller(basis.low_y, p.y);
    s.is_inside = Answer::yes;
    for (const Form<T>& b : basis.bary) {
        const T at = b.at(p);
        s.spread = s.spread + magnitude(at);
        const Answer side = is_at_most(T(0.0), at);
        s.is_inside = s.is_inside == Answer::no || side == Answer::yes ? s.is_inside : side;
    }
    s.d = inv_w.form.at(p);
    s.bd = inv_w.budget(s.extent_x, s.extent_y, s.spread);
    s.safe = s.d - factor * s.bd;
    s.exists = is_positive(s.safe);
    return s;
}

template <class T>
Valued<T> value_at(const Site<T>& s, const Plane<T>& plane, bool is_perspective, const T& factor) {
    Valued<T> out;
    const T n = plane.form.at(s.p);
    const T bn = plane.budget(s.extent_x, s.extent_y, s.spread);
    if (!is_perspective) {
        out.exists = Answer::yes;
        out.value = n;
        out.budget = bn;
        out.reach = factor * bn;
        return out;
    }
    out.exists = s.exists;
    if (out.exists != Answer::yes) {
        return out;
    }
    out.value = n / s.d;
    const T f = magnitude(out.value);
    const T planes = bn + f * s.bd;
    const T own = T(2 * kUnitRoundoff) * f;
    out.budget = planes / s.d + own;
    out.reach = factor * (planes / s.safe + own);
    return out;
}

// How far a smooth value may leave the hull of the vertex values where no denominator is safe, at a
// point that is covered; `least` is the least 1/w there, `most` the largest |f|. To first order:
// the budgets' own formula (docs/precision.md, "The quotient").
template <class T>
T hull_reach(const Site<T>& s, const Plane<T>& inv_w, const Plane<T>& plane, const T& least,
             const T& most, const T& factor) {
    const T one(1.0);  // the positions that cover the point have it inside
    const T planes = plane.budget(s.extent_x, s.extent_y, one) +
                     most * inv_w.budget(s.extent_x, s.extent_y, one);
    return factor * (planes / larger(s.d, least) + T(2 * kUnitRoundoff) * most);
}

}  // namespace ref::value
