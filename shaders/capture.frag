// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes what a capture holds (diff/capture.hpp). No store, no atomic: additional invocations for the
// same fragment, which Vulkan allows, must not be seen. Defined by the build: ATTRIBUTES (0..4), MODE0..MODE3
// (smooth, noperspective or flat), PRIMITIVE_ID (0: the device has no gl_PrimitiveID).
#version 450

layout(push_constant) uniform Draw {
    uint index;
}
draw;

layout(location = 0) flat in uint in_vertex;
#if ATTRIBUTES > 0
layout(location = 1) MODE0 in vec4 in_attribute0;
layout(location = 3) out vec4 out_attribute0;
#endif
#if ATTRIBUTES > 1
layout(location = 2) MODE1 in vec4 in_attribute1;
layout(location = 4) out vec4 out_attribute1;
#endif
#if ATTRIBUTES > 2
layout(location = 3) MODE2 in vec4 in_attribute2;
layout(location = 5) out vec4 out_attribute2;
#endif
#if ATTRIBUTES > 3
layout(location = 4) MODE3 in vec4 in_attribute3;
layout(location = 6) out vec4 out_attribute3;
#endif

layout(location = 0) out vec4 out_hits;  // blended with ONE, ONE
// Ids as binary32, exact below 2^24: integer attachments need not support more than one sample
// (framebufferIntegerColorSampleCounts), and small integers as float bits would be denormals.
layout(location = 1) out vec4 out_writer;
layout(location = 2) out vec4 out_frag_coord;

void main() {
    out_hits = gl_FrontFacing ? vec4(1.0, 0.0, 0.0, 1.0) : vec4(0.0, 1.0, 0.0, 1.0);
#if PRIMITIVE_ID
    out_writer = vec4(float(draw.index), float(gl_PrimitiveID), float(in_vertex), -1.0);
#else
    out_writer = vec4(float(draw.index), -2.0, float(in_vertex), -1.0);
#endif
    out_frag_coord = gl_FragCoord;
#if ATTRIBUTES > 0
    out_attribute0 = in_attribute0;
#endif
#if ATTRIBUTES > 1
    out_attribute1 = in_attribute1;
#endif
#if ATTRIBUTES > 2
    out_attribute2 = in_attribute2;
#endif
#if ATTRIBUTES > 3
    out_attribute3 = in_attribute3;
#endif
}
