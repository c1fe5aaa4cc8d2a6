// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/fragment/partials.hpp"

namespace ref {

std::optional<Partials> partials_at(const std::array<PartialVertex, 3>& v, const mpq_class& x,
                                    const mpq_class& y, const mpq_class& spacing) {
    std::array<mpq_class, 3> alpha, beta, product, weighted;
    mpq_class denominator;
    for (size_t i = 0; i < 3; ++i) {
        const PartialVertex& a = v[(i + 1) % 3];
        const PartialVertex& b = v[(i + 2) % 3];
        alpha[i] = a.y - b.y;  // eq. 2
        beta[i] = b.x - a.x;
        const mpq_class gamma = a.x * b.y - b.x * a.y;
        product[i] = a.w * b.w;
        weighted[i] = product[i] * (alpha[i] * x + beta[i] * y + gamma);
        denominator += weighted[i];
    }
    if (sgn(denominator) == 0) {
        return std::nullopt;
    }
    Partials out;
    for (size_t i = 0; i < 3; ++i) {
        out.u += weighted[i] / denominator * v[i].u;  // eq. 5 and 6
    }
    for (size_t i = 0; i < 3; ++i) {
        const mpq_class difference = product[i] * (v[i].u - out.u) / denominator;
        out.dx += difference * alpha[i];
        out.dy += difference * beta[i];
        out.total += spacing * difference * (alpha[i] + beta[i]);
    }
    return out;
}

}  // namespace ref
