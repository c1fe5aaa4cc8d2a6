// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "cases/load/color.hpp"
#include "cases/load/parts.hpp"

namespace cases {

namespace {

constexpr uint64_t kMaxPixels = uint64_t{1} << 26;
constexpr uint32_t kMaxSamples = 16;
constexpr int64_t kSixteenths = 16;  // the standard grid of sample locations, a pixel

void read_samples(LeafContext& context, const TomlValue& table, Target& target) {
    const TomlValue* samples = table.find("samples");
    if (samples == nullptr) {
        return;
    }
    const std::optional<int64_t> n = context.integer(*samples, "samples", 1, kMaxSamples);
    if (!n) {
        return;
    }
    target.samples = static_cast<uint32_t>(*n);
    if ((target.samples & (target.samples - 1)) != 0) {
        context.error(samples->where,
                      fmt::format("{} samples have no standard locations; write 1, 2, 4, 8 or 16",
                                  target.samples));
    }
}

void read_layers(LeafContext& context, const TomlValue& table, Target& target) {
    if (const TomlValue* layers = table.find("layers")) {
        target.layers =
            static_cast<uint32_t>(context.integer(*layers, "layers", 1, kMaxLayers).value_or(1));
    }
}

void read_locations(LeafContext& context, const TomlValue& table, Target& target) {
    const TomlValue* locations = table.find("sample_locations");
    if (locations == nullptr || !context.array(*locations, "sample_locations")) {
        return;
    }
    if (locations->array.size() != target.samples) {
        context.error(locations->where,
                      fmt::format("sample_locations has {} entries for {} sample(s); write one "
                                  "[x, y] a sample",
                                  locations->array.size(), target.samples));
        return;
    }
    for (const TomlValue& pair : locations->array) {
        if (!context.array(pair, "a sample location")) {
            return;
        }
        if (pair.array.size() != 2) {
            context.error(pair.where, fmt::format("a sample location has {} numbers; write [x, y] "
                                                  "in sixteenths of a pixel",
                                                  pair.array.size()));
            return;
        }
        std::array<uint8_t, 2> location{};
        for (size_t k = 0; k < 2; ++k) {
            location.at(k) = static_cast<uint8_t>(
                context.integer(pair.array[k], "a sample location", 0, kSixteenths - 1)
                    .value_or(0));
        }
        target.sample_locations.push_back(location);
    }
}

void read_attachments(LeafContext& context, const TomlValue& table, Target& target) {
    constexpr std::array<std::string_view, 3> kAttachments = {"all", "color", "color+depth"};
    const TomlValue* value = table.find("attachments");
    if (value == nullptr) {
        return;
    }
    const std::optional<size_t> word = context.word(*value, "attachments", kAttachments);
    if (!word) {
        return;
    }
    target.has_instruments = *word == 0;
    target.has_depth = *word != 1;
    if (*word != 0 && !target.color) {
        context.error(value->where, "attachments leaves nothing to draw to; write [target.color]");
    }
}

void read_resolve(LeafContext& context, const TomlValue& table, const char* key, uint32_t samples,
                  Resolve& to) {
    const TomlValue* value = table.find(key);
    if (value == nullptr) {
        return;
    }
    to = context.enumerator<Resolve>(*value, key).value_or(Resolve::none);
    if (to != Resolve::none && samples < 2) {
        context.error(value->where,
                      fmt::format("{} needs several samples; write samples = 4", key));
    }
}

void read_resolves(LeafContext& context, const TomlValue& table, Target& target) {
    read_resolve(context, table, "resolve", target.samples, target.color_resolve);
    read_resolve(context, table, "depth_resolve", target.samples, target.depth_resolve);
    for (const char* key : {"resolve", "depth_resolve"}) {
        const bool is_on =
            (key[0] == 'r' ? target.color_resolve : target.depth_resolve) != Resolve::none;
        if (is_on && target.layers > 1) {
            context.error(table.find(key)->where,
                          fmt::format("{} does not go with several layers; leave out layers", key));
        }
    }
    if (target.color_resolve != Resolve::none) {
        const SourceLocation& where = table.find("resolve")->where;
        if (!target.color) {
            context.error(where, "resolve needs a colour target; write [target.color]");
        } else if (target.color_resolve !=
                   (is_integer(target.color->format) ? Resolve::sample_zero : Resolve::average)) {
            context.error(where,
                          "Vulkan resolves colours of integers by sample-zero and all others by "
                          "average; write that one");
        }
    }
    if (target.depth_resolve != Resolve::none && !target.has_depth) {
        context.error(table.find("depth_resolve")->where,
                      "depth_resolve needs a depth attachment; leave out attachments");
    }
}

void read_stencil(LeafContext& context, const TomlValue& table, Target& target) {
    const TomlValue* value = table.find("stencil");
    if (value == nullptr) {
        return;
    }
    target.has_stencil = context.boolean(*value, "stencil").value_or(false);
    if (target.has_stencil &&
        (!target.has_instruments || target.depth_format != DepthFormat::d32_float)) {
        context.error(value->where,
                      "stencil is judged by the hit counter and lies beside d32-float; leave out "
                      "attachments and depth");
    }
}

}  // namespace

Target load_target(LeafContext& context, const TomlValue& table) {
    Target target;
    context.known_keys(table, "[target]",
                       {"size", "samples", "layers", "sample_locations", "depth", "depth_clear",
                        "color", "attachments", "resolve", "depth_resolve", "stencil"});
    read_depth_target(context, table, target);
    read_samples(context, table, target);
    read_layers(context, table, target);
    read_locations(context, table, target);
    if (const TomlValue* color = table.find("color")) {
        target.color = read_color_target(context, *color);
    }
    read_attachments(context, table, target);
    read_resolves(context, table, target);
    read_stencil(context, table, target);
    const TomlValue* size = table.find("size");
    if (size == nullptr) {
        context.error(table.where, "[target] has no size; write size = [width, height]");
        return target;
    }
    if (!context.array(*size, "size")) {
        return target;
    }
    if (size->array.size() != 2) {
        context.error(size->where, fmt::format("size has {} numbers; write [width, height]",
                                               size->array.size()));
        return target;
    }
    const auto side = [&](size_t i, const char* what) {
        return static_cast<uint32_t>(
            context.integer(size->array[i], what, 1, kMaxTargetSize).value_or(0));
    };
    target.width = side(0, "the target's width");
    target.height = side(1, "the target's height");
    if (uint64_t{target.width} * target.height * target.layers * target.samples > kMaxPixels) {
        context.error(size->where, target.samples == 1
                                       ? "the target has more than 2^26 pixels; make it smaller"
                                       : "the target has more than 2^26 samples; make it smaller");
    }
    return target;
}

Multisample load_multisample(LeafContext& context, const TomlValue& draw) {
    Multisample state;
    const auto mask = [&](const char* key) -> std::optional<uint32_t> {
        const TomlValue* value = draw.find(key);
        if (value == nullptr) {
            return std::nullopt;
        }
        const std::optional<int64_t> bits = context.integer(*value, key, 0, UINT32_MAX);
        return bits ? std::optional(static_cast<uint32_t>(*bits)) : std::nullopt;
    };
    state.sample_mask = mask("sample_mask").value_or(state.sample_mask);
    state.shader_mask = mask("shader_mask");
    if (const TomlValue* value = draw.find("min_sample_shading")) {
        const std::optional<Number> number = context.number(*value, "min_sample_shading");
        if (number && (number->value < 0 || number->value > 1)) {
            context.error(value->where,
                          "min_sample_shading is outside 0..1; write the fraction of the samples "
                          "that is shaded at least");
        } else if (number) {
            state.min_sample_shading = round_to_binary32(*number).value;
        }
    }
    return state;
}

}  // namespace cases
