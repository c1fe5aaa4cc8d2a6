// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The two number types that every formula of the value reference is written for: mpq_class (exact)
// and Ball (binary64 with a bound on its own error). What a Ball decides is proven; what it cannot
// decide is computed again in mpq_class.
#pragma once

#include <gmpxx.h>

#include <cmath>
#include <cstdint>

namespace ref::value {

// Compilers leave small functions of two doubles out of line where a template has hundreds of them,
// and then pass them through memory.
#if defined(__GNUC__)
#define EDGECASE_BALL_INLINE [[gnu::always_inline]] inline
#else
#define EDGECASE_BALL_INLINE inline
#endif

// binary64 midpoint v and a rigorous bound e on |v - exact value|. Every operation adds its own
// rounding (half an ulp, at most |v| 2^-53, or 2^-1074 below the normal range) and inflates the
// bound by 2^-50, which pays for the rounding of the bound itself (at most 8 operations each).
// An overflow makes e infinite or NaN; then nothing is decided.
struct Ball {
    double v = 0, e = 0;

    Ball() = default;
    Ball(double value) : v(value) {}  // exact; implicit, as for mpq_class
    Ball(double value, double error) : v(value), e(error) {}
};

namespace ball {
inline constexpr double kHalfUlp = 0x1p-53;
inline constexpr double kInflate = 1.0 + 0x1p-50;
inline constexpr double kTiny = 0x1p-1000;  // covers gradual underflow of value and bound
EDGECASE_BALL_INLINE Ball rounded(double v, double e) {
    return {v, (e + std::fabs(v) * kHalfUlp + kTiny) * kInflate};
}
}  // namespace ball

EDGECASE_BALL_INLINE Ball operator+(const Ball& a, const Ball& b) {
    return ball::rounded(a.v + b.v, a.e + b.e);
}
EDGECASE_BALL_INLINE Ball operator-(const Ball& a, const Ball& b) {
    return ball::rounded(a.v - b.v, a.e + b.e);
}
EDGECASE_BALL_INLINE Ball operator-(const Ball& a) {
    return {-a.v, a.e};
}
EDGECASE_BALL_INLINE Ball operator*(const Ball& a, const Ball& b) {
    return ball::rounded(a.v * b.v, std::fabs(a.v) * b.e + std::fabs(b.v) * a.e + a.e * b.e);
}
// |a/b - va/vb| <= (ea + |va/vb| eb) / (|vb| - eb), if 0 is not in b; otherwise the bound is
// infinite.
EDGECASE_BALL_INLINE Ball operator/(const Ball& a, const Ball& b) {
    const double q = a.v / b.v;
    const double room = (std::fabs(b.v) - b.e) * (1.0 - 0x1p-50);
    if (!(room > 0)) {
        return {0, HUGE_VAL};
    }
    return ball::rounded(
        q, (a.e + (std::fabs(q) + ball::kTiny) * b.e) / room + std::fabs(q) * 0x1p-52);
}
EDGECASE_BALL_INLINE Ball magnitude(const Ball& a) {
    return {std::fabs(a.v), a.e};
}
// The one that is larger for sure, with its own bound: what is clamped to an exact number is that
// number. Of two that may be equal, the larger of the midpoints is off the larger exact value by at
// most the larger bound.
EDGECASE_BALL_INLINE Ball larger(const Ball& a, const Ball& b) {
    const Ball d = b - a;
    if (d.v > d.e || d.v < -d.e) {
        return d.v > 0 ? b : a;
    }
    return {a.v < b.v ? b.v : a.v, a.e < b.e ? b.e : a.e};
}
EDGECASE_BALL_INLINE Ball smaller(const Ball& a, const Ball& b) {
    const Ball d = b - a;
    if (d.v > d.e || d.v < -d.e) {
        return d.v > 0 ? a : b;
    }
    return {a.v < b.v ? a.v : b.v, a.e < b.e ? b.e : a.e};
}

inline mpq_class magnitude(const mpq_class& a) {
    return abs(a);
}
inline mpq_class larger(const mpq_class& a, const mpq_class& b) {
    return a < b ? b : a;
}
inline mpq_class smaller(const mpq_class& a, const mpq_class& b) {
    return a < b ? a : b;
}

enum class Answer : uint8_t { no, yes, unknown };

inline Answer both(Answer a, Answer b) {
    return a == Answer::no || b == Answer::no     ? Answer::no
           : a == Answer::yes && b == Answer::yes ? Answer::yes
                                                  : Answer::unknown;
}

inline Answer either(Answer a, Answer b) {
    return a == Answer::yes || b == Answer::yes ? Answer::yes
           : a == Answer::no && b == Answer::no ? Answer::no
                                                : Answer::unknown;
}

// Whether a <= b.
inline Answer is_at_most(const mpq_class& a, const mpq_class& b) {
    return a <= b ? Answer::yes : Answer::no;
}
inline Answer is_at_most(const Ball& a, const Ball& b) {
    if (a.e <= 0 && b.e <= 0) {
        return a.v <= b.v ? Answer::yes : Answer::no;  // both are exact
    }
    const Ball d = b - a;
    return d.v >= d.e ? Answer::yes : d.v < -d.e ? Answer::no : Answer::unknown;
}
// Whether a > 0.
inline Answer is_positive(const mpq_class& a) {
    return sgn(a) > 0 ? Answer::yes : Answer::no;
}
inline Answer is_positive(const Ball& a) {
    return a.v > a.e                              ? Answer::yes
           : a.v < -a.e || (a.v <= 0 && a.e <= 0) ? Answer::no
                                                  : Answer::unknown;
}
// -1, 0, 1, or 2 if unknown.
inline int sign_of(const mpq_class& a) {
    return sgn(a);
}
inline int sign_of(const Ball& a) {
    return a.v > a.e ? 1 : a.v < -a.e ? -1 : a.v <= 0 && a.v >= 0 && a.e <= 0 ? 0 : 2;
}

// An exact number as T. get_d truncates: its error is below one ulp, 2^-52 |v|.
template <class T>
T from_exact(const mpq_class& a);
template <>
inline mpq_class from_exact<mpq_class>(const mpq_class& a) {
    return a;
}
template <>
inline Ball from_exact<Ball>(const mpq_class& a) {
    const double v = a.get_d();
    return {v, sgn(a) == 0 ? 0.0 : std::fabs(v) * 0x1p-51 + ball::kTiny};
}

// The nearest Ball to an exact number, without an error where binary64 has the number.
inline Ball tight_ball(const mpq_class& a) {
    const double v = a.get_d();
    return std::isfinite(v) && mpq_class(v) == a ? Ball(v) : from_exact<Ball>(a);
}

// Gives the value of a finite binary32 as T, exactly.
template <class T>
T from_float(float f) {
    return T(static_cast<double>(f));
}

inline double nearest_double(const mpq_class& a) {
    return a.get_d();
}
inline double nearest_double(const Ball& a) {
    return a.v;
}

#undef EDGECASE_BALL_INLINE

}  // namespace ref::value
