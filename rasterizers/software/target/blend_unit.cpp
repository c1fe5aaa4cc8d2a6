// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/target/blend_unit.hpp"

#include <algorithm>

#include "rasterizers/software/target/blend_math.hpp"
#include "rasterizers/software/target/logic_unit.hpp"
#include "rasterizers/software/target/neighbour.hpp"

namespace software {

namespace {

float clamp_to_unit(float v, float least = 0) {
    return v > least ? v < 1 ? v : 1.0F : least;
}

std::array<float, 4> to_array(const glm::vec4& v) {
    return {v.x, v.y, v.z, v.w};
}

}  // namespace

BlendUnit::BlendUnit(cases::ColorFormat format, const Device& device)
    : device_(device), format_(format), layout_(layout_of(format)) {
    if (device.fault == "srgb-alpha-encoded"_fault && layout_.channels[0].number == Number::srgb) {
        layout_.channels[3].number = Number::srgb;
    }
}

bool BlendUnit::is_fixed() const {
    const Number number = layout_.channels[0].number;
    return number == Number::unorm || number == Number::srgb || number == Number::snorm;
}

Texel BlendUnit::cleared(const glm::vec4& color) const {
    Device device = device_;  // clears take another path
    device.fault = kNoFault;
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
        case "write-mask-ignored"_fault:
            return 0xf;
        case "write-mask-ignored-blending"_fault:
            return output.blend ? 0xf : output.write_mask;
        case "logic-mask-ignored"_fault:
            return output.logic ? 0xf : output.write_mask;
        case "write-mask-shifted"_fault:
            return static_cast<uint8_t>((mask << 1 | mask >> 3) & 0xfU);
        case "write-mask-unswizzled"_fault: {  // bit k is the component at position k in memory
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
    const Operands<FloatMath> o{to_array(source), to_array(blend.second), to_array(destination),
                                to_array(blend.constants)};
    const auto out = blend_all(
        blend, o, FloatMath{device_.fused, device_.blend == BlendMath::one_product}, device_.fault);
    return {out[0], out[1], out[2], out[3]};
}

float BlendUnit::source_of_blending(float v) const {
    return device_.blend == BlendMath::cut ? std::floor(v * 4096.0F) / 4096.0F : v;
}

std::array<uint32_t, 4> BlendUnit::blend_fixed(const cases::Blend& blend,
                                               const std::array<uint32_t, 4>& source,
                                               const std::array<uint32_t, 4>& destination) const {
    Operands<FixedMath> o{source, {}, destination, {}};
    for (size_t k = 0; k < 4; ++k) {
        o.second[k] = store_channel(source_of_blending(blend.second[static_cast<int>(k)]),
                                    layout_.channels[k], device_);
        o.constants[k] =
            store_channel(blend.constants[static_cast<int>(k)], {Number::unorm, 8}, device_);
    }
    const FixedMath math{device_.multiply, device_.unorm == UnormRounding::down,
                         device_.fault == "blend-shift-only"_fault};
    return blend_all(blend, o, math, device_.fault);
}

glm::vec4 BlendUnit::replaced(const cases::ColorOutput& output, const glm::vec4& written) const {
    const Number number = layout_.channels[0].number;
    const bool is_on = output.alpha_to_one && (!cases::is_integer(number) ||
                                               device_.fault == "alpha-to-one-of-integers"_fault);
    const bool is_lost = device_.fault == "alpha-to-one-ignored"_fault ||
                         device_.fault == "alpha-to-one-stored"_fault ||
                         (device_.fault == "alpha-to-one-unblended"_fault && output.blend);
    if (!is_on || is_lost) {
        return written;
    }
    if (device_.fault == "alpha-to-one-everywhere"_fault) {
        return glm::vec4(1);
    }
    const float most = cases::is_integer(number) ? 255.0F : 1.0F;
    return {written.x, written.y, written.z, most};
}

Texel BlendUnit::write(const cases::ColorOutput& output, const glm::vec4& written,
                       const Texel& before) const {
    const glm::vec4 source = replaced(output, written);
    const auto& channels = layout_.channels;
    const bool is_eight_bits = std::ranges::all_of(
        channels, [](const Channel& c) { return c.number == Number::unorm && c.bits == 8; });
    std::array<uint32_t, 4> codes{};
    const bool operates = output.logic && device_.fault != "logic-ignored"_fault;
    const std::optional<cases::Blend> equation =
        operates && device_.fault != "logic-blends-too"_fault ? std::nullopt : output.blend;
    if (!equation || device_.fault == "blend-ignored"_fault) {
        for (size_t k = 0; k < 4; ++k) {
            codes[k] = channels[k].bits != 0
                           ? store_channel(source[static_cast<int>(k)], channels[k], device_)
                           : 0;
        }
    } else if (is_eight_bits && device_.blend != BlendMath::binary32 &&
               device_.blend != BlendMath::one_product &&
               device_.fault != "a8b8g8r8-blended-with-zero"_fault) {
        std::array<uint32_t, 4> s{}, d{};
        for (size_t k = 0; k < 4; ++k) {
            s[k] = store_channel(source_of_blending(source[static_cast<int>(k)]), channels[k],
                                 device_);
            d[k] = before[layout_.position[k]];
        }
        if (device_.fault == "blend-dst-alpha-one"_fault) {
            d[3] = 255;
        }
        cases::Blend fixed = *equation;
        if (output.alpha_to_one && device_.fault == "alpha-to-one-of-second"_fault) {
            fixed.second.w = 1;
        }
        codes = blend_fixed(fixed, s, d);
    } else {
        glm::vec4 s = source;
        glm::vec4 d(0, 0, 0, 1);
        const float least = channels[0].number == Number::snorm ? -1.0F : 0.0F;
        cases::Blend clamped =
            device_.blend == BlendMath::one_product
                ? with_known_factors(*equation, output.alpha_to_one, channels[3].bits == 0)
                : *equation;
        if (output.alpha_to_one && device_.fault == "alpha-to-one-of-second"_fault) {
            clamped.second.w = 1;
        }
        for (int k = 0; k < 4; ++k) {
            const auto n = static_cast<size_t>(k);
            if (is_fixed() && device_.fault != "blend-source-unclamped"_fault) {
                s[k] = clamp_to_unit(s[k], least);
                clamped.constants[k] = clamp_to_unit(clamped.constants[k], least);
            }
            if (is_fixed() && device_.fault != "second-unclamped"_fault) {
                clamped.second[k] = clamp_to_unit(clamped.second[k], least);
            }
            if (device_.fault == "blend-floats-clamped"_fault && !is_fixed()) {
                s[k] = clamp_to_unit(s[k]);
            }
            if (device_.fault == "a8b8g8r8-blended-with-zero"_fault &&
                cases::name_of(format_).starts_with("a8b8g8r8")) {
                d[k] = 0;
            } else if (channels[n].bits != 0) {
                d[k] = load_channel(before[layout_.position[n]], channels[n], device_);
            }
        }
        if (device_.fault == "blend-dst-alpha-one"_fault) {
            d.w = 1;
        } else if (device_.fault == "blend-missing-alpha-zero"_fault && channels[3].bits == 0) {
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
    if (output.alpha_to_one && device_.fault == "alpha-to-one-stored"_fault &&
        channels[3].bits != 0) {
        codes[3] = store_channel(1.0F, channels[3], device_);
    }
    for (size_t k = 0; operates && k < 4; ++k) {
        if (has_logic(layout_, k, device_.fault)) {
            codes[k] = operated(*output.logic, codes[k], before[layout_.position[k]],
                                layout_.channels[k].bits, device_.fault);
        }
    }
    Texel out = before;
    const unsigned mask = mask_of(output);
    for (size_t k = 0; k < 4; ++k) {
        const size_t at = device_.fault == "bgra-swapped"_fault ? k : layout_.position[k];
        if (channels[k].bits != 0 && (mask >> k & 1U) != 0) {
            out[at] = codes[k];
        }
    }
    return out;
}

void ColorAttachment::clear(size_t sample, uint32_t draw) {
    Device plain = device_;  // clears take another path
    plain.fault = kNoFault;
    const cases::ColorOutput& output = case_.draws[draw].color;
    texels_[sample] =
        BlendUnit(case_.target.color->format, plain).write(output, output.value, texels_[sample]);
}

ColorAttachment::ColorAttachment(const cases::Case& c, const Device& device)
    : case_(c),
      device_(device),
      unit_(c.target.color ? c.target.color->format : cases::ColorFormat::rgba8_unorm, device) {
    if (!c.target.color) {
        return;
    }
    const size_t count = size_t{c.target.width} * c.target.rows() * c.target.samples;
    texels_.assign(count, unit_.cleared(clear_of(c.target, device)));
    last_.assign(
        device.fault == "blend-stale"_fault || device.fault == "blend-merges"_fault ? count : 0,
        Last{});
    for (const cases::Draw& draw : c.draws) {
        cases::ColorOutput output = draw.color;
        const cases::ColorOutput& first = c.draws.front().color;
        switch (device.fault) {
            case "blend-of-first-draw"_fault:
                output.blend = first.blend;
                break;
            case "logic-of-first-draw"_fault:
                output.logic = first.logic;
                break;
            case "logic-off-with-early-tests"_fault:
                output.logic = draw.early_tests ? std::nullopt : output.logic;
                break;
            case "logic-off-with-written-depth"_fault:
                output.logic = draw.frag_depth ? std::nullopt : output.logic;
                break;
            case "write-mask-of-first-draw"_fault:
                output.write_mask = first.write_mask;
                break;
            case "blend-constants-of-first-draw"_fault:
                if (output.blend && first.blend) {
                    output.blend->constants = first.blend->constants;
                }
                break;
            case "alpha-to-one-of-first-draw"_fault:
                output.alpha_to_one = first.alpha_to_one;
                break;
            case "alpha-to-one-multisampled"_fault:
                output.alpha_to_one = output.alpha_to_one && c.target.samples > 1;
                break;
            case "second-of-first-draw"_fault:
                if (output.blend && first.blend && takes_second(*first.blend)) {
                    output.blend->second = first.blend->second;
                }
                break;
            case "blend-constants-ignored"_fault:
                if (output.blend) {
                    output.blend->constants = glm::vec4(0);
                }
                break;
            case "blend-stays-on"_fault:
                if (!outputs_.empty() && !output.blend) {
                    output.blend = outputs_.back().blend;
                }
                break;
            default:
                break;
        }
        outputs_.push_back(output_beside(c, draw, output, device));
    }
}

void ColorAttachment::write(size_t sample, uint32_t draw, uint32_t primitive,
                            const glm::vec4& value) {
    if (!case_.target.color) {
        return;
    }
    const std::optional<size_t> place = place_in(case_.target, sample, device_);
    if (!place) {
        return;
    }
    const size_t index = *place;
    const glm::vec4 source = passed(case_.target, value, device_);
    if (device_.fault == "color-reloaded"_fault && draw != draw_) {
        // Each draw starts with the load operation.
        std::ranges::fill(texels_, unit_.cleared(clear_of(case_.target, device_)));
    }
    draw_ = draw;
    if (device_.fault == "color-per-pixel"_fault) {
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
        if (device_.fault == "blend-merges"_fault && is_next && output.blend) {
            last.primitive = primitive;
            return;  // taken for the fragment before
        }
        if (device_.fault == "blend-stale"_fault && is_next) {
            before = last.before;
        }
        last = {draw, primitive, texel};
    }
    texel = unit_.write(output, source, before);
    if (device_.fault == "blend-twice"_fault && output.blend) {
        texel = unit_.write(output, source, texel);
    }
}

glm::vec4 ColorAttachment::beside(uint32_t draw, const glm::vec4& value,
                                  const glm::vec4& before) const {
    if (device_.fault == "blend-everywhere"_fault && !outputs_.empty() && outputs_[draw].blend) {
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
