// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Exact rationals and binary32 (IEEE 754 single precision).
#pragma once

#include <gmpxx.h>

#include <string>

namespace cases {

// A number as a file writes it: an exact rational, plus the sign that a rational zero cannot carry.
struct Number {
    mpq_class value;
    bool negative_zero = false;  // only if value == 0
};

struct Rounded {
    float value = 0;     // infinite if the rational is too large
    bool exact = false;  // value is the rational itself
};

// The nearest binary32, ties to even, subnormals included; correct for every rational.
Rounded round_to_binary32(const mpq_class& q);
// As above, with the sign of a zero kept.
Rounded round_to_binary32(const Number& n);

// The largest binary32 below and the smallest above a rational that is no binary32 itself.
struct Neighbours {
    float below = 0, above = 0;
};
Neighbours neighbours(const mpq_class& q);

// The exact value of a finite float or double.
mpq_class exact(double value);

// The shortest text that reads back as the same binary32 (as case files write it).
std::string shortest(float value);

}  // namespace cases
