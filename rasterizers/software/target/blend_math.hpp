// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The arithmetic of a blend unit, in binary32 and in 8-bit fixed point: factors and equations.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <type_traits>
#include <utility>

#include "cases/model/case.hpp"
#include "rasterizers/software/choice/device.hpp"

namespace software {

using cases::BlendFactor;
using cases::BlendOp;

// Numbers that a blend unit computes with. One is what 1.0 is.
struct FloatMath {
    using Value = float;
    static constexpr float kOne = 1.0F;
    bool fused;
    bool has_one_product;

    // s f + d g and the like: the first product may be kept in full.
    float add(float s, float f, float d, float g) const {
        return fused ? std::fma(s, f, d * g) : s * f + d * g;
    }
    float subtract(float s, float f, float d, float g) const {
        return fused ? std::fma(s, f, -(d * g)) : s * f - d * g;
    }
    float scale(float a, float b) const { return a * b; }
};

// Whether one factor is 1 minus the other by its name.
inline bool are_complements(BlendFactor a, BlendFactor b) {
    const auto is_of = [&](BlendFactor plain, BlendFactor complement) {
        return (a == plain && b == complement) || (b == plain && a == complement);
    };
    return is_of(BlendFactor::one, BlendFactor::zero) ||
           is_of(BlendFactor::src_color, BlendFactor::one_minus_src_color) ||
           is_of(BlendFactor::dst_color, BlendFactor::one_minus_dst_color) ||
           is_of(BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha) ||
           is_of(BlendFactor::dst_alpha, BlendFactor::one_minus_dst_alpha) ||
           is_of(BlendFactor::constant_color, BlendFactor::one_minus_constant_color) ||
           is_of(BlendFactor::constant_alpha, BlendFactor::one_minus_constant_alpha) ||
           is_of(BlendFactor::src1_color, BlendFactor::one_minus_src1_color) ||
           is_of(BlendFactor::src1_alpha, BlendFactor::one_minus_src1_alpha);
}

// The blend with one and zero by these names where state makes factors so: the alpha of a source
// that alpha to one replaces, and of a target that has none.
inline cases::Blend with_known_factors(cases::Blend blend, bool is_source_alpha_one,
                                       bool is_target_alpha_one) {
    const auto know = [&](BlendFactor& factor, bool is_alpha) {
        const bool is_source =
            factor == BlendFactor::src_alpha || (is_alpha && factor == BlendFactor::src_color);
        const bool is_less_source = factor == BlendFactor::one_minus_src_alpha ||
                                    (is_alpha && factor == BlendFactor::one_minus_src_color);
        if ((is_source && is_source_alpha_one) ||
            (factor == BlendFactor::dst_alpha && is_target_alpha_one) ||
            (factor == BlendFactor::src_alpha_saturate && is_alpha)) {
            factor = BlendFactor::one;
        } else if ((is_less_source && is_source_alpha_one) ||
                   (factor == BlendFactor::one_minus_dst_alpha && is_target_alpha_one)) {
            factor = BlendFactor::zero;
        }
    };
    for (cases::BlendEquation* equation : {&blend.color, &blend.alpha}) {
        know(equation->source, equation == &blend.alpha);
        know(equation->destination, equation == &blend.alpha);
    }
    return blend;
}

// Whether of two complements the first one is no complement by its name.
inline bool is_plain_first(BlendFactor first, BlendFactor second) {
    return first == BlendFactor::one || (first != BlendFactor::zero && first < second);
}

// s f + d g and the like with f + g = 1: whichever of them is the complement is not used.
inline float with_one_product(BlendOp op, float s, float f, float d, float g, bool is_by_source) {
    const float sum = op == BlendOp::add ? (is_by_source ? s - d : d - s) : s + d;
    if (op == BlendOp::add) {
        return is_by_source ? d + f * sum : s + g * sum;
    }
    const float less = is_by_source ? f * sum - d : s - g * sum;
    return op == BlendOp::subtract ? less : -less;
}

// 8 bits: every step is clamped to 0..255.
struct FixedMath {
    using Value = uint32_t;
    static constexpr uint32_t kOne = 255;
    FixedMultiply multiply;
    bool truncates;
    bool is_shift_only;  // a fault

    uint32_t scale(uint32_t a, uint32_t b) const {
        if (is_shift_only) {
            return a * b >> 8;
        }
        if (truncates) {
            return a * b / 255;
        }
        if (multiply == FixedMultiply::divide) {
            return (a * b + 127) / 255;
        }
        const uint32_t t = a * b + 128;
        return (t + (t >> 8)) >> 8;
    }
    uint32_t add(uint32_t s, uint32_t f, uint32_t d, uint32_t g) const {
        return std::min(scale(s, f) + scale(d, g), 255U);
    }
    uint32_t subtract(uint32_t s, uint32_t f, uint32_t d, uint32_t g) const {
        const uint32_t a = scale(s, f);
        const uint32_t b = scale(d, g);
        return a > b ? a - b : 0U;
    }
};

template <class Math>
struct Operands {
    using Value = typename Math::Value;
    std::array<Value, 4> source, second, destination, constants;
};

template <class Math>
typename Math::Value second_factor_of(BlendFactor factor, size_t k, const Operands<Math>& o,
                                      Fault fault) {
    const bool is_alpha =
        factor == BlendFactor::src1_alpha || factor == BlendFactor::one_minus_src1_alpha;
    const bool is_complement =
        factor == BlendFactor::one_minus_src1_color || factor == BlendFactor::one_minus_src1_alpha;
    const size_t from = is_alpha && fault != "second-alpha-as-color"_fault ? 3 : k;
    const auto value =
        fault == "second-lost"_fault ? 0
        : fault == "second-as-first"_fault || (fault == "second-alpha-as-first"_fault && is_alpha)
            ? o.source[from]
            : o.second[from];
    return is_complement && fault != "second-complement-forgotten"_fault ? Math::kOne - value
                                                                         : value;
}

template <class Math>
typename Math::Value factor_of(BlendFactor factor, size_t k, const Operands<Math>& o, Fault fault) {
    const auto one = Math::kOne;
    const auto minus = [&](auto v) {
        return fault == "blend-complement-forgotten"_fault ? v : one - v;
    };
    const size_t constant = fault == "blend-constants-alpha"_fault ? 3 : k;
    switch (factor) {
        case BlendFactor::zero:
            return 0;
        case BlendFactor::one:
            return one;
        case BlendFactor::src_color:
            return o.source[k];
        case BlendFactor::one_minus_src_color:
            return minus(o.source[k]);
        case BlendFactor::dst_color:
            return o.destination[k];
        case BlendFactor::one_minus_dst_color:
            return minus(o.destination[k]);
        case BlendFactor::src_alpha:
            return o.source[3];
        case BlendFactor::one_minus_src_alpha:
            return minus(o.source[3]);
        case BlendFactor::dst_alpha:
            return o.destination[3];
        case BlendFactor::one_minus_dst_alpha:
            return minus(o.destination[3]);
        case BlendFactor::constant_color:
            return o.constants[constant];
        case BlendFactor::one_minus_constant_color:
            return minus(o.constants[constant]);
        case BlendFactor::constant_alpha:
            return o.constants[3];
        case BlendFactor::one_minus_constant_alpha:
            return minus(o.constants[3]);
        case BlendFactor::src1_color:
        case BlendFactor::one_minus_src1_color:
        case BlendFactor::src1_alpha:
        case BlendFactor::one_minus_src1_alpha:
            return second_factor_of(factor, k, o, fault);
        case BlendFactor::src_alpha_saturate:
            break;
    }
    if (k == 3 && fault != "blend-saturate-alpha"_fault) {
        return one;
    }
    const bool is_zero = std::equal_to<>()(o.source[3], typename Math::Value{});
    if (fault == "blend-saturate-source-zero"_fault && is_zero) {
        return o.source[3];
    }
    return fault == "blend-saturate-ignored"_fault ? o.source[3]
                                                   : std::min(o.source[3], minus(o.destination[3]));
}

template <class Math>
std::array<typename Math::Value, 4> blend_all(const cases::Blend& blend, Operands<Math> o,
                                              const Math& math, Fault fault) {
    if (fault == "sources-exchanged"_fault && cases::takes_second(blend)) {
        std::swap(o.source, o.second);
    }
    if (fault == "blend-premultiplies"_fault) {
        for (size_t k = 0; k < 3; ++k) {
            o.source[k] = math.scale(o.source[k], o.source[3]);
        }
    }
    std::array<typename Math::Value, 4> out{};
    for (size_t k = 0; k < 4; ++k) {
        const bool is_alpha = fault == "blend-alpha-for-color"_fault   ? true
                              : fault == "blend-color-for-alpha"_fault ? false
                                                                       : k == 3;
        const cases::BlendEquation& equation = is_alpha ? blend.alpha : blend.color;
        auto f = factor_of(equation.source, k, o, fault);
        auto g = factor_of(equation.destination, k, o, fault);
        if (fault == "blend-factors-exchanged"_fault) {
            std::swap(f, g);
        }
        const auto s = o.source[k];
        const auto d = o.destination[k];
        BlendOp op = equation.op;
        if (fault == "blend-subtract-exchanged"_fault && op == BlendOp::subtract) {
            op = BlendOp::reverse_subtract;
        } else if (fault == "blend-subtract-exchanged"_fault && op == BlendOp::reverse_subtract) {
            op = BlendOp::subtract;
        } else if (fault == "blend-op-ignored"_fault) {
            op = BlendOp::add;
        }
        const bool scales = fault == "blend-min-max-scaled"_fault;
        const auto a = scales ? math.scale(s, f) : s;
        const auto b = scales ? math.scale(d, g) : d;
        if constexpr (std::is_same_v<Math, FloatMath>) {
            if (math.has_one_product && op != BlendOp::min && op != BlendOp::max &&
                are_complements(equation.source, equation.destination)) {
                out[k] = with_one_product(op, s, f, d, g,
                                          is_plain_first(equation.source, equation.destination));
                continue;
            }
        }
        switch (op) {
            case BlendOp::add:
                out[k] = math.add(s, f, d, g);
                break;
            case BlendOp::subtract:
                out[k] = math.subtract(s, f, d, g);
                break;
            case BlendOp::reverse_subtract:
                out[k] = math.subtract(d, g, s, f);
                break;
            case BlendOp::min:
                out[k] = std::min(a, b);
                break;
            case BlendOp::max:
                out[k] = std::max(a, b);
                break;
        }
    }
    return out;
}

}  // namespace software
