// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/color/blend_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ref/color/interval.hpp"

namespace ref::color {

using cases::BlendFactor;
using cases::BlendOp;
using cases::ComponentKind;

Interval held(const Component& component, const Interval& v) {
    static const mpq_class kNormal(0x1p-126);
    Interval out = component.either(v);
    if (component.kind() == ComponentKind::binary32) {
        out.low = out.low > 0 && out.low < kNormal ? mpq_class(0) : out.low;
        out.high = out.high < 0 && out.high > -kNormal ? mpq_class(0) : out.high;
    } else if (component.is_unsigned_float() && out.low < 0 && !Component::is_anything(out)) {
        out.high = std::max(out.high, mpq_class(0));
    }
    return out;
}

namespace {

// What of a pixel a factor names, and whether it is 1 minus that.
struct Named {
    BlendFactor of = BlendFactor::zero;
    bool is_complement = false;
};

// Nothing for the factor that no other one is 1 minus of. Of alpha (`k` is 3) colours are alphas.
std::optional<Named> named(BlendFactor factor, size_t k) {
    using enum BlendFactor;
    struct Row {
        BlendFactor plain, complement, alpha;
    };
    constexpr std::array<Row, 9> kRows = {
        {{one, zero, one},
         {src_color, one_minus_src_color, src_alpha},
         {dst_color, one_minus_dst_color, dst_alpha},
         {src_alpha, one_minus_src_alpha, src_alpha},
         {dst_alpha, one_minus_dst_alpha, dst_alpha},
         {constant_color, one_minus_constant_color, constant_alpha},
         {constant_alpha, one_minus_constant_alpha, constant_alpha},
         {src1_color, one_minus_src1_color, src1_alpha},
         {src1_alpha, one_minus_src1_alpha, src1_alpha}}};
    for (const Row& row : kRows) {
        if (factor == row.plain || factor == row.complement) {
            return Named{k == 3 ? row.alpha : row.plain, factor == row.complement};
        }
    }
    return std::nullopt;
}

}  // namespace

BlendFactor KnownFactors::operator()(BlendFactor factor, size_t k) const {
    using enum BlendFactor;
    const std::optional<Named> name = named(factor, k);
    if (name && ((is_source_alpha_one && name->of == src_alpha) ||
                 (is_target_alpha_one && name->of == dst_alpha))) {
        return name->is_complement ? zero : one;
    }
    return k == 3 && factor == src_alpha_saturate ? one : factor;
}

namespace {

// Whether the two products of an equation can be computed as one: with f twice, or f and 1 - f.
enum class Shared : uint8_t { nothing, factor, complement };

Shared shared_by(const cases::BlendEquation& equation, size_t k, const KnownFactors& known) {
    const std::optional<Named> a = named(known(equation.source, k), k),
                               b = named(known(equation.destination, k), k);
    if (!a || !b || a->of != b->of) {
        return Shared::nothing;
    }
    // 1 twice leaves no product to save.
    const bool is_same = a->is_complement == b->is_complement;
    return is_same && a->of == BlendFactor::one ? Shared::nothing
           : is_same                            ? Shared::factor
                                                : Shared::complement;
}

// The equation with one product of a sum, of numbers s and d: f (s + d), d + f (s - d) or s + g (d
// - s), and the like. `round`: of each step.
template <class Round>
std::vector<Interval> with_one_product(Shared shared, BlendOp op, const mpq_class& s,
                                       const mpq_class& d, const Interval& f, const Interval& g,
                                       const Round& round) {
    const auto times = [&](const Interval& factor, const mpq_class& sum) {
        return round(product(factor, round(point(sum))));
    };
    const auto plus = [](const Interval& v, const mpq_class& b) {
        return Interval{v.low + b, v.high + b};
    };
    const mpq_class a = op == BlendOp::reverse_subtract ? mpq_class(-s) : s;
    const mpq_class b = op == BlendOp::subtract ? mpq_class(-d) : d;
    if (shared == Shared::factor) {
        return {times(f, a + b)};
    }
    return {plus(times(f, a - b), b), plus(times(g, b - a), a)};
}

// The unit of the last place of numbers of that magnitude, in the format.
mpq_class unit_of(const Component& component, const mpq_class& magnitude) {
    int exponent = 0;
    std::frexp(magnitude.get_d() * (1 + 0x1p-40), &exponent);  // magnitude < 2^exponent
    return mpq_class(component.least_step(std::ldexp(1.0, exponent - 1)));
}

// The largest magnitude in an interval.
mpq_class most_of(const Interval& v) {
    return std::max<mpq_class>(abs(v.low), abs(v.high));
}

}  // namespace

std::optional<Interval> reordered(const Component& component, const cases::BlendEquation& equation,
                                  size_t k, const KnownFactors& known, const Interval& source,
                                  const Interval& destination, const Interval& f,
                                  const Interval& g) {
    const Shared shared = shared_by(equation, k, known);
    if (shared == Shared::nothing) {
        return std::nullopt;
    }
    // f s - f d and f s + (1 - f) d have s - d for a sum, the others s + d.
    const bool is_difference = (equation.op == BlendOp::add) == (shared == Shared::complement);
    mpq_class most_sum = 0, least_sum = -1;
    for (const mpq_class& s : {source.low, source.high}) {
        for (const mpq_class& d : {destination.low, destination.high}) {
            const mpq_class sum = abs(is_difference ? mpq_class(s - d) : mpq_class(s + d));
            most_sum = std::max(most_sum, sum);
            least_sum = least_sum < 0 ? sum : std::min(least_sum, sum);
        }
    }
    if (component.may_be_infinite(point(most_sum))) {
        return component.may_be_infinite(point(least_sum)) ? std::nullopt
                                                           : std::optional(Component::anything());
    }
    std::optional<Interval> all;
    const auto gather = [&](const auto& round) {
        for (const mpq_class& s : {source.low, source.high}) {
            for (const mpq_class& d : {destination.low, destination.high}) {
                for (const Interval& one :
                     with_one_product(shared, equation.op, s, d, f, g, round)) {
                    all = all ? hull(*all, one) : one;
                }
            }
        }
    };
    if (source.low == source.high && destination.low == destination.high) {
        gather([&](const Interval& v) { return held(component, v); });
        return all;
    }
    gather([](const Interval& v) { return v; });
    const mpq_class most_factor = std::max<mpq_class>(most_of(f), most_of(g));
    const mpq_class sum_unit = unit_of(component, most_sum);
    mpq_class lost =
        most_factor * sum_unit + unit_of(component, most_factor * (most_sum + sum_unit));
    if (component.kind() == ComponentKind::binary32) {
        lost += (most_factor + 1) * mpq_class(0x1p-126);
    }
    return Interval{all->low - lost, all->high + lost};
}

}  // namespace ref::color
