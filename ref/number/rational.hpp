// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes rationals of other numbers, and rounds them to whole ones.
#pragma once

#include <gmpxx.h>

namespace ref {

// Gives the value of a finite binary32.
inline mpq_class rational(float f) {
    return mpq_class(static_cast<double>(f));
}

inline mpq_class power_of_two(long exponent) {
    mpq_class out(1);
    if (exponent >= 0) {
        mpq_mul_2exp(out.get_mpq_t(), out.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
    } else {
        mpq_div_2exp(out.get_mpq_t(), out.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
    }
    return out;
}

// The largest whole number that is <= x.
inline mpz_class floor_of(const mpq_class& x) {
    mpz_class out;
    mpz_fdiv_q(out.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
    return out;
}

// The smallest whole number that is >= x.
inline mpz_class ceil_of(const mpq_class& x) {
    mpz_class out;
    mpz_cdiv_q(out.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
    return out;
}

// a / b, in lowest terms.
inline mpq_class fraction(const mpz_class& a, const mpz_class& b) {
    mpq_class out(a, b);
    out.canonicalize();
    return out;
}

}  // namespace ref
