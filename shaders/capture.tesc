// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A triangle as a patch that is not divided: all factors are 1. Defined by the build: ATTRIBUTES (0..4).
#version 450
layout(vertices = 3) out;

in gl_PerVertex {
    vec4 gl_Position;
}
gl_in[];
out gl_PerVertex {
    vec4 gl_Position;
}
gl_out[];

layout(location = 0) flat in uint in_vertex[];
layout(location = 0) flat out uint out_vertex[];
#define HAND_ON(k, place)                                  \
    layout(location = place) in vec4 in_attribute##k[];    \
    layout(location = place) out vec4 out_attribute##k[];
#if ATTRIBUTES > 0
HAND_ON(0, 1)
#endif
#if ATTRIBUTES > 1
HAND_ON(1, 2)
#endif
#if ATTRIBUTES > 2
HAND_ON(2, 3)
#endif
#if ATTRIBUTES > 3
HAND_ON(3, 4)
#endif

void main() {
    gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position;
    out_vertex[gl_InvocationID] = in_vertex[gl_InvocationID];
#if ATTRIBUTES > 0
    out_attribute0[gl_InvocationID] = in_attribute0[gl_InvocationID];
#endif
#if ATTRIBUTES > 1
    out_attribute1[gl_InvocationID] = in_attribute1[gl_InvocationID];
#endif
#if ATTRIBUTES > 2
    out_attribute2[gl_InvocationID] = in_attribute2[gl_InvocationID];
#endif
#if ATTRIBUTES > 3
    out_attribute3[gl_InvocationID] = in_attribute3[gl_InvocationID];
#endif
    gl_TessLevelOuter[0] = 1.0;
    gl_TessLevelOuter[1] = 1.0;
    gl_TessLevelOuter[2] = 1.0;
    gl_TessLevelInner[0] = 1.0;
}
