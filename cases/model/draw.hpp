// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A draw: its vertices, what they carry, and the state of the pipeline that draws them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cases/base/error.hpp"
#include "cases/base/fields.hpp"
#include "cases/model/color_state.hpp"

namespace cases {

enum class Topology : uint8_t { triangle_list, triangle_strip, triangle_fan };
enum class CullMode : uint8_t { none, front, back, front_and_back };
enum class FrontFace : uint8_t { counter_clockwise, clockwise };
enum class Interpolation : uint8_t { smooth, noperspective, flat };
// Auxiliary storage qualifier of a fragment input: where in the pixel it is evaluated.
enum class Auxiliary : uint8_t { none, centroid, sample };
enum class ProvokingVertex : uint8_t { first, last };
// Which of a draw's fragments the fragment shader discards: those in every second column, row or
// both, pixel (0, 0) not among them, those of one face, or those of which the first component of an
// attribute is below 0.
enum class Discard : uint8_t { none, odd_columns, odd_rows, checker, front, back, negative };
// By which instruction: OpKill, OpDemoteToHelperInvocation or OpTerminateInvocation.
enum class DiscardBy : uint8_t { kill, demote, terminate };
// Whether a draw covers pixels by area instead of by samples: every one that a triangle touches, or
// those that it fills (VK_EXT_conservative_rasterization).
enum class Conservative : uint8_t { none, overestimate, underestimate };
// The query around a draw: one that counts its samples, or, not precise, tells only whether any
// passed; or one of pipeline statistics that counts what a stage does.
enum class Query : uint8_t {
    none,
    occlusion,
    occlusion_precise,
    input_vertices,  // the first of the statistics
    input_primitives,
    vertex_invocations,
    clipping_invocations,
    clipping_primitives,
    fragment_invocations
};
// What a fragment shader promises of the depth that it writes, beside the fragment's own.
enum class DepthLayout : uint8_t { any, greater, less, unchanged };
// How the depth test and the stencil test compare.
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
enum class StencilOp : uint8_t {  // numbered as VkStencilOp
    keep,
    zero,
    replace,
    increment_and_clamp,
    decrement_and_clamp,
    invert,
    increment_and_wrap,
    decrement_and_wrap
};

// Where an attribute comes from.
enum class Source : uint8_t {
    vertex,           // one value a vertex
    barycentric,      // gl_BaryCoordEXT; gl_BaryCoordNoPerspEXT if noperspective; 3 components
    sample_mask_in,   // gl_SampleMaskIn[0] as a number; 1 component
    sample_id,        // gl_SampleID as a number; 1 component, turns sample shading on
    sample_position,  // gl_SamplePosition; 2 components, turns sample shading on
    shading_rate,     // gl_ShadingRateEXT as a number; 1 component
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

inline constexpr uint32_t kMaxAttributes = 4;
inline constexpr uint32_t kMaxFragmentSide = 4;    // VUID-VkGraphicsPipelineCreateInfo-04500, 04501
inline constexpr float kMaxConservativeExtra = 4;  // pixels; known devices have up to 0.75
inline constexpr uint32_t kRestartIndex = 0xffffffffU;  // primitive restart, 32-bit indices
// Enough for each divisor to be met by some instances that share an element and by a last one that
// does not. Devices take far more (maxDrawIndexedIndexValue, maxVertexAttribDivisor).
inline constexpr uint32_t kMaxInstances = 16;
inline constexpr float kMaxAttributeMagnitude =
    0x1p126F;  // larger ones could look like the clear value

// As VkViewport: pixels; height may be negative; depths in [0,1].
struct Viewport {
    float x = 0, y = 0, width = 0, height = 0;
    float min_depth = 0, max_depth = 1;
    static void fields(auto&& visit, auto&... v) {
        visit("x", v.x...);
        visit("y", v.y...);
        visit("width", v.width...);
        visit("height", v.height...);
        visit("min_depth", v.min_depth...);
        visit("max_depth", v.max_depth...);
    }
    friend bool operator==(const Viewport&, const Viewport&) = default;
};

// Is laid out as VkRect2D: half-open, in pixels.
struct Rect {
    int32_t x = 0, y = 0;
    uint32_t width = 0, height = 0;
    static void fields(auto&& visit, auto&... r) {
        visit("x", r.x...);
        visit("y", r.y...);
        visit("width", r.width...);
        visit("height", r.height...);
    }
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
    // Read once for so many instances, 0: for all; nothing: at each vertex.
    std::optional<uint32_t> divisor = {};
    static void fields(auto&& visit, auto&... a) {
        visit("name", a.name...);
        visit("interpolation", a.interpolation...);
        visit("auxiliary", a.auxiliary...);
        visit("source", a.source...);
        visit("probe", a.probe...);
        visit("components", a.components...);
        visit("probe_sample", a.probe_sample...);
        visit("probe_offset", a.probe_offset...);
        visit("texture_size", a.texture_size...);
        visit({"divisor", kNotExported}, a.divisor...);  // values are those of all instances
        visit("values", a.values...);
    }
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
    static void fields(auto&& visit, auto&... b) {
        visit("constant", b.constant...);
        visit("slope", b.slope...);
        visit("clamp", b.clamp...);
        visit("representation", b.representation...);
        visit("exact", b.is_exact...);
    }
    friend bool operator==(const DepthBias&, const DepthBias&) = default;
};

// As vkCmdSetDepthBounds: what a stored depth lies in, the ends included. 0..1, min <= max.
struct DepthBounds {
    float min = 0, max = 1;
    static void fields(auto&& visit, auto&... b) {
        visit("min", b.min...);
        visit("max", b.max...);
    }
    friend bool operator==(const DepthBounds&, const DepthBounds&) = default;
};

// Depth state of a draw. The defaults are what the capture of single-draw cases needs: every
// fragment passes and writes.
struct DepthState {
    CompareOp compare = CompareOp::always;
    bool write = true;
    std::optional<DepthBias> bias = {};      // depthBiasEnable
    bool clamp = false;                      // depthClampEnable
    std::optional<bool> clip = {};           // VK_EXT_depth_clip_enable; nothing: !clamp
    bool negative_one_to_one = false;        // VK_EXT_depth_clip_control
    std::optional<DepthBounds> bounds = {};  // depthBoundsTestEnable
    static void fields(auto&& visit, auto&... d) {
        visit("compare", d.compare...);
        visit("write", d.write...);
        visit("bias", d.bias...);
        visit("clamp", d.clamp...);
        visit("clip", d.clip...);
        visit("volume", d.negative_one_to_one...);
        visit("bounds", d.bounds...);
    }
    friend bool operator==(const DepthState&, const DepthState&) = default;
};

inline constexpr uint32_t kStencilBits = 0xff;  // of the attachment

// As VkStencilOpState. Of the masks the lowest eight bits count.
struct StencilFace {
    CompareOp compare = CompareOp::always;
    StencilOp fail = StencilOp::keep, depth_fail = StencilOp::keep, pass = StencilOp::keep;
    uint32_t compare_mask = kStencilBits, write_mask = kStencilBits;
    uint32_t reference = 0;  // 0..255: any other is undefined
    static void fields(auto&& visit, auto&... f) {
        visit("compare", f.compare...);
        visit("fail", f.fail...);
        visit("depth_fail", f.depth_fail...);
        visit("pass", f.pass...);
        visit("compare_mask", f.compare_mask...);
        visit("write_mask", f.write_mask...);
        visit("reference", f.reference...);
    }
    friend bool operator==(const StencilFace&, const StencilFace&) = default;
};

// The defaults count fragments: front faces add one and back faces subtract one, modulo 256.
struct StencilState {
    StencilFace front{.pass = StencilOp::increment_and_wrap};
    StencilFace back{.pass = StencilOp::decrement_and_wrap};
    static void fields(auto&& visit, auto&... s) {
        visit("front", s.front...);
        visit("back", s.back...);
    }
    friend bool operator==(const StencilState&, const StencilState&) = default;
};

// User clip and cull distances: component k of clip[v] is gl_ClipDistance[k] of vertex v.
struct ClipDistances {
    uint32_t clip_count = 0, cull_count = 0;      // 0..4 each
    std::vector<glm::vec4> clip = {}, cull = {};  // one a vertex, or empty if the count is 0
    static void fields(auto&& visit, auto&... d) {
        visit("clip_count", d.clip_count...);
        visit("clip", d.clip...);
        visit("cull_count", d.cull_count...);
        visit("cull", d.cull...);
    }
    friend bool operator==(const ClipDistances&, const ClipDistances&) = default;
};

// Multisample state of a draw.
struct Multisample {
    uint32_t sample_mask = 0xffffffffU;            // pSampleMask
    std::optional<uint32_t> shader_mask = {};      // written to gl_SampleMask
    std::optional<float> min_sample_shading = {};  // sampleShadingEnable, minSampleShading, 0..1
    static void fields(auto&& visit, auto&... m) {
        visit("sample_mask", m.sample_mask...);
        visit("shader_mask", m.shader_mask...);
        visit("min_sample_shading", m.min_sample_shading...);
    }
    friend bool operator==(const Multisample&, const Multisample&) = default;
};

// gl_FragDepth: gl_FragCoord.z, or `value`, and of the pixels that `where` would discard `other`.
// Numbers are finite, 0 or no denormals.
struct FragDepth {
    bool is_coord = false;
    float value = 0, other = 0;
    Discard where = Discard::none;
    DepthLayout layout = DepthLayout::any;
    static void fields(auto&& visit, auto&... d) {
        visit("coord", d.is_coord...);
        visit("value", d.value...);
        visit("other", d.other...);
        visit("where", d.where...);
        visit("layout", d.layout...);
    }
    friend bool operator==(const FragDepth&, const FragDepth&) = default;
};

// vkCmdClearAttachments in place of a draw: what each named aspect holds in some rectangles inside
// the target, and in `layers` layers from Draw::layer on. Nothing of a pipeline applies to it.
struct Clear {
    std::vector<Rect> rects;  // none is empty
    uint32_t layers = 1;
    std::optional<glm::vec4> color = {};   // of the judged colour target
    std::optional<float> depth = {};       // 0..1
    std::optional<uint32_t> stencil = {};  // 0..255
    static void fields(auto&& visit, auto&... c) {
        visit("rects", c.rects...);
        visit("layers", c.layers...);
        visit("color", c.color...);
        visit("depth", c.depth...);
        visit("stencil", c.stencil...);
    }
    friend bool operator==(const Clear&, const Clear&) = default;
};

// One draw command and the state it needs.
struct Draw {
    // Then there is no draw: the rest is a triangle over the target whose state stores what the
    // clear does (clear_draw, derive.hpp).
    std::optional<Clear> clear = {};
    Topology topology = Topology::triangle_list;
    std::vector<glm::vec4> positions;  // clip space, binary32, bits as they reach the device
    // instanceCount, firstInstance. Positions, values and distances are those of all instances, one
    // behind the other: instance i has those from i * vertex_count() on. The vertex shader has
    // added its offset (instances.hpp) to the positions; none: 0 to all.
    uint32_t instances = 1, first_instance = 0;
    std::vector<glm::vec4> offsets = {};
    bool matrix = false;  // the vertex shader makes them of others by a matrix (matrix.hpp)
    std::optional<std::vector<uint32_t>> indices;
    bool primitive_restart = false;     // only with indices
    std::vector<Attribute> attributes;  // at most kMaxAttributes
    Viewport viewport;
    Rect scissor;  // the whole target unless the file says otherwise
    CullMode cull = CullMode::none;
    FrontFace front_face = FrontFace::counter_clockwise;
    ProvokingVertex provoking = ProvokingVertex::first;
    bool rasterizer_discard = false;  // rasterizerDiscardEnable: no fragment comes of it
    Conservative conservative = Conservative::none;
    float conservative_extra = 0;  // extraPrimitiveOverestimationSize, pixels; overestimate
    // Pixels that a fragment is, width and height, each 1, 2 or 4 (VK_KHR_fragment_shading_rate).
    std::array<uint32_t, 2> fragment_size{1, 1};
    Discard discard = Discard::none;  // by the fragment shader
    uint32_t discard_attribute = 0;   // Discard::negative: number of the attribute
    DiscardBy discard_by = DiscardBy::kill;
    // EarlyFragmentTests: depth and stencil are tested and stored before the fragment shader, and
    // what it discards has been stored.
    bool early_tests = false;
    std::optional<FragDepth> frag_depth = {};  // nothing: the shader writes no depth
    DepthState depth;
    StencilState stencil;  // if the target has a stencil
    ClipDistances distances;
    Multisample multisample;
    ColorOutput color;  // if the target has a colour target: of the judged one,
    std::vector<ColorOutput> other_colors = {};  // and of Target::other_colors
    Query query = Query::none;                   // around this draw alone
    uint32_t layer = 0;           // below Target::layers; gl_Layer of all its primitives
    uint32_t viewport_index = 0;  // below 16; gl_ViewportIndex of all its primitives
    SourceLocation where;
    // Of one instance.
    size_t vertex_count() const { return positions.size() / instances; }
    // What input assembly reads of one instance: indices, or vertices without them.
    size_t element_count() const { return indices ? indices->size() : vertex_count(); }
    static void fields(auto&& visit, auto&... d) {
        visit({"clear", kLeftOutIfEmpty}, d.clear...);
        visit("topology", d.topology...);
        visit("positions", d.positions...);
        visit({"matrix", kNotExported}, d.matrix...);  // the positions are those
        visit("instances", d.instances...);
        visit({"first_instance", kNotExported}, d.first_instance...);  // nor how they come about
        visit({"offsets", kNotExported}, d.offsets...);
        visit("indices", d.indices...);
        visit("primitive_restart", d.primitive_restart...);
        visit("viewport", d.viewport...);
        visit("viewport_index", d.viewport_index...);
        visit("layer", d.layer...);
        visit("scissor", d.scissor...);
        visit("cull", d.cull...);
        visit("front_face", d.front_face...);
        visit("provoking_vertex", d.provoking...);
        visit("rasterizer_discard", d.rasterizer_discard...);
        visit("conservative", d.conservative...);
        visit("conservative_extra", d.conservative_extra...);
        visit("fragment_size", d.fragment_size...);
        visit("discard", d.discard...);
        visit("discard_attribute", d.discard_attribute...);
        visit("discard_by", d.discard_by...);
        visit("early_tests", d.early_tests...);
        visit("frag_depth", d.frag_depth...);
        visit({"query", kNotExported}, d.query...);  // planes alone are delivered
        visit("depth", d.depth...);
        visit("stencil", d.stencil...);
        visit("multisample", d.multisample...);
        visit("distances", d.distances...);
        visit("color", d.color...);
        visit({"other_colors", kNotExported}, d.other_colors...);  // as Target::other_colors
        visit("attributes", d.attributes...);
        visit({"where", kNotOnWire | kNotExported}, d.where...);  // for errors
    }
};

}  // namespace cases
