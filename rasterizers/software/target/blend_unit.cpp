// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/target/blend_unit.hpp"

#include <algorithm>
#include <cmath>

namespace software {

namespace {

using cases::BlendFactor;
using cases::BlendOp;

// Numbers that a blend unit computes with. One is what 1.0 is.
struct FloatMath {
    using Value = float;
    static constexpr float kOne = 1.0F;
    bool fused;

    // s f + d g and the like: the first product may be kept in full.
    float add(float s, float f, float d, float g) const {
        return fused ? std::fma(s, f, d * g) : s * f + d * g;
    }
    float subtract(float s, float f, float d, float g) const {
        return fused ? std::fma(s, f, -(d * g)) : s * f - d * g;
    }
    float scale(float a, float b) const { return a * b; }
};

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
    std::array<Value, 4> source, destination, constants;
};

template <class Math>
typename Math::Value factor_of(BlendFactor factor, size_t k, const Operands<Math>& o, Fault fault) {
    const auto one = Math::kOne;
    const auto minus = [&](auto v) {
        return fault == Fault::blend_complement_forgotten ? v : one - v;
    };
    const size_t constant = fault == Fault::blend_constants_alpha ? 3 : k;
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
        case BlendFactor::src_alpha_saturate:
            break;
    }
    if (k == 3 && fault != Fault::blend_saturate_alpha) {
        return one;
    }
    return fault == Fault::blend_saturate_ignored ? o.source[3]
                                                  : std::min(o.source[3], minus(o.destination[3]));
}

template <class Math>
std::array<typename Math::Value, 4> blend_all(const cases::Blend& blend, Operands<Math> o,
                                              const Math& math, Fault fault) {
    if (fault == Fault::blend_premultiplies) {
        for (size_t k = 0; k < 3; ++k) {
            o.source[k] = math.scale(o.source[k], o.source[3]);
        }
    }
    std::array<typename Math::Value, 4> out{};
    for (size_t k = 0; k < 4; ++k) {
        const bool is_alpha = fault == Fault::blend_alpha_for_color   ? true
                              : fault == Fault::blend_color_for_alpha ? false
                                                                      : k == 3;
        const cases::BlendEquation& equation = is_alpha ? blend.alpha : blend.color;
        auto f = factor_of(equation.source, k, o, fault);
        auto g = factor_of(equation.destination, k, o, fault);
        if (fault == Fault::blend_factors_exchanged) {
            std::swap(f, g);
        }
        const auto s = o.source[k];
        const auto d = o.destination[k];
        BlendOp op = equation.op;
        if (fault == Fault::blend_subtract_exchanged && op == BlendOp::subtract) {
            op = BlendOp::reverse_subtract;
        } else if (fault == Fault::blend_subtract_exchanged && op == BlendOp::reverse_subtract) {
            op = BlendOp::subtract;
        } else if (fault == Fault::blend_op_ignored) {
            op = BlendOp::add;
        }
        const bool scales = fault == Fault::blend_min_max_scaled;
        const auto a = scales ? math.scale(s, f) : s;
        const auto b = scales ? math.scale(d, g) : d;
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

float clamp_to_unit(float v) {
    return v > 0 ? v < 1 ? v : 1.0F : 0.0F;
}

std::array<float, 4> to_array(const glm::vec4& v) {
    return {v.x, v.y, v.z, v.w};
}

}  // namespace

BlendUnit::BlendUnit(cases::ColorFormat format, const Device& device)
    : device_(device), format_(format), layout_(layout_of(format)) {
    if (device.fault == Fault::srgb_alpha_encoded && layout_.channels[0].number == Number::srgb) {
        layout_.channels[3].number = Number::srgb;
    }
}

bool BlendUnit::is_fixed() const {
    return layout_.channels[0].number == Number::unorm ||
           layout_.channels[0].number == Number::srgb;
}

Texel BlendUnit::cleared(const glm::vec4& color) const {
    Device device = device_;  // clears take another path
    device.fault = Fault::none;
    Texel out{};
    const FormatLayout layout = layout_of(format_);
    for (size_t k = 0; k < 4; ++k) {
        if (layout.channels[k].bits != 0) {
            out[layout.position[k]] =
                store_channel(color[static_cast<int>(k)], layout.channels[k], device);
        }
    }
    return out;
}

capture::ColorCodes BlendUnit::read_back(const Texel& texel) const {
    capture::ColorCodes out{};
    for (size_t k = 0; k < 4; ++k) {
        out[k] = layout_.channels[k].bits != 0 ? texel[layout_.position[k]] : 0;
    }
    return out;
}

// Bit k: component k may be written.
uint8_t BlendUnit::mask_of(const cases::ColorOutput& output) const {
    const unsigned mask = output.write_mask;
    switch (device_.fault) {
        case Fault::write_mask_ignored:
            return 0xf;
        case Fault::write_mask_ignored_blending:
            return output.blend ? 0xf : output.write_mask;
        case Fault::logic_mask_ignored:
            return output.logic ? 0xf : output.write_mask;
        case Fault::write_mask_shifted:
            return static_cast<uint8_t>((mask << 1 | mask >> 3) & 0xfU);
        case Fault::write_mask_unswizzled: {  // bit k is the component at position k in memory
            unsigned out = 0;
            for (unsigned k = 0; k < 4; ++k) {
                out |= (mask >> layout_.position[k] & 1U) << k;
            }
            return static_cast<uint8_t>(out);
        }
        default:
            return output.write_mask;
    }
}

glm::vec4 BlendUnit::blend(const cases::Blend& blend, const glm::vec4& source,
                           const glm::vec4& destination) const {
    const Operands<FloatMath> o{to_array(source), to_array(destination), to_array(blend.constants)};
    const auto out = blend_all(blend, o, FloatMath{device_.fused}, device_.fault);
    return {out[0], out[1], out[2], out[3]};
}

std::array<uint32_t, 4> BlendUnit::blend_fixed(const cases::Blend& blend,
                                               const std::array<uint32_t, 4>& source,
                                               const std::array<uint32_t, 4>& destination) const {
    Operands<FixedMath> o{source, destination, {}};
    for (size_t k = 0; k < 4; ++k) {
        o.constants[k] =
            store_channel(blend.constants[static_cast<int>(k)], {Number::unorm, 8}, device_);
    }
    const FixedMath math{device_.multiply, device_.unorm == UnormRounding::down,
                         device_.fault == Fault::blend_shift_only};
    return blend_all(blend, o, math, device_.fault);
}

Texel BlendUnit::write(const cases::ColorOutput& output, const glm::vec4& source,
                       const Texel& before) const {
    const auto& channels = layout_.channels;
    const bool is_eight_bits = std::all_of(channels.begin(), channels.end(), [](const Channel& c) {
        return c.number == Number::unorm && c.bits == 8;
    });
    std::array<uint32_t, 4> codes{};
    const bool operates = output.logic && device_.fault != Fault::logic_ignored;
    const std::optional<cases::Blend> equation =
        operates && device_.fault != Fault::logic_blends_too ? std::nullopt : output.blend;
    if (!equation || device_.fault == Fault::blend_ignored) {
        for (size_t k = 0; k < 4; ++k) {
            codes[k] = channels[k].bits != 0
                           ? store_channel(source[static_cast<int>(k)], channels[k], device_)
                           : 0;
        }
    } else if (is_eight_bits && device_.blend == BlendMath::fixed) {
        std::array<uint32_t, 4> s{}, d{};
        for (size_t k = 0; k < 4; ++k) {
            s[k] = store_channel(source[static_cast<int>(k)], channels[k], device_);
            d[k] = before[layout_.position[k]];
        }
        if (device_.fault == Fault::blend_dst_alpha_one) {
            d[3] = 255;
        }
        codes = blend_fixed(*equation, s, d);
    } else {
        glm::vec4 s = source;
        glm::vec4 d(0, 0, 0, 1);
        cases::Blend clamped = *equation;
        for (int k = 0; k < 4; ++k) {
            const auto n = static_cast<size_t>(k);
            if (is_fixed() && device_.fault != Fault::blend_source_unclamped) {
                s[k] = clamp_to_unit(s[k]);
                clamped.constants[k] = clamp_to_unit(clamped.constants[k]);
            }
            if (device_.fault == Fault::blend_floats_clamped && !is_fixed()) {
                s[k] = clamp_to_unit(s[k]);
            }
            if (channels[n].bits != 0) {
                d[k] = load_channel(before[layout_.position[n]], channels[n], device_);
            }
        }
        if (device_.fault == Fault::blend_dst_alpha_one) {
            d.w = 1;
        } else if (device_.fault == Fault::blend_missing_alpha_zero && channels[3].bits == 0) {
            d.w = 0;
        }
        const glm::vec4 result = blend(clamped, s, d);
        Device rounding = device_;  // what binary32 missed by its rounding is not rounded away
        rounding.unorm =
            device_.unorm == UnormRounding::down ? UnormRounding::nearest : device_.unorm;
        for (size_t k = 0; k < 4; ++k) {
            codes[k] = channels[k].bits != 0
                           ? store_channel(result[static_cast<int>(k)], channels[k], rounding)
                           : 0;
        }
    }
    for (size_t k = 0; operates && k < 4; ++k) {
        if (has_logic(k)) {
            codes[k] = operated(*output.logic, codes[k], before[layout_.position[k]], k);
        }
    }
    Texel out = before;
    const unsigned mask = mask_of(output);
    for (size_t k = 0; k < 4; ++k) {
        const size_t at = device_.fault == Fault::bgra_swapped ? k : layout_.position[k];
        if (channels[k].bits != 0 && (mask >> k & 1U) != 0) {
            out[at] = codes[k];
        }
    }
    return out;
}

ColorAttachment::ColorAttachment(const cases::Case& c, const Device& device)
    : case_(c),
      device_(device),
      unit_(c.target.color ? c.target.color->format : cases::ColorFormat::rgba8_unorm, device) {
    if (!c.target.color) {
        return;
    }
    const size_t count = size_t{c.target.width} * c.target.rows() * c.target.samples;
    texels_.assign(count, unit_.cleared(c.target.color->clear));
    last_.assign(
        device.fault == Fault::blend_stale || device.fault == Fault::blend_merges ? count : 0,
        Last{});
    for (const cases::Draw& draw : c.draws) {
        cases::ColorOutput output = draw.color;
        const cases::ColorOutput& first = c.draws.front().color;
        switch (device.fault) {
            case Fault::blend_of_first_draw:
                output.blend = first.blend;
                break;
            case Fault::logic_of_first_draw:
                output.logic = first.logic;
                break;
            case Fault::logic_off_with_early_tests:
                output.logic = draw.early_tests ? std::nullopt : output.logic;
                break;
            case Fault::logic_off_with_written_depth:
                output.logic = draw.frag_depth ? std::nullopt : output.logic;
                break;
            case Fault::write_mask_of_first_draw:
                output.write_mask = first.write_mask;
                break;
            case Fault::blend_constants_of_first_draw:
                if (output.blend && first.blend) {
                    output.blend->constants = first.blend->constants;
                }
                break;
            case Fault::blend_constants_ignored:
                if (output.blend) {
                    output.blend->constants = glm::vec4(0);
                }
                break;
            case Fault::blend_stays_on:
                if (!outputs_.empty() && !output.blend) {
                    output.blend = outputs_.back().blend;
                }
                break;
            default:
                break;
        }
        outputs_.push_back(output);
    }
}

void ColorAttachment::write(size_t index, uint32_t draw, uint32_t primitive,
                            const glm::vec4& source) {
    if (!case_.target.color) {
        return;
    }
    if (device_.fault == Fault::color_reloaded && draw != draw_) {
        // Each draw starts with the load operation.
        std::fill(texels_.begin(), texels_.end(), unit_.cleared(case_.target.color->clear));
    }
    draw_ = draw;
    if (device_.fault == Fault::color_per_pixel) {
        const size_t first = index - index % case_.target.samples;
        for (size_t s = 0; s < case_.target.samples; ++s) {
            if (first + s == index || !outputs_[draw].blend) {
                write_sample(first + s, draw, primitive, source);
            }
        }
        return;
    }
    write_sample(index, draw, primitive, source);
}

void ColorAttachment::write_sample(size_t index, uint32_t draw, uint32_t primitive,
                                   const glm::vec4& source) {
    Texel& texel = texels_[index];
    const cases::ColorOutput& output = outputs_[draw];
    Texel before = texel;
    if (!last_.empty()) {
        Last& last = last_[index];
        const bool is_next = last.draw == draw && last.primitive + 1 == primitive;
        if (device_.fault == Fault::blend_merges && is_next && output.blend) {
            last.primitive = primitive;
            return;  // taken for the fragment before
        }
        if (device_.fault == Fault::blend_stale && is_next) {
            before = last.before;
        }
        last = {draw, primitive, texel};
    }
    texel = unit_.write(output, source, before);
    if (device_.fault == Fault::blend_twice && output.blend) {
        texel = unit_.write(output, source, texel);
    }
}

glm::vec4 ColorAttachment::beside(uint32_t draw, const glm::vec4& value,
                                  const glm::vec4& before) const {
    if (device_.fault == Fault::blend_everywhere && !outputs_.empty() && outputs_[draw].blend) {
        return unit_.blend(*outputs_[draw].blend, value, before);
    }
    return value;
}

std::vector<capture::ColorCodes> ColorAttachment::read_back() const {
    std::vector<capture::ColorCodes> out;
    out.reserve(texels_.size());
    for (const Texel& texel : texels_) {
        out.push_back(unit_.read_back(texel));
    }
    return out;
}

}  // namespace software
