// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/load/depth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace cases {

namespace {

// "minDepthBounds must be between 0.0 and 1.0, inclusive" (Vulkan specification,
// vkCmdSetDepthBounds), as maxDepthBounds must.
std::optional<DepthBounds> read_bounds(LeafContext& context, const TomlValue& value) {
    const auto ends = context.depths(value, "bounds", "a depth bound");
    if (ends && ends->front() > ends->back()) {
        context.error(value.where,
                      "no depth lies in bounds whose minimum is larger than their maximum; write "
                      "[minimum, maximum]");
    }
    return ends ? std::optional(DepthBounds{ends->front(), ends->back()}) : std::nullopt;
}

}  // namespace

DepthState read_depth_state(LeafContext& context, const TomlValue& value) {
    DepthState state;
    if (!context.table(value, "depth")) {
        return state;
    }
    context.known_keys(value, kDepthKeys);
    context.read_all(value, kDepthKeys, state);
    if (const TomlValue* bias = value.find("bias");
        bias != nullptr && context.table(*bias, "bias")) {
        context.known_keys(*bias, kBiasKeys);
        context.read_all(*bias, kBiasKeys, state.bias.emplace());
    }
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
    context.known_keys(value, kStencilKeys);
    StencilState state{{}, {}};
    context.read_all(value, kStencilFaceKeys, state.front);
    state.back = state.front;
    for (const auto& [key, face] :
         {std::pair("front", &state.front), std::pair("back", &state.back)}) {
        const TomlValue* own = value.find(key);
        if (own == nullptr || !context.table(*own, key)) {
            continue;
        }
        context.known_keys(*own, kStencilFaceKeys, key);
        context.read_all(*own, kStencilFaceKeys, *face);
    }
    return state;
}

namespace {

void check_written(LeafContext& context, const TomlValue& table, const char* key, float out) {
    if (const TomlValue* value = table.find(key)) {
        if (!std::isfinite(out)) {
            context.error(
                value->where,
                fmt::format("{} is no finite number, of which Vulkan does not say what is "
                            "stored",
                            key));
        } else if (std::fpclassify(out) == FP_SUBNORMAL) {
            context.error(value->where,
                          fmt::format("{} is a denormal number, which a shader may take for 0; "
                                      "write 0 or at least 2^-126",
                                      key));
        }
    }
}

// The depths that a draw's triangles may have before the shader replaces them; nothing if a vertex
// says too little of them.
std::optional<std::array<double, 2>> depths_of(const Draw& draw) {
    const auto near = static_cast<double>(draw.viewport.min_depth);
    const auto far = static_cast<double>(draw.viewport.max_depth);
    std::array<double, 2> out = {HUGE_VAL, -HUGE_VAL};
    for (const glm::vec4& p : draw.positions) {
        if (!(p.w > 0) || !std::isfinite(p.z) || !std::isfinite(p.w)) {
            return std::nullopt;
        }
        const double ndc = static_cast<double>(p.z) / static_cast<double>(p.w);
        const double z = draw.depth.negative_one_to_one ? (far - near) / 2 * ndc + (far + near) / 2
                                                        : (far - near) * ndc + near;
        out = {std::min(out[0], z), std::max(out[1], z)};
    }
    return out;
}

// "per-fragment tests may assume that any FragDepth ... value written by the shader is
// greater-than-or-equal to the fragment's interpolated depth value" (SPIR-V specification,
// DepthGreater): a promise that is not kept leaves all of it open.
void check_layout(LeafContext& context, const TomlValue& where, const Draw& draw) {
    constexpr double kMargin = 0x1p-16;  // far beyond what a device may be off
    const FragDepth& d = *draw.frag_depth;
    if (d.layout == DepthLayout::any) {
        return;
    }
    if (draw.depth.bias) {
        context.error(where.where,
                      "a layout promises something of the fragment's own depth, and this draw has "
                      "a bias; leave one of them out");
        return;
    }
    if (d.is_coord) {
        return;  // the depth itself, which every layout allows
    }
    const float least = d.where == Discard::none ? d.value : std::min(d.value, d.other);
    const float most = d.where == Discard::none ? d.value : std::max(d.value, d.other);
    const auto own = depths_of(draw);
    if (d.layout == DepthLayout::unchanged) {
        context.error(where.where,
                      "the layout \"unchanged\" promises the fragment's own depth; write from = "
                      "\"frag-coord\"");
    } else if (!own) {
        context.error(where.where,
                      "a vertex is behind the eye or has no finite depth, so that it is not known "
                      "whether the layout's promise is kept; leave layout out");
    } else if (d.layout == DepthLayout::greater &&
               static_cast<double>(least) < (*own)[1] + kMargin) {
        context.error(where.where,
                      fmt::format("the layout \"greater\" promises depths above the draw's own, "
                                  "which reach {:.9g}; write larger ones or leave layout out",
                                  (*own)[1]));
    } else if (d.layout == DepthLayout::less && static_cast<double>(most) > (*own)[0] - kMargin) {
        context.error(where.where,
                      fmt::format("the layout \"less\" promises depths below the draw's own, which "
                                  "begin at {:.9g}; write smaller ones or leave layout out",
                                  (*own)[0]));
    }
}

}  // namespace

FragDepth read_frag_depth(LeafContext& context, const TomlValue& value) {
    FragDepth d;
    if (!context.table(value, "frag_depth")) {
        return d;
    }
    context.known_keys(value, kFragDepthKeys);
    const size_t errors = context.errors().size();
    context.read_all(value, kFragDepthKeys, d);
    check_written(context, value, "value", d.value);
    check_written(context, value, "other", d.other);
    uint32_t from = 0;
    context.read(value, kFragDepthKeys, "from", from);
    d.is_coord = value.find("from") != nullptr;
    if (context.errors().size() > errors) {
        return d;
    }
    const bool has_value = value.find("value") != nullptr;
    const bool has_other = value.find("other") != nullptr;
    if (has_value == d.is_coord) {
        context.error(value.where, has_value ? "frag_depth has both value and from; keep one"
                                             : "frag_depth has no number; write value, or from = "
                                               "\"frag-coord\"");
    } else if (has_other != (d.where != Discard::none) || (has_other && d.is_coord)) {
        context.error(value.where,
                      "other is written where the pattern `where` says: they need value and each "
                      "other");
    }
    return d;
}

void check_frag_depth(LeafContext& context, const TomlValue& value, const Draw& draw) {
    const FragDepth& d = *draw.frag_depth;
    const auto [low, high] = std::minmax(draw.viewport.min_depth, draw.viewport.max_depth);
    const auto is_outside = [low = low, high = high](float z) { return z < low || z > high; };
    if (d.is_coord && draw.depth.bias) {
        context.error(
            value.where,
            "gl_FragCoord.z of a draw with a bias has the bias or not; leave out bias, or "
            "write a value");
    } else if (!d.is_coord && !draw.depth.clamp &&
               (is_outside(d.value) || (d.where != Discard::none && is_outside(d.other)))) {
        context.error(value.where,
                      fmt::format("without depth clamp Vulkan leaves undefined what becomes of a "
                                  "depth beyond the viewport's, {} to {}; write depth = {{ clamp = "
                                  "true }} or another number",
                                  low, high));
    } else {
        check_layout(context, value, draw);
    }
}

}  // namespace cases
