// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a colour target is, and what a draw writes to it.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>

#include "cases/base/fields.hpp"
#include "cases/format/color_format.hpp"

namespace cases {

// Blending of the colour target.
enum class BlendFactor : uint8_t {  // numbered as VkBlendFactor
    zero,
    one,
    src_color,
    one_minus_src_color,
    dst_color,
    one_minus_dst_color,
    src_alpha,
    one_minus_src_alpha,
    dst_alpha,
    one_minus_dst_alpha,
    constant_color,
    one_minus_constant_color,
    constant_alpha,
    one_minus_constant_alpha,
    src_alpha_saturate,
    // Of the second source colour (dual-source blending).
    src1_color,
    one_minus_src1_color,
    src1_alpha,
    one_minus_src1_alpha
};
constexpr bool is_second(BlendFactor factor) {
    return factor >= BlendFactor::src1_color;
}
enum class BlendOp : uint8_t { add, subtract, reverse_subtract, min, max };  // as VkBlendOp
struct BlendEquation {
    BlendFactor source = BlendFactor::one, destination = BlendFactor::zero;
    BlendOp op = BlendOp::add;
    static void fields(auto&& visit, auto&... e) {
        visit("source", e.source...);
        visit("destination", e.destination...);
        visit("op", e.op...);
    }
    friend bool operator==(const BlendEquation&, const BlendEquation&) = default;
};
struct Blend {
    BlendEquation color, alpha;
    glm::vec4 constants{};
    glm::vec4 second{};  // source colour of every fragment, if takes_second
    static void fields(auto&& visit, auto&... b) {
        visit("color", b.color...);
        visit("alpha", b.alpha...);
        visit("constants", b.constants...);
        visit("second", b.second...);
    }
    friend bool operator==(const Blend&, const Blend&) = default;
};
// Whether a factor is of the second source, also where the operation ignores factors.
constexpr bool takes_second(const Blend& blend) {
    return is_second(blend.color.source) || is_second(blend.color.destination) ||
           is_second(blend.alpha.source) || is_second(blend.alpha.destination);
}

// What becomes of the bits of a fragment's colour and of the target's.
enum class LogicOp : uint8_t {  // numbered as VkLogicOp
    clear,
    and_both,
    and_reverse,
    copy,
    and_inverted,
    no_op,
    exclusive_or,
    or_both,
    nor,
    equivalent,
    invert,
    or_reverse,
    copy_inverted,
    or_inverted,
    nand,
    set
};

// Where a fragment shader has a colour from that is no attribute. A texture is read at the draw's
// first attribute, without filtering. Its texels have one colour; `rendered` is such an image,
// which an earlier rendering cleared. Of `texels` each texel tells where it lies (texels.hpp). A
// `mask` is transparent at the left, where the attribute is below 0, and there the shader discards.
enum class ColorFrom : uint8_t {
    push_constant,
    constant,  // a specialization constant
    uniform,
    uniform_offset,  // a dynamic one
    storage,
    texture,
    rendered,
    texels,
    mask
};
constexpr bool is_texture(ColorFrom from) {
    return from >= ColorFrom::texture;
}

// What a draw writes to the colour target (Target::color).
struct ColorOutput {
    glm::vec4 value{};                          // what every fragment writes if attribute is -1
    int32_t attribute = -1;                     // else the index of the attribute that is written
    ColorFrom from = ColorFrom::push_constant;  // of value
    std::optional<Blend> blend = {};
    uint8_t write_mask = 0xf;  // bit 0: red ... bit 3: alpha
    // With one nothing is blended. Floating-point and sRGB formats are
    // written as without it.
    std::optional<LogicOp> logic = {};
    // The shader's first alpha counts as 1, before anything is blended. Integer formats are written
    // as without it.
    bool alpha_to_one = false;
    // The shader's first alpha, before that, takes samples away from the fragment. With an integer
    // format it takes none.
    bool alpha_to_coverage = false;
    static void fields(auto&& visit, auto&... c) {
        visit("value", c.value...);
        visit("attribute", c.attribute...);
        visit({"from", kNotExported}, c.from...);  // the colours are those
        visit("blend", c.blend...);
        visit("write_mask", c.write_mask...);
        visit("logic", c.logic...);
        visit("alpha_to_one", c.alpha_to_one...);
        visit("alpha_to_coverage", c.alpha_to_coverage...);
    }
    friend bool operator==(const ColorOutput&, const ColorOutput&) = default;
};
inline constexpr uint32_t kMaxColorTargets = 4;  // every device has as many outputs

// What a pass begins with (VkAttachmentLoadOp): the clear value, by a clear or as the contents that
// an earlier pass has left; what nobody knows; or those contents, which the pass does not read.
enum class LoadOp : uint8_t { clear, load, dont_care, none };
// Whether a pass keeps what it ends with. By none the contents of the earlier pass stay, as long as
// nothing is written.
enum class StoreOp : uint8_t { store, dont_care, none };
// Whether an earlier pass leaves the clear value there.
constexpr bool is_loaded(LoadOp op) {
    return op == LoadOp::load || op == LoadOp::none;
}

// One more colour attachment, judged by its stored bits.
struct ColorTarget {
    ColorFormat format = ColorFormat::rgba8_unorm;
    glm::vec4 clear{};  // as the clear colour; whole numbers for integer formats
    LoadOp load = LoadOp::clear;
    StoreOp store = StoreOp::store;
    static void fields(auto&& visit, auto&... c) {
        visit("format", c.format...);
        visit("clear", c.clear...);
        visit({"load", kNotExported}, c.load...);  // one that clears is right, too
        visit({"store", kNotExported}, c.store...);
    }
    friend bool operator==(const ColorTarget&, const ColorTarget&) = default;
};

}  // namespace cases
