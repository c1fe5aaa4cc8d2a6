// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cases/load/color.hpp"
#include "cases/load/parts.hpp"
#include "cases/model/derive.hpp"

namespace cases {

namespace {

constexpr size_t kMaxRects = 256;

// "The rectangular region ... must be contained within the render area", and is not empty
// (VUID-vkCmdClearAttachments-pRects-00016, -rect-02682, -rect-02683).
std::optional<Rect> read_rect(LeafContext& context, const TomlValue& value, const Target& target) {
    if (!context.numbers(value, "a rectangle", 4)) {
        return std::nullopt;
    }
    const std::array<uint32_t, 2> sides = {target.width, target.height};
    std::array<int64_t, 4> n{};
    for (size_t k = 0; k < 4; ++k) {
        const std::optional<int64_t> number =
            context.integer(value.array[k], "a rectangle", k < 2 ? 0 : 1, sides.at(k % 2));
        if (!number) {
            return std::nullopt;
        }
        n.at(k) = *number;
    }
    if (n[0] + n[2] > target.width || n[1] + n[3] > target.height) {
        context.error(value.where, "a rectangle reaches beyond the target, which Vulkan forbids");
        return std::nullopt;
    }
    return Rect{static_cast<int32_t>(n[0]), static_cast<int32_t>(n[1]), static_cast<uint32_t>(n[2]),
                static_cast<uint32_t>(n[3])};
}

void read_rects(LeafContext& context, const TomlValue* value, const Target& target, Clear& out) {
    if (value == nullptr) {
        out.rects.push_back({0, 0, target.width, target.height});
        return;
    }
    if (!context.array(*value, "rects")) {
        return;
    }
    for (const TomlValue& each : value->array) {
        if (const std::optional<Rect> rect = read_rect(context, each, target)) {
            out.rects.push_back(*rect);
        }
    }
    if (value->array.empty() || value->array.size() > kMaxRects) {
        context.error(value->where, fmt::format("a clear has 1 to {} rectangles, not {}", kMaxRects,
                                                value->array.size()));
    }
}

}  // namespace

Draw load_clear(LeafContext& context, const TomlValue& table, const TomlValue& value,
                const Target& target) {
    Clear clear;
    Draw named;
    if (!context.table(value, "clear")) {
        return named;
    }
    context.known_keys(value, kClearKeys);
    context.known_keys(table, "a [[draw]] with clear",
                       std::to_array<std::string_view>({"clear", "layer"}));
    context.read_all(value, kClearKeys, clear);
    context.read(table, kDrawKeys, "layer", named.layer);
    read_rects(context, value.find("rects"), target, clear);
    const TomlValue* color = value.find("color");
    if (color != nullptr && target.color) {
        clear.color = read_color(context, *color, "color", target.color->format);
    }
    const auto lacks = [&](const char* key, bool has) {
        if (value.find(key) != nullptr && !has) {
            context.error(value.find(key)->where,
                          fmt::format("the target has no {}; leave it out of the clear", key));
        }
        return value.find(key) == nullptr;
    };
    const bool has_no_color = lacks("color", target.color.has_value());
    const bool has_no_depth = lacks("depth", target.has_depth);
    if (lacks("stencil", target.has_stencil) && has_no_color && has_no_depth) {
        context.error(value.where, "the clear clears nothing; write color, depth or stencil");
    }
    if (uint64_t{named.layer} + clear.layers > target.layers) {
        context.error(value.where, fmt::format("the clear reaches layer {}, and the target has {}",
                                               named.layer + clear.layers - 1, target.layers));
    }
    Draw out = clear_draw(target, std::move(clear), named.layer);
    out.where = table.where;
    return out;
}

}  // namespace cases
