// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A small case as the enumerator of histories sees it: what its fragments are is plain, or open for
// one reason that is known. Written from docs/cases.md and the Vulkan text, apart from ref and
// diff; the judge sees the same case as the text that text_of() makes of it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace histories {

// How two numbers lie to each other. A comparison is the set of relations that pass, so that its
// number is the one of VkCompareOp.
inline constexpr uint8_t kLess = 1, kEqual = 2, kGreater = 4, kAlways = 7;
inline bool is_same(double a, double b) {
    return !(a < b) && !(b < a);
}

// In the order of VkStencilOp, VkBlendFactor, VkBlendOp and VkLogicOp.
enum class StencilOp : uint8_t { keep, zero, replace, inc, dec, invert, inc_wrap, dec_wrap };
enum class Factor : uint8_t {
    zero,
    one,
    src,
    inv_src,
    dst,
    inv_dst,
    src_alpha,
    inv_src_alpha,
    dst_alpha,
    inv_dst_alpha,
    constant,
    inv_constant,
    constant_alpha,
    inv_constant_alpha,
    saturate,
    src1,
    inv_src1,
    src1_alpha,
    inv_src1_alpha
};
enum class BlendOp : uint8_t { add, subtract, reverse_subtract, min, max };

using Numbers = std::array<double, 4>;

// The triangle covers the whole target, or all of it on one side of a line through samples.
struct Shape {
    enum class Cut : uint8_t { none, x, y } cut = Cut::none;
    double edge = 0;         // pixels
    bool is_beyond = false;  // covers what has a larger coordinate than the edge
};

struct Triangle {
    Shape shape;
    bool is_reversed = false;  // second and third vertex exchanged
    // z = z0 + slope * (x - x0), in pixels: exact in binary32 at every vertex and sample.
    double z0 = 0.5, slope = 0, x0 = 0.5;
    // Shares its edge with the triangle of the same number on the other side of it; -1: with none.
    int pair = -1;
};

struct StencilFace {
    uint8_t compare = kAlways;
    StencilOp fail = StencilOp::keep, depth_fail = StencilOp::keep, pass = StencilOp::keep;
    uint32_t compare_mask = 0xff, write_mask = 0xff, reference = 0;
};

struct BlendPart {
    Factor source = Factor::one, destination = Factor::zero;
    BlendOp op = BlendOp::add;
};

// What a draw does to one colour target.
struct ColorState {
    Numbers value{};
    std::optional<std::array<BlendPart, 2>> blend;  // of colour and of alpha
    uint32_t write_mask = 15;                       // bit c lets component c be written
};

enum class Discard : uint8_t { none, odd_columns, odd_rows, checker, front, back, negative };

struct FragDepth {
    double value = 0, other = 0;
    Discard where = Discard::none;
};

enum class Query : uint8_t { none, occlusion, precise };

// Instead of a draw: what it names holds the color's value, this depth, this stencil in the
// scissor.
struct Clear {
    bool has_color = false;
    std::optional<double> depth;
    std::optional<uint32_t> stencil;
};

struct Draw {
    std::optional<Clear> clear;
    std::vector<Triangle> triangles;                 // none of a clear
    std::optional<std::array<uint32_t, 4>> scissor;  // x, y, width, height
    bool has_wide_viewport = false;  // 32 x 32 pixels about (0, 0), so that nothing is clipped
    bool culls_front = false, culls_back = false;
    bool clockwise = false;  // is the front face
    bool rasterizer_discard = false;
    uint32_t layer = 0;
    uint8_t compare = kAlways;
    bool writes_depth = true;
    std::optional<std::array<double, 2>> bounds;
    std::optional<std::array<StencilFace, 2>> stencil;  // front and back
    Discard discard = Discard::none;
    int discard_by = 0;  // kill, demote, terminate
    // Attribute "a" where discard is negative: sign * (x - zero), 0 at the centre of a column.
    double zero = 0.5, sign = 1;
    bool early = false;
    bool has_sample_shading = false;  // an invocation a sample
    std::optional<FragDepth> frag_depth;
    uint32_t sample_mask = ~0U;
    std::optional<uint32_t> shader_mask;
    std::vector<ColorState> colors;  // one a target
    Numbers constants{}, second{};
    std::optional<uint32_t> logic;  // VkLogicOp
    bool alpha_to_one = false, alpha_to_coverage = false;
    Query query = Query::none;
};

inline constexpr size_t kMaxDraws = 5;

enum class Attachments : uint8_t { all, color, color_and_depth };
enum class DepthFormat : uint8_t { d32, d24, d16 };

struct ColorFormat {
    const char* name;
    std::array<uint32_t, 4> bits;  // of each component; 0: absent
    enum class Kind : uint8_t { unorm, srgb, floating, integer } kind;
};
extern const std::array<ColorFormat, 12> kColorFormats;

struct ColorTarget {
    size_t format = 0;  // into kColorFormats
    Numbers clear{};
    const ColorFormat& about() const { return kColorFormats[format]; }
};

struct Scene {
    uint32_t width = 1, height = 1, samples = 1, layers = 1;
    Attachments attachments = Attachments::all;
    std::optional<DepthFormat> depth;  // named
    double depth_clear = 0.375;
    bool has_stencil = false;
    uint32_t stencil_clear = 0;
    std::vector<ColorTarget> colors;
    uint32_t judged = 0;
    bool has_logic = false;  // some draw combines codes bit by bit
    std::vector<Draw> draws;

    bool has_query() const {
        return std::any_of(draws.begin(), draws.end(),
                           [](const Draw& d) { return d.query != Query::none; });
    }
    bool has_instruments() const { return attachments == Attachments::all; }
    bool has_depth() const { return attachments != Attachments::color; }
    size_t sample_count() const { return size_t{width} * height * layers * samples; }
};

// Where a sample is: its pixel, number and place, in pixels.
struct Place {
    uint32_t x = 0, y = 0, layer = 0, sample = 0;
    double at_x = 0, at_y = 0;
};
// By the index that planes have: layers, rows, columns, samples.
Place place_of(const Scene& scene, size_t index);

// Framebuffer positions, as they are written to the case.
std::array<std::array<double, 2>, 3> corners_of(const Triangle& triangle);
bool is_front(const Draw& draw, const Triangle& triangle);
// Values of attribute "v", which no two triangles of a scene share.
double value_of(size_t draw, size_t triangle);

}  // namespace histories
