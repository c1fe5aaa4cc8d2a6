// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// One component of a colour format: the grid of its values, and what may be stored of a value that
// the shader wrote, as intervals of exact rationals.
//
// Conversion (Vulkan specification, "Conversion from Floating-Point to Normalized Fixed-Point";
// docs/rules.md): the value is clamped to [0, 1], r = f (2^b - 1), and one of the two integers
// nearest to r is stored; a whole r is stored as it is. Trap: k/255 rounded to binary32 is not
// k/255, so its r is no integer and k + 1 may be stored. Direct3D ("FLOAT -> UNORM") allows 0.6 of
// a unit. SNORM: the same between -1 and 1 with 2^(b-1) - 1, in two's complement; the code
// -2^(b-1), which no number is stored as, is read as -1 ("Conversion From Normalized Fixed-Point to
// Floating-Point"). Halves: either neighbour, and beyond the largest one that one or infinity
// ("Floating-Point Format Conversions": finite values of a larger magnitude "may be rounded either
// to the closest representable finite value or to the appropriately signed infinity"); "for
// unsigned destination formats", those of 11 and 10 bits, "any negative values are converted to
// zero". binary32 and integers: the value itself.
#pragma once

#include <gmpxx.h>

#include <cstdint>
#include <string>

#include "cases/format/color_format.hpp"
#include "cases/model/profile.hpp"

namespace ref::color {

// Closed interval of values.
struct Interval {
    mpq_class low, high;
    friend bool operator==(const Interval&, const Interval&) = default;
};
Interval point(const mpq_class& value);

// One component of a format: its grid of values.
class Component {
  public:
    // Nothing is known of what is stored, which may be NaN.
    static Interval anything();
    static bool is_anything(const Interval& v);
    // Whether a value of the interval may be an infinity in the format.
    bool may_be_infinite(const Interval& v) const;
    Component(cases::ComponentFormat format) : format_(format) {}
    bool exists() const { return format_.bits != 0; }
    cases::ComponentKind kind() const { return format_.kind; }
    uint32_t bits() const { return format_.bits; }
    bool is_fixed_point() const;
    bool is_unsigned_float() const;
    // What a store or the blend unit first makes of a value: [0, 1] cut out of it, or [-1, 1] if
    // the format is of fixed point, nothing below 0 if it is an unsigned float; else the value
    // itself.
    Interval clamped(const Interval& v) const;
    // Floating point: the spacing of the format's numbers from a power of two on; of a magnitude
    // that is none, at least the spacing around it.
    double least_step(double magnitude) const;

    // The neighbours in the format: the largest value that is <= x, the smallest that is >= x.
    // Beyond the largest finite one, that one and x itself, which stands for infinity.
    mpq_class down(const mpq_class& x) const { return neighbour(x, false); }
    mpq_class up(const mpq_class& x) const { return neighbour(x, true); }
    // Either neighbour of every value.
    Interval either(const Interval& v) const { return {down(v.low), up(v.high)}; }

    // What may be stored of a value. `is_blended`: it comes out of the blend unit, which rounds by
    // itself.
    Interval stored(const Interval& v, cases::Profile profile, bool is_blended) const;
    // Whether a code means a value of an interval that stored() returned. An infinity does if its
    // end lies beyond the largest finite number.
    bool allows(uint32_t code, const Interval& stored) const;
    // Whether a transfer (a blit) may leave the code of some value of v: either neighbour, as
    // Vulkan has it (Direct3D's 0.6 of a unit is a rule of its shaders' stores; it has no blit).
    // Integers beyond the largest become that one.
    bool may_convert(const Interval& v, uint32_t code) const;

    // The whole number that a code is, in two's complement if its kind has a sign.
    double whole_of(uint32_t code) const {
        return is_signed(format_.kind) ? cases::signed_code(code, format_.bits)
                                       : static_cast<double>(code);
    }
    // The value that a stored code means; nothing if the code is no number (NaN, infinity).
    // sRGB: rounded to binary64, see kSrgbError. SNORM: of the lowest code a number below -1.
    bool value_of(uint32_t code, mpq_class& value) const;
    // The same in binary64: exact for integers and floating point, NaN and
    // infinity as they are; UNORM and SNORM rounded once; sRGB the number that value_of() has.
    double number(uint32_t code) const;
    // What a device may read where the code (of a number) is stored: its value. An sRGB code may be
    // decoded as far off as half a code more or less would be, but 0 and 1 exactly: so Direct3D
    // 3.2.3.7. Vulkan names no bound, but its formula has 0 and 1 for these codes. Both ends are
    // moved outwards by 2^-40, far more than binary64 loses.
    Interval read(uint32_t code) const;
    // The code nearest to a value, of two the upper; of values beyond the format's its end.
    uint32_t code_of(const mpq_class& value) const;
    // The unit of the last place at 1: 1 / (2^bits - 1) of UNORM and sRGB, 1 / (2^(bits - 1) - 1)
    // of SNORM, 0 of others.
    mpq_class step() const;
    // A range of codes as text: "127", "127 to 128", "0x3f800000 (1)".
    std::string text_of(const Interval& v) const;

  private:
    mpq_class neighbour(const mpq_class& x, bool upwards) const;
    const mpz_class& units() const;  // 2^bits - 1, of signed ones 2^(bits - 1) - 1
    uint32_t code_of_whole(const mpz_class& whole) const;  // in two's complement
    cases::ComponentFormat format_;
};

// Decoded sRGB codes are irrational: they are kept in binary64, off by less than this.
inline constexpr double kSrgbError = 0x1p-48;

}  // namespace ref::color
