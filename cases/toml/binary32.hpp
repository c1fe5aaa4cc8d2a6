// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts between exact rationals and binary32 (IEEE 754 single precision).
#pragma once

#include <gmpxx.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cases {

// A number as a file writes it: an exact rational, plus the sign that a rational zero cannot carry.
struct Number {
    mpq_class value;
    bool negative_zero = false;  // only if value == 0
    // The bits of a NaN or an infinity, which no rational can be; value is 0 then.
    std::optional<uint32_t> non_finite = {};
};

// The binary32 with these bits.
Number number_of_bits(uint32_t bits);
// Reads what no expression can write: "nan", "-nan", "inf", "-inf" and "bits(0x7fc00001)" with
// eight hexadecimal digits. Returns nothing for any other text.
std::optional<Number> read_special_number(std::string_view text);

struct Rounded {
    float value = 0;     // infinite if the rational is too large
    bool exact = false;  // value is the rational itself
};

// The nearest binary32, ties to even, subnormals included; correct for every rational.
Rounded round_to_binary32(const mpq_class& q);
// Does the same for q != 0 by rationals alone. round_to_binary32 uses it where 128 bits are too
// few.
Rounded round_wide(const mpq_class& q);
// As round_to_binary32, with the sign of a zero kept.
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
