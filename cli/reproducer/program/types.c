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

struct Code {
    const uint32_t* words;  // SPIR-V
    size_t size;            // bytes
};

struct Draw {
    VkPrimitiveTopology topology;
    VkBool32 restart;
    uint32_t vertices, count;           // count: of indices, if there are any
    uint32_t attributes, clips, culls;  // how many of each
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
// FragCoord.w, depth, then four for each attribute.
struct Writer {
    uint32_t draw, provoking_vertex, ranges;
};

// What is right at `samples` samples in a row (in the order sample, x, y).
struct Expected {
    uint32_t samples;
    uint32_t bounds;                 // index into kBounds
    uint32_t first_writer, writers;  // in kWriters; none: no triangle hits
    uint32_t first_depth, depths;    // in kRanges: depths of draws that wrote it before
    uint32_t depth_may_be_clear;
};
