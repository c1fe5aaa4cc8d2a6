// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The SPIR-V modules that the build compiled from the GLSL beside this file.
#pragma once

#include <compare>
#include <cstdint>
#include <span>

namespace shaders {

inline constexpr uint32_t kMaxAttributes = 4;

// What capture.vert does of instances, numbered as its INSTANCED: nothing; of several
// kShownInstance alone is drawn; each has its offset, input 7, added to the position and
// DrawConstants::instance_vertices to the number of its vertices.
enum class Instances : uint8_t { one, shown, placed };

// What capture.vert, or capture.geom behind it, was compiled for. Vertex inputs: location 0
// positions, 1 + k attribute k, 5 clip distances, 6 cull distances, all vec4.
struct VertexVariant {
    uint32_t attributes = 0;                  // 0..4
    uint32_t clip_count = 0, cull_count = 0;  // 0..4, sizes of gl_ClipDistance and gl_CullDistance
    bool layer = false;                       // writes gl_Layer
    bool viewport_index = false;              // writes gl_ViewportIndex
    bool pulled = false;                      // no inputs: a storage buffer, set 1, binding 0
    Instances instances = Instances::one;
    friend auto operator<=>(const VertexVariant&, const VertexVariant&) = default;
};

// The others have their vertices beside the view volume.
inline constexpr uint32_t kShownInstance = 7;

// Components of the colour output. two_numbers: a second one for dual-source blending; integer: an
// output of unsigned and one of signed integers; several: these and one of numbers for each of four
// colour targets. Of both with_outputs() (spirv_variant.hpp) leaves those that there are.
enum class ColorKind : uint8_t { none, number, integer, two_numbers, several };

// What capture.frag was compiled for: everything that needs a capability of the device or that has
// an effect by its mere presence.
struct FragmentVariant {
    uint32_t attributes = 0;  // 0..4
    bool probes = false;      // interpolateAt*, derivatives
    bool lod = false;         // textureQueryLod: set 0, binding 0
    bool barycentrics = false;
    bool mask_in = false;
    bool sample = false;  // gl_SampleID, gl_SamplePosition: turn sample shading on
    bool rate = false;    // gl_ShadingRateEXT
    bool mask_out = false;
    bool discards = false;
    bool depth_out = false;  // gl_FragDepth
    bool split = false;      // instruments as four small outputs instead of two of four numbers
    bool pairs = false;      // split: each attribute as two outputs of two numbers
    ColorKind color = ColorKind::none;
    bool instruments = true;  // false: the colour output alone, at location 0
    friend auto operator<=>(const FragmentVariant&, const FragmentVariant&) = default;
};

// Values of the specialization constants kChoiceK of capture.frag: 0..13 are numbered as
// cases::Probe.
enum class Choice : uint32_t {
    value = 0,
    last_probe = 13,
    barycentric_linear = 16,
    barycentric = 17,
    sample_mask_in = 18,
    sample_id = 19,
    sample_position = 20,
    shading_rate = 21,
};
// Ids of the specialization constants of capture.frag: k the choice (uint) of attribute k; then the
// attribute that is the colour (-1: the push constant).
inline constexpr uint32_t kColorAttributeConstant = kMaxAttributes;
// What a back hit adds where front and back hits share a number.
inline constexpr uint32_t kBackHitConstant = kColorAttributeConstant + 1;
// ColorKind::several: as kColorAttributeConstant, of the colours behind the first.
inline constexpr uint32_t kMaxColors = 4;
inline constexpr uint32_t kOtherAttributeConstant = kBackHitConstant + 1;

// The input of capture.frag that stands for gl_PrimitiveID.
inline constexpr uint32_t kPrimitiveLocation = 7;

// Of interpolateAtOffset (pixels) and interpolateAtSample, by attribute.
struct ProbeConstants {
    float offsets[kMaxAttributes][2];
    int32_t sample_numbers[kMaxAttributes];
};

// As push constants in both stages.
struct DrawConstants {
    uint32_t index = 0;  // of the draw; FragmentVariant::split: + 2^16 * number of draws
    uint32_t layer = 0, viewport_index = 0;
    uint32_t instance_vertices = 0;  // Instances::placed
    uint32_t color[4] = {};          // bits of the colour that is written
    // Where there are several colours, which do not go with probes, the bits of those behind the
    // first.
    union {
        ProbeConstants probes = {};
        uint32_t other_colors[kMaxColors - 1][4];
    };
    uint32_t sample_mask = 0xffffffffU;  // gl_SampleMask, if the shader writes it
    uint32_t discarded = 0;              // numbered as cases::Discard, if the shader discards
    // gl_FragDepth, if the shader writes it: gl_FragCoord.z, or other_depth where that would
    // discard.
    float depth = 0, other_depth = 0;
    uint32_t other_where = 0;
    uint32_t depth_is_coord = 0;
    uint32_t discarded_by = 0;    // the input whose sign discards (Discard::negative)
    uint32_t first_instance = 0;  // Instances::placed
    float second[4] = {};         // the second colour, if the shader writes one
};
// maxPushConstantsSize is at least 128.
static_assert(sizeof(DrawConstants) == 128);

// The module of a variant; empty if the build made none of that combination.
// None of those that are pulled or instanced has both clip and cull distances.
std::span<const uint32_t> capture_vertex(const VertexVariant& variant);
// The same with positions that are multiplied by a matrix, push constants 0 to 63, of no distances
// and no routing.
std::span<const uint32_t> matrix_vertex(uint32_t attributes);
// The same of capture.geom, which has no variant with both clip and cull distances.
std::span<const uint32_t> capture_geometry(const VertexVariant& variant);
// Id of its specialization constant: 1 and 2 make strips in which the first and the last vertex of
// a triangle provokes.
inline constexpr uint32_t kStripConstant = 0;
// The same of capture.mesh, which reads vertices and triangles from a storage buffer.
std::span<const uint32_t> capture_mesh(const VertexVariant& variant);
// capture.tesc and capture.tese of 0..4 attributes.
std::span<const uint32_t> capture_control(uint32_t attributes);
std::span<const uint32_t> capture_evaluation(uint32_t attributes);
// Ids of the specialization constants of capture.tese: the vertex of a triangle that provokes, 0 or
// 2; the attributes that are flat, a bit each.
inline constexpr uint32_t kProvokingConstant = 0, kFlatConstant = 1;
std::span<const uint32_t> capture_fragment(const FragmentVariant& variant);
// bare.frag: writes one colour, which it has from `from`, numbered as cases::ColorFrom (1 to 8; of
// 5 to 7 the shader is one). Of 1 the specialization constants 0 to 3 are the colour.
std::span<const uint32_t> bare_fragment(uint32_t from);

// feedback.vert of 0..4 attributes: positions and attributes lie one behind the other in what it
// writes.
std::span<const uint32_t> feedback_vertex(uint32_t attributes);

// What a shader writes to a colour.
enum class Output : uint8_t { number, whole, signed_whole };

// clear.vert: a triangle over every target. clear.frag: writes the push constant to one of the
// colours, or to the depth.
inline constexpr uint32_t kClearLocations = 16;
std::span<const uint32_t> clear_vertex();
std::span<const uint32_t> clear_color(uint32_t location, Output output);
std::span<const uint32_t> clear_depth();

// input.frag: copies an input attachment to a buffer, of integers or of other numbers.
std::span<const uint32_t> read_input(bool is_integer, bool has_samples);
// Ids of its specialization constants: words of a sample, the kind of its components, four numbers
// of bits, four first bits.
inline constexpr uint32_t kInputWords = 0, kInputKind = 1, kInputBits = 2, kInputFirstBits = 6;

// copy_samples.comp for depth attachments, or colour attachments with `words` (1, 2 or 4) a sample.
std::span<const uint32_t> copy_samples(bool depth, uint32_t words);
// copy_samples.comp for rgba8-unorm of one sample, and for depth of one.
std::span<const uint32_t> copy_codes_of_color();
std::span<const uint32_t> copy_codes_of_depth();

// Number i of all modules, for tests; empty beyond the last.
std::span<const uint32_t> any_module(size_t i);

}  // namespace shaders
