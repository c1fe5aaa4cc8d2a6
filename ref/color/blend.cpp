// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/color/blend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/base/number_text.hpp"
#include "ref/color/blend_order.hpp"
#include "ref/color/interval.hpp"
#include "ref/color/logic.hpp"

namespace ref::color {

namespace {

using cases::BlendFactor;
using cases::BlendOp;
using cases::ComponentKind;

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
    using enum BlendFactor;
    struct Pair {
        BlendFactor itself, complement;
        const Interval& value;
    };
    const std::array<Pair, 8> pairs = {{{src_color, one_minus_src_color, source[k]},
                                        {dst_color, one_minus_dst_color, destination[k]},
                                        {src_alpha, one_minus_src_alpha, source[3]},
                                        {dst_alpha, one_minus_dst_alpha, destination[3]},
                                        {constant_color, one_minus_constant_color, constants[k]},
                                        {constant_alpha, one_minus_constant_alpha, constants[3]},
                                        {src1_color, one_minus_src1_color, second[k]},
                                        {src1_alpha, one_minus_src1_alpha, second[3]}}};
    for (const Pair& pair : pairs) {
        if (factor == pair.itself) {
            return pair.value;
        }
        if (factor == pair.complement) {
            return complement(pair.value);
        }
    }
    if (factor == src_alpha_saturate) {
        return k == 3 ? point(1) : smaller(source[3], complement(destination[3]));
    }
    return point(factor == one ? 1 : 0);
}

// What a device may read of a component of the target; what it may hold is codes.
Interval read(const Component& component, const Interval& before) {
    if (component.kind() != ComponentKind::srgb) {
        return held(component, component.clamped(before));
    }
    return {component.read(component.code_of(before.low)).low,
            component.read(component.code_of(before.high)).high};
}

bool is_exactly(const Interval& v, int number) {
    return v.low == number && v.high == number;
}

// What the blend unit computes with.
struct BlendInputs {
    Color s, second, d, constants;  // source, second source, target, constants
    KnownFactors known;

    // Component k of the result; `before`: what the target may hold of it.
    Interval blended(const Component& component, const cases::Blend& blend, uint32_t k,
                     const Interval& before) const;
};

Interval BlendInputs::blended(const Component& component, const cases::Blend& blend, uint32_t k,
                              const Interval& before) const {
    const cases::BlendEquation& equation = k == 3 ? blend.alpha : blend.color;
    // What goes through unchanged stays the code it is, however it is decoded.
    const Interval& stored = component.kind() == ComponentKind::srgb ? before : d[k];
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
            const Interval value = factor_of(of, k, s, second, d, constants);
            return held(component, component.is_fixed_point() ? component.clamped(value) : value);
        };
        const Interval f = factor(equation.source), g = factor(equation.destination);
        const Interval a = term(component, s[k], f);
        const bool is_read = component.kind() == ComponentKind::srgb && is_exactly(g, 1);
        const Interval b = !is_read ? term(component, d[k], g) : is_exactly(a, 0) ? stored : d[k];
        result = sum(component, equation.op == BlendOp::reverse_subtract ? negated(a) : a,
                     equation.op == BlendOp::subtract ? negated(b) : b);
        const bool is_finite = !Component::is_anything(result) &&
                               !component.may_be_infinite(s[k]) &&
                               !component.may_be_infinite(d[k]) && !component.may_be_infinite(f) &&
                               !component.may_be_infinite(g);
        if (!component.is_fixed_point() && is_finite) {
            const auto other = reordered(component, equation, k, known, s[k], d[k], f, g);
            result = !other                           ? result
                     : Component::is_anything(*other) ? *other
                                                      : hull(result, *other);
        }
    }
    return result;
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
            target.load == cases::LoadOp::dont_care && component.exists() ? Component::anything()
            : component.exists()
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
    BlendInputs inputs{
        source,
        {},
        {},
        {},
        {replaces_alpha(output, format), !Component(cases::component_of(format, 3)).exists()}};
    auto& [s, second, d, constants, known] = inputs;
    for (uint32_t k = 0; k < 4; ++k) {
        second[k] = point(static_cast<double>(output.blend->second[static_cast<int>(k)]));
        constants[k] = point(static_cast<double>(output.blend->constants[static_cast<int>(k)]));
        const Component component(cases::component_of(format, k));
        const Component& grid = component.exists() ? component : first;
        if (first.is_fixed_point()) {
            s[k] = first.clamped(s[k]);
            second[k] = first.clamped(second[k]);
            constants[k] = first.clamped(constants[k]);
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
        const Interval result = inputs.blended(component, *output.blend, k, before[k]);
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

bool Unit::may_overflow(const Color& color) const {
    constexpr int kLargest = 65504;  // of binary16
    return std::ranges::any_of(std::array{0U, 1U, 2U, 3U}, [&](uint32_t k) {
        const mpq_class low = abs(color[k].low), high = abs(color[k].high);
        return Component(cases::component_of(format, k)).exists() &&
               !Component::is_anything(color[k]) && sgn(color[k].low) * sgn(color[k].high) > 0 &&
               std::max(low, high) > kLargest && std::min(low, high) >= kLargest / 2;
    });
}

bool Unit::has_overflown(const std::array<uint32_t, 4>& codes) const {
    return std::ranges::any_of(std::array{0U, 1U, 2U, 3U}, [&](uint32_t k) {
        const cases::ComponentFormat c = cases::component_of(format, k);
        return c.bits != 0 && is_floating(c.kind) && !std::isfinite(Component(c).number(codes[k]));
    });
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
            out += fmt::format("{:.0f}", Component(c).whole_of(codes[k]));
        } else {
            out += fmt::format("{} (0x{:0{}x})", cases::number_text(value), codes[k],
                               (c.bits + 3) / 4);
        }
    }
    return out;
}

}  // namespace ref::color
