// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <optional>
#include <utility>

#include "cases/load/parts.hpp"

namespace cases {

namespace {

DepthBias read_bias(LeafContext& context, const TomlValue& value) {
    DepthBias bias;
    if (!context.table(value, "bias")) {
        return bias;
    }
    context.known_keys(value, "bias", {"constant", "slope", "clamp", "representation", "exact"});
    context.read(value, "constant", bias.constant);
    context.read(value, "slope", bias.slope);
    context.read(value, "clamp", bias.clamp);
    context.read(value, "representation", bias.representation);
    context.read(value, "exact", bias.is_exact);
    return bias;
}

// "minDepthBounds must be between 0.0 and 1.0, inclusive" (Vulkan specification,
// vkCmdSetDepthBounds), as maxDepthBounds must.
std::optional<DepthBounds> read_bounds(LeafContext& context, const TomlValue& value) {
    const auto numbers = context.numbers(value, "bounds", 2);
    if (!numbers) {
        return std::nullopt;
    }
    for (size_t k = 0; k < 2; ++k) {
        if ((*numbers)[k].value < 0 || (*numbers)[k].value > 1) {
            context.error(value.array[k].where,
                          "a depth bound is outside 0..1, which Vulkan does not allow");
            return std::nullopt;
        }
    }
    const DepthBounds out{round_to_binary32((*numbers)[0]).value,
                          round_to_binary32((*numbers)[1]).value};
    if (out.min > out.max) {
        context.error(value.where,
                      "no depth lies in bounds whose minimum is larger than their maximum; write "
                      "[minimum, maximum]");
    }
    return out;
}

// Masks may have more bits than the attachment, which count for nothing. "The reference value used
// by stencil comparison must be within the range [0,2^s-1] ..., otherwise the reference value is
// considered undefined" (Vulkan specification, VkStencilOpState).
void read_face(LeafContext& context, const TomlValue& table, StencilFace& face) {
    context.read(table, "compare", face.compare);
    context.read(table, "fail", face.fail);
    context.read(table, "depth_fail", face.depth_fail);
    context.read(table, "pass", face.pass);
    context.read(table, "compare_mask", face.compare_mask, 0, UINT32_MAX);
    context.read(table, "write_mask", face.write_mask, 0, UINT32_MAX);
    context.read(table, "reference", face.reference, 0, kStencilBits);
}

}  // namespace

void read_depth_target(LeafContext& context, const TomlValue& table, Target& target) {
    context.read(table, "depth", target.depth_format);
    context.read_fraction(table, "depth_clear", target.depth_clear,
                          ", which Vulkan does not allow");
}

DepthState read_depth_state(LeafContext& context, const TomlValue& value) {
    DepthState state;
    if (!context.table(value, "depth")) {
        return state;
    }
    context.known_keys(value, "depth", {"compare", "write", "bias", "clamp", "clip", "bounds"});
    context.read(value, "compare", state.compare);
    context.read(value, "write", state.write);
    if (const TomlValue* bias = value.find("bias")) {
        state.bias = read_bias(context, *bias);
    }
    context.read(value, "clamp", state.clamp);
    context.read(value, "clip", state.clip);
    if (const TomlValue* bounds = value.find("bounds")) {
        state.bounds = read_bounds(context, *bounds);
    }
    return state;
}

StencilState read_stencil_state(LeafContext& context, const TomlValue& value,
                                const Target& target) {
    if (!target.has_stencil) {
        context.error(value.where, "the target has no stencil; write stencil = true in [target]");
        return {};
    }
    if (!context.table(value, "stencil")) {
        return {};
    }
    context.known_keys(value, "stencil",
                       {"compare", "fail", "depth_fail", "pass", "compare_mask", "write_mask",
                        "reference", "front", "back"});
    StencilState state{{}, {}};
    read_face(context, value, state.front);
    state.back = state.front;
    for (const auto& [key, face] :
         {std::pair("front", &state.front), std::pair("back", &state.back)}) {
        const TomlValue* own = value.find(key);
        if (own == nullptr || !context.table(*own, key)) {
            continue;
        }
        context.known_keys(
            *own, key,
            {"compare", "fail", "depth_fail", "pass", "compare_mask", "write_mask", "reference"});
        read_face(context, *own, *face);
    }
    return state;
}

}  // namespace cases
