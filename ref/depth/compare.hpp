// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Three-valued comparison of depths that are known as ranges (Vulkan specification, "Depth Test"),
// in Balls or rationals; outcome.cpp uses it.
#pragma once

#include <cmath>
#include <optional>

#include "ref/depth/outcome.hpp"
#include "ref/number/ball.hpp"
#include "ref/number/rational.hpp"
#include "ref/value/accept/judge_candidates.hpp"

namespace ref::value {

using cases::CompareOp;

// A range of depths as they may take part in a comparison.
template <class T>
struct DepthRange {
    bool is_free = false;
    T low{}, high{};
};

// The floor of a number; nothing where the number's own error leaves it open.
inline std::optional<double> floor_of(const Ball& a) {
    const double low = std::floor(a.v - a.e);
    return low < std::floor(a.v + a.e) ? std::nullopt : std::optional(low);
}
inline std::optional<double> floor_of(const mpq_class& a) {
    return ref::floor_of(a).get_d();
}

// The range of what may stand for values of z: each itself, or either neighbour among the codes.
template <class T>
std::optional<DepthRange<T>> with_neighbours(const Range<T>& z, double steps) {
    if (steps <= 0) {
        return DepthRange<T>{false, z.low, z.high};
    }
    const std::optional<double> low = floor_of(T(z.low * T(steps)));
    const std::optional<double> minus_high = floor_of(T(-T(z.high * T(steps))));
    if (!low || !minus_high) {
        return std::nullopt;
    }
    return DepthRange<T>{false, smaller(T(T(*low) / T(steps)), z.low),
                         larger(T(T(-*minus_high) / T(steps)), z.high)};
}

// An outcome is three-valued, or nothing if T cannot tell.
using Outcome = std::optional<DepthOutcome>;

inline Outcome outcome_of(Answer always, Answer never) {
    if (always == Answer::yes) {
        return DepthOutcome::passes;
    }
    if (never == Answer::yes) {
        return DepthOutcome::fails;
    }
    if (always == Answer::unknown || never == Answer::unknown) {
        return std::nullopt;
    }
    return DepthOutcome::open;
}

inline DepthOutcome opposite(DepthOutcome o) {
    return o == DepthOutcome::passes  ? DepthOutcome::fails
           : o == DepthOutcome::fails ? DepthOutcome::passes
                                      : o;
}
inline Outcome opposite(const Outcome& o) {
    return o ? Outcome(opposite(*o)) : o;
}

// Whether a < b; strictly less is what is_at_most() denies the other way round.
template <class T>
Outcome is_less(const DepthRange<T>& a, const DepthRange<T>& b) {
    const auto negated = [](Answer answer) {
        return answer == Answer::yes ? Answer::no : answer == Answer::no ? Answer::yes : answer;
    };
    return outcome_of(negated(is_at_most(b.low, a.high)), is_at_most(b.high, a.low));
}

template <class T>
Outcome is_equal(const DepthRange<T>& a, const DepthRange<T>& b) {
    const Outcome less = is_less(a, b);
    const Outcome greater = is_less(b, a);
    if (less == DepthOutcome::passes || greater == DepthOutcome::passes) {
        return DepthOutcome::fails;
    }
    // Points that are equal: neither side reaches beyond the other.
    const Answer same = both(is_at_most(a.high, b.low), is_at_most(b.high, a.low));
    if (same == Answer::yes) {
        return DepthOutcome::passes;
    }
    if (same == Answer::unknown || !less || !greater) {
        return std::nullopt;
    }
    return DepthOutcome::open;
}

template <class T>
Outcome compare(CompareOp op, const DepthRange<T>& fragment, const DepthRange<T>& stored) {
    switch (op) {
        case CompareOp::never:
            return DepthOutcome::fails;
        case CompareOp::always:
            return DepthOutcome::passes;
        default:
            break;
    }
    if (fragment.is_free || stored.is_free) {
        return DepthOutcome::open;
    }
    switch (op) {
        case CompareOp::less:
            return is_less(fragment, stored);
        case CompareOp::greater_or_equal:
            return opposite(is_less(fragment, stored));
        case CompareOp::greater:
            return is_less(stored, fragment);
        case CompareOp::less_or_equal:
            return opposite(is_less(stored, fragment));
        case CompareOp::equal:
            return is_equal(fragment, stored);
        case CompareOp::not_equal:
            return opposite(is_equal(fragment, stored));
        default:
            return DepthOutcome::open;
    }
}

// Whether low <= stored <= high.
template <class T>
Outcome within(const DepthRange<T>& stored, const DepthRange<T>& low, const DepthRange<T>& high) {
    if (stored.is_free) {
        return DepthOutcome::open;
    }
    const Outcome is_below = is_less(stored, low);
    const Outcome is_above = is_less(high, stored);
    if (is_below == DepthOutcome::passes || is_above == DepthOutcome::passes) {
        return DepthOutcome::fails;
    }
    if (!is_below || !is_above) {
        return std::nullopt;
    }
    return *is_below == DepthOutcome::fails && *is_above == DepthOutcome::fails
               ? DepthOutcome::passes
               : DepthOutcome::open;
}

// The outcome if the sign of fragment - stored is known.
inline DepthOutcome compare_sign(CompareOp op, int sign) {
    const bool passes =
        op == CompareOp::always || (op == CompareOp::less && sign < 0) ||
        (op == CompareOp::less_or_equal && sign <= 0) || (op == CompareOp::equal && sign == 0) ||
        (op == CompareOp::not_equal && sign != 0) ||
        (op == CompareOp::greater_or_equal && sign >= 0) || (op == CompareOp::greater && sign > 0);
    return passes ? DepthOutcome::passes : DepthOutcome::fails;
}

}  // namespace ref::value
