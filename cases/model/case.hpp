// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The model of one case: what is drawn and what is claimed of it. Everything that draws or judges
// starts from this structure; how it is written in a file is the loader's business (loader.hpp).
//
// Conventions: framebuffer origin top left, x right, y down; pixel (i,j) is [i,i+1) x [j,j+1). A
// vertex's truth is its clip-space quadruple of binary32 numbers.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/base/error.hpp"
#include "cases/format/color_format.hpp"
#include "cases/format/depth_format.hpp"
#include "cases/model/relation.hpp"

namespace cases {

enum class Topology : uint8_t { triangle_list, triangle_strip, triangle_fan };
enum class CullMode : uint8_t { none, front, back, front_and_back };
enum class FrontFace : uint8_t { counter_clockwise, clockwise };
enum class Interpolation : uint8_t { smooth, noperspective, flat };
// Auxiliary storage qualifier of a fragment input: where in the pixel it is evaluated.
enum class Auxiliary : uint8_t { none, centroid, sample };
enum class ProvokingVertex : uint8_t { first, last };
enum class CompareOp : uint8_t {  // numbered as VkCompareOp
    never,
    less,
    equal,
    less_or_equal,
    greater,
    not_equal,
    greater_or_equal,
    always
};

// Where an attribute comes from.
enum class Source : uint8_t {
    vertex,           // one value a vertex
    barycentric,      // gl_BaryCoordEXT; gl_BaryCoordNoPerspEXT if noperspective; 3 components
    sample_mask_in,   // gl_SampleMaskIn[0] as a number; 1 component
    sample_id,        // gl_SampleID as a number; 1 component, turns sample shading on
    sample_position,  // gl_SamplePosition; 2 components, turns sample shading on
};
// What the fragment shader writes of an attribute from vertices.
enum class Probe : uint8_t {
    value,
    at_centroid,  // interpolateAtCentroid
    at_sample,    // interpolateAtSample(Attribute::probe_sample)
    at_offset,    // interpolateAtOffset(Attribute::probe_offset)
    dx,           // dFdx ...
    dy,
    dx_fine,
    dy_fine,
    dx_coarse,
    dy_coarse,
    width,  // fwidth ...
    width_fine,
    width_coarse,
    lod,  // textureQueryLod of a texture of Attribute::texture_size at (x, y): 2 components
};

inline constexpr float kDepthClear = 0.375F;  // unless the case says otherwise
inline constexpr uint32_t kMaxAttributes = 4;
inline constexpr uint32_t kMaxTargetSize = 16384;  // pixels a side
inline constexpr uint32_t kMaxLayers = 256;  // every device with layered rendering has as many
inline constexpr uint32_t kRestartIndex = 0xffffffffU;  // primitive restart, 32-bit indices
inline constexpr float kMaxAttributeMagnitude =
    0x1p126F;  // larger ones could look like the clear value

// As VkViewport: pixels; height may be negative; depths in [0,1].
struct Viewport {
    float x = 0, y = 0, width = 0, height = 0;
    float min_depth = 0, max_depth = 1;
    friend bool operator==(const Viewport&, const Viewport&) = default;
};

// As VkRect2D: half-open, pixels.
struct Rect {
    int32_t x = 0, y = 0;
    uint32_t width = 0, height = 0;
    friend bool operator==(const Rect&, const Rect&) = default;
};

// A fragment-shader input. values[v] belongs to vertex v; components beyond `components` are 0.
struct Attribute {
    std::string name;
    Interpolation interpolation = Interpolation::smooth;
    uint32_t components = 1;        // 1..4
    std::vector<glm::vec4> values;  // empty unless the source is vertex
    Auxiliary auxiliary = Auxiliary::none;
    Source source = Source::vertex;
    Probe probe = Probe::value;
    std::array<float, 2> probe_offset{};     // pixels from the centre; at_offset
    uint32_t probe_sample = 0;               // at_sample
    std::array<uint32_t, 2> texture_size{};  // texels, lod
    friend bool operator==(const Attribute&, const Attribute&) = default;
};

// What the unit r of a constant depth bias is (VkDepthBiasRepresentationEXT): the least step of the
// attachment's format, a constant for the whole attachment even if it is floating point, or 1.
enum class DepthBiasRepresentation { format, force_unorm, floating };

// As vkCmdSetDepthBias2EXT. constant in units of r, slope in units of the maximum depth slope,
// clamp 0: none. is_exact: a constant r is 2^-n and not scaled (depthBiasExact).
struct DepthBias {
    float constant = 0, clamp = 0, slope = 0;
    DepthBiasRepresentation representation = DepthBiasRepresentation::format;
    bool is_exact = false;
    // Whether VK_EXT_depth_bias_control is needed.
    bool is_controlled() const {
        return representation != DepthBiasRepresentation::format || is_exact;
    }
    friend bool operator==(const DepthBias&, const DepthBias&) = default;
};

// Depth state of a draw. The defaults are what the capture of single-draw cases needs: every
// fragment passes and writes.
struct DepthState {
    CompareOp compare = CompareOp::always;
    bool write = true;
    std::optional<DepthBias> bias = {};  // depthBiasEnable
    bool clamp = false;                  // depthClampEnable
    std::optional<bool> clip = {};       // VK_EXT_depth_clip_enable; nothing: !clamp
    bool negative_one_to_one = false;    // VK_EXT_depth_clip_control
    friend bool operator==(const DepthState&, const DepthState&) = default;
};

// User clip and cull distances: component k of clip[v] is gl_ClipDistance[k] of vertex v.
struct ClipDistances {
    uint32_t clip_count = 0, cull_count = 0;      // 0..4 each
    std::vector<glm::vec4> clip = {}, cull = {};  // one a vertex, or empty if the count is 0
    friend bool operator==(const ClipDistances&, const ClipDistances&) = default;
};

// Multisample state of a draw.
struct Multisample {
    uint32_t sample_mask = 0xffffffffU;            // pSampleMask
    std::optional<uint32_t> shader_mask = {};      // written to gl_SampleMask
    std::optional<float> min_sample_shading = {};  // sampleShadingEnable, minSampleShading, 0..1
    friend bool operator==(const Multisample&, const Multisample&) = default;
};

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
    src_alpha_saturate
};
enum class BlendOp : uint8_t { add, subtract, reverse_subtract, min, max };  // as VkBlendOp
struct BlendEquation {
    BlendFactor source = BlendFactor::one, destination = BlendFactor::zero;
    BlendOp op = BlendOp::add;
    friend bool operator==(const BlendEquation&, const BlendEquation&) = default;
};
struct Blend {
    BlendEquation color, alpha;
    glm::vec4 constants{};
    friend bool operator==(const Blend&, const Blend&) = default;
};

// What a draw writes to the colour target (Target::color).
struct ColorOutput {
    glm::vec4 value{};       // the same for every fragment, unless
    int32_t attribute = -1;  // index of the attribute that is written instead
    std::optional<Blend> blend = {};
    uint8_t write_mask = 0xf;  // bit 0: red ... bit 3: alpha
    friend bool operator==(const ColorOutput&, const ColorOutput&) = default;
};
// One more colour attachment, judged by its stored bits.
struct ColorTarget {
    ColorFormat format = ColorFormat::rgba8_unorm;
    glm::vec4 clear{};  // as the clear colour; whole numbers for integer formats
    friend bool operator==(const ColorTarget&, const ColorTarget&) = default;
};

// One draw command and the state it needs.
struct Draw {
    Topology topology = Topology::triangle_list;
    std::vector<glm::vec4> positions;  // clip space, binary32, bits as they reach the device
    std::optional<std::vector<uint32_t>> indices;
    bool primitive_restart = false;     // only with indices
    std::vector<Attribute> attributes;  // at most kMaxAttributes
    Viewport viewport;
    Rect scissor;  // the whole target unless the file says otherwise
    CullMode cull = CullMode::none;
    FrontFace front_face = FrontFace::counter_clockwise;
    ProvokingVertex provoking = ProvokingVertex::first;
    DepthState depth;
    ClipDistances distances;
    Multisample multisample;
    ColorOutput color;   // if the target has a colour target
    uint32_t layer = 0;  // below Target::layers; gl_Layer of all its primitives
    uint32_t viewport_index = 0;
    SourceLocation where;
};

// How the samples of a pixel become one value at the end of rendering (VkResolveModeFlagBits).
enum class Resolve : uint8_t { none, sample_zero, average, min, max };

struct Target {
    uint32_t width = 0, height = 0;  // pixels
    uint32_t samples = 1;
    uint32_t layers = 1;  // 1..kMaxLayers, all of one size
    DepthFormat depth_format = DepthFormat::d32_float;
    // Custom sample locations in 1/16 pixel, one a sample; empty: the standard ones.
    std::vector<std::array<uint8_t, 2>> sample_locations = {};
    std::optional<ColorTarget> color = {};
    // False: only the colour target (and depth if has_depth) is attached, nothing that counts hits.
    // Drivers take other paths then.
    bool has_instruments = true;
    bool has_depth = true;
    float depth_clear = kDepthClear;  // what the depth attachment is cleared to, 0..1
    // With several samples: average of numbers, sample_zero of integers; any of depth.
    Resolve color_resolve = Resolve::none, depth_resolve = Resolve::none;
    // An 8-bit stencil beside D32, cleared to 0: front faces add one, back faces subtract one,
    // modulo 256.
    bool has_stencil = false;
    // Rows of pixels of all layers, stacked: row y of layer k is row k * height + y of every plane.
    uint32_t rows() const { return height * layers; }
    friend bool operator==(const Target&, const Target&) = default;
};

// vkCmdBlitImage instead of draws. The destination is the colour target, Target::color, cleared
// first; the source is an image of its own, filled with a pattern (blit_source.hpp).
enum class BlitFilter : uint8_t { nearest, linear };
enum class BlitPattern : uint8_t {
    unique,  // every texel has other bits
    ramp,    // values grow to the right and downwards
};
// Two corners of a region in texels, in either order: x1 < x0 mirrors.
struct Corners {
    int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    friend bool operator==(const Corners&, const Corners&) = default;
};
struct Blit {
    ColorFormat source_format = ColorFormat::rgba8_unorm;
    uint32_t source_width = 0, source_height = 0;  // texels
    BlitPattern pattern = BlitPattern::unique;
    uint32_t seed = 1;
    BlitFilter filter = BlitFilter::nearest;
    Corners source, destination;  // each inside its image
    friend bool operator==(const Blit&, const Blit&) = default;
};

// A picture drawn by hand that the REFERENCE must agree with, checked before any device is asked.
// rows[j][i] is pixel (i,j): '.' no hit, '1'..'9' that many hits, '?' the reference must say that
// more than one number of hits is allowed. Judged at profile direct3d with 8 subpixel bits.
struct ExpectedHits {
    std::vector<std::string> rows;
    SourceLocation where;
};

struct Case {
    std::string id;  // path below the suite without .toml, plus ":key=value,..." for a matrix leaf
    SourceLocation where;
    std::string description;         // what is claimed
    std::string catches;             // which fault would break it; may be empty
    std::vector<std::string> rules;  // rule ids, rule.hpp
    std::vector<std::string> links;  // reports from the field
    std::vector<std::pair<std::string, std::string>> parameters;  // matrix leaf, in file order
    Target target;
    std::vector<Draw> draws;
    std::optional<Blit> blit = {};         // then there are no draws
    std::vector<Relation> relations = {};  // renderings that must have the same bits
    Variation variation = {};  // of such a rendering, derive.hpp; neither in files nor on the wire
    std::optional<ExpectedHits> expected_hits;
    std::vector<std::string> notes;  // conversions that rounded, one sentence each
};

}  // namespace cases
