// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
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
    context.known_keys(value, "depth", {"compare", "write", "bias", "clamp", "clip"});
    context.read(value, "compare", state.compare);
    context.read(value, "write", state.write);
    if (const TomlValue* bias = value.find("bias")) {
        state.bias = read_bias(context, *bias);
    }
    context.read(value, "clamp", state.clamp);
    context.read(value, "clip", state.clip);
    return state;
}

}  // namespace cases
