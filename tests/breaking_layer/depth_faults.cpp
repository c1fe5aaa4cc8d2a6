// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Depth: test, write, bias, clamp, clip, and the stencil that counts beside it.
#include <array>

#include "fault.hpp"

namespace breaking {

namespace {

template <VkCompareOp from, VkCompareOp to>
bool compare(VkCompareOp& op) {
    return op == from && change(op, to);
}

bool mirror_compare(VkCompareOp& op) {
    // LESS (1) and GREATER (4) are bits; EQUAL (2), NEVER (0) and ALWAYS (7) stay.
    const auto bits = static_cast<uint32_t>(op);
    return change(op,
                  static_cast<VkCompareOp>((bits & 2U) | (bits & 1U) << 2U | (bits & 4U) >> 2U));
}

bool no_clip_control(PipelineCopy& p) {
    const bool had = p.clip_control && p.clip_control->negativeOneToOne == VK_TRUE;
    p.clip_control.reset();
    return had;
}

bool flip_depth_clip(PipelineCopy& p) {
    if (!p.depth_clip) {
        return false;
    }
    p.depth_clip->depthClipEnable = p.depth_clip->depthClipEnable == VK_TRUE ? VK_FALSE : VK_TRUE;
    return true;
}

// What is set for front faces is set for back faces, too.
template <class Call>
bool front_for_back(Call& call) {
    if (call.faces == VK_STENCIL_FACE_FRONT_BIT) {
        call.faces = VK_STENCIL_FACE_FRONT_AND_BACK;
    } else {
        call.is_dropped = true;
    }
    return true;
}

// Each operation of a call that is `from`.
template <VkStencilOp from, VkStencilOp to>
bool operate(StencilOps& ops) {
    bool is_altered = false;
    for (VkStencilOp* op : {&ops.fail, &ops.pass, &ops.depth_fail}) {
        is_altered = (*op == from && change(*op, to)) || is_altered;
    }
    return is_altered;
}

constexpr std::array kDepthFaults = {
    Fault{"depth-compare-less-or-equal",
          "depth-less-or-equal"_fault,
          {.depth_compare = compare<VK_COMPARE_OP_LESS, VK_COMPARE_OP_LESS_OR_EQUAL>}},
    Fault{"depth-compare-less",
          "less-or-equal-as-less"_fault,
          {.depth_compare = compare<VK_COMPARE_OP_LESS_OR_EQUAL, VK_COMPARE_OP_LESS>}},
    Fault{"depth-compare-greater-or-equal",
          "greater-as-greater-or-equal"_fault,
          {.depth_compare = compare<VK_COMPARE_OP_GREATER, VK_COMPARE_OP_GREATER_OR_EQUAL>}},
    Fault{"depth-compare-greater",
          "greater-or-equal-as-greater"_fault,
          {.depth_compare = compare<VK_COMPARE_OP_GREATER_OR_EQUAL, VK_COMPARE_OP_GREATER>}},
    Fault{"depth-compare-not-equal",
          "not-equal-as-always"_fault,
          {.depth_compare = compare<VK_COMPARE_OP_NOT_EQUAL, VK_COMPARE_OP_ALWAYS>}},
    Fault{"depth-compare-equal",
          "equal-as-less-or-equal"_fault,
          {.depth_compare = compare<VK_COMPARE_OP_EQUAL, VK_COMPARE_OP_LESS_OR_EQUAL>}},
    Fault{"depth-compare-never",
          "never-as-always"_fault,
          {.depth_compare = compare<VK_COMPARE_OP_NEVER, VK_COMPARE_OP_ALWAYS>}},
    Fault{"depth-compare-mirrored",
          "Less and greater are swapped in the depth test.",
          {.depth_compare = mirror_compare}},
    Fault{"depth-compare-off",
          "depth-test-ignored"_fault,
          {.depth_compare = [](VkCompareOp& op) { return change(op, VK_COMPARE_OP_ALWAYS); }}},
    Fault{"depth-test-off",
          "depth-test-off"_fault,
          {.pipeline = [](PipelineCopy& p) { return change(p.depth.depthTestEnable, VK_FALSE); }}},
    Fault{"depth-write-off",
          "depth-write-off"_fault,
          {.depth_write = [](VkBool32& w) { return change(w, VK_FALSE); }}},
    Fault{"depth-write-on",
          "depth-write-ignored"_fault,
          {.depth_write = [](VkBool32& w) { return change(w, VK_TRUE); }}},
    Fault{"depth-bounds-off",
          "bounds-ignored"_fault,
          {.depth_bounds_enable = [](VkBool32& e) { return change(e, VK_FALSE); }}},
    Fault{"depth-bounds-no-max",
          "bounds-without-max"_fault,
          {.depth_bounds = [](DepthBounds& b) { return change(b.max, 1); }}},
    Fault{"depth-bias-off",
          "bias-ignored"_fault,
          {.depth_bias_enable = [](VkBool32& e) { return change(e, VK_FALSE); }}},
    Fault{"depth-bias-no-constant",
          "bias-no-constant"_fault,
          {.depth_bias = [](DepthBias& b) { return change(b.constant, 0); }}},
    Fault{"depth-bias-constant-doubled",
          "bias-constant-doubled"_fault,
          {.depth_bias = [](DepthBias& b) { return change(b.constant, 2 * b.constant); }}},
    Fault{"depth-bias-no-slope",
          "bias-no-slope"_fault,
          {.depth_bias = [](DepthBias& b) { return change(b.slope, 0); }}},
    Fault{"depth-bias-slope-negated",
          "bias-slope-negated"_fault,
          {.depth_bias = [](DepthBias& b) { return change(b.slope, -b.slope); }}},
    Fault{"depth-bias-slope-halved",
          "bias-slope-halved"_fault,
          {.depth_bias = [](DepthBias& b) { return change(b.slope, b.slope / 2); }}},
    Fault{"depth-bias-no-clamp",
          "bias-clamp-ignored"_fault,
          {.depth_bias = [](DepthBias& b) { return change(b.clamp, 0); }}},
    Fault{"depth-bias-clamp-negated",
          "bias-clamp-negated"_fault,
          {.depth_bias = [](DepthBias& b) { return change(b.clamp, -b.clamp); }}},
    Fault{"depth-clamp-off",
          "depth-clamp-off"_fault,
          {.pipeline =
               [](PipelineCopy& p) { return change(p.rasterization.depthClampEnable, VK_FALSE); }}},
    Fault{"depth-clamp-on",
          "Depth is clamped where it is to be clipped.",
          {.pipeline =
               [](PipelineCopy& p) { return change(p.rasterization.depthClampEnable, VK_TRUE); }}},
    Fault{"depth-clip-flipped", "depth-clip-flipped"_fault, {.pipeline = flip_depth_clip}},
    Fault{"depth-clip-zero-to-one",
          "Depth from -1 to 1 is clipped and mapped as if from 0 to 1.",
          {.pipeline = no_clip_control}},
    Fault{
        "stencil-off",
        "stencil-off"_fault,
        {.pipeline = [](PipelineCopy& p) { return change(p.depth.stencilTestEnable, VK_FALSE); }}},
    Fault{"stencil-back-as-front",
          "The stencil operation of front faces is used for back faces.",
          {.stencil_ops = front_for_back<StencilOps>}},
    Fault{"stencil-clamps",
          "The stencil decrement stops at 0 instead of wrapping.",
          {.stencil_ops =
               operate<VK_STENCIL_OP_DECREMENT_AND_WRAP, VK_STENCIL_OP_DECREMENT_AND_CLAMP>}},
};

}  // namespace

std::span<const Fault> depth_faults() {
    return kDepthFaults;
}

}  // namespace breaking
