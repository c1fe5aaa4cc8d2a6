// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a case is drawn to: size, samples, layers, depth, stencil and colour attachments.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cases/base/fields.hpp"
#include "cases/format/depth_format.hpp"
#include "cases/model/color_state.hpp"

namespace cases {

inline constexpr float kDepthClear = 0.375F;       // unless the case says otherwise
inline constexpr uint32_t kMaxTargetSize = 16384;  // pixels a side
inline constexpr uint32_t kMaxLayers = 256;  // every device with layered rendering has as many

// How the samples of a pixel become one value at the end of rendering (VkResolveModeFlagBits).
enum class Resolve : uint8_t { none, sample_zero, average, min, max };

// What is attached: all with what counts hits, or these alone (beside a stencil that the target
// has).
enum class Attachments : uint8_t { all, color, color_depth, depth, stencil };

// What the picture is: of images that are copied from; of images without transfer usage, which a
// shader reads; of the second time that the same commands are submitted, with other vertices; of
// images that have more columns and rows, other layers and, with one sample, other mip levels.
enum class Frame : uint8_t { copied, sampled, second, part };

struct Target {
    uint32_t width = 0, height = 0;  // pixels
    uint32_t samples = 1;
    uint32_t layers = 1;  // 1..kMaxLayers, all of one size
    DepthFormat depth_format = DepthFormat::d32_float;
    bool names_depth = false;  // the format is what the case is about: no other stands for it
    // Custom sample locations in 1/16 pixel, one a sample; empty: the standard ones.
    std::vector<std::array<uint8_t, 2>> sample_locations = {};
    std::optional<ColorTarget> color = {};  // that is judged
    // Those drawn beside it, in the order of their locations, and its own among them.
    std::vector<ColorTarget> other_colors = {};
    uint32_t judged_color = 0;
    // False: nothing that counts hits is attached. Drivers take other paths then.
    bool has_instruments = true;
    bool has_depth = true;
    float depth_clear = kDepthClear;  // what the depth attachment is cleared to, 0..1
    LoadOp depth_load = LoadOp::clear, stencil_load = LoadOp::clear;
    StoreOp depth_store = StoreOp::store, stencil_store = StoreOp::store;  // else not judged
    // With several samples: average of numbers, sample_zero of integers; any of depth; of a stencil
    // any but average.
    Resolve color_resolve = Resolve::none, depth_resolve = Resolve::none,
            stencil_resolve = Resolve::none;
    bool has_stencil = false;    // 8 bits, in one image with the depth if there is one
    uint32_t stencil_clear = 0;  // what the stencil is cleared to, 0..255
    Frame frame = Frame::copied;
    Attachments attachments() const {
        return has_instruments ? Attachments::all
               : color         ? (has_depth ? Attachments::color_depth : Attachments::color)
                               : (has_depth ? Attachments::depth : Attachments::stencil);
    }
    // Whether some aspect begins with contents that nobody knows, other ones in each rendering.
    bool has_unknown_contents() const {
        const auto loads = [](const ColorTarget& t) { return t.load == LoadOp::dont_care; };
        return depth_load == LoadOp::dont_care || stencil_load == LoadOp::dont_care ||
               (color && loads(*color)) || std::ranges::any_of(other_colors, loads);
    }
    // Whether some aspect's load operation is none.
    bool loads_nothing() const {
        const auto is_none = [](const ColorTarget& t) { return t.load == LoadOp::none; };
        return depth_load == LoadOp::none || stencil_load == LoadOp::none ||
               (color && is_none(*color)) || std::ranges::any_of(other_colors, is_none);
    }
    // Whether some aspect has other operations than to be cleared and stored.
    bool has_operations() const {
        const auto loads = [](const ColorTarget& t) {
            return t.load != LoadOp::clear || t.store != StoreOp::store;
        };
        return depth_load != LoadOp::clear || stencil_load != LoadOp::clear ||
               depth_store != StoreOp::store || stencil_store != StoreOp::store ||
               (color && loads(*color)) || std::ranges::any_of(other_colors, loads);
    }
    // Whether a shader reads it back, and no copy.
    bool is_read_by_shader() const { return samples > 1 || frame == Frame::sampled; }
    // Rows of pixels of all layers, stacked: row y of layer k is row k * height + y of every plane.
    uint32_t rows() const { return height * layers; }
    // Colour targets, and the one of a location (below color_count()).
    uint32_t color_count() const {
        return color ? static_cast<uint32_t>(other_colors.size()) + 1 : 0;
    }
    const ColorTarget& color_at(uint32_t location) const {
        return location == judged_color
                   ? *color
                   : other_colors.at(location - (location > judged_color ? 1U : 0U));
    }
    static void fields(auto&& visit, auto&... t) {
        visit("width", t.width...);
        visit("height", t.height...);
        visit("samples", t.samples...);
        visit("layers", t.layers...);
        visit("sample_locations", t.sample_locations...);
        visit("depth", t.has_depth...);
        visit("depth_format", t.depth_format...);
        visit({"names_depth", kNotExported}, t.names_depth...);
        visit("depth_clear", t.depth_clear...);
        visit("color", t.color...);
        // What is judged does not depend on them, and nothing else is delivered.
        visit({"other_colors", kNotExported}, t.other_colors...);
        visit({"judged_color", kNotExported}, t.judged_color...);
        visit("stencil", t.has_stencil...);
        visit("stencil_clear", t.stencil_clear...);
        visit({"depth_load", kNotExported}, t.depth_load...);
        visit({"stencil_load", kNotExported}, t.stencil_load...);
        visit({"depth_store", kNotExported}, t.depth_store...);
        visit({"stencil_store", kNotExported}, t.stencil_store...);
        visit("color_resolve", t.color_resolve...);
        visit("depth_resolve", t.depth_resolve...);
        visit("stencil_resolve", t.stencil_resolve...);
        // How this program looks.
        visit({"instruments", kNotExported}, t.has_instruments...);
        visit({"frame", kNotExported}, t.frame...);
    }
    friend bool operator==(const Target&, const Target&) = default;
};

}  // namespace cases
