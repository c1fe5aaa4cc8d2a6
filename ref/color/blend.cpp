// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/color/blend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "cases/base/number_text.hpp"
#include "ref/color/logic.hpp"

namespace ref::color {

namespace {

using cases::BlendFactor;
using cases::BlendOp;
using cases::ComponentKind;

Interval complement(const Interval& v) {
    return {1 - v.high, 1 - v.low};
}

Interval product(const Interval& a, const Interval& b) {
    const std::array<mpq_class, 4> ends = {a.low * b.low, a.low * b.high, a.high * b.low,
                                           a.high * b.high};
    return {*std::min_element(ends.begin(), ends.end()),
            *std::max_element(ends.begin(), ends.end())};
}

Interval smaller(const Interval& a, const Interval& b) {
    return {std::min(a.low, b.low), std::min(a.high, b.high)};
}

Interval larger(const Interval& a, const Interval& b) {
    return {std::max(a.low, b.low), std::max(a.high, b.high)};
}

Interval negated(const Interval& v) {
    return {-v.high, -v.low};
}

Interval hull(const Interval& a, const Interval& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

// What the unit may hold of a value: either neighbour, and 0 for a denormal number of binary32,
// since nothing is said of the numbers that it works with ("Floating-Point Computation"). NVIDIA's
// takes such sources for 0.
Interval held(const Component& component, const Interval& v) {
    static const mpq_class kNormal(0x1p-126);
    Interval out = component.either(v);
    if (component.kind() == ComponentKind::binary32) {
        out.low = out.low > 0 && out.low < kNormal ? mpq_class(0) : out.low;
        out.high = out.high < 0 && out.high > -kNormal ? mpq_class(0) : out.high;
    }
    return out;
}

// A term of the sum: either neighbour of a product. Infinity times 0 is NaN, and times any other
// factor no multiple of the number that stands for it, so that nothing is known of either.
Interval term(const Component& component, const Interval& value, const Interval& factor) {
    return component.may_be_infinite(value) || component.may_be_infinite(factor)
               ? Component::anything()
               : held(component, product(value, factor));
}

// The difference of two infinities is NaN; one of them stays what it is, whatever is added.
Interval sum(const Component& component, const Interval& a, const Interval& b) {
    const bool is_a_infinite = component.may_be_infinite(a);
    const bool is_b_infinite = component.may_be_infinite(b);
    if (Component::is_anything(a) || Component::is_anything(b) ||
        (is_a_infinite && is_b_infinite)) {
        return Component::anything();
    }
    const Interval total = {a.low + b.low, a.high + b.high};
    return is_a_infinite ? hull(total, a) : is_b_infinite ? hull(total, b) : total;
}

// Table "Blend Factors". `k`: the component, 3 alpha.
Interval factor_of(BlendFactor factor, size_t k, const Color& source, const Color& second,
                   const Color& destination, const Color& constants) {
    switch (factor) {
        case BlendFactor::zero:
            return point(0);
        case BlendFactor::one:
            return point(1);
        case BlendFactor::src_color:
            return source[k];
        case BlendFactor::one_minus_src_color:
            return complement(source[k]);
        case BlendFactor::dst_color:
            return destination[k];
        case BlendFactor::one_minus_dst_color:
            return complement(destination[k]);
        case BlendFactor::src_alpha:
            return source[3];
        case BlendFactor::one_minus_src_alpha:
            return complement(source[3]);
        case BlendFactor::dst_alpha:
            return destination[3];
        case BlendFactor::one_minus_dst_alpha:
            return complement(destination[3]);
        case BlendFactor::constant_color:
            return constants[k];
        case BlendFactor::one_minus_constant_color:
            return complement(constants[k]);
        case BlendFactor::constant_alpha:
            return constants[3];
        case BlendFactor::one_minus_constant_alpha:
            return complement(constants[3]);
        case BlendFactor::src1_color:
            return second[k];
        case BlendFactor::one_minus_src1_color:
            return complement(second[k]);
        case BlendFactor::src1_alpha:
            return second[3];
        case BlendFactor::one_minus_src1_alpha:
            return complement(second[3]);
        case BlendFactor::src_alpha_saturate:
            break;
    }
    return k == 3 ? point(1) : smaller(source[3], complement(destination[3]));
}

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

// Whether the two products of an equation can be computed as one: with f twice, or f and 1 - f.
enum class Shared : uint8_t { nothing, factor, complement };

// What state makes 1 of a factor, or 0, so that a device may take it for that: the alpha of a
// target without one and of a source that alpha to one replaces, and the saturated alpha of an
// alpha.
struct KnownFactors {
    bool is_source_alpha_one = false, is_target_alpha_one = false;

    BlendFactor operator()(BlendFactor factor, size_t k) const {
        using enum BlendFactor;
        const std::optional<Named> name = named(factor, k);
        if (name && ((is_source_alpha_one && name->of == src_alpha) ||
                     (is_target_alpha_one && name->of == dst_alpha))) {
            return name->is_complement ? zero : one;
        }
        return k == 3 && factor == src_alpha_saturate ? one : factor;
    }
};

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

// The unit of the last place of numbers of that magnitude, in binary16 or binary32.
mpq_class unit_of(const Component& component, const mpq_class& magnitude) {
    const bool is_half = component.kind() == ComponentKind::half;
    int exponent = 0;
    std::frexp(magnitude.get_d() * (1 + 0x1p-40), &exponent);  // magnitude < 2^exponent
    const int least = is_half ? -24 : -149;
    return mpq_class(std::ldexp(1.0, std::max(exponent - (is_half ? 11 : 24), least)));
}

// The largest magnitude in an interval.
mpq_class most_of(const Interval& v) {
    return std::max<mpq_class>(abs(v.low), abs(v.high));
}

// What an equation may give if it is computed with one product; f and g are its factors. Of numbers
// s and d each step is either neighbour. Of intervals the exact result is least and greatest at
// ends, since it is of degree 1 in each variable, and rounding moves it by the sum's unit, times
// the factor, and the product's; a denormal number of binary32 may be taken for 0. Nothing where
// the sum overflows: the dynamic range is to be that of the target or more.
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

// What a device may read of a component of the target; what it may hold is codes.
Interval read(const Component& component, const Interval& before) {
    if (component.kind() != ComponentKind::srgb) {
        return held(component, before);
    }
    return {component.read(component.code_of(before.low)).low,
            component.read(component.code_of(before.high)).high};
}

bool is_exactly(const Interval& v, int number) {
    return v.low == number && v.high == number;
}

}  // namespace

bool replaces_alpha(const cases::ColorOutput& output, cases::ColorFormat format) {
    return output.alpha_to_one && !cases::is_integer(format);
}

Color Unit::cleared(const cases::ColorTarget& target) const {
    Color out;
    for (uint32_t k = 0; k < 4; ++k) {
        const Component component(cases::component_of(format, k));
        out[k] =
            component.exists()
                ? component.stored(point(static_cast<double>(target.clear[static_cast<int>(k)])),
                                   profile, false)
                : point(k == 3 ? 1 : 0);
    }
    return out;
}

Color Unit::write(const cases::ColorOutput& output, const Color& written,
                  const Color& before) const {
    Color source = written;
    if (replaces_alpha(output, format)) {
        source[3] = point(1);
    }
    Color out = before;
    if (!output.blend || output.logic) {
        for (uint32_t k = 0; k < 4; ++k) {
            const Component component(cases::component_of(format, k));
            if (component.exists() && (output.write_mask >> k & 1U) != 0) {
                out[k] = component.stored(source[k], profile, false);
                if (output.logic && takes_logic(format)) {
                    out[k] = operated(*output.logic, component, out[k], before[k]);
                }
            }
        }
        return out;
    }
    // Alpha of the source takes part even where the target has none; then it is not rounded.
    const Component first(cases::component_of(format, 0));
    Color s = source;
    Color second, constants, d;
    const KnownFactors known{replaces_alpha(output, format),
                             !Component(cases::component_of(format, 3)).exists()};
    for (uint32_t k = 0; k < 4; ++k) {
        second[k] = point(static_cast<double>(output.blend->second[static_cast<int>(k)]));
        constants[k] = point(static_cast<double>(output.blend->constants[static_cast<int>(k)]));
        const Component component(cases::component_of(format, k));
        const Component& grid = component.exists() ? component : first;
        if (first.is_fixed_point()) {
            s[k] = clamped(s[k]);
            second[k] = clamped(second[k]);
            constants[k] = clamped(constants[k]);
        }
        s[k] = held(grid, s[k]);
        second[k] = held(grid, second[k]);
        constants[k] = held(grid, constants[k]);
        d[k] = component.exists() ? read(component, before[k]) : held(grid, before[k]);
    }
    for (uint32_t k = 0; k < 4; ++k) {
        const Component component(cases::component_of(format, k));
        if (!component.exists() || (output.write_mask >> k & 1U) == 0) {
            continue;
        }
        const cases::BlendEquation& equation = k == 3 ? output.blend->alpha : output.blend->color;
        // What goes through unchanged stays the code it is, however it is decoded.
        const Interval& stored = component.kind() == ComponentKind::srgb ? before[k] : d[k];
        Interval result;
        const bool is_extreme = equation.op == BlendOp::min || equation.op == BlendOp::max;
        if (is_extreme && Component::is_anything(s[k])) {
            result = Component::anything();  // NaN is neither
        } else if (is_extreme) {             // factors are ignored
            const auto extreme = equation.op == BlendOp::min ? smaller : larger;
            result = extreme(s[k], stored);
            // What is decoded otherwise may be the larger one of two that are near.
            if (s[k].low <= d[k].high && d[k].low <= s[k].high) {
                result = hull(result, extreme(s[k], d[k]));
            }
        } else {
            const auto factor = [&](BlendFactor of) {
                return held(component, factor_of(of, k, s, second, d, constants));
            };
            const Interval f = factor(equation.source), g = factor(equation.destination);
            const Interval a = term(component, s[k], f);
            const bool is_read = component.kind() == ComponentKind::srgb && is_exactly(g, 1);
            const Interval b = !is_read           ? term(component, d[k], g)
                               : is_exactly(a, 0) ? stored
                                                  : d[k];
            result = sum(component, equation.op == BlendOp::reverse_subtract ? negated(a) : a,
                         equation.op == BlendOp::subtract ? negated(b) : b);
            const bool is_finite = !Component::is_anything(result) &&
                                   !component.may_be_infinite(s[k]) &&
                                   !component.may_be_infinite(d[k]) &&
                                   !component.may_be_infinite(f) && !component.may_be_infinite(g);
            if (!component.is_fixed_point() && is_finite) {
                const auto other = reordered(component, equation, k, known, s[k], d[k], f, g);
                result = !other                           ? result
                         : Component::is_anything(*other) ? *other
                                                          : hull(result, *other);
            }
        }
        out[k] = Component::is_anything(before[k]) || Component::is_anything(result)
                     ? Component::anything()
                     : held(component, component.stored(result, profile, true));
    }
    return out;
}

std::array<uint32_t, 4> Unit::codes_of(const Color& color) const {
    std::array<uint32_t, 4> out{};
    for (uint32_t k = 0; k < 4; ++k) {
        const Component component(cases::component_of(format, k));
        if (component.exists()) {
            out[k] = component.code_of((color[k].low + color[k].high) / 2);
        }
    }
    return out;
}

bool Unit::allows(const Color& color, const std::array<uint32_t, 4>& codes) const {
    for (uint32_t k = 0; k < 4; ++k) {
        const Component component(cases::component_of(format, k));
        if (component.exists() && !component.allows(codes[k], color[k])) {
            return false;
        }
    }
    return true;
}

std::string Unit::text_of(const Color& color) const {
    std::string out;
    for (uint32_t k = 0; k < 4; ++k) {
        const Component component(cases::component_of(format, k));
        if (component.exists()) {
            out += fmt::format("{}{} {}", out.empty() ? "" : ", ", "rgba"[k],
                               component.text_of(color[k]));
        }
    }
    return out;
}

std::string Unit::text_of(const std::array<uint32_t, 4>& codes) const {
    std::string out;
    for (uint32_t k = 0; k < 4; ++k) {
        const cases::ComponentFormat c = cases::component_of(format, k);
        if (c.bits == 0) {
            continue;
        }
        out += fmt::format("{}{} ", out.empty() ? "" : ", ", "rgba"[k]);
        const double value = Component(c).number(codes[k]);
        if (!is_floating(c.kind)) {
            out += std::to_string(codes[k]);
        } else {
            out += fmt::format("{} (0x{:0{}x})", cases::number_text(value), codes[k], c.bits / 4);
        }
    }
    return out;
}

}  // namespace ref::color
