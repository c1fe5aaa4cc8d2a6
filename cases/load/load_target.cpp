// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "cases/base/counted.hpp"
#include "cases/load/color.hpp"
#include "cases/load/parts.hpp"
#include "cases/model/sample.hpp"

namespace cases {

namespace {

// Of all layers. A run takes some 320 bytes a sample, so 5 GiB for the most.
constexpr uint64_t kMaxTargetSamples = uint64_t{1} << 24;
constexpr int64_t kSixteenths = 16;  // the standard grid of sample locations, a pixel

void check_samples(LeafContext& context, const TomlValue& table, const Target& target) {
    if ((target.samples & (target.samples - 1)) != 0) {
        context.error(table.find("samples")->where,
                      fmt::format("{} samples have no standard locations; write 1, 2, 4, 8 or 16",
                                  target.samples));
    }
}

void read_locations(LeafContext& context, const TomlValue& table, Target& target) {
    const TomlValue* locations = table.find("sample_locations");
    if (locations == nullptr || !context.array(*locations, "sample_locations")) {
        return;
    }
    if (locations->array.size() != target.samples) {
        context.error(locations->where, fmt::format("sample_locations has {} for {}; write one "
                                                    "[x, y] a sample",
                                                    counted(locations->array.size(), "pair"),
                                                    counted(target.samples, "sample")));
        return;
    }
    for (const TomlValue& pair : locations->array) {
        if (!context.array_of(pair, "a sample location", 2, "[x, y] in sixteenths of a pixel")) {
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

// One table, or a list of them with the location of the one that is judged.
void read_color_targets(LeafContext& context, const TomlValue& table, Target& target) {
    const TomlValue* color = table.find("color");
    const TomlValue* judged = table.find("judged");
    const bool is_list = color != nullptr && color->is(TomlValue::Kind::array);
    if (judged != nullptr && !is_list) {
        context.error(judged->where,
                      "judged chooses from a list of colour targets; write color = [{ format = "
                      "...}, ...]");
        return;
    }
    if (color == nullptr) {
        return;
    }
    if (!is_list) {
        target.color = read_color_target(context, *color);
        return;
    }
    if (color->array.size() < 2 || color->array.size() > kMaxColorTargets) {
        context.error(color->where,
                      fmt::format("color lists {}; write 2 to {}, or a table for one",
                                  counted(color->array.size(), "colour target"), kMaxColorTargets));
        return;
    }
    std::vector<ColorTarget> all;
    for (const TomlValue& value : color->array) {
        all.push_back(read_color_target(context, value).value_or(ColorTarget{}));
    }
    context.read(table, kTargetKeys, "judged", target.judged_color,
                 static_cast<int64_t>(all.size()) - 1);
    target.color = all[target.judged_color];
    all.erase(all.begin() + target.judged_color);
    target.other_colors = std::move(all);
}

void read_attachments(LeafContext& context, const TomlValue& table, Target& target) {
    Attachments word = Attachments::all;
    context.read(table, kTargetKeys, "attachments", word);
    target.has_instruments = word == Attachments::all;
    target.has_depth = word != Attachments::color && word != Attachments::stencil;
    const bool has_color = word == Attachments::color || word == Attachments::color_depth;
    if (has_color && !target.color) {
        context.error(table.find("attachments")->where,
                      "attachments leaves nothing to draw to; write [target.color]");
    } else if (!has_color && !target.has_instruments && target.color) {
        context.error(table.find("attachments")->where,
                      "attachments leaves no place for a colour; leave out [target.color]");
    } else if (word == Attachments::stencil && !target.has_stencil) {
        context.error(table.find("attachments")->where,
                      "attachments leaves nothing to draw to; write stencil = true");
    }
}

void check_resolves(LeafContext& context, const TomlValue& table, const Target& target) {
    for (const auto& [key, mode] : {std::pair("resolve", target.color_resolve),
                                    std::pair("depth_resolve", target.depth_resolve),
                                    std::pair("stencil_resolve", target.stencil_resolve)}) {
        if (mode != Resolve::none && target.samples < 2) {
            context.error(table.find(key)->where,
                          fmt::format("{} needs several samples; write samples = 4", key));
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
    for (const auto& [key, mode, store] :
         {std::tuple("resolve", target.color_resolve,
                     target.color ? target.color->store : StoreOp::store),
          std::tuple("depth_resolve", target.depth_resolve, target.depth_store),
          std::tuple("stencil_resolve", target.stencil_resolve, target.stencil_store)}) {
        if (mode != Resolve::none && store != StoreOp::store) {
            context.error(table.find(key)->where,
                          fmt::format("{} is judged by the samples, which are not stored; leave "
                                      "out one of the two",
                                      key));
        }
    }
    if (target.stencil_resolve != Resolve::none && !target.has_stencil) {
        context.error(table.find("stencil_resolve")->where,
                      "stencil_resolve needs a stencil; write stencil = true");
    } else if (target.stencil_resolve == Resolve::average) {
        context.error(table.find("stencil_resolve")->where,
                      "Vulkan has no average of stencils; write sample-zero, min or max");
    }
}

// What a shader reads without a copy: 8-bit codes, and depths that binary32 holds.
void check_frame(LeafContext& context, const TomlValue& table, const Target& target) {
    if (target.frame == Frame::copied) {
        return;
    }
    const bool reads_all = (!target.color || target.color->format == ColorFormat::rgba8_unorm) &&
                           (!target.has_depth || target.depth_format != DepthFormat::d24_unorm) &&
                           !target.has_stencil && target.samples == 1;
    if (target.has_instruments || !target.other_colors.empty() ||
        (target.frame == Frame::sampled && !reads_all)) {
        context.error(
            table.find("frame")->where,
            target.frame != Frame::sampled
                ? "frame is of a picture without what counts hits, and of one colour; "
                  "write attachments"
                : "what is sampled is one rgba8-unorm, a depth but d24-unorm, or both, of "
                  "one sample; write attachments, and no stencil");
    }
}

void check_stencil(LeafContext& context, const TomlValue& table, const Target& target) {
    for (const char* key : {"depth_load", "depth_store", "stencil_load", "stencil_store"}) {
        const TomlValue* value = table.find(key);
        if (value != nullptr && !(key[0] == 'd' ? target.has_depth : target.has_stencil)) {
            context.error(value->where,
                          fmt::format("the target has no such attachment; leave out {}", key));
        }
    }
    if (const TomlValue* clear = table.find("stencil_clear"); clear && !target.has_stencil) {
        context.error(clear->where, "the target has no stencil; write stencil = true");
    }
}

}  // namespace

Target load_target(LeafContext& context, const TomlValue& table) {
    Target target;
    context.known_keys(table, kTargetKeys);
    context.read_all(table, kTargetKeys, target);
    target.names_depth = table.find("depth") != nullptr;
    check_samples(context, table, target);
    read_locations(context, table, target);
    read_color_targets(context, table, target);
    read_attachments(context, table, target);
    check_resolves(context, table, target);
    check_stencil(context, table, target);
    check_frame(context, table, target);
    const auto size = context.read_size(table, "[target]", "the target", kMaxTargetSize);
    if (!size) {
        return target;
    }
    target.width = size->front();
    target.height = size->back();
    if (uint64_t{target.width} * target.height * target.layers * target.samples >
        kMaxTargetSamples) {
        context.error(table.find("size")->where,
                      "the target has more than 2^24 samples; make it smaller");
    }
    return target;
}

namespace {

// gl_SampleMaskIn reaches the capture as a number below 2^16 (ref/value/sample_values.cpp).
constexpr uint32_t kMaxMaskInSamples = 16;

bool is_shaded_by_sample(const Attribute& a) {
    return a.auxiliary == Auxiliary::sample || a.source == Source::sample_id ||
           a.source == Source::sample_position;
}

bool has_rate(const Attribute& a) {
    return a.source == Source::shading_rate;
}

// What a draw has that does not go with fragments of several pixels; empty if there is nothing.
// "If Sample Shading is enabled", the final rate is {1,1}. Of the others either no text says what
// is right (distances at a sample are tested somewhere in the fragment, where an enlarged
// primitive's centroid lies), or what is right is another thing than of one pixel: derivatives are
// those between fragments, offsets and masks are numbered by the fragment, and what a shader
// discards or writes is one for all pixels.
const char* obstacle(const Draw& draw, const Target& target) {
    const auto any = [&](auto&& has) { return std::ranges::any_of(draw.attributes, has); };
    if (draw.multisample.min_sample_shading || any(is_shaded_by_sample)) {
        return "sample shading";
    }
    if (!target.sample_locations.empty()) {
        return "sample_locations";
    }
    if (draw.conservative != Conservative::none) {
        return "conservative";
    }
    if (draw.distances.clip_count > 0 || draw.distances.cull_count > 0) {
        return "clip and cull distances";
    }
    if (draw.discard != Discard::none && draw.discard != Discard::front &&
        draw.discard != Discard::back) {
        return "a discard by pixels or values";
    }
    if (draw.frag_depth) {
        return "frag_depth";
    }
    if (draw.multisample.shader_mask) {
        return "shader_mask";
    }
    if (draw.color.alpha_to_coverage) {
        return "alpha_to_coverage";
    }
    if (draw.query == Query::fragment_invocations) {
        return "a query of fragment invocations";
    }
    if (any([](const Attribute& a) { return a.probe != Probe::value; })) {
        return "probes";
    }
    if (any([](const Attribute& a) { return a.source == Source::barycentric; })) {
        return "barycentric inputs";
    }
    return nullptr;
}

}  // namespace

void read_fragment_size(LeafContext& context, const TomlValue& table, Draw& draw) {
    const TomlValue* value = table.find("fragment_size");
    if (value == nullptr || !context.array_of(*value, "fragment_size", 2, "[width, height]")) {
        return;
    }
    for (size_t k = 0; k < 2; ++k) {
        const std::optional<int64_t> side =
            context.integer(value->array[k], "fragment_size", 1, kMaxFragmentSide);
        if (side && *side == 3) {
            context.error(value->array[k].where, "a side of fragment_size is 1, 2 or 4, not 3");
        } else if (side) {
            draw.fragment_size.at(k) = static_cast<uint32_t>(*side);
        }
    }
}

void check_fragment_size(LeafContext& context, const TomlValue& table, const Draw& draw,
                         const Target& target) {
    const auto any = [&](auto&& has) { return std::ranges::any_of(draw.attributes, has); };
    if (any(has_rate) && any([](const Attribute& a) {
            return a.probe != Probe::value ||
                   (a.source != Source::vertex && a.source != Source::sample_mask_in &&
                    a.source != Source::shading_rate);
        })) {
        context.error(table.find("attribute")->where,
                      "no shader here reads the shading rate beside probes, barycentric inputs, "
                      "gl_SampleID and gl_SamplePosition; put them into two draws");
    }
    if (any(has_rate) && (target.color || draw.multisample.shader_mask || draw.frag_depth ||
                          draw.discard != Discard::none)) {
        context.error(table.find("attribute")->where,
                      "no shader here reads the shading rate and writes a colour, a sample mask or "
                      "a depth, or discards; leave out one of them");
    }
    if (!has_large_fragments(draw)) {
        return;
    }
    const SourceLocation& where = table.find("fragment_size")->where;
    if (const char* other = obstacle(draw, target)) {
        context.error(
            where, fmt::format("fragment_size does not go with {}; leave out one of them", other));
        return;
    }
    const uint32_t samples = samples_of_fragment(draw, target);
    const bool has_mask =
        any([](const Attribute& a) { return a.source == Source::sample_mask_in; });
    const uint32_t most = has_mask ? kMaxMaskInSamples : kMaxFragmentSamples;
    if (samples > most) {
        context.error(where,
                      fmt::format("a fragment of {} x {} pixels has {} samples, at most {} are "
                                  "judged{}; write a smaller one",
                                  draw.fragment_size[0], draw.fragment_size[1], samples, most,
                                  has_mask ? " with source = \"sample-mask-in\"" : ""));
    }
}

}  // namespace cases
