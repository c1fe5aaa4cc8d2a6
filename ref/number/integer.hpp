// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Rounds rationals to whole numbers.
#pragma once

#include <gmpxx.h>

namespace ref {

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

}  // namespace ref
