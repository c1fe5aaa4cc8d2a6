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
    const auto read = [&](const char* key, float& member) {
        if (const TomlValue* number = value.find(key)) {
            member = context.binary32(*number, key).value_or(0.0F);
        }
    };
    read("constant", bias.constant);
    read("slope", bias.slope);
    read("clamp", bias.clamp);
    if (const TomlValue* word = value.find("representation")) {
        bias.representation = context.enumerator<DepthBiasRepresentation>(*word, "representation")
                                  .value_or(DepthBiasRepresentation::format);
    }
    if (const TomlValue* exact = value.find("exact")) {
        bias.is_exact = context.boolean(*exact, "exact").value_or(false);
    }
    return bias;
}

}  // namespace

void read_depth_target(LeafContext& context, const TomlValue& table, Target& target) {
    if (const TomlValue* value = table.find("depth")) {
        target.depth_format =
            context.enumerator<DepthFormat>(*value, "depth").value_or(DepthFormat::d32_float);
    }
    if (const TomlValue* value = table.find("depth_clear")) {
        const std::optional<Number> number = context.number(*value, "depth_clear");
        if (number && (number->value < 0 || number->value > 1)) {
            context.error(value->where, "depth_clear is outside 0..1, which Vulkan does not allow");
        } else if (number) {
            target.depth_clear = round_to_binary32(*number).value;
        }
    }
}

DepthState read_depth_state(LeafContext& context, const TomlValue& value) {
    DepthState state;
    if (!context.table(value, "depth")) {
        return state;
    }
    context.known_keys(value, "depth", {"compare", "write", "bias", "clamp", "clip"});
    if (const TomlValue* compare = value.find("compare")) {
        state.compare =
            context.enumerator<CompareOp>(*compare, "compare").value_or(CompareOp::never);
    }
    if (const TomlValue* write = value.find("write")) {
        state.write = context.boolean(*write, "write").value_or(true);
    }
    if (const TomlValue* bias = value.find("bias")) {
        state.bias = read_bias(context, *bias);
    }
    if (const TomlValue* clamp = value.find("clamp")) {
        state.clamp = context.boolean(*clamp, "clamp").value_or(false);
    }
    if (const TomlValue* clip = value.find("clip")) {
        state.clip = context.boolean(*clip, "clip");
    }
    return state;
}

}  // namespace cases
