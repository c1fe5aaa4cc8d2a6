// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/color/color_steps.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "cases/base/number_text.hpp"
#include "cases/model/words.hpp"
#include "ref/color/logic.hpp"

namespace ref::color {

namespace {

// Each operation on a source code {s} and a stored code {d}, in the signs of C.
constexpr std::array<std::string_view, 16> kFormulas = {
    "0",         "{s} & {d}",  "{s} & ~{d}",   "{s}",          "~{s} & {d}", "{d}",
    "{s} ^ {d}", "{s} | {d}",  "~({s} | {d})", "~({s} ^ {d})", "~{d}",       "{s} | ~{d}",
    "~{s}",      "~{s} | {d}", "~({s} & {d})", "all bits"};

std::string number_text(double low, double high) {
    return low < high ? fmt::format("{} to {}", cases::number_text(low), cases::number_text(high))
                      : cases::number_text(low);
}

std::string equation_text(const cases::BlendEquation& equation) {
    const auto source = cases::word_of(equation.source);
    const auto destination = cases::word_of(equation.destination);
    switch (equation.op) {
        case cases::BlendOp::add:
            return fmt::format("source x {} + stored x {}", source, destination);
        case cases::BlendOp::subtract:
            return fmt::format("source x {} - stored x {}", source, destination);
        case cases::BlendOp::reverse_subtract:
            return fmt::format("stored x {} - source x {}", destination, source);
        case cases::BlendOp::min:
            return "the smaller of source and stored";
        case cases::BlendOp::max:
            break;
    }
    return "the larger of source and stored";
}

std::string blend_text(const cases::Blend& blend) {
    const std::string color = equation_text(blend.color), alpha = equation_text(blend.alpha);
    std::string text = blend.color == blend.alpha
                           ? fmt::format("blends it ({})", color)
                           : fmt::format("blends it (colour {}; alpha {})", color, alpha);
    const auto add = [&](std::string_view factor, std::string_view what, const glm::vec4& v) {
        if ((color + alpha).find(factor) != std::string::npos) {
            text += fmt::format(" with the {} ({}, {}, {}, {})", what, cases::number_text(v.x),
                                cases::number_text(v.y), cases::number_text(v.z),
                                cases::number_text(v.w));
        }
    };
    add("constant", "constants", blend.constants);
    add("src1", "second source", blend.second);
    return text;
}

// What the shader writes, of the components that the format has: "r 0.25, g 1".
std::string source_text(cases::ColorFormat format, const Source& source) {
    std::string text;
    for (uint32_t k = 0; k < 4; ++k) {
        if (cases::component_of(format, k).bits != 0) {
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", "rgba"[k],
                                std::isinf(source.low.at(k))
                                    ? "anything"
                                    : number_text(source.low.at(k), source.high.at(k)));
        }
    }
    return text;
}

// What the operation makes of each component: "r 204 & ~51 = 204".
std::string operation_text(const Unit& unit, const cases::ColorOutput& output, const Color& source,
                           const Color& before, const Color& left) {
    std::string text;
    for (uint32_t k = 0; k < 4; ++k) {
        const Component component(cases::component_of(unit.format, k));
        if (!component.exists() || (uint32_t{output.write_mask} >> k & 1U) == 0) {
            continue;
        }
        const std::string s = component.text_of(component.stored(source[k], unit.profile, false));
        const std::string d = component.text_of(before[k]);
        const auto in_brackets = [](const std::string& range) {
            return range.find(' ') == std::string::npos ? range : "(" + range + ")";
        };
        text +=
            fmt::format("{}{} {} = {}", text.empty() ? "" : ", ", "rgba"[k],
                        fmt::format(fmt::runtime(kFormulas.at(static_cast<size_t>(*output.logic))),
                                    fmt::arg("s", in_brackets(s)), fmt::arg("d", in_brackets(d))),
                        component.text_of(left[k]));
    }
    return text;
}

std::string mask_text(uint32_t mask) {
    std::string text;
    for (uint32_t k = 0; k < 4; ++k) {
        if ((mask >> k & 1U) != 0) {
            text += fmt::format("{}{}", text.empty() ? "" : ", ", "rgba"[k]);
        }
    }
    return text.empty() ? "none of it" : text + " alone";
}

}  // namespace

std::string step_text(const Unit& unit, const cases::ColorOutput& output, const Source& source,
                      const Color& before, const Color& left) {
    const bool has_logic = output.logic && takes_logic(unit.format);
    std::string text = fmt::format("writes {}", source_text(unit.format, source));
    if (replaces_alpha(output, unit.format)) {
        text += ", whose alpha becomes 1";
    }
    if (output.write_mask != 0xf) {
        text += fmt::format(", of which the mask lets through {}", mask_text(output.write_mask));
    }
    if (has_logic) {
        text +=
            fmt::format(", and does the logical operation {}: {}", cases::word_of(*output.logic),
                        operation_text(unit, output, color_of(source), before, left));
    } else if (output.logic) {
        text += ", to a format that has no logical operations";
    } else if (output.blend) {
        text += fmt::format(", and {}", blend_text(*output.blend));
    }
    if (!has_logic || output.write_mask != 0xf) {  // else that has been said
        text += fmt::format("; that leaves {}", unit.text_of(left));
    }
    return text;
}

}  // namespace ref::color
