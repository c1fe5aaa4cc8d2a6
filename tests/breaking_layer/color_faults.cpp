// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Blending and write masks. An attachment counts hits in every case (colour ONE, ZERO; alpha ONE,
// ONE; ADD), so a fault of it would be seen everywhere: apart from the first few, faults touch
// other equations only, and none of those that add.
#include <array>

#include "fault.hpp"

namespace breaking {

namespace {

using Blend = VkPipelineColorBlendAttachmentState;

bool counts_or_adds(const Blend& b) {
    const bool counts = b.dstColorBlendFactor == VK_BLEND_FACTOR_ZERO &&
                        b.srcAlphaBlendFactor == VK_BLEND_FACTOR_ONE &&
                        b.dstAlphaBlendFactor == VK_BLEND_FACTOR_ONE;
    return b.srcColorBlendFactor == VK_BLEND_FACTOR_ONE && b.colorBlendOp == VK_BLEND_OP_ADD &&
           (counts || b.dstColorBlendFactor == VK_BLEND_FACTOR_ONE);
}

template <bool (*alter)(Blend&)>
bool each(PipelineCopy& p) {
    bool altered = false;
    for (Blend& b : p.blends) {
        altered = alter(b) || altered;
    }
    return altered;
}

template <bool (*alter)(Blend&)>
bool each_equation(PipelineCopy& p) {
    bool altered = false;
    for (Blend& b : p.blends) {
        altered = (b.blendEnable == VK_TRUE && !counts_or_adds(b) && alter(b)) || altered;
    }
    return altered;
}

// All four factors.
template <VkBlendFactor from, VkBlendFactor to>
bool factor(Blend& b) {
    bool altered = false;
    for (VkBlendFactor* f : {&b.srcColorBlendFactor, &b.dstColorBlendFactor, &b.srcAlphaBlendFactor,
                             &b.dstAlphaBlendFactor}) {
        altered = (*f == from && change(*f, to)) || altered;
    }
    return altered;
}

bool first_for_second(Blend& b) {
    bool altered = factor<VK_BLEND_FACTOR_SRC1_COLOR, VK_BLEND_FACTOR_SRC_COLOR>(b);
    altered =
        factor<VK_BLEND_FACTOR_ONE_MINUS_SRC1_COLOR, VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR>(b) ||
        altered;
    altered = factor<VK_BLEND_FACTOR_SRC1_ALPHA, VK_BLEND_FACTOR_SRC_ALPHA>(b) || altered;
    altered =
        factor<VK_BLEND_FACTOR_ONE_MINUS_SRC1_ALPHA, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA>(b) ||
        altered;
    return altered;
}

template <VkBlendOp from, VkBlendOp to>
bool op(Blend& b) {
    bool altered = false;
    for (VkBlendOp* o : {&b.colorBlendOp, &b.alphaBlendOp}) {
        altered = (*o == from && change(*o, to)) || altered;
    }
    return altered;
}

bool disable(Blend& b) {
    return change(b.blendEnable, VK_FALSE);
}
// Of pipelines with a logical operation.
template <VkLogicOp op>
bool operate(PipelineCopy& p) {
    return p.blend.logicOpEnable == VK_TRUE && change(p.blend.logicOp, op);
}
bool stop_operating(PipelineCopy& p) {
    return change(p.blend.logicOpEnable, VK_FALSE);
}
bool exchange_operands(PipelineCopy& p) {
    if (p.blend.logicOpEnable == VK_FALSE) {
        return false;
    }
    // Bits 1 and 2 of the number are the results where one operand's bit is set.
    const auto op = static_cast<unsigned>(p.blend.logicOp);
    return change(p.blend.logicOp,
                  static_cast<VkLogicOp>((op & 9U) | (op & 2U) << 1U | (op & 4U) >> 1U));
}
bool swap_factors(Blend& b) {
    std::swap(b.srcColorBlendFactor, b.dstColorBlendFactor);
    std::swap(b.srcAlphaBlendFactor, b.dstAlphaBlendFactor);
    return b.srcColorBlendFactor != b.dstColorBlendFactor ||
           b.srcAlphaBlendFactor != b.dstAlphaBlendFactor;
}
bool alpha_as_color(Blend& b) {
    const bool source = change(b.srcAlphaBlendFactor, b.srcColorBlendFactor);
    const bool destination = change(b.dstAlphaBlendFactor, b.dstColorBlendFactor);
    return change(b.alphaBlendOp, b.colorBlendOp) || source || destination;
}
bool alpha_replaced(Blend& b) {
    const bool source = change(b.srcAlphaBlendFactor, VK_BLEND_FACTOR_ONE);
    const bool destination = change(b.dstAlphaBlendFactor, VK_BLEND_FACTOR_ZERO);
    return change(b.alphaBlendOp, VK_BLEND_OP_ADD) || source || destination;
}
bool swap_min_max(Blend& b) {
    return op<VK_BLEND_OP_MIN, VK_BLEND_OP_MAX>(b) || op<VK_BLEND_OP_MAX, VK_BLEND_OP_MIN>(b);
}
bool swap_subtract(Blend& b) {
    return op<VK_BLEND_OP_SUBTRACT, VK_BLEND_OP_REVERSE_SUBTRACT>(b) ||
           op<VK_BLEND_OP_REVERSE_SUBTRACT, VK_BLEND_OP_SUBTRACT>(b);
}
bool write_all(Blend& b) {
    return change(b.colorWriteMask, 0xf);
}
bool write_no_alpha(Blend& b) {
    return change(b.colorWriteMask,
                  b.colorWriteMask & ~VkColorComponentFlags{VK_COLOR_COMPONENT_A_BIT});
}
bool write_blue_for_red(Blend& b) {
    const VkColorComponentFlags mask = b.colorWriteMask;
    return change(b.colorWriteMask, (mask & 0xaU) | (mask & 1U) << 2U | (mask & 4U) >> 2U);
}

bool swap_constants(std::span<float, 4> c) {
    const float red = c[0];
    const bool altered = change(c[0], c[2]);
    c[2] = red;
    return altered;
}
bool no_constants(std::span<float, 4> c) {
    bool altered = false;
    for (float& value : c) {
        altered = change(value, 0) || altered;
    }
    return altered;
}

constexpr auto kSourceAlpha = VK_BLEND_FACTOR_SRC_ALPHA;
constexpr auto kOne = VK_BLEND_FACTOR_ONE;

constexpr std::array kColorFaults = {
    Fault{"blend-off", "blend-ignored"_fault, {.pipeline = each<disable>}},
    Fault{"blend-off-but-adding",
          "blend-off-unless-adding"_fault,
          {.pipeline = each_equation<disable>}},
    Fault{"blend-factors-swapped",
          "blend-factors-exchanged"_fault,
          {.pipeline = each_equation<swap_factors>}},
    Fault{"blend-alpha-as-color",
          "blend-color-for-alpha"_fault,
          {.pipeline = each_equation<alpha_as_color>}},
    Fault{"blend-alpha-replaced",
          "blend-alpha-replaced"_fault,
          {.pipeline = each_equation<alpha_replaced>}},
    Fault{"blend-source-alpha-one",
          "src-alpha-as-one"_fault,
          {.pipeline = each_equation<factor<kSourceAlpha, kOne>>}},
    Fault{"blend-source-alpha-destination",
          "src-alpha-as-dst-alpha"_fault,
          {.pipeline = each_equation<factor<kSourceAlpha, VK_BLEND_FACTOR_DST_ALPHA>>}},
    Fault{"blend-one-minus-source-alpha-one",
          "one-minus-src-alpha-as-one"_fault,
          {.pipeline = each_equation<factor<VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA, kOne>>}},
    Fault{"blend-destination-alpha-one",
          "dst-alpha-as-one"_fault,
          {.pipeline = each_equation<factor<VK_BLEND_FACTOR_DST_ALPHA, kOne>>}},
    Fault{
        "blend-destination-color-source",
        "dst-color-as-src-color"_fault,
        {.pipeline = each_equation<factor<VK_BLEND_FACTOR_DST_COLOR, VK_BLEND_FACTOR_SRC_COLOR>>}},
    Fault{"blend-constant-color-alpha",
          "constant-color-as-alpha"_fault,
          {.pipeline = each_equation<
               factor<VK_BLEND_FACTOR_CONSTANT_COLOR, VK_BLEND_FACTOR_CONSTANT_ALPHA>>}},
    Fault{"blend-saturate-source-alpha",
          "blend-saturate-ignored"_fault,
          {.pipeline = each_equation<factor<VK_BLEND_FACTOR_SRC_ALPHA_SATURATE, kSourceAlpha>>}},
    Fault{"blend-min-max-swapped",
          "min-max-exchanged"_fault,
          {.pipeline = each_equation<swap_min_max>}},
    Fault{"blend-subtract-swapped",
          "blend-subtract-exchanged"_fault,
          {.pipeline = each_equation<swap_subtract>}},
    Fault{"blend-subtract-as-add",
          "subtract-adds"_fault,
          {.pipeline = each_equation<op<VK_BLEND_OP_SUBTRACT, VK_BLEND_OP_ADD>>}},
    Fault{"dual-source-as-first",
          "second-as-first"_fault,
          {.pipeline = each_equation<first_for_second>}},
    Fault{"dual-source-alpha-as-color",
          "second-alpha-as-color"_fault,
          {.pipeline =
               each_equation<factor<VK_BLEND_FACTOR_SRC1_ALPHA, VK_BLEND_FACTOR_SRC1_COLOR>>}},
    Fault{"logic-op-off", "logic-ignored"_fault, {.pipeline = stop_operating}},
    Fault{"logic-op-copies", "logic-copies"_fault, {.pipeline = operate<VK_LOGIC_OP_COPY>}},
    Fault{"logic-op-operands-swapped",
          "logic-operands-exchanged"_fault,
          {.pipeline = exchange_operands}},
    Fault{"blend-constants-swapped",
          "blend-constants-red-blue"_fault,
          {.blend_constants = swap_constants}},
    Fault{
        "blend-constants-zero", "blend-constants-ignored"_fault, {.blend_constants = no_constants}},
    Fault{"write-mask-ignored", "write-mask-ignored"_fault, {.pipeline = each<write_all>}},
    Fault{"write-mask-no-alpha", "write-mask-no-alpha"_fault, {.pipeline = each<write_no_alpha>}},
    Fault{
        "write-mask-red-blue", "write-mask-red-blue"_fault, {.pipeline = each<write_blue_for_red>}},
};

}  // namespace

std::span<const Fault> color_faults() {
    return kColorFaults;
}

}  // namespace breaking
