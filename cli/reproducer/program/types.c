// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The first part of every reproducer: what the tables behind it hold.
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <vulkan/vulkan.h>

#define INPUTS 7        // locations of vertex inputs: position, attributes 0 to 3, clip, cull
#define MOST_LINES 100  // of wrong samples that are printed
#define MOST_PLANES 10  // attachments of one drawing

struct Code {
    const uint32_t* words;  // SPIR-V
    size_t size;            // bytes
};

// Where FragCoord.xy and gl_SamplePosition may be in a pixel.
enum { AT_CENTRE = 1, AT_OWN_SAMPLE = 2, AT_ANY_SAMPLE = 4 };
// What an attribute holds that is judged by a rule of its own.
enum { INPUT = 0, SAMPLE_ID, SAMPLE_POSITION, SAMPLE_MASK, LEVEL };

struct Draw {
    VkPrimitiveTopology topology;
    VkBool32 restart;
    uint32_t vertices, count;           // count: of indices, if there are any
    uint32_t attributes, clips, culls;  // how many of each; attributes: that are judged
    uint32_t flat;                      // bit k: attribute k is compared bit for bit
    const uint32_t* inputs[INPUTS];     // bits of binary32, four a vertex; NULL: none
    const uint32_t* indices;            // NULL: none
    struct Code vertex_code, fragment_code;
    VkViewport viewport;
    VkRect2D scissor;
    VkCullModeFlags cull;
    VkFrontFace front;
    VkBool32 discard, depth_clamp, depth_write;
    VkCompareOp compare;
    VkBool32 has_bias;
    float bias[3];  // constant, clamp, slope
    uint32_t sample_mask, shader_mask;
    // What few draws have.
    VkBool32 has_sample_rate;  // the shader needs the feature sampleRateShading
    VkBool32 shades_samples;   // sampleShadingEnable
    float least_shading;       // minSampleShading
    uint32_t places;           // of FragCoord.xy
    uint32_t kinds[4];         // of attributes
    uint32_t own_only;         // bit k: attribute k is of the sample itself
    int32_t choices[5];        // specialization constants: of each attribute, and of the colour
    uint32_t colors[4];        // bits that are written where no attribute is the colour
    float offsets[4][2];       // of interpolateAtOffset
    int32_t sample_numbers[4];  // of interpolateAtSample
    uint32_t layer;             // gl_Layer of all its triangles
    uint32_t texture[2];        // size of the texture that is asked for a level of detail
    VkBool32 last_provokes, is_symmetric;     // depths from -1 to 1
    VkBool32 has_barycentrics;                // VK_KHR_fragment_shader_barycentric
    uint32_t depth_clip;                      // 0: as Vulkan has it, 1: off, 2: on
    VkPipelineColorBlendAttachmentState mix;  // of the colour target
    float mix_constants[4];
};

// A drawing of the case: as it stands, or as one that must agree with it bit for bit.
struct Drawing {
    const char* name;
    const struct Draw* draws;
    uint32_t attributes;          // attachments
    uint32_t tile[2];             // not 0: every draw is repeated under each tile's scissor
    VkBool32 other_clears;        // attachments are cleared to other values, ...
    VkBool32 other_depth_clear;   // depth, too
    uint32_t masked;              // bit 0: hits, 1: writer, 2: FragCoord, 3 + k: attribute k
    VkBool32 masks_depth, later;  // later: in a later submission
};

// How often front and back faces may hit a sample: each of the two, their difference, their sum.
struct Bounds {
    uint32_t front_min, front_max, back_min, back_max;
    int32_t signed_min, signed_max;
    uint32_t total_min, total_max;
};

// All numbers that are right for a value, from low to high; nothing is promised if low > high.
struct Range {
    float low, high;
};

// A triangle that may have written last. Its ranges begin at kRanges[ranges]: FragCoord.z,
// FragCoord.w, depth, FragCoord.z with the bias if the draw has one (which is the other answer:
// what lies between the two is wrong), then four for each attribute.
struct Writer {
    uint32_t draw, provoking_vertex, ranges;
};

// A colour that is right after `hits` fragments of which this one was the last: stored codes in
// the order of their values (code_key), from low to high. captured: 1 + the attribute that is
// the colour, where the device's own number of it decides.
struct Color {
    uint32_t hits, draw, provoking_vertex, captured;
    int64_t low[4], high[4];
};

// What is right at `samples` samples in a row (in the order sample, x, y, layer).
struct Expected {
    uint32_t samples;
    uint32_t bounds;                 // index into kBounds
    uint32_t first_writer, writers;  // in kWriters; none: no triangle hits
    uint32_t first_depth, depths;    // in kRanges: depths of draws that wrote it before
    uint32_t depth_may_be_clear;
    uint32_t first_color, colors;  // in kColors; none: nothing is promised
};
