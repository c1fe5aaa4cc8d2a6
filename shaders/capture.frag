// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes what a capture holds (capture/capture.hpp). No store, no atomic: additional invocations for the
// same fragment, which Vulkan allows, must not be seen.
//
// Defined by the build is only what changes capabilities or what is statically used: ATTRIBUTES (0..4),
// PROBES (interpolateAt*, derivatives), LOD (textureQueryLod), BARYCENTRICS, MASK_IN (gl_SampleMaskIn),
// SAMPLE (gl_SampleID, gl_SamplePosition), RATE (gl_ShadingRateEXT), MASK_OUT (gl_SampleMask), DISCARD, DEPTH (gl_FragDepth), COLOR (0 none, 1 float,
// 2 uint or int, 3 two sources of float, 4 several, each as float, as uint and as int), INSTRUMENTS (0: the colour output alone), SPLIT (the instruments as four small outputs), PAIRS (with them
// each attribute as two). What an attribute holds is chosen by specialization
// constants (shaders.hpp). All inputs are smooth here: Flat, NoPerspective, Centroid and Sample are
// added to the compiled module (shaders/spirv_variant.hpp), where the input at location 7 may also
// become gl_PrimitiveID.
#version 450
#if BARYCENTRICS
#extension GL_EXT_fragment_shader_barycentric : require
#endif
#if RATE
#extension GL_EXT_fragment_shading_rate : require
#endif

layout(push_constant) uniform Draw {
    // SPLIT: below 2^16, with the number of draws above. Drivers may read word 0 for all invocations
    // at once and any other once for each.
    layout(offset = 0) uint index;
    layout(offset = 16) uvec4 color;  // bits
    // Of the probes, by attribute, and gl_SampleMask: no constants of the pipeline, so that no other
    // shader has to be compiled for each value.
#if COLOR == 4
    layout(offset = 32) uvec4 other_colors[3];  // in their place
#else
    layout(offset = 32) vec2 offsets[4];
    layout(offset = 64) ivec4 sample_numbers;
#endif
    layout(offset = 80) uint sample_mask;
    layout(offset = 84) uint discarded;  // numbered as cases::Discard
    layout(offset = 88) float depth;
    layout(offset = 92) float other_depth;
    layout(offset = 96) uint other_where;  // numbered as cases::Discard
    layout(offset = 100) uint depth_is_coord;
    layout(offset = 104) uint discarded_by;  // the input whose sign discards
#if COLOR == 3
    layout(offset = 112) vec4 second;
#endif
}
draw;

layout(location = 0) flat in uint in_vertex;
layout(location = 7) flat in uint in_primitive;

#if ATTRIBUTES > 0
layout(constant_id = 0) const uint kChoice0 = 0u;
layout(location = 1) in vec4 in_attribute0;
#endif
#if ATTRIBUTES > 1
layout(constant_id = 1) const uint kChoice1 = 0u;
layout(location = 2) in vec4 in_attribute1;
#endif
#if ATTRIBUTES > 2
layout(constant_id = 2) const uint kChoice2 = 0u;
layout(location = 3) in vec4 in_attribute2;
#endif
#if ATTRIBUTES > 3
layout(constant_id = 3) const uint kChoice3 = 0u;
layout(location = 4) in vec4 in_attribute3;
#endif
#if COLOR
layout(constant_id = 4) const int kColorAttribute = -1;
#endif
#if COLOR == 4
layout(constant_id = 6) const int kColorAttribute1 = -1;
layout(constant_id = 7) const int kColorAttribute2 = -1;
layout(constant_id = 8) const int kColorAttribute3 = -1;
#endif
#if LOD
layout(set = 0, binding = 0) uniform sampler2D lod_texture;
#endif

#if INSTRUMENTS
// Who wrote, replaced, and how often, added. Ids as binary32, exact below 2^24: integer attachments
// need not support more than one sample (framebufferIntegerColorSampleCounts), and small integers as
// float bits would be denormals. Hits and the two layouts as vk_harness/target/attachments.hpp says.
#if SPLIT
layout(location = 0) out vec2 out_writer;  // draw and primitive, vertex
layout(location = 1) out vec2 out_hits;    // by front and by back faces
layout(location = 2) out vec2 out_frag_xy;
layout(location = 3) out vec2 out_frag_zw;
#define FIRST_ATTRIBUTE 4
#else
layout(constant_id = 5) const float kBackHit = 2048.0;
layout(location = 0) out vec4 out_writer_and_hits;
layout(location = 1) out vec4 out_frag_coord;
#define FIRST_ATTRIBUTE 2
#endif
#if PAIRS
#define ATTRIBUTE_WIDTH 2
#define ATTRIBUTE_OUTPUT(k)                                                    \
    layout(location = FIRST_ATTRIBUTE + 2 * k) out vec2 out_attribute##k##_xy; \
    layout(location = FIRST_ATTRIBUTE + 2 * k + 1) out vec2 out_attribute##k##_zw;
#define WRITE_ATTRIBUTE(k)                              \
    {                                                   \
        vec4 value;                                     \
        CHOOSE(in_attribute##k, kChoice##k, k, value)   \
        out_attribute##k##_xy = value.xy;               \
        out_attribute##k##_zw = value.zw;               \
    }
#else
#define ATTRIBUTE_WIDTH 1
#define ATTRIBUTE_OUTPUT(k) layout(location = FIRST_ATTRIBUTE + k) out vec4 out_attribute##k;
#define WRITE_ATTRIBUTE(k) CHOOSE(in_attribute##k, kChoice##k, k, out_attribute##k)
#endif
#if ATTRIBUTES > 0
ATTRIBUTE_OUTPUT(0)
#endif
#if ATTRIBUTES > 1
ATTRIBUTE_OUTPUT(1)
#endif
#if ATTRIBUTES > 2
ATTRIBUTE_OUTPUT(2)
#endif
#if ATTRIBUTES > 3
ATTRIBUTE_OUTPUT(3)
#endif
#define COLOR_LOCATION FIRST_ATTRIBUTE + ATTRIBUTES * ATTRIBUTE_WIDTH
#else
#define COLOR_LOCATION 0
#endif
#if COLOR == 1
layout(location = COLOR_LOCATION) out vec4 out_color;
#elif COLOR == 2
// One is left, at the first location (shaders/spirv_variant.hpp).
layout(location = COLOR_LOCATION + 1) out uvec4 out_color;
layout(location = COLOR_LOCATION + 2) out ivec4 out_signed;
#elif COLOR == 3
layout(location = COLOR_LOCATION, index = 0) out vec4 out_color;
layout(location = COLOR_LOCATION, index = 1) out vec4 out_second;
#elif COLOR == 4
// Of each three one is left, at the location of its target (shaders/spirv_variant.hpp).
layout(location = COLOR_LOCATION) out vec4 out_number0;
layout(location = COLOR_LOCATION + 1) out uvec4 out_integer0;
layout(location = COLOR_LOCATION + 2) out ivec4 out_signed0;
layout(location = COLOR_LOCATION + 3) out vec4 out_number1;
layout(location = COLOR_LOCATION + 4) out uvec4 out_integer1;
layout(location = COLOR_LOCATION + 5) out ivec4 out_signed1;
layout(location = COLOR_LOCATION + 6) out vec4 out_number2;
layout(location = COLOR_LOCATION + 7) out uvec4 out_integer2;
layout(location = COLOR_LOCATION + 8) out ivec4 out_signed2;
layout(location = COLOR_LOCATION + 9) out vec4 out_number3;
layout(location = COLOR_LOCATION + 10) out uvec4 out_integer3;
layout(location = COLOR_LOCATION + 11) out ivec4 out_signed3;
#endif

// Choices are numbered as shaders::Choice.
#if PROBES
#define PROBE_CASES(value, k, result)                                            \
    case 1u: result = interpolateAtCentroid(value); break;                    \
    case 2u: result = interpolateAtSample(value, draw.sample_numbers[k]); break; \
    case 3u: result = interpolateAtOffset(value, draw.offsets[k]); break;      \
    case 4u: result = dFdx(value); break;                                     \
    case 5u: result = dFdy(value); break;                                     \
    case 6u: result = dFdxFine(value); break;                                 \
    case 7u: result = dFdyFine(value); break;                                 \
    case 8u: result = dFdxCoarse(value); break;                               \
    case 9u: result = dFdyCoarse(value); break;                               \
    case 10u: result = fwidth(value); break;                                  \
    case 11u: result = fwidthFine(value); break;                              \
    case 12u: result = fwidthCoarse(value); break;
#else
#define PROBE_CASES(value, k, result)
#endif
#if LOD
#define LOD_CASES(value, result) \
    case 13u: result = vec4(textureQueryLod(lod_texture, value.xy), 0.0, 0.0); break;
#else
#define LOD_CASES(value, result)
#endif
#if BARYCENTRICS
#define BARYCENTRIC_CASES(result)                               \
    case 16u: result = vec4(gl_BaryCoordNoPerspEXT, 0.0); break; \
    case 17u: result = vec4(gl_BaryCoordEXT, 0.0); break;
#else
#define BARYCENTRIC_CASES(result)
#endif
#if MASK_IN
#define MASK_CASES(result) \
    case 18u: result = vec4(float(uint(gl_SampleMaskIn[0])), 0.0, 0.0, 0.0); break;
#else
#define MASK_CASES(result)
#endif
#if SAMPLE
#define SAMPLE_CASES(result)                                         \
    case 19u: result = vec4(float(gl_SampleID), 0.0, 0.0, 0.0); break; \
    case 20u: result = vec4(gl_SamplePosition, 0.0, 0.0); break;
#else
#define SAMPLE_CASES(result)
#endif
#if RATE
#define RATE_CASES(result) \
    case 21u: result = vec4(float(uint(gl_ShadingRateEXT)), 0.0, 0.0, 0.0); break;
#else
#define RATE_CASES(result)
#endif
#if PROBES || LOD || BARYCENTRICS || MASK_IN || SAMPLE || RATE
#define CHOOSE(value, choice, k, result)                                      \
    switch (choice) {                                                          \
        PROBE_CASES(value, k, result)                                          \
        LOD_CASES(value, result)                                               \
        BARYCENTRIC_CASES(result)                                              \
        MASK_CASES(result)                                                     \
        SAMPLE_CASES(result)                                                   \
        RATE_CASES(result)                                                     \
        default: result = value; break;                                        \
    }
#else
#define CHOOSE(value, choice, k, result) result = value;
#endif

#if DISCARD || DEPTH
// Whether the first component of the input that is asked for is below 0.
bool is_negative() {
    float value = 0.0;
#if ATTRIBUTES > 0 && DISCARD
    value = draw.discarded_by == 0u ? in_attribute0.x : value;
#endif
#if ATTRIBUTES > 1 && DISCARD
    value = draw.discarded_by == 1u ? in_attribute1.x : value;
#endif
#if ATTRIBUTES > 2 && DISCARD
    value = draw.discarded_by == 2u ? in_attribute2.x : value;
#endif
#if ATTRIBUTES > 3 && DISCARD
    value = draw.discarded_by == 3u ? in_attribute3.x : value;
#endif
    return value < 0.0;
}

// Whether cases::Discard of this number picks the fragment.
bool is_picked(uint which) {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    switch (which) {
        case 0u: return false;
        case 1u: return pixel.x % 2u == 1u;
        case 2u: return pixel.y % 2u == 1u;
        case 3u: return (pixel.x + pixel.y) % 2u == 1u;
        case 4u: return gl_FrontFacing;
        case 5u: return !gl_FrontFacing;
        default: return is_negative();
    }
}
#endif

#if COLOR
// An attribute, or these bits.
vec4 color_of(int which, uvec4 bits) {
    vec4 color = uintBitsToFloat(bits);
#if ATTRIBUTES > 0
    color = which == 0 ? in_attribute0 : color;
#endif
#if ATTRIBUTES > 1
    color = which == 1 ? in_attribute1 : color;
#endif
#if ATTRIBUTES > 2
    color = which == 2 ? in_attribute2 : color;
#endif
#if ATTRIBUTES > 3
    color = which == 3 ? in_attribute3 : color;
#endif
    return color;
}
#endif
#if COLOR == 4
void write_color(int which, uvec4 bits, out vec4 number, out uvec4 whole, out ivec4 signed_whole) {
    number = color_of(which, bits);
    signed_whole = which < 0 ? ivec4(bits) : ivec4(number);
    whole = which < 0 ? bits : uvec4(number);
}
#endif

void main() {
#if INSTRUMENTS
    // in_primitive is 2^32 - 2 if the device has no gl_PrimitiveID: written as -2.
#if SPLIT
    // packed_id of vk_harness/target/readback.hpp: without gl_PrimitiveID the sum wraps to 0.
    uint draws = draw.index >> 16;
    out_writer = vec2(float((in_primitive + 2u) * draws + (draw.index & 0xffffu)), float(in_vertex));
    out_hits = gl_FrontFacing ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    out_frag_xy = gl_FragCoord.xy;
    out_frag_zw = gl_FragCoord.zw;
#else
    out_writer_and_hits = vec4(float(draw.index), float(int(in_primitive)), float(in_vertex),
                               gl_FrontFacing ? 1.0 : kBackHit);
    out_frag_coord = gl_FragCoord;
#endif
#if ATTRIBUTES > 0
    WRITE_ATTRIBUTE(0)
#endif
#if ATTRIBUTES > 1
    WRITE_ATTRIBUTE(1)
#endif
#if ATTRIBUTES > 2
    WRITE_ATTRIBUTE(2)
#endif
#if ATTRIBUTES > 3
    WRITE_ATTRIBUTE(3)
#endif
#endif
#if COLOR == 4
    write_color(kColorAttribute, draw.color, out_number0, out_integer0, out_signed0);
    write_color(kColorAttribute1, draw.other_colors[0], out_number1, out_integer1, out_signed1);
    write_color(kColorAttribute2, draw.other_colors[1], out_number2, out_integer2, out_signed2);
    write_color(kColorAttribute3, draw.other_colors[2], out_number3, out_integer3, out_signed3);
#elif COLOR
    vec4 color = color_of(kColorAttribute, draw.color);
#if COLOR != 2
    out_color = color;
#if COLOR == 3
    out_second = draw.second;
#endif
#else
    out_color = kColorAttribute < 0 ? draw.color : uvec4(color);
    out_signed = kColorAttribute < 0 ? ivec4(draw.color) : ivec4(color);
#endif
#endif
#if MASK_OUT
    gl_SampleMask[0] = int(draw.sample_mask);
#endif
#if DEPTH
    gl_FragDepth = draw.depth_is_coord != 0u ? gl_FragCoord.z : is_picked(draw.other_where) ? draw.other_depth : draw.depth;
#endif
#if DISCARD
    // At the end, so that derivatives see every fragment.
    if (is_picked(draw.discarded)) {
        discard;
    }
#endif
}
